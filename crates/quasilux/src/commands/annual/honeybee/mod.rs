//! A year as Honeybee's recipe "annual daylight" leaves it, for the programs that go on from there
//! (honeybee-radiance-postprocess: LEED, BREEAM, WELL, EN 17037).
//!
//! `results/PATH/STATE/total/GRID.npy` has illuminances in lx by sensor and hour with light,
//! `direct` those straight from the sun, and `half_width` what Honeybee does not know (`arrays`). A
//! light path (`light_paths`) is a group of windows, or all that is in none; its illuminances add
//! up with those of the others. Which hours these are say `sun-up-hours.txt` and `study_info.json`
//! (`clock`), and `grids_info.json` and `grid_states.json` what there is (`documents`). `metrics/`
//! has the measures of the project's own year, whose blinds move as it says.

mod arrays;
mod clock;
mod documents;
mod light_paths;
mod metrics;

use super::year::Year;
use crate::exit::CliError;
use crate::print::tell;
use crate::results::{self, Claim};
use crate::year_file::YearBlock;
use arrays::{ArrayReader, ArrayWriter};
use clock::Clock;
use light_paths::{LightPath, LightPaths, STATIC, STATIC_STATE, light_paths, without_groups};
use metrics::Metrics;
use std::fs;
use std::path::{Path, PathBuf};

/// Where the results are until all of them are there.
const UNFINISHED: &str = "results.unfinished";
const RESULTS: &str = "results";

/// A folder that a year is written to while it goes.
pub(super) struct HoneybeeFolder<'y> {
    folder: PathBuf,
    year: &'y Year<'y>,
    clock: Clock,
    paths: Vec<LightPath>,
    /// Of the light path that is no group, where that is the whole room.
    arrays: Option<ArrayWriter<'y>>,
    metrics: Metrics<'y>,
    _claim: Claim,
}

impl<'y> HoneybeeFolder<'y> {
    /// Begins a folder, before anything is computed.
    pub(super) fn begin(folder: &Path, year: &'y Year<'y>) -> Result<Self, CliError> {
        let project = year.project();
        let refuse = |message: String| CliError::in_file(&project.name, None, message);
        let clock = Clock::new(year.calendar()).map_err(refuse)?;
        let LightPaths { paths, others } = light_paths(&project.loaded).map_err(refuse)?;
        warn(folder, &clock, &others);
        let claim = results::claim(folder)?;
        let (results, unfinished) = (folder.join(RESULTS), folder.join(UNFINISHED));
        if results.exists() {
            let message = "is there already; remove it or name another folder by --honeybee";
            return Err(CliError::in_file(results.display(), None, message));
        }
        if unfinished.exists() {
            // Of a run that was killed: no other one is at this folder.
            fs::remove_dir_all(&unfinished)
                .map_err(|it| results::cannot_write(&unfinished, &it))?;
        }
        let sensors = &project.loaded.scene.sensors;
        let of_all = unfinished.join(STATIC).join(STATIC_STATE);
        let is_all = project.loaded.blinds.is_none();
        let arrays = is_all.then(|| ArrayWriter::begin(&of_all, sensors, &clock));
        Ok(Self {
            folder: folder.to_owned(),
            year,
            paths,
            arrays: arrays.transpose()?,
            metrics: Metrics::new(sensors),
            clock,
            _claim: claim,
        })
    }

    /// Takes the next points of the project's own year.
    pub(super) fn take(&mut self, block: &YearBlock) -> Result<(), CliError> {
        for point in &block.points {
            self.metrics.take(&point.summary);
            if let Some(arrays) = &mut self.arrays {
                arrays.take(point, &self.clock)?;
            }
        }
        Ok(())
    }

    /// Simulates the light paths that are left, and puts everything in its place; says whether
    /// that came to its end.
    pub(super) fn end(mut self) -> Result<bool, CliError> {
        if let Some(arrays) = self.arrays.take() {
            arrays.end()?;
        } else if !self.by_light_paths()? {
            return Ok(false);
        }
        let unfinished = self.folder.join(UNFINISHED);
        let sensors = &self.year.project().loaded.scene.sensors;
        documents::write(&unfinished, sensors, &self.paths, &self.clock)?;
        let results = self.folder.join(RESULTS);
        fs::rename(&unfinished, &results).map_err(|it| results::cannot_write(&results, &it))?;
        self.metrics.write(&self.folder.join("metrics"))?;
        Ok(true)
    }

    /// Simulates what comes by none of the groups, and each state of each group without that.
    fn by_light_paths(&self) -> Result<bool, CliError> {
        let of_static = self.folder.join(UNFINISHED).join(STATIC).join(STATIC_STATE);
        let room = without_groups(&self.year.project().loaded);
        let writer = self.writer(&of_static)?;
        if !self.fill(writer, &room)? {
            return Ok(false);
        }
        for path in &self.paths {
            for state in &path.states {
                let folder = self.folder.join(UNFINISHED).join(&path.name).join(&state.name);
                let beside = ArrayReader::open(&of_static, self.sensors(), &self.clock);
                let writer = self.writer(&folder)?.without(beside);
                if !self.fill(writer, &state.room)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    fn sensors(&self) -> &'y [quasilux_scene::Sensor] {
        &self.year.project().loaded.scene.sensors
    }

    fn writer(&self, folder: &Path) -> Result<ArrayWriter<'y>, CliError> {
        ArrayWriter::begin(folder, self.sensors(), &self.clock)
    }

    /// Simulates the year of a room into arrays.
    fn fill(
        &self,
        mut arrays: ArrayWriter<'_>,
        room: &quasilux_scene::Scene,
    ) -> Result<bool, CliError> {
        let is_complete = self.year.simulate_in(room, &mut |block| {
            block.points.iter().try_for_each(|point| arrays.take(point, &self.clock))
        })?;
        if is_complete {
            arrays.end()?;
        }
        Ok(is_complete)
    }
}

/// Puts the model beside the results, where areas of grids are looked for.
pub(super) fn copy_model(model: &Path, folder: &Path) -> Result<(), CliError> {
    let Some(name) = model.file_name() else { return Ok(()) };
    let bytes = fs::read(model).map_err(|error| results::cannot_read(model, &error))?;
    results::write_atomic(&folder.join(name), &bytes)
}

/// Tells what of a year is not in the folder.
fn warn(folder: &Path, clock: &Clock, others: &[String]) {
    let folder = folder.display();
    if clock.left_out > 0 {
        tell(format_args!(
            "warning: {folder}: {} hours are left out: Honeybee's year has no 29 February",
            clock.left_out
        ));
    }
    for name in others {
        tell(format_args!(
            "warning: {folder}: the blinds \"{name}\" stay open there: they change no pane, and \
             Honeybee tells light by the windows that it comes through"
        ));
    }
}
