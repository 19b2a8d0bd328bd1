//! `quasilux annual`: the daylight of a year, hour by hour.
//!
//! Points come in blocks, from the simulation (`year`) or from what was kept of it (`kept`), and
//! become the files of results (`sink`), on disk or in memory (`in_memory`), and those that
//! Honeybee's recipe leaves (`honeybee`).

mod honeybee;
mod in_memory;
mod kept;
mod sink;
mod year;

use super::{Folder, count};
use crate::arguments::{AnnualArguments, OutputArguments};
use crate::checkpoint::{Heading, RunPaths};
use crate::exit::{CliError, Exit};
use crate::interrupt;
use crate::print::print;
use crate::project::{self, Project};
use crate::source::{Model, Source, is_model};
use crate::year_file::{YearHeading, YearWriter};
use honeybee::HoneybeeFolder;
pub(crate) use in_memory::year_in_memory;
pub use in_memory::{FinishedYear, YearListener};
use kept::Keeper;
pub(super) use kept::{merge_years, resume_year};
pub use sink::YearFile;
use std::ops::Range;
use std::path::Path;
use year::Year;

/// Simulates a year, or a part of it, writes its results and prints what was asked for.
pub(crate) fn annual(arguments: &AnnualArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let file = &arguments.project;
    let project = open(arguments)?;
    let settings = project::annual_settings(&project, &arguments.year)?;
    let threads = count(arguments.year.threads);
    let year = Year::new(&project, settings, arguments.year.occupied.as_ref(), threads)?;
    let points = points(arguments, year.points())?;
    let folder = arguments.output.out.clone().unwrap_or_else(|| Folder::by_name(file));
    if let Some(neighbours) = &arguments.honeybee {
        let model = is_model(file).then_some(file.as_path());
        return for_honeybee(&year, Folders { own: &folder, neighbours, model }, &arguments.output);
    }
    let Some(path) = &arguments.checkpoint else {
        return year.deliver(&folder, &arguments.output, |sink| {
            year.simulate(points, &mut |block| sink.take(&block))
        });
    };
    kept::expect_nothing_to_lose(path, file)?;
    let heading = YearHeading {
        run: Heading::new(&project, RunPaths { file, out: &folder, settings: &year.settings }),
        occupied_h: arguments.year.occupied.clone(),
        points: points.clone(),
        of: year.points(),
    };
    let writer = YearWriter::begin(path, &heading);
    let mut writer = writer.map_err(|error| kept::cannot_keep(path, &error))?;
    if arguments.shard.is_some() {
        let quiet = arguments.output.quiet;
        return kept::simulate_part(&year, &points, points.start, &mut writer, path, quiet);
    }
    let mut keeper = Keeper::new(path, writer);
    year.deliver(&folder, &arguments.output, |sink| {
        year.simulate(points, &mut |block| {
            keeper.add(&block);
            sink.take(&block)
        })
    })
}

/// Where a year is written, and the model that it is of.
#[derive(Clone, Copy)]
struct Folders<'f> {
    own: &'f Path,
    neighbours: &'f Path,
    model: Option<&'f Path>,
}

/// Simulates a year, and writes it to Honeybee's folder, too.
fn for_honeybee(
    year: &Year<'_>,
    folders: Folders<'_>,
    output: &OutputArguments,
) -> Result<Exit, CliError> {
    let Folders { own, neighbours, model } = folders;
    if own == neighbours {
        return Err(CliError::new("--out and --honeybee: expected two folders"));
    }
    let mut honeybee = HoneybeeFolder::begin(neighbours, year)?;
    let exit = year.deliver(own, output, |sink| {
        year.simulate(0..year.points(), &mut |block| {
            honeybee.take(&block)?;
            sink.take(&block)
        })
    })?;
    let is_complete = exit != Exit::Interrupted && honeybee.end(model)?;
    if is_complete && !(output.quiet || output.json) {
        print(&format!("results for Honeybee in {}\n", neighbours.display()))?;
    }
    Ok(if is_complete { exit } else { Exit::Interrupted })
}

/// The project, or that of a model in its weather.
fn open(arguments: &AnnualArguments) -> Result<Project, CliError> {
    let AnnualArguments { project: file, weather, checkpoint, .. } = arguments;
    let refuse = |message: &str| Err(CliError::in_file(file.display(), None, message));
    match (is_model(file), weather) {
        (false, None) => project::open(file),
        (false, Some(_)) => {
            refuse("--weather goes with a Honeybee model; name the file in [weather]")
        }
        (true, None) => refuse("a year of a model needs its weather; add --weather FILE"),
        (true, Some(_)) if checkpoint.is_some() => refuse(
            "--checkpoint goes with a project file; make one of the model and its weather with \
             `quasilux import`",
        ),
        (true, Some(weather)) => Project::load(Source::of_model(&Model::at(file), Some(weather))?),
    }
}

/// The points that are asked for.
fn points(arguments: &AnnualArguments, all: usize) -> Result<Range<usize>, CliError> {
    let Some(slice) = arguments.shard else { return Ok(0..all) };
    let Range { start, end } = slice.indices(all as u64);
    if start == end {
        return Err(CliError::new(format!("--shard: more parts than the {all} sensor points")));
    }
    Ok(start as usize..end as usize)
}
