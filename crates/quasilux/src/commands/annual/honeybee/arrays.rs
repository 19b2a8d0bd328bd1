//! Illuminances of one state of a light path: for each grid three arrays by sensor and hour with
//! light, written as the points come.

use super::clock::Clock;
use crate::exit::CliError;
use crate::npy::NpyHeader;
use crate::results::{cannot_read, cannot_write};
use quasilux_report::annual::PointOfHours;
use quasilux_scene::Sensor;
use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The folders of the arrays: all light, that straight from the sun, and the half-width of all.
const KINDS: [&str; 3] = ["total", "direct", "half_width"];

/// Illuminances of a sensor in lx, hour by hour of those with light, in the order of [`KINDS`].
type Rows = [Vec<f32>; 3];

/// The next of a sequence of points, grid by grid.
struct NextPoint<'s> {
    sensors: &'s [Sensor],
    /// The number of the grid, and of its points those before the next one.
    grid: usize,
    before: usize,
}

impl<'s> NextPoint<'s> {
    fn new(sensors: &'s [Sensor]) -> Self {
        Self { sensors, grid: 0, before: 0 }
    }

    /// The grid that the next point is in, if that is its first one.
    fn begun(&mut self) -> Option<&'s Sensor> {
        while self.sensors.get(self.grid).is_some_and(|sensor| self.before == sensor.len()) {
            (self.grid, self.before) = (self.grid + 1, 0);
        }
        let sensor = self.sensors.get(self.grid).filter(|_| self.before == 0);
        self.before += 1;
        sensor
    }
}

fn file_of(folder: &Path, kind: &str, sensor: &Sensor) -> PathBuf {
    folder.join(kind).join(format!("{}.npy", sensor.name))
}

/// Arrays that are written.
pub(super) struct ArrayWriter<'s> {
    folder: PathBuf,
    next_point: NextPoint<'s>,
    hours: usize,
    files: Vec<OpenArray>,
    /// Illuminances that do not come by this light path.
    beside: Option<ArrayReader<'s>>,
}

struct OpenArray {
    path: PathBuf,
    file: BufWriter<File>,
}

impl<'s> ArrayWriter<'s> {
    /// Begins in a folder that is not there yet.
    pub(super) fn begin(
        folder: &Path,
        sensors: &'s [Sensor],
        clock: &Clock,
    ) -> Result<Self, CliError> {
        for kind in KINDS {
            let folder = folder.join(kind);
            fs::create_dir_all(&folder).map_err(|error| cannot_write(&folder, &error))?;
        }
        let (folder, next_point) = (folder.to_owned(), NextPoint::new(sensors));
        Ok(Self { folder, next_point, hours: clock.sun_up.len(), files: Vec::new(), beside: None })
    }

    /// Takes the illuminances of other arrays off those that come.
    pub(super) fn without(self, beside: ArrayReader<'s>) -> Self {
        Self { beside: Some(beside), ..self }
    }

    /// Takes the next point.
    pub(super) fn take(&mut self, point: &PointOfHours, clock: &Clock) -> Result<(), CliError> {
        if let Some(sensor) = self.next_point.begun() {
            self.close()?;
            self.open(sensor)?;
        }
        let PointOfHours { illuminance_lx, sun_lx, half_width_lx, .. } = point;
        let with_light = |all: &Vec<f32>| clock.sun_up.iter().map(|&hour| all[hour]).collect();
        let mut rows: Rows = [illuminance_lx, sun_lx, half_width_lx].map(with_light);
        if let Some(beside) = &mut self.beside {
            rows = without(&rows, &beside.next()?);
        }
        for (open, row) in self.files.iter_mut().zip(&rows) {
            let bytes: Vec<u8> = row.iter().flat_map(|x| x.to_le_bytes()).collect();
            open.file.write_all(&bytes).map_err(|error| cannot_write(&open.path, &error))?;
        }
        Ok(())
    }

    /// Makes sure that all is on disk.
    pub(super) fn end(mut self) -> Result<(), CliError> {
        self.close()
    }

    fn open(&mut self, sensor: &Sensor) -> Result<(), CliError> {
        let header = NpyHeader { shape: &[sensor.len(), self.hours] }.bytes();
        for kind in KINDS {
            let path = file_of(&self.folder, kind, sensor);
            let created = File::create_new(&path).map(BufWriter::new);
            let begun = created.and_then(|mut file| file.write_all(&header).map(|()| file));
            let file = begun.map_err(|error| cannot_write(&path, &error))?;
            self.files.push(OpenArray { path, file });
        }
        Ok(())
    }

    fn close(&mut self) -> Result<(), CliError> {
        for OpenArray { path, file } in self.files.drain(..) {
            let file = file.into_inner().map_err(std::io::IntoInnerError::into_error);
            let written = file.and_then(|file| file.sync_all());
            written.map_err(|error| cannot_write(&path, &error))?;
        }
        Ok(())
    }
}

/// Illuminances that come beside others, whose errors are taken for independent.
fn without([total, direct, half_width]: &Rows, beside: &Rows) -> Rows {
    let pairs = |own: &[f32], other: &[f32], join: fn(f32, f32) -> f32| -> Vec<f32> {
        own.iter().zip(other).map(|(own, other)| join(*own, *other)).collect()
    };
    [
        pairs(total, &beside[0], |own, other| own - other),
        pairs(direct, &beside[1], |own, other| own - other),
        pairs(half_width, &beside[2], f32::hypot),
    ]
}

/// Arrays that were written, read point by point.
pub(super) struct ArrayReader<'s> {
    folder: PathBuf,
    next_point: NextPoint<'s>,
    hours: usize,
    files: Vec<(PathBuf, BufReader<File>)>,
}

impl<'s> ArrayReader<'s> {
    pub(super) fn open(folder: &Path, sensors: &'s [Sensor], clock: &Clock) -> Self {
        let (folder, next_point) = (folder.to_owned(), NextPoint::new(sensors));
        Self { folder, next_point, hours: clock.sun_up.len(), files: Vec::new() }
    }

    /// The rows of the next point.
    fn next(&mut self) -> Result<Rows, CliError> {
        if let Some(sensor) = self.next_point.begun() {
            self.files.clear();
            let header = NpyHeader { shape: &[sensor.len(), self.hours] }.bytes().len() as u64;
            for kind in KINDS {
                let path = file_of(&self.folder, kind, sensor);
                let opened = File::open(&path).map(BufReader::new);
                let begun =
                    opened.and_then(|mut file| file.seek(SeekFrom::Start(header)).map(|_| file));
                let file = begun.map_err(|error| cannot_read(&path, &error))?;
                self.files.push((path, file));
            }
        }
        let mut rows = Rows::default();
        for ((path, file), row) in self.files.iter_mut().zip(&mut rows) {
            let mut bytes = vec![0; 4 * self.hours];
            file.read_exact(&mut bytes).map_err(|error| cannot_read(path, &error))?;
            let (numbers, _) = bytes.as_chunks::<4>();
            *row = numbers.iter().map(|it| f32::from_le_bytes(*it)).collect();
        }
        Ok(rows)
    }
}
