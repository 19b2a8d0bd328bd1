//! Names of estimators, sequences and randomisations, known and to come.

use crate::exit::Refusal;
use quasilux_scene::{LoadError, Placed, SimulationSection, nearest};

/// Names that the design promises and this version lacks.
const NOT_BUILT: [&str; 4] = ["halton", "hammersley", "rotation", "rank1"];

/// The value that a name given on the command line stands for; `what` says where it was given.
pub(crate) fn on_command_line<T: Copy>(
    what: &str,
    name: &str,
    known: &[(&str, T)],
) -> Result<T, Refusal> {
    if let Some((_, value)) = known.iter().find(|(other, _)| *other == name) {
        return Ok(*value);
    }
    if NOT_BUILT.contains(&name) {
        return Err(Refusal::not_built(format!("{what} {name}")));
    }
    let list: Vec<&str> = known.iter().map(|(other, _)| *other).collect();
    let nearest = nearest(name, list.iter().copied())
        .map(|nearest| format!(", did you mean \"{nearest}\""))
        .unwrap_or_default();
    let list = list.join(", ");
    Err(Refusal::new(format!("{what}: unknown name \"{name}\"{nearest}; expected {list}")))
}

/// The value that a name in a project file stands for.
pub(crate) fn in_project<T: Copy>(
    section: &SimulationSection,
    key: &str,
    name: &Placed<String>,
    known: &[(&str, T)],
) -> Result<T, LoadError> {
    if let Some((_, value)) = known.iter().find(|(other, _)| *other == name.value) {
        return Ok(*value);
    }
    if NOT_BUILT.contains(&name.value.as_str()) {
        return Err(section.error_at(name, format!("{key} = \"{}\" is not built yet", name.value)));
    }
    let list: Vec<&str> = known.iter().map(|(other, _)| *other).collect();
    Err(section.unknown_name(name, key, &list))
}
