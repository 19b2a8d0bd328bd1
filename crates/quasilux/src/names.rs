//! Names of estimators, sequences and randomisations.

use crate::exit::CliError;
use quasilux_sampling::Sequence;
use quasilux_scene::{LoadError, SimulationSection, Spanned, nearest};

/// The sequences by name. Without the number of points those that need it are left out.
pub(crate) fn sequences(points: Option<u64>) -> Vec<(&'static str, Sequence)> {
    let all =
        points.map_or_else(|| Sequence::ALL.to_vec(), |points| Sequence::all_for(points).to_vec());
    all.into_iter().map(|sequence| (sequence.name(), sequence)).collect()
}

/// Why a known name is not in a list of sequences.
fn lacks_points(name: &str) -> Option<String> {
    let needs = Sequence::all_for(0).into_iter().filter(|kind| kind.points().is_some());
    needs
        .map(Sequence::name)
        .find(|known| *known == name)
        .map(|name| format!("{name} must know the number of points ahead: give --samples"))
}

/// The value that a name given on the command line stands for; `what` says where it was given.
pub(crate) fn on_command_line<T: Copy>(
    what: &str,
    name: &str,
    known: &[(&str, T)],
) -> Result<T, CliError> {
    if let Some((_, value)) = known.iter().find(|(other, _)| *other == name) {
        return Ok(*value);
    }
    if let Some(reason) = lacks_points(name) {
        return Err(CliError::new(format!("{what}: {reason}")));
    }
    let list: Vec<&str> = known.iter().map(|(other, _)| *other).collect();
    let nearest = nearest(name, list.iter().copied())
        .map(|nearest| format!(", did you mean \"{nearest}\""))
        .unwrap_or_default();
    let list = list.join(", ");
    Err(CliError::new(format!("{what}: unknown name \"{name}\"{nearest}; expected {list}")))
}

/// The value that a name in a project file stands for; `None` without a name.
pub(crate) fn in_project<T: Copy>(
    section: &SimulationSection,
    key: &str,
    name: &Option<Spanned<String>>,
    known: &[(&str, T)],
) -> Result<Option<T>, LoadError> {
    let Some(name) = name else {
        return Ok(None);
    };
    if let Some((_, value)) = known.iter().find(|(other, _)| *other == name.value) {
        return Ok(Some(*value));
    }
    if let Some(reason) = lacks_points(&name.value) {
        return Err(section.error_at(name, format!("{key}: {reason}")));
    }
    let list: Vec<&str> = known.iter().map(|(other, _)| *other).collect();
    Err(section.unknown_name(name, key, &list))
}
