//! `quasilux shard`: a part of a run.

use super::plan::{Made, make};
use super::run::{count, pool};
use crate::arguments::ShardArguments;
use crate::exit::{CliError, Exit};
use crate::forecast::Forecast;
use crate::plan::{Plan, part};
use crate::print::tell;
use crate::watcher::Watcher;
use crate::{interrupt, project, results};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Computes a range of the indices of a plan and writes it.
pub(crate) fn shard(arguments: &ShardArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let project = project::open(&arguments.project)?;
    let threads = count(arguments.work.threads);
    let Made { plan, settings } = match &arguments.plan {
        None => make(&arguments.project, &project, &arguments.planned, threads)?,
        Some(path) => {
            let plan = Plan::read(path)?;
            let settings = plan.settings(&path.display().to_string(), &project)?;
            Made { plan, settings }
        }
    };
    let range = indices(arguments, &plan)?;
    let stem = arguments.project.file_stem().unwrap_or_default().to_string_lossy();
    let by_range = || PathBuf::from(format!("{stem}-{}-{}.part", range.start, range.end));
    let path = arguments.out.clone().unwrap_or_else(by_range);
    let read: Vec<&Path> =
        std::iter::once(arguments.project.as_path()).chain(arguments.plan.as_deref()).collect();
    results::prepare_file(&path, &read)?;
    let scene = &project.loaded.scene;
    if !arguments.quiet && !scene.cameras.is_empty() {
        tell("warning: parts have no pictures; `merge` takes them");
    }
    let forecast = Forecast::new(&project.loaded, &settings, threads);
    let mut watcher = Watcher::new(forecast, None, arguments.quiet);
    let trace = || {
        let (samples, range) = (plan.samples, range.clone());
        quasilux_transport::trace_part(scene, &settings, samples, range, &mut watcher)
    };
    let sums = pool(threads)?.install(trace);
    interrupt::keep_results();
    let seconds = watcher.finish();
    let Some(sums) = sums else {
        tell("interrupted: no part was written");
        return Ok(Exit::Interrupted);
    };
    plan.expect_decisions(&sums, &project.name)?;
    results::write_atomic(&path, &part(&plan, &range, &sums))?;
    if !arguments.quiet {
        let (start, last, of) = (range.start, range.end - 1, plan.samples);
        let name = path.display();
        tell(format_args!("indices {start} to {last} of {of} in {name}, {seconds:.1} s"));
    }
    Ok(Exit::Done)
}

fn indices(arguments: &ShardArguments, plan: &Plan) -> Result<Range<u64>, CliError> {
    let samples = plan.samples;
    let range = match (&arguments.index_range, arguments.shard) {
        (Some(range), _) => range.clone(),
        (None, Some(slice)) => slice.indices(samples),
        (None, None) => 0..samples,
    };
    if range.is_empty() {
        return Err(CliError::new(format!("--shard: more parts than the {samples} samples")));
    }
    if range.end > samples {
        let Range { start, end } = range;
        return Err(CliError::new(format!(
            "--index-range {start}..{end}: the plan has the indices 0 to {}",
            samples - 1
        )));
    }
    Ok(range)
}
