//! Where the points of a year go: into its report, and their hours into a file.

use crate::exit::CliError;
use crate::npy::NpyHeader;
use crate::results;
use crate::year_file::YearBlock;
use quasilux_report::PictureOf;
use quasilux_report::annual::{
    AnnualReport, annual_csv, annual_json, annual_maps, hours_csv, hours_png,
};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The hours of all points: by point, value and half-width, and interval of the weather file.
pub(super) const HOURS_FILE: &str = "hours.npy";

/// Takes the points of a year in their order.
pub(super) struct Sink<'s, 'r> {
    report: &'s mut AnnualReport<'r>,
    hours: &'s mut (dyn Write + Send),
    /// Where the file is to be.
    path: PathBuf,
    /// How many points there will be.
    points: usize,
}

impl<'s, 'r> Sink<'s, 'r> {
    /// Into a report without points and an empty file.
    pub(super) fn begin(
        report: &'s mut AnnualReport<'r>,
        hours: &'s mut (dyn Write + Send),
        path: PathBuf,
        points: usize,
    ) -> io::Result<Self> {
        let intervals = report.calendar.intervals.len();
        hours.write_all(&NpyHeader { shape: &[points, 2, intervals] }.bytes())?;
        Ok(Self { report, hours, path, points })
    }

    /// Takes the next points.
    pub(super) fn take(&mut self, block: &YearBlock) -> Result<(), CliError> {
        for point in &block.points {
            let numbers = point.illuminance_lx.iter().chain(&point.half_width_lx);
            let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
            let written = self.hours.write_all(&bytes);
            written.map_err(|error| results::cannot_write(&self.path, &error))?;
            self.report.push(point);
        }
        self.report.run.work.rays += block.took.rays;
        self.report.run.work.paths += block.took.paths;
        Ok(())
    }

    /// Takes the next points, which took their time before this program.
    pub(super) fn take_kept(&mut self, block: &YearBlock) -> Result<(), CliError> {
        self.report.run.seconds += block.took.seconds;
        self.take(block)
    }

    /// Ends the file: a year that was interrupted has NaN for the rest, so that the file is whole.
    pub(super) fn end(self, is_complete: bool) -> io::Result<()> {
        self.report.run.work.is_complete = is_complete;
        let intervals = self.report.calendar.intervals.len();
        for _ in self.report.points.len()..self.points {
            let unknown = f32::NAN.to_le_bytes().repeat(2 * intervals);
            self.hours.write_all(&unknown)?;
        }
        Ok(())
    }
}

/// A file of results.
#[derive(Clone, Debug)]
pub struct YearFile {
    /// Its name in their folder.
    pub name: String,
    /// Bytes of the file.
    pub content: Vec<u8>,
}

/// All files of a report but that of the hours.
pub(super) fn files(report: &AnnualReport<'_>, title: &str) -> Vec<YearFile> {
    let mut files = Vec::new();
    let mut add = |name: String, content| files.push(YearFile { name, content });
    add("annual.json".to_owned(), annual_json(report).into_bytes());
    add("hours.csv".to_owned(), hours_csv(report).into_bytes());
    for (number, of) in report.sensors().enumerate() {
        let name = &of.sensor.name;
        add(format!("{name}.annual.csv"), annual_csv(of).into_bytes());
        if let Some(sheet) = report.equinox.csv(of.sensor, of.first, report.calendar) {
            add(format!("{name}.equinox.csv"), sheet.into_bytes());
        }
        if let Some(png) = hours_png(report, number, title) {
            add(format!("{name}.hours.png"), png);
        }
    }
    if report.run.work.is_complete {
        for map in annual_maps(report, PictureOf { scene: report.scene, title }) {
            add(format!("{}.{}.png", map.sensor.name, map.measure.name()), map.png);
        }
    }
    files
}

/// Writes what a report says.
pub(super) fn write(report: &AnnualReport<'_>, folder: &Path, title: &str) -> Result<(), CliError> {
    let files = files(report, title);
    results::rescued(folder, |folder| {
        let write =
            |file: &YearFile| results::write_atomic(&folder.join(&file.name), &file.content);
        files.iter().try_for_each(write)
    })
}
