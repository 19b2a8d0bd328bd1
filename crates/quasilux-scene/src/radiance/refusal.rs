//! Refusal of programs, none of which is started.

use super::document::shown;

/// The refusal of a program.
pub(super) fn not_run(name: &str) -> String {
    format!(
        "the command \"{}\" is not run: no program is started for a scene; run it, save what it \
         prints as a file, and name that by !xform in its place",
        shown(name)
    )
}
