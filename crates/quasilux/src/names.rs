//! Names of estimators, sequences and other settings out of closed sets.

use crate::exit::CliError;
use quasilux_sampling::Sequence;
use quasilux_scene::{LoadError, SimulationSection, Spanned, nearest};

/// The sequences that can be named. Without the number of points those that need it are left out.
pub(crate) fn sequences(points: Option<u64>) -> Vec<Sequence> {
    points.map_or_else(|| Sequence::ALL.to_vec(), |points| Sequence::all_for(points).to_vec())
}

/// The one of `known` that a name given on the command line stands for; `what` says where it was
/// given.
pub(crate) fn on_command_line<T: Copy>(
    what: &str,
    name: &str,
    known: &[T],
    name_of: fn(T) -> &'static str,
) -> Result<T, CliError> {
    if let Some(value) = find(name, known, name_of) {
        return Ok(value);
    }
    if let Some(reason) = why_unknown(name) {
        return Err(CliError::new(format!("{what}: {reason}")));
    }
    let list: Vec<&str> = known.iter().copied().map(name_of).collect();
    let nearest = nearest(name, list.iter().copied())
        .map(|nearest| format!("; did you mean \"{nearest}\"?"))
        .unwrap_or_default();
    let list = list.join(", ");
    Err(CliError::new(format!("{what}: unknown name \"{name}\"; expected one of {list}{nearest}")))
}

/// Takes over the one of `known` that a name in a project file stands for, if there is a name;
/// `what` says what it names.
pub(crate) fn take_from_project<T: Copy>(
    setting: &mut T,
    section: &SimulationSection,
    name: &Option<Spanned<String>>,
    what: &str,
    known: &[T],
    name_of: fn(T) -> &'static str,
) -> Result<(), LoadError> {
    let Some(name) = name else {
        return Ok(());
    };
    if let Some(value) = find(&name.value, known, name_of) {
        *setting = value;
        return Ok(());
    }
    if let Some(reason) = why_unknown(&name.value) {
        return Err(section.error_at(name, format!("{what}: {reason}")));
    }
    let list: Vec<&str> = known.iter().copied().map(name_of).collect();
    Err(section.unknown_name(name, what, &list))
}

fn find<T: Copy>(name: &str, known: &[T], name_of: fn(T) -> &'static str) -> Option<T> {
    known.iter().copied().find(|value| name_of(*value) == name)
}

/// Why a name that users may know is not in a list.
fn why_unknown(name: &str) -> Option<String> {
    let is_gone = name == "selected";
    let gone = is_gone.then(|| "\"selected\" is gone: \"auto\" does what it chose from".to_owned());
    gone.or_else(|| lacks_points(name))
}

/// Why a known name is not in a list of sequences.
fn lacks_points(name: &str) -> Option<String> {
    let sequence = find(name, &Sequence::all_for(0), Sequence::name)?;
    sequence
        .points()
        .map(|_| format!("{name} needs the number of points in advance: give --samples"))
}
