//! Where the workspace is, and what a command says that fails.

use std::path::{Path, PathBuf};

/// A failure, told to the person at the terminal.
pub type Failure = String;

/// The folder of the workspace's `Cargo.toml`.
#[must_use]
pub fn root() -> PathBuf {
    let xtask = Path::new(env!("CARGO_MANIFEST_DIR"));
    xtask.parent().unwrap_or(xtask).to_path_buf()
}
