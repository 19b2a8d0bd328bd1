//! `cargo xtask gauntlet`: hard rooms at random, by `quasilux-gauntlet`, which is built as users
//! build quasilux, for its runs are looked at by the clock. What CI runs is built as tests are: of
//! the same crates, with checked arithmetic and the assertions of caps.

use std::path::Path;
use std::process::Command;
use xtask::workspace::Failure;

/// What CI runs: a room of each family that has shipped references, looked at after a second.
const QUICK: [&str; 3] = ["--quick", "--out", "target/gauntlet-quick"];

/// Builds the program and runs it with these options.
pub(crate) fn run(root: &Path, options: &[&str]) -> Result<(), Failure> {
    run_built(root, "release", options)
}

fn run_built(root: &Path, profile: &str, options: &[&str]) -> Result<(), Failure> {
    let mut arguments = vec!["run", "--quiet", "--profile", profile];
    arguments.extend(["--package", "quasilux-gauntlet", "--"]);
    arguments.extend(options);
    let status = Command::new("cargo").args(&arguments).current_dir(root).status();
    let status = status.map_err(|error| format!("cargo does not start: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("the gauntlet ended with {status}")) }
}

/// The short part of it.
pub(crate) fn run_quick(root: &Path) -> Result<(), Failure> {
    run_built(root, "ci", &QUICK)
}
