//! `quasilux validate`: every case of a folder against its known answer, in one table. Several are
//! run at a time: few have work for two processors.

use super::run::simulate;
use crate::arguments::{SimulationArguments, ValidateArguments};
use crate::cases::{Case, Verdict};
use crate::exit::{CliError, Exit};
use crate::print::print;
use crate::{interrupt, project};
use quasilux_report::number::{brief, exact, figure_text};
use quasilux_report::{Figure, Report};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

/// Runs the cases; exit code 1 when one fails. An interrupted run is no verdict.
pub(crate) fn validate(arguments: &ValidateArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let folder = arguments.folder.join("cases");
    let cases = case_files(&folder)
        .map_err(|error| CliError::new(format!("{}: {error}", folder.display())))?;
    if cases.is_empty() {
        return Err(CliError::new(format!("{}: no cases, expected *.toml", folder.display())));
    }
    print(&row(["estimator", "figure", "expected", "got", "verdict"]))?;
    let (mut held, mut failed) = (0, 0);
    let is_complete = in_order(&cases, judge_case, |judged| {
        print(&judged.text)?;
        held += judged.held;
        failed += judged.failed;
        Ok(!judged.is_interrupted)
    })?;
    if !is_complete {
        return Ok(Exit::Interrupted);
    }
    print(&format!("{held} passed, {failed} failed\n"))?;
    Ok(if failed == 0 { Exit::Done } else { Exit::CheckFailed })
}

/// Does some work for each file, as many at a time as there are processors, and tells of it in
/// their order; `false` where that said stop.
fn in_order(
    files: &[PathBuf],
    work: impl Fn(&Path) -> Result<Judged, CliError> + Sync,
    mut tell: impl FnMut(Judged) -> Result<bool, CliError>,
) -> Result<bool, CliError> {
    let next = AtomicUsize::new(0);
    let (sender, receiver) = mpsc::channel();
    let worker = |sender: mpsc::Sender<(usize, Result<Judged, CliError>)>| {
        let numbers = std::iter::repeat_with(|| next.fetch_add(1, Ordering::Relaxed));
        for number in numbers.take_while(|number| *number < files.len()) {
            // Nobody listens where the user stopped it, or a case cannot be run.
            if sender.send((number, work(&files[number]))).is_err() {
                break;
            }
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            let sender = sender.clone();
            scope.spawn(|| worker(sender));
        }
        drop(sender);
        let (mut early, mut due) = (BTreeMap::new(), 0);
        for (number, judged) in receiver {
            early.insert(number, judged);
            while let Some(judged) = early.remove(&due) {
                due += 1;
                if !tell(judged?)? {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    })
}

/// A case by all of its estimators.
#[derive(Default)]
struct Judged {
    text: String,
    held: u64,
    failed: u64,
    is_interrupted: bool,
}

fn judge_case(path: &Path) -> Result<Judged, CliError> {
    let case = Case::read(path)?;
    let mut judged =
        Judged { text: format!("{} ({})\n", case.name, case.source), ..Judged::default() };
    let project = project::open(&case.project)?;
    for estimator in case.estimators() {
        let rel_tol = estimator.as_ref().and_then(|name| case.rel_tol.get(name)).copied();
        let arguments =
            SimulationArguments { estimator, rel_tol, ..SimulationArguments::default() };
        let finished = simulate(&project, &arguments, true)?;
        if finished.exit == Exit::Interrupted {
            return Ok(Judged { is_interrupted: true, ..judged });
        }
        for verdict in judge(&case, &finished.report)? {
            judged.text += &row_of(&finished.report, &verdict);
            *(if verdict.holds { &mut judged.held } else { &mut judged.failed }) += 1;
        }
    }
    Ok(judged)
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
fn judge(case: &Case, report: &Report) -> Result<Vec<Verdict>, CliError> {
    let mut verdicts = Vec::new();
    for expectation in &case.expect {
        verdicts.extend(expectation.judge(report).map_err(|error| {
            CliError::new(format!("case \"{}\" ({}): {error}", case.name, case.source))
        })?);
    }
    Ok(verdicts)
}

fn row_of(report: &Report, verdict: &Verdict) -> String {
    let Verdict { what, expected, got, holds, why } = verdict;
    let judged = if *holds { "holds".to_owned() } else { format!("FAILS: {why}") };
    row([report.run.settings.estimator.name(), what, &exact(*expected), &got_text(*got), &judged])
}

/// A figure with its half-width; one that has none, or none but of rounding, with the digits that a
/// closed form may differ in.
fn got_text(got: Figure) -> String {
    let is_exact =
        |value: &f64| got.half_width.is_none_or(|half_width| half_width <= 1e-9 * value.abs());
    let exact = got.value.filter(is_exact);
    exact.map_or_else(|| figure_text(got).joined(), |value| brief(value, 7))
}

fn row([estimator, figure, expected, got, verdict]: [&str; 5]) -> String {
    format!("  {estimator:<13}  {figure:<26}  {expected:>18}  {got:<20}  {verdict}\n")
}
