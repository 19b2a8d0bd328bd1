//! `quasilux plan`: all about a run of a fixed number of samples, before it runs.

use super::run::{count, pool};
use crate::arguments::{PlanArguments, PlannedArguments, SimulationArguments};
use crate::exit::{CliError, Exit};
use crate::plan::Plan;
use crate::print::print_document;
use crate::project::Project;
use crate::{project, results};
use quasilux_transport::Settings;
use std::path::Path;

/// Writes the plan of a project.
pub(crate) fn plan(arguments: &PlanArguments) -> Result<Exit, CliError> {
    let project = project::open(&arguments.project)?;
    if let Some(path) = &arguments.out {
        results::prepare_file(path, &[&arguments.project])?;
    }
    let made =
        make(&arguments.project, &project, &arguments.planned, count(arguments.work.threads))?;
    match &arguments.out {
        Some(path) => results::write_atomic(path, made.plan.text().as_bytes())?,
        None => print_document(&made.plan.text())?,
    }
    Ok(Exit::Done)
}

/// A plan and its settings.
pub(crate) struct Made {
    pub(crate) plan: Plan,
    pub(crate) settings: Settings,
}

/// Makes the plan of a project: its surveys and pilots are run.
pub(crate) fn make(
    path: &Path,
    project: &Project,
    planned: &PlannedArguments,
    threads: usize,
) -> Result<Made, CliError> {
    let Some(samples) = planned.samples else {
        return Err(CliError::new("a plan needs --samples: it says where the run ends"));
    };
    if project.loaded.scene.sensors.is_empty() {
        let name = &project.name;
        return Err(CliError::new(format!("{name}: without sensors there is nothing to plan")));
    }
    results::expect_text(path)?;
    let arguments = SimulationArguments {
        samples: Some(samples),
        estimator: planned.estimator.clone(),
        sequence: planned.sequence.clone(),
        seed: planned.seed,
        ..SimulationArguments::default()
    };
    let settings = project::settings(project, &arguments)?;
    let scene = &project.loaded.scene;
    let decisions = pool(threads)?.install(|| quasilux_transport::decide(scene, &settings));
    let plan = Plan::new(path, project, &settings, samples, &decisions);
    Ok(Made { plan, settings })
}
