//! Results on disk: a document, a spreadsheet for each sensor, a picture for each grid.

use crate::exit::Refusal;
use quasilux_measure::{Report, csv, false_colour_png, json};
use std::path::Path;

/// Makes sure that results can be written to `folder` before anything is computed.
pub(crate) fn prepare(folder: &Path) -> Result<(), Refusal> {
    std::fs::create_dir_all(folder).map_err(|error| cannot_write(folder, &error))
}

/// Writes everything; each file appears whole or not at all.
pub(crate) fn write(folder: &Path, report: &Report) -> Result<(), Refusal> {
    write_whole(&folder.join("result.json"), json::json(report).as_bytes())?;
    for sensor in &report.sensors {
        let file = |ending: &str| folder.join(format!("{}.{ending}", sensor.name));
        write_whole(&file("csv"), csv::csv(sensor).as_bytes())?;
        if let Some(png) = false_colour_png(sensor, report) {
            write_whole(&file("png"), &png)?;
        }
    }
    Ok(())
}

fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Refusal> {
    let mut temporary = path.as_os_str().to_owned();
    temporary.push(".part");
    std::fs::write(&temporary, bytes)
        .and_then(|()| std::fs::rename(&temporary, path))
        .map_err(|error| cannot_write(path, &error))
}

fn cannot_write(path: &Path, error: &std::io::Error) -> Refusal {
    Refusal::new(format!("{}: cannot write results: {error}", path.display()))
}
