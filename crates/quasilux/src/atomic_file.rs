//! Files that appear whole or not at all, and are still there after a power cut.
//!
//! A file is written beside its place as `FILE.unfinished`, forced to disk, renamed into its place,
//! and then the folder is forced to disk, without which the new name may be lost.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file that is on disk, beside its place.
#[derive(Debug)]
#[must_use = "it is not in its place yet"]
pub(crate) struct Finished {
    beside: PathBuf,
    place: PathBuf,
}

/// Whether a file can be made there, by trying beside it.
pub(crate) fn try_beside(place: &Path) -> io::Result<()> {
    let beside = beside(place, "unfinished");
    File::create(&beside)?;
    fs::remove_file(beside)
}

/// Writes a file beside its place, piece by piece.
pub(crate) fn write_beside(
    place: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<Finished> {
    let beside = beside(place, "unfinished");
    let mut file = BufWriter::new(File::create(&beside)?);
    write(&mut file)?;
    let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.sync_all()?;
    Ok(Finished { beside, place: place.to_owned() })
}

impl Finished {
    /// Puts it in its place.
    pub(crate) fn publish(self) -> io::Result<()> {
        let Self { beside, place } = self;
        fs::rename(beside, &place)?;
        sync_folder(&place)
    }
}

/// The path with another ending behind its own.
pub(crate) fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

/// Forces the names of a file's folder to disk.
#[cfg(unix)]
fn sync_folder(place: &Path) -> io::Result<()> {
    let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty());
    match File::open(folder.unwrap_or(Path::new(".")))?.sync_all() {
        // Some file systems do not know how to.
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => Ok(()),
        outcome => outcome,
    }
}

/// Folders are no files there, and cannot be forced.
#[cfg(not(unix))]
fn sync_folder(_place: &Path) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_appears_when_it_is_whole() {
        let folder = std::env::temp_dir().join(format!("quasilux-whole-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let place = folder.join("file");
        let failed = write_beside(&place, |file| {
            file.write_all(b"half")?;
            Err(io::ErrorKind::StorageFull.into())
        });
        assert!(failed.is_err() && !place.exists());
        let finished = write_beside(&place, |file| file.write_all(b"whole")).unwrap();
        assert!(!place.exists());
        finished.publish().unwrap();
        assert_eq!(fs::read(&place).unwrap(), b"whole");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        try_beside(&place).unwrap();
        assert_eq!(fs::read(&place).unwrap(), b"whole");
        assert!(try_beside(&folder.join("none").join("file")).is_err());
        fs::remove_dir_all(folder).unwrap();
    }
}
