//! `quasilux validate`: every case of a folder against its known answer, in one table, a case after
//! the other.

use super::run::simulate;
use crate::arguments::{SimulationArguments, ValidateArguments};
use crate::cases::{Case, PlacedExpectation, Verdict};
use crate::exit::{CliError, Exit};
use crate::print::print;
use crate::{interrupt, project};
use quasilux_report::number::{brief, exact, figure_text};
use quasilux_report::{Figure, Report};
use std::path::{Path, PathBuf};

/// Runs the cases; exit code 1 when one fails. An interrupted run is no verdict.
pub(crate) fn validate(arguments: &ValidateArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let folder = arguments.folder.join("cases");
    let cases = case_files(&folder)
        .map_err(|error| CliError::new(format!("{}: {error}", folder.display())))?;
    if cases.is_empty() {
        return Err(CliError::new(format!("{}: no cases, expected *.toml", folder.display())));
    }
    print_row(["estimator", "figure", "expected", "got", "verdict"])?;
    let (mut held, mut failed) = (0, 0);
    for path in cases {
        let case = Case::read(&path)?;
        print(&format!("{} ({})\n", case.name, case.source))?;
        let project = project::open(&case.project)?;
        for estimator in case.estimators() {
            let rel_tol = estimator.as_ref().and_then(|name| case.rel_tol.get(name)).copied();
            let arguments =
                SimulationArguments { estimator, rel_tol, ..SimulationArguments::default() };
            let finished = simulate(&project, &arguments, true)?;
            if finished.exit == Exit::Interrupted {
                return Ok(Exit::Interrupted);
            }
            for verdict in judge(&path, &case, &finished.report)? {
                print_verdict(&finished.report, &verdict)?;
                *(if verdict.holds { &mut held } else { &mut failed }) += 1;
            }
        }
    }
    print(&format!("{held} passed, {failed} failed\n"))?;
    Ok(if failed == 0 { Exit::Done } else { Exit::CheckFailed })
}

fn case_files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// The verdicts of all expectations of a case.
fn judge(path: &Path, case: &Case, report: &Report) -> Result<Vec<Verdict>, CliError> {
    let mut verdicts = Vec::new();
    for PlacedExpectation { expectation, place } in case.expectations() {
        verdicts.extend(expectation.judge(report).map_err(|error| {
            let message = format!("case \"{}\" ({}): {error}", case.name, case.source);
            CliError::in_file(path.display(), Some(place), message)
        })?);
    }
    Ok(verdicts)
}

fn print_verdict(report: &Report, verdict: &Verdict) -> Result<(), CliError> {
    let Verdict { what, expected, got, holds, why } = verdict;
    let judged = if *holds { "holds".to_owned() } else { format!("FAILS: {why}") };
    print_row([
        report.run.settings.estimator.name(),
        what,
        &exact(*expected),
        &got_text(*got),
        &judged,
    ])
}

/// A figure with its half-width; one that has none, or none but of rounding, with the digits that a
/// closed form may differ in.
fn got_text(got: Figure) -> String {
    let is_exact =
        |value: &f64| got.half_width.is_none_or(|half_width| half_width <= 1e-9 * value.abs());
    let exact = got.value.filter(is_exact);
    exact.map_or_else(|| figure_text(got).joined(), |value| brief(value, 7))
}

fn print_row([estimator, figure, expected, got, verdict]: [&str; 5]) -> Result<(), CliError> {
    print(&format!("  {estimator:<13}  {figure:<26}  {expected:>18}  {got:<20}  {verdict}\n"))
}
