//! Schedules: a column of a CSV file that says something of each interval of the weather file.

use super::photometry::load_error;
use crate::geometry::read_file;
use crate::project::Project;
use crate::{FileKind, Files, LoadError, Spanned};
use quasilux_text::{
    ParseError, Position, TextWarning, Warnings, decode, lines, quoted, refuse_web_page,
};

/// Column of a schedule, and the meaning of what is in it.
pub(super) struct Scheduled<'s> {
    pub(super) file: &'s Spanned<String>,
    pub(super) column: &'s Spanned<String>,
    /// Names that stand for the numbers from 0 on.
    pub(super) names: &'s [&'s str],
    /// Of the weather file.
    pub(super) intervals: usize,
}

impl Scheduled<'_> {
    /// The number of each interval.
    pub(super) fn read(
        &self,
        project: &Project,
        files: &dyn Files,
    ) -> Result<Vec<usize>, LoadError> {
        let bytes = read_file(project, self.file, files, FileKind::Schedule)?;
        read_schedule(&bytes, &self.column.value, self.names, self.intervals)
            .map_err(|error| load_error(&self.file.value, &error))
    }
}

/// The column of a CSV file with a line of names and one for each interval: the number of one of
/// these names, from 0 on, or the name.
fn read_schedule(
    bytes: &[u8],
    column: &str,
    names: &[&str],
    intervals: usize,
) -> Result<Vec<usize>, ParseError> {
    refuse_web_page(bytes)?;
    let mut warnings: Warnings<TextWarning> = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let mut rows = (1..).zip(lines(&text)).filter(|(_, row)| !row.trim().is_empty());
    let (_, head) = rows.next().unwrap_or((1, ""));
    let Some(number) = head.split(',').position(|name| name.trim() == column) else {
        let expected = format!("a line of names with \"{column}\"");
        return Err(ParseError::new(Position::START, quoted(head), expected));
    };
    let mut scheduled = Vec::new();
    let mut last = 1;
    for (line, row) in rows.by_ref().take(intervals + 1) {
        last = line;
        let cells = row.split(',').scan(1, |start, cell| {
            let column = *start;
            *start += cell.chars().count() + 1;
            Some((column, cell.trim()))
        });
        let end = (row.chars().count() + 1, "");
        let (at, cell) = cells.clone().nth(number).unwrap_or(end);
        let by_number = cell.parse().ok().filter(|number| *number < names.len());
        let number = by_number.or_else(|| names.iter().position(|name| *name == cell));
        scheduled.push(number.ok_or_else(|| {
            let all = (0..).zip(names).map(|(number, name)| format!("{number} ({name})"));
            let expected = all.collect::<Vec<_>>().join(" or ");
            ParseError::new(Position { line, column: at }, quoted(cell), expected)
        })?);
    }
    if scheduled.len() != intervals {
        let found = match scheduled.len() {
            more if more > intervals => "another line".to_owned(),
            fewer => format!("{fewer} lines and the end of the file"),
        };
        let expected = format!("{intervals} lines, one for each interval of the weather file");
        return Err(ParseError::new(Position { line: last, column: 1 }, found, expected));
    }
    Ok(scheduled)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schedules_are_read_by_their_column() {
        let names = ["open", "half", "closed"];
        let read = |text: &str, intervals| read_schedule(text.as_bytes(), "b", &names, intervals);
        assert_eq!(read("a,b\n7,1\n8, 0\n\n", 2), Ok(vec![1, 0]));
        assert_eq!(read("b\r\nopen\r\nclosed\r\n2\n", 3), Ok(vec![0, 2, 2]));
        let message = |text, intervals| {
            let error = read(text, intervals).unwrap_err();
            format!("{}:{}: {}", error.line(), error.column(), error.message())
        };
        for (text, place, words) in [
            ("a,c\n7,1\n", "1:1", "a line of names with \"b\""),
            ("", "1:1", "a line of names with \"b\""),
            ("a,b\n7,1\n8,shut\n", "3:3", "0 (open) or 1 (half) or 2 (closed)"),
            ("a,b\n7,1\n8\n", "3:2", "0 (open) or 1 (half) or 2 (closed)"),
            ("a,b\n7,3\n8,0\n", "2:3", "2 (closed)"),
            ("a,b\n7,1\n", "2:1", "2 lines, one for each interval"),
            ("a,b\n7,1\n7,1\n7,1\n7,1\n", "4:1", "another line"),
        ] {
            let message = message(text, 2);
            assert!(message.starts_with(place) && message.contains(words), "{message}");
        }
    }
}
