//! Files that are committed and written by a generator.

use std::path::Path;
use xtask::workspace::Failure;

/// Name below a folder, and content.
pub(crate) type File = (String, String);

/// Writes the files of a folder.
pub(crate) fn write(folder: &Path, files: &[File]) -> Result<(), Failure> {
    for (name, content) in files {
        let path = folder.join(name);
        std::fs::write(&path, content).map_err(|error| format!("{}: {error}", path.display()))?;
        println!("xtask: wrote {}", path.display());
    }
    Ok(())
}

/// Whether the committed files of a folder are those that the generator writes.
///
/// # Panics
/// Where one differs, or is not there.
#[cfg(test)]
pub(crate) fn assert_committed(folder: &Path, files: &[File], command: &str) {
    for (name, content) in files {
        let committed = std::fs::read(folder.join(name));
        assert!(
            committed.is_ok_and(|committed| committed == content.as_bytes()),
            "{name} differs from its generator: run `cargo xtask {command}`"
        );
    }
}
