//! Files that appear whole or not at all, and are still there after a power cut.
//!
//! A file is written beside its place as `FILE.unfinished`, forced to disk, renamed into its place,
//! and then the folder is forced to disk, without which the new name may be lost. What is no
//! regular file, like a device or a pipe, keeps its place: bytes are written into it. A link to a
//! file stays a link.

mod device;

use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A file that is on disk, beside its place, or bytes that went where they were to go.
#[derive(Debug)]
#[must_use = "it is not in its place yet"]
pub(crate) struct Finished(Option<Beside>);

/// A file beside its place.
#[derive(Debug)]
struct Beside {
    beside: PathBuf,
    place: PathBuf,
    _locked: File,
}

/// Whether a file can be made there, by trying beside it.
pub(crate) fn try_beside(place: &Path) -> io::Result<()> {
    if is_device(place) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "is not a regular file"));
    }
    let beside = beside(&behind_links(place), "unfinished");
    create_new(&beside)?;
    fs::remove_file(beside)
}

/// Makes a file that is there for this process alone. What a run left that was killed makes room;
/// what another is writing, or is no file, does not: nothing behind a link or a pipe is touched.
fn create_new(path: &Path) -> io::Result<File> {
    let file = match File::create_new(path) {
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
            if !fs::symlink_metadata(path)?.is_file() {
                let message = format!("{} is in the way", path.display());
                return Err(io::Error::new(io::ErrorKind::AlreadyExists, message));
            }
            if let Err(TryLockError::WouldBlock) = File::open(path)?.try_lock() {
                let message = format!("another run is writing {}", path.display());
                return Err(io::Error::new(io::ErrorKind::ResourceBusy, message));
            }
            fs::remove_file(path)?;
            File::create_new(path)?
        }
        created => created?,
    };
    // A file system without locks leaves it unlocked.
    _ = file.try_lock();
    Ok(file)
}

/// Writes a file beside its place, piece by piece.
pub(crate) fn write_beside(
    place: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<Finished> {
    if is_device(place) {
        let mut device = BufWriter::new(device::open(place)?);
        write(&mut device)?;
        device.flush()?;
        return Ok(Finished(None));
    }
    let place = behind_links(place);
    let beside = beside(&place, "unfinished");
    let file = create_new(&beside)?;
    let written = write_to(file, write);
    if written.is_err() {
        // Half a file is of no use, and may take the last of a disk.
        _ = fs::remove_file(&beside);
    }
    written.map(|file| Finished(Some(Beside { beside, place, _locked: file })))
}

/// The file, whole and on disk.
fn write_to(
    file: File,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<File> {
    let mut file = BufWriter::new(file);
    write(&mut file)?;
    let file = file.into_inner().map_err(io::IntoInnerError::into_error)?;
    file.sync_all()?;
    Ok(file)
}

impl Finished {
    /// Puts it in its place.
    pub(crate) fn publish(self) -> io::Result<()> {
        let Self(Some(Beside { beside, place, _locked })) = self else { return Ok(()) };
        fs::rename(beside, &place)?;
        sync_folder(&place)
    }
}

/// Whether something is there that is neither file nor folder.
fn is_device(place: &Path) -> bool {
    fs::metadata(place).is_ok_and(|there| !there.is_file() && !there.is_dir())
}

/// The file that a link leads to; the path itself where there is none.
fn behind_links(place: &Path) -> PathBuf {
    let is_link = fs::symlink_metadata(place).is_ok_and(|there| there.is_symlink());
    let target = if is_link { place.canonicalize().ok() } else { None };
    target.unwrap_or_else(|| place.to_owned())
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
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1, "half a file is left");
        try_beside(&place).unwrap();
        assert_eq!(fs::read(&place).unwrap(), b"whole");
        assert!(try_beside(&folder.join("none").join("file")).is_err());
        fs::remove_dir_all(folder).unwrap();
    }

    /// A killed run leaves a file, a running one holds it, and others put links and pipes there.
    #[cfg(unix)]
    #[test]
    fn what_stands_beside_a_file_is_its_own() {
        use std::os::unix::fs::symlink;
        let folder = std::env::temp_dir().join(format!("quasilux-beside-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let place = folder.join("file");
        let unfinished = folder.join("file.unfinished");
        let write = || write_beside(&place, |file| file.write_all(b"new"))?.publish();
        fs::write(&unfinished, b"half").unwrap();
        write().unwrap();
        assert_eq!(fs::read(&place).unwrap(), b"new");
        let held = write_beside(&place, |file| file.write_all(b"other")).unwrap();
        assert_eq!(write().unwrap_err().kind(), io::ErrorKind::ResourceBusy);
        held.publish().unwrap();
        assert_eq!(fs::read(&place).unwrap(), b"other");
        fs::write(folder.join("mine"), b"mine").unwrap();
        for target in ["mine", "none"] {
            symlink(target, &unfinished).unwrap();
            assert!(write().unwrap_err().to_string().contains("file.unfinished is in the way"));
            fs::remove_file(&unfinished).unwrap();
        }
        assert_eq!(fs::read(folder.join("mine")).unwrap(), b"mine");
        // A pipe without a reader would wait for ever.
        let made = std::process::Command::new("mkfifo").arg(&unfinished).status().unwrap();
        assert!(made.success());
        assert!(write().is_err() && try_beside(&place).is_err());
        assert_eq!(fs::read(&place).unwrap(), b"other");
        fs::remove_dir_all(folder).unwrap();
    }

    /// As a user who may: a rename would put a file in the place of the device.
    #[cfg(unix)]
    #[test]
    fn devices_and_links_keep_their_places() {
        use std::os::unix::fs::{FileTypeExt, symlink};
        let folder = std::env::temp_dir().join(format!("quasilux-links-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        for name in ["null", "full"] {
            symlink(Path::new("/dev").join(name), folder.join(name)).unwrap();
        }
        fs::write(folder.join("file"), b"old").unwrap();
        symlink("file", folder.join("link")).unwrap();
        let write =
            |name: &str| write_beside(&folder.join(name), |file| file.write_all(b"new"))?.publish();
        write("null").unwrap();
        write("link").unwrap();
        assert_eq!(write("full").unwrap_err().kind(), io::ErrorKind::StorageFull);
        assert!(fs::metadata(folder.join("full")).unwrap().file_type().is_char_device());
        assert_eq!(fs::read(folder.join("file")).unwrap(), b"new");
        assert!(fs::symlink_metadata(folder.join("link")).unwrap().is_symlink());
        assert!(try_beside(&folder.join("null")).is_err());
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 4);
        fs::remove_dir_all(folder).unwrap();
    }
}
