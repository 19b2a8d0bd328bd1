//! Text for stdout.

use std::io::Write;

/// Prints to stdout; a reader that has gone away is no reason to fail.
pub(crate) fn print(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}
