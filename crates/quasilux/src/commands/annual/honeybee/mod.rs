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
use quasilux_scene::{Loaded, Scene, Sensor};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

/// Where everything is until all of it is there.
const UNFINISHED: &str = "unfinished";
const RESULTS: &str = "results";
const METRICS: &str = "metrics";

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
        expect_empty(folder)?;
        let unfinished = folder.join(UNFINISHED);
        if unfinished.exists() {
            // Of a run that was killed: no other one is at this folder.
            fs::remove_dir_all(&unfinished)
                .map_err(|it| results::cannot_write(&unfinished, &it))?;
        }
        let sensors = &project.loaded.scene.sensors;
        let of_all = unfinished.join(RESULTS).join(STATIC).join(STATIC_STATE);
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

    /// Simulates the light paths that are left, and puts everything in its place, with the model
    /// that it is of; says whether that came to its end.
    pub(super) fn end(mut self, model: Option<&Path>) -> Result<bool, CliError> {
        if let Some(arrays) = self.arrays.take() {
            arrays.end()?;
        } else if !self.by_light_paths()? {
            return Ok(false);
        }
        let unfinished = self.folder.join(UNFINISHED);
        documents::write(&unfinished.join(RESULTS), self.sensors(), &self.paths, &self.clock)?;
        self.metrics.write(&unfinished.join(METRICS))?;
        let mut parts: Vec<OsString> = vec![METRICS.into()];
        if let Some((model, name)) = model.and_then(|it| Some((it, it.file_name()?))) {
            let bytes = fs::read(model).map_err(|error| results::cannot_read(model, &error))?;
            results::write_atomic(&unfinished.join(name), &bytes)?;
            parts.push(name.to_owned());
        }
        // Whoever looks for the results finds all of it.
        parts.push(RESULTS.into());
        for part in parts {
            let place = self.folder.join(&part);
            let moved = fs::rename(unfinished.join(&part), &place);
            moved.map_err(|error| results::cannot_write(&place, &error))?;
        }
        _ = fs::remove_dir(&unfinished);
        Ok(true)
    }

    /// Simulates what comes by none of the groups, and each state of each group without that.
    fn by_light_paths(&self) -> Result<bool, CliError> {
        let results = self.folder.join(UNFINISHED).join(RESULTS);
        let of_static = results.join(STATIC).join(STATIC_STATE);
        let room = without_groups(&self.year.project().loaded);
        let writer = self.writer(&of_static)?;
        if !self.fill(writer, &room)? {
            return Ok(false);
        }
        let Loaded { scene: open, blinds, .. } = &self.year.project().loaded;
        let Some(blinds) = blinds else { return Ok(true) };
        for path in &self.paths {
            for (number, state) in path.states.iter().enumerate() {
                let folder = results.join(&path.name).join(state);
                let beside = ArrayReader::open(&of_static, self.sensors(), &self.clock);
                let writer = self.writer(&folder)?.without(beside);
                if !self.fill(writer, &path.room(open, blinds, number))? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }

    fn sensors(&self) -> &'y [Sensor] {
        &self.year.project().loaded.scene.sensors
    }

    fn writer(&self, folder: &Path) -> Result<ArrayWriter<'y>, CliError> {
        ArrayWriter::begin(folder, self.sensors(), &self.clock)
    }

    /// Simulates the year of a room into arrays.
    fn fill(&self, mut arrays: ArrayWriter<'_>, room: &Scene) -> Result<bool, CliError> {
        let is_complete = self.year.simulate_in(room, &mut |block| {
            block.points.iter().try_for_each(|point| arrays.take(point, &self.clock))
        })?;
        if is_complete {
            arrays.end()?;
        }
        Ok(is_complete)
    }
}

/// Refuses a folder that has results, or a model that areas of grids would be taken from.
fn expect_empty(folder: &Path) -> Result<(), CliError> {
    let entries = fs::read_dir(folder).map_err(|error| results::cannot_read(folder, &error))?;
    for path in entries.filter_map(Result::ok).map(|entry| entry.path()) {
        let is_model = path.extension().is_some_and(|it| it == "hbjson" || it == "hbpkl");
        let is_ours = [RESULTS, METRICS].iter().any(|name| path.file_name() == Some(name.as_ref()));
        if is_model || is_ours {
            let message = "is there already; remove it or name another folder by --honeybee";
            return Err(CliError::in_file(path.display(), None, message));
        }
    }
    Ok(())
}

/// Tells what of a year is not in the folder.
fn warn(folder: &Path, clock: &Clock, others: &[String]) {
    let folder = folder.display();
    if clock.left_out > 0 {
        tell(format_args!(
            "warning: {folder}: {} intervals are left out: Honeybee's year has no 29 February",
            clock.left_out
        ));
    }
    if clock.timestep > 1 {
        tell(format_args!(
            "warning: {folder}: {} intervals an hour, of which honeybee-radiance-postprocess takes \
             schedules of hours amiss; give it a weather file of hours",
            clock.timestep
        ));
    }
    for name in others {
        tell(format_args!(
            "warning: {folder}: the blinds \"{name}\" stay open there: they change no pane, and \
             Honeybee tells light by the windows that it comes through"
        ));
    }
}
