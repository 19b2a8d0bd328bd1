//! The scene while blinds are closed, and the schedule that says when.

use super::photometry::load_error;
use super::{Built, build};
use crate::annual::{Blinds, BlindsControl};
use crate::geometry::read_file;
use crate::project::{BlindsEntry, BlindsRule, Project};
use crate::{FileKind, Files, LoadError, Spanned, Warning};
use quasilux_text::{
    ParseError, Position, TextWarning, Warnings, decode, lines, quoted, refuse_web_page,
};

/// `None` where a project has none. `intervals` are those of its weather file.
pub(super) fn hang(
    project: &Project,
    intervals: usize,
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Blinds>, LoadError> {
    let Some(entry) = &project.blinds else { return Ok(None) };
    let control = match &entry.rule {
        BlindsRule::Sunlight { sensor } => BlindsControl::Sunlight {
            sensor: sensor.as_ref().map(|name| project.sensor_number(name)).transpose()?,
        },
        BlindsRule::Schedule { file, column } => {
            let bytes = read_file(project, file, files, FileKind::Schedule)?;
            let is_closed = read_schedule(&bytes, &column.value, intervals)
                .map_err(|error| load_error(&file.value, &error))?;
            BlindsControl::Schedule { is_closed }
        }
    };
    let mut again = Vec::new();
    let Built { scene: closed, .. } = build(&with_blinds(project, entry), files, &mut again)?;
    again.retain(|warning| !warnings.contains(warning));
    warnings.extend(again);
    Ok(Some(Blinds { closed, control }))
}

/// The project of the room with closed blinds.
fn with_blinds(project: &Project, entry: &BlindsEntry) -> Project {
    let mut closed = Project { blinds: None, ..project.clone() };
    closed.geometry.extend(entry.geometry.iter().cloned());
    let is_new =
        |name: &Spanned<String>| entry.materials.iter().all(|it| it.name.value != name.value);
    closed.materials.retain(|material| is_new(&material.name));
    closed.materials.extend(entry.materials.iter().cloned());
    closed
}

/// The column of a CSV file with a line of names and one for each interval: 1 while they are
/// closed, 0 while they are open.
fn read_schedule(bytes: &[u8], column: &str, intervals: usize) -> Result<Vec<bool>, ParseError> {
    refuse_web_page(bytes)?;
    let mut warnings: Warnings<TextWarning> = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let mut rows = (1..).zip(lines(&text)).filter(|(_, row)| !row.trim().is_empty());
    let (_, head) = rows.next().unwrap_or((1, ""));
    let Some(number) = head.split(',').position(|name| name.trim() == column) else {
        let expected = format!("a line of names with \"{column}\"");
        return Err(ParseError::new(Position::START, quoted(head), expected));
    };
    let mut is_closed = Vec::new();
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
        is_closed.push(match cell {
            "0" => false,
            "1" => true,
            _ => {
                let position = Position { line, column: at };
                return Err(ParseError::new(position, quoted(cell), "0 (open) or 1 (closed)"));
            }
        });
    }
    if is_closed.len() != intervals {
        let found = match is_closed.len() {
            more if more > intervals => "another line".to_owned(),
            fewer => format!("{fewer} lines and the end of the file"),
        };
        let expected = format!("{intervals} lines, one for each interval of the weather file");
        return Err(ParseError::new(Position { line: last, column: 1 }, found, expected));
    }
    Ok(is_closed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn schedules_are_read_by_their_column() {
        let read = |text: &str, intervals| read_schedule(text.as_bytes(), "b", intervals);
        assert_eq!(read("a,b\n7,1\n8, 0\n\n", 2), Ok(vec![true, false]));
        assert_eq!(read("b\r\n0\r\n", 1), Ok(vec![false]));
        let message = |text, intervals| {
            let error = read(text, intervals).unwrap_err();
            format!("{}:{}: {}", error.line(), error.column(), error.message())
        };
        for (text, place, words) in [
            ("a,c\n7,1\n", "1:1", "a line of names with \"b\""),
            ("", "1:1", "a line of names with \"b\""),
            ("a,b\n7,1\n8,closed\n", "3:3", "0 (open) or 1 (closed)"),
            ("a,b\n7,1\n8\n", "3:2", "0 (open) or 1 (closed)"),
            ("a,b\n7,1\n", "2:1", "2 lines, one for each interval"),
            ("a,b\n7,1\n7,1\n7,1\n7,1\n", "4:1", "another line"),
        ] {
            let message = message(text, 2);
            assert!(message.starts_with(place) && message.contains(words), "{message}");
        }
    }
}
