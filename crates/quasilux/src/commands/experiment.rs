//! `quasilux experiment NAME`: runs an experiment of `quasilux-experiments`, writes its files and
//! prints its tables.

use crate::arguments::ExperimentArguments;
use crate::exit::{CliError, Exit};
use crate::print::{print, tell};
use crate::{digest, results};
use quasilux_experiments::{Experiment, Options};
use std::path::{Path, PathBuf};

/// Runs an experiment, writes its files and prints its table.
pub(crate) fn experiment(arguments: &ExperimentArguments) -> Result<Exit, CliError> {
    let name = arguments.name.as_str();
    let experiment = Experiment::named(name)
        .ok_or_else(|| CliError::new(format!("unknown experiment \"{name}\"")))?;
    let options = Options {
        max_n: arguments.max_n,
        seeds: arguments.seeds,
        seconds_per_point: arguments.seconds_per_point,
        seed: arguments.seed,
    };
    if let Some(option) = experiment.unheeded(&options) {
        tell(format_args!("warning: the experiment \"{name}\" ignores {option}"));
    }
    let folder = arguments.out.clone().unwrap_or_else(|| Path::new("out").join(name));
    results::prepare(&folder)?;
    let outcome = experiment.run(&options);
    let file = |ending: &str| -> PathBuf { folder.join(format!("{name}.{ending}")) };
    results::write_atomic(&file("csv"), outcome.csv.as_bytes())?;
    // So that tables and figures are known to belong together, and to be as they were written.
    let [csv, text] =
        [&outcome.csv, &outcome.markdown].map(|text| digest::sha256_hex(text.as_bytes()));
    let tables = format!(
        "{}\n<!-- SHA-256 of {name}.csv:\n{csv},\nof the text before:\n{text} -->\n",
        outcome.markdown
    );
    results::write_atomic(&file("md"), tables.as_bytes())?;
    results::write_atomic(&file("svg"), outcome.svg.as_bytes())?;
    for picture in &outcome.pictures {
        let path = folder.join(format!("{name}-{}.png", picture.name));
        results::write_atomic(&path, &picture.png)?;
    }
    print(&format!("{}\nFiles: {}\n", outcome.markdown, file("{csv,md,svg}").display()))?;
    Ok(if outcome.passed { Exit::Done } else { Exit::CheckFailed })
}
