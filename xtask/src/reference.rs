//! The tables of `docs/project-reference.md`, which the program prints: `quasilux keys`. A test of
//! the program says whether they are up to date.

use crate::documents::commands;
use std::path::Path;
use xtask::workspace::Failure;

const PAGE: &str = "docs/project-reference.md";
/// The line before the tables.
const MARK: &str = "<!-- From here on: cargo xtask reference -->\n";

/// Writes the tables anew, below what the page says first.
pub(crate) fn write(root: &Path) -> Result<(), Failure> {
    let path = root.join(PAGE);
    let wrong = |error: std::io::Error| format!("{}: {error}", path.display());
    let page = std::fs::read_to_string(&path).map_err(wrong)?;
    let (head, _) = page.split_once(MARK).ok_or_else(|| format!("{PAGE} lacks {MARK}"))?;
    let program = commands::build(root)?;
    let tables = commands::output(&program, root, &["keys", "--markdown"].map(str::to_owned))?;
    std::fs::write(&path, format!("{head}{MARK}{tables}")).map_err(wrong)?;
    println!("xtask: wrote {}", path.display());
    Ok(())
}
