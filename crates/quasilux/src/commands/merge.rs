//! `quasilux merge`: the parts of a run become its result.

use super::annual::merge_years;
use super::run::{Folder, count, work};
use crate::arguments::MergeArguments;
use crate::door::Door;
use crate::exit::{CliError, Exit};
use crate::forecast::Forecast;
use crate::plan::{Part, in_order};
use crate::watcher::Watcher;
use crate::{interrupt, project, year_file};
use quasilux_transport::{MergeError, PreparedScene};

/// Puts parts together and writes the results of the run.
pub(crate) fn merge(arguments: &MergeArguments) -> Result<Exit, CliError> {
    if arguments.parts.iter().any(|path| year_file::is_year(path)) {
        return merge_years(arguments);
    }
    interrupt::listen()?;
    let parts: Result<Vec<Part>, CliError> =
        arguments.parts.iter().map(|path| Part::read(path)).collect();
    let parts = in_order(parts?)?;
    let Some(Part { name, plan, .. }) = parts.first() else {
        return Err(CliError::new("no parts"));
    };
    let file = arguments.project.as_ref().unwrap_or(&plan.project);
    let project = project::open(file)?;
    let settings = plan.settings(name, &project)?;
    for part in &parts {
        plan.expect_decisions(&part.sums, &part.name)?;
    }
    let folder = Folder::prepare(&arguments.output, Folder::by_name(file), &project)?;
    let threads = count(arguments.work.threads);
    let forecast = Forecast::new(&project.loaded, &settings, threads);
    let watcher = Watcher::new(forecast, None, arguments.output.quiet);
    let put_together = |prepared: &PreparedScene<'_>, watcher: &mut Watcher<'_>| {
        let scene = prepared.clone();
        let sums: Vec<&[u8]> = parts.iter().map(|part| part.sums.as_slice()).collect();
        quasilux_transport::merge(scene, &settings, plan.samples, &sums, watcher).map(Some).map_err(
            |error| match error {
                MergeError::Part { part, error } => {
                    CliError::new(format!("{}: {error}", parts[part].name))
                }
                error => CliError::new(error),
            },
        )
    };
    let door = Door { strict: false, announces: !arguments.output.quiet };
    match work(&project, door, watcher, put_together)? {
        Some(finished) => folder.deliver(&finished),
        None => Ok(Exit::Interrupted),
    }
}
