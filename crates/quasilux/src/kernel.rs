//! The ray kernel that the environment asks for.

use crate::exit::CliError;
use quasilux_bvh::SimdLevel;

/// Names one, for tests: no result depends on it.
const VARIABLE: &str = "QUASILUX_KERNEL";

/// Chooses the kernel that the environment names, if it names one.
///
/// # Errors
/// When this machine has none of that name.
pub(crate) fn choose() -> Result<(), CliError> {
    let Some(name) = std::env::var_os(VARIABLE).filter(|name| !name.is_empty()) else {
        return Ok(());
    };
    let name = name.to_string_lossy();
    let level = SimdLevel::named(&name).ok_or_else(|| {
        CliError::new(format!("{VARIABLE} is {name:?}; expected one of {}, or nothing", names()))
    })?;
    level.choose();
    Ok(())
}

/// Which one runs, and which this machine has.
pub(crate) fn text() -> String {
    format!("ray kernel: {}, of {} on this machine", SimdLevel::chosen().name(), names())
}

fn names() -> String {
    let names: Vec<&str> = SimdLevel::all().into_iter().map(SimdLevel::name).collect();
    names.join(", ")
}
