//! `quasilux validate`: every case of a folder against its known answer, in one table.

use super::run::simulate;
use crate::arguments::{SimulationArguments, ValidateArguments};
use crate::cases::{Case, Verdict};
use crate::exit::{Exit, Refusal};
use crate::{interrupt, project};
use quasilux_measure::number::figure_text;
use std::path::PathBuf;

/// Runs the cases; exit code 1 when one fails.
pub(crate) fn validate(arguments: &ValidateArguments) -> Result<Exit, Refusal> {
    interrupt::listen()?;
    let folder = arguments.folder.join("cases");
    let cases = case_files(&folder)
        .map_err(|error| Refusal::new(format!("{}: {error}", folder.display())))?;
    if cases.is_empty() {
        return Err(Refusal::new(format!("{}: no cases, expected *.toml", folder.display())));
    }
    println!(
        "{:<24}{:<19}{:<28}{:>12}  {:<24}verdict",
        "case", "estimator", "figure", "expected", "got"
    );
    let (mut held, mut failed) = (0, 0);
    for path in cases {
        for (name, verdict) in judge(&Case::read(&path)?)? {
            print_row(&name, &verdict);
            *(if verdict.holds { &mut held } else { &mut failed }) += 1;
        }
    }
    println!("{held} passed, {failed} failed");
    Ok(if failed == 0 { Exit::Done } else { Exit::CheckFailed })
}

fn case_files(folder: &std::path::Path) -> std::io::Result<Vec<PathBuf>> {
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

/// The verdicts of a case under each of its estimators, with what to call them.
fn judge(case: &Case) -> Result<Vec<(String, Verdict)>, Refusal> {
    let loaded = project::open(&case.project)?;
    let own = vec![None];
    let named = case.estimators.iter().cloned().map(Some).collect();
    let estimators: Vec<Option<String>> = if case.estimators.is_empty() { own } else { named };
    let mut verdicts = Vec::new();
    for estimator in estimators {
        let arguments = SimulationArguments { estimator, ..SimulationArguments::default() };
        let report = simulate(&loaded, &arguments, true)?.report;
        let label = format!("{:<24}{:<19}", case.name, report.run.settings.estimator.name());
        for expectation in &case.expect {
            let own = expectation.judge(&report).map_err(|refusal| {
                Refusal::new(format!("case \"{}\" ({}): {refusal}", case.name, case.source))
            })?;
            verdicts.extend(own.into_iter().map(|verdict| (label.clone(), verdict)));
        }
    }
    Ok(verdicts)
}

fn print_row(label: &str, verdict: &Verdict) {
    let Verdict { what, expected, got, holds, why } = verdict;
    let got = figure_text(*got).joined();
    let judged = if *holds { "holds".to_owned() } else { format!("FAILS: {why}") };
    println!("{label}{what:<28}{expected:>12.6}  {got:<24}{judged}");
}
