//! Results on disk: a document, a spreadsheet for each sensor, a picture for each grid, three for
//! each camera.

use crate::atomic_file;
use crate::exit::CliError;
use quasilux_report::{
    CameraReport, PictureOf, Report, SensorReport, camera_false_colour_png, csv, exr,
    false_colour_png, json, tone_mapped_png,
};
use std::fs::{File, TryLockError};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Makes sure that results can be written to `folder` before anything is computed.
pub(crate) fn prepare(folder: &Path) -> Result<(), CliError> {
    std::fs::create_dir_all(folder).map_err(|error| cannot_write(folder, &error))
}

/// A folder of results that no other run may write to while this lives: files of two runs would be
/// mixed there.
#[derive(Debug)]
pub(crate) struct Claim {
    /// Locked, where the system can lock folders; the end of the process unlocks it.
    _folder: Option<File>,
}

/// Makes a folder before anything is computed, and keeps other runs out of it.
pub(crate) fn claim(folder: &Path) -> Result<Claim, CliError> {
    prepare(folder)?;
    let Ok(opened) = File::open(folder) else { return Ok(Claim { _folder: None }) };
    if let Err(TryLockError::WouldBlock) = opened.try_lock() {
        let message =
            "another run writes its results there; give this one a folder of its own by --out";
        return Err(CliError::in_file(folder.display(), None, message));
    }
    Ok(Claim { _folder: Some(opened) })
}

/// A file of results, not made yet.
pub struct ResultFile<'a> {
    /// Its name in their folder.
    pub name: String,
    /// Makes what it holds.
    pub render: Box<dyn FnOnce() -> Vec<u8> + 'a>,
}

impl<'a> ResultFile<'a> {
    fn new(name: String, render: impl FnOnce() -> Vec<u8> + 'a) -> Self {
        Self { name, render: Box::new(render) }
    }
}

/// Writes everything; each file appears whole or not at all.
///
/// # Errors
/// When a file cannot be written. What a run found is not lost then: all files are in a folder of
/// their own among those for a short time, if they can be written there, and the error says where.
pub(crate) fn write(folder: &Path, report: &Report, of: PictureOf<'_>) -> Result<(), CliError> {
    rescued(folder, |folder| {
        files(report, of)
            .try_for_each(|ResultFile { name, render }| write_atomic(&folder.join(name), &render()))
    })
}

/// Writes results to a folder, which is made again if it has gone; where that fails, among the
/// files for a short time.
///
/// # Errors
/// When they cannot be written to the folder; where they are instead.
pub(crate) fn rescued(
    folder: &Path,
    write: impl Fn(&Path) -> Result<(), CliError>,
) -> Result<(), CliError> {
    let Err(error) = prepare(folder).and_then(|()| write(folder)) else { return Ok(()) };
    let elsewhere = std::env::temp_dir().join(format!("quasilux-{}", std::process::id()));
    // What is there already is somebody's.
    if std::fs::create_dir(&elsewhere).is_err() {
        return Err(error);
    }
    Err(match write(&elsewhere) {
        Ok(()) => error.with_advice(&format!("; all of them are in {}", elsewhere.display())),
        Err(_) => {
            // Half of them are of no use, and may take the last of a disk.
            _ = std::fs::remove_dir_all(&elsewhere);
            error
        }
    })
}

/// All files of results.
pub(crate) fn files<'a>(
    report: &'a Report,
    of: PictureOf<'a>,
) -> impl Iterator<Item = ResultFile<'a>> {
    let document = ResultFile::new("result.json".to_owned(), || json::json(report).into_bytes());
    let of_sensor = move |sensor: &'a SensorReport| {
        let name = |ending: &str| format!("{}.{ending}", sensor.name);
        let table = ResultFile::new(name("csv"), || csv::csv(sensor).into_bytes());
        let picture = sensor.grid.map(|_| {
            let png = move || false_colour_png(sensor, report, of).unwrap_or_default();
            ResultFile::new(name("png"), png)
        });
        std::iter::once(table).chain(picture)
    };
    let of_camera = move |camera: &'a CameraReport| {
        let files = camera.files().map(|names| {
            [
                ResultFile::new(names.exr, || exr(camera)),
                ResultFile::new(names.png, || tone_mapped_png(camera)),
                ResultFile::new(names.false_colour_png, || camera_false_colour_png(camera, report)),
            ]
        });
        files.into_iter().flatten()
    };
    std::iter::once(document)
        .chain(report.sensors.iter().flat_map(of_sensor))
        .chain(report.cameras.iter().flat_map(of_camera))
}

/// Makes sure that `path` can become a file before anything is computed, and none of those that are
/// read.
pub(crate) fn prepare_file(path: &Path, read: &[&Path]) -> Result<(), CliError> {
    if path.is_dir() {
        return Err(CliError::in_file(path.display(), None, "is a folder, expected a file"));
    }
    let same = |other: &&Path| match (path.canonicalize(), other.canonicalize()) {
        (Ok(own), Ok(other)) => own == other,
        _ => false,
    };
    if read.iter().any(same) {
        let message = "is read by this command; name another file";
        return Err(CliError::in_file(path.display(), None, message));
    }
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => prepare(folder),
        _ => Ok(()),
    }
}

/// Refuses a project whose name cannot stand in a text file that says where it is.
pub(crate) fn expect_text(path: &Path) -> Result<(), CliError> {
    let absolute = std::path::absolute(path);
    if path.to_str().is_some() && absolute.is_ok_and(|path| path.to_str().is_some()) {
        return Ok(());
    }
    let message = "what is kept names the project, expected UTF-8";
    Err(CliError::in_file(path.display(), None, message))
}

/// Writes a file, whole or not at all.
pub(crate) fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    stream_atomic(path, |file| file.write_all(bytes))
}

/// Writes a file piece by piece; it appears when it is whole, and is on disk then.
pub(crate) fn stream_atomic(
    path: &Path,
    write: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> Result<(), CliError> {
    atomic_file::write_beside(path, write)
        .and_then(atomic_file::Finished::publish)
        .map_err(|error| cannot_write(path, &error))
}

/// The first of these paths where something is, were it a link that leads nowhere.
pub(crate) fn first_taken(mut paths: impl Iterator<Item = PathBuf>) -> Option<PathBuf> {
    paths.find(|path| path.symlink_metadata().is_ok())
}

/// A file that is not there yet.
pub(crate) struct NewFile<'b> {
    pub(crate) path: PathBuf,
    pub(crate) bytes: &'b [u8],
}

/// Writes files: all of them, or none.
pub(crate) fn write_all_new(files: &[NewFile<'_>]) -> Result<(), CliError> {
    for (number, NewFile { path, bytes }) in files.iter().enumerate() {
        let written = write_atomic(path, bytes);
        if written.is_err() {
            // A part of them is of no use, and would keep the next try from its place.
            files[..number].iter().for_each(|it| _ = std::fs::remove_file(&it.path));
        }
        written?;
    }
    Ok(())
}

/// Says of a file that it cannot be read again.
pub(crate) fn cannot_read(path: &Path, error: &io::Error) -> CliError {
    CliError::in_file(path.display(), None, format!("cannot be read again: {error}"))
}

/// Says of a file of results that it cannot be written.
pub(crate) fn cannot_write(path: &Path, error: &io::Error) -> CliError {
    CliError::in_file(path.display(), None, format!("cannot write results: {error}"))
}
