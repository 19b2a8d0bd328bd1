//! The scene while blinds are closed, and the schedule that says when.

use super::photometry::load_error;
use super::{Built, build};
use crate::annual::{Blinds, BlindsControl, BlindsGroup, BlindsPosition};
use crate::geometry::read_file;
use crate::project::{BlindsEntry, BlindsRule, PositionEntry, Project};
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
    let mut groups = Vec::new();
    for entry in &project.blinds {
        let control = control(project, entry, intervals, files)?;
        let mut positions = Vec::new();
        for position in &entry.positions {
            let mut again = Vec::new();
            let project = with_blinds(project, position);
            let Built { scene: room, .. } = build(&project, files, &mut again)?;
            again.retain(|warning| !warnings.contains(warning));
            warnings.extend(again);
            positions.push(BlindsPosition { name: position.name.clone(), room });
        }
        groups.push(BlindsGroup { name: entry.name.clone(), positions, control });
    }
    Ok((!groups.is_empty()).then_some(Blinds { groups }))
}

fn control(
    project: &Project,
    entry: &BlindsEntry,
    intervals: usize,
    files: &dyn Files,
) -> Result<BlindsControl, LoadError> {
    Ok(match &entry.rule {
        BlindsRule::Sunlight { sensor } => BlindsControl::Sunlight {
            sensor: sensor.as_ref().map(|name| project.sensor_number(name)).transpose()?,
        },
        BlindsRule::Schedule { file, column } => {
            let bytes = read_file(project, file, files, FileKind::Schedule)?;
            let names = entry.positions.iter().map(|position| position.name.as_str());
            let names: Vec<&str> = ["open"].into_iter().chain(names).collect();
            let positions = read_schedule(&bytes, &column.value, &names, intervals)
                .map_err(|error| load_error(&file.value, &error))?;
            BlindsControl::Schedule { positions }
        }
    })
}

/// The project of the room with blinds in a position.
fn with_blinds(project: &Project, position: &PositionEntry) -> Project {
    let mut room = Project { blinds: Vec::new(), ..project.clone() };
    room.geometry.extend(position.geometry.iter().cloned());
    let is_new =
        |name: &Spanned<String>| position.materials.iter().all(|it| it.name.value != name.value);
    room.materials.retain(|material| is_new(&material.name));
    room.materials.extend(position.materials.iter().cloned());
    room
}

/// The column of a CSV file with a line of names and one for each interval: the number of one of
/// the positions, from 0 for open, or its name.
fn read_schedule(
    bytes: &[u8],
    column: &str,
    positions: &[&str],
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
        let by_number = cell.parse().ok().filter(|number| *number < positions.len());
        let number = by_number.or_else(|| positions.iter().position(|name| *name == cell));
        scheduled.push(number.ok_or_else(|| {
            let all = (0..).zip(positions).map(|(number, name)| format!("{number} ({name})"));
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
