//! The rooms that blinds make of a scene.

use super::measured::Sources;
use super::schedule::Scheduled;
use super::{Built, build};
use crate::annual::{Blinds, BlindsControl, BlindsGroup, BlindsPosition};
use crate::project::{BlindsEntry, BlindsRule, PositionEntry, Project};
use crate::{Files, LoadError, Spanned, Warning};

/// `None` where a project has none. `intervals` are those of its weather file.
pub(super) fn hang(
    project: &Project,
    intervals: usize,
    sources: &mut Sources<'_>,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Blinds>, LoadError> {
    let mut groups = Vec::new();
    for entry in &project.blinds {
        let control = control(project, entry, intervals, sources.files)?;
        let mut positions = Vec::new();
        for position in &entry.positions {
            let mut again = Vec::new();
            let project = with_blinds(project, position);
            let Built { scene: room, .. } = build(&project, sources, &mut again)?;
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
            let names = entry.positions.iter().map(|position| position.name.as_str());
            let names: Vec<&str> = ["open"].into_iter().chain(names).collect();
            let what = Scheduled { file, column, names: &names, intervals };
            BlindsControl::Schedule { positions: what.read(project, files)? }
        }
    })
}

/// The project of the room with blinds in a position.
fn with_blinds(project: &Project, position: &PositionEntry) -> Project {
    let mut room = project.clone();
    room.geometry.extend(position.geometry.iter().cloned());
    let is_new =
        |name: &Spanned<String>| position.materials.iter().all(|it| it.name.value != name.value);
    room.materials.retain(|material| is_new(&material.name));
    room.materials.extend(position.materials.iter().cloned());
    room
}
