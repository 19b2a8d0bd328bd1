//! Results on disk: a document, a spreadsheet for each sensor, a picture for each grid, three for
//! each camera.

use crate::atomic_file;
use crate::exit::CliError;
use quasilux_report::{
    PictureOf, Report, camera_false_colour_png, csv, exr, false_colour_png, json, tone_mapped_png,
};
use std::io::{self, Write};
use std::path::Path;

/// Makes sure that results can be written to `folder` before anything is computed.
pub(crate) fn prepare(folder: &Path) -> Result<(), CliError> {
    std::fs::create_dir_all(folder).map_err(|error| cannot_write(folder, &error))
}

/// Writes everything; each file appears whole or not at all.
pub(crate) fn write(folder: &Path, report: &Report, of: PictureOf<'_>) -> Result<(), CliError> {
    write_atomic(&folder.join("result.json"), json::json(report).as_bytes())?;
    for sensor in &report.sensors {
        let file = |ending: &str| folder.join(format!("{}.{ending}", sensor.name));
        write_atomic(&file("csv"), csv::csv(sensor).as_bytes())?;
        if let Some(png) = false_colour_png(sensor, report, of) {
            write_atomic(&file("png"), &png)?;
        }
    }
    for camera in &report.cameras {
        let Some(files) = camera.files() else { continue };
        write_atomic(&folder.join(files.exr), &exr(camera))?;
        write_atomic(&folder.join(files.png), &tone_mapped_png(camera))?;
        let false_colours = camera_false_colour_png(camera, report);
        write_atomic(&folder.join(files.false_colour_png), &false_colours)?;
    }
    Ok(())
}

/// Makes sure that `path` can become a file before anything is computed, and none of those that are
/// read.
pub(crate) fn prepare_file(path: &Path, read: &[&Path]) -> Result<(), CliError> {
    if path.is_dir() {
        return Err(CliError::new(format!("{}: is a folder, expected a file", path.display())));
    }
    let same = |other: &&Path| match (path.canonicalize(), other.canonicalize()) {
        (Ok(own), Ok(other)) => own == other,
        _ => false,
    };
    if read.iter().any(same) {
        let message = format!("{}: is read by this command, expected another file", path.display());
        return Err(CliError::new(message));
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
    let message = format!("{}: what is kept names the project, expected UTF-8", path.display());
    Err(CliError::new(message))
}

/// Writes a file, whole or not at all.
pub(crate) fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), CliError> {
    stream_atomic(path, |file| file.write_all(bytes))
}

/// Writes a file piece by piece; it appears when it is whole, and is on disk then.
pub(crate) fn stream_atomic(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), CliError> {
    atomic_file::write_beside(path, write)
        .and_then(atomic_file::Finished::publish)
        .map_err(|error| cannot_write(path, &error))
}

fn cannot_write(path: &Path, error: &io::Error) -> CliError {
    CliError::new(format!("{}: cannot write results: {error}", path.display()))
}
