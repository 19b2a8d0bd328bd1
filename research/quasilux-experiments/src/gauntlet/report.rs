//! The counts as CSV and as tables, and what is claimed.

use super::count::Count;
use super::trial::{Trial, TrialResult};
use super::{ESTIMATORS, Effort, RoomReferences, families};
use crate::claim::Claim;
use quasilux_report::number::exact;
use quasilux_transport::EstimatorKind;
use std::fmt::Write;

/// A coverage below this is refused: 95 % is promised, of few intervals, and of points of one run,
/// which are not independent.
const MIN_COVERAGE: f64 = 0.9;

/// One line a point of a run, one a run that was refused.
pub(super) fn csv(trials: &[Trial]) -> String {
    let mut text = "room,family,estimator,seed,point,lx,half_width_lx,reference_lx,\
                    reference_error_lx,sigmas,covers,seconds,samples,tolerance_reached,refused\n"
        .to_owned();
    for trial in trials {
        let head =
            format!("{},{},{},{}", trial.room, trial.family, trial.estimator.name(), trial.seed);
        match &trial.result {
            TrialResult::Refused(_) => writeln!(text, "{head},,,,,,,,,,,yes"),
            TrialResult::Done(run) => {
                for (number, point) in run.points.iter().enumerate() {
                    let judged = point.interval;
                    let or_none = |value: Option<f64>| value.map_or(String::new(), exact);
                    writeln!(
                        text,
                        "{head},{number},{},{},{},{},{},{},{},{},{},",
                        exact(point.lx),
                        or_none(judged.map(|it| it.half_width_lx)),
                        exact(point.reference_lx),
                        exact(point.reference_error_lx),
                        or_none(judged.map(|it| it.sigmas)),
                        judged.map_or(String::new(), |it| it.covers.to_string()),
                        exact(run.seconds),
                        run.samples,
                        run.tolerance_reached,
                    )
                    .expect("strings grow");
                }
                Ok(())
            }
        }
        .expect("strings grow");
    }
    text
}

/// What the default estimator is held to.
pub(super) fn claims(trials: &[Trial]) -> Vec<Claim> {
    let estimator = ESTIMATORS[0];
    let count = Count::new(trials, estimator, None);
    let Count { lies, covered, largest_sigmas, .. } = count;
    let intervals = count.intervals();
    let name = estimator.name();
    let coverage = count.coverage();
    vec![
        Claim::new(
            format!(
                "Of {intervals} intervals of `{name}` {} are more than 6 standard errors off, the \
                 worst {largest_sigmas:.1}",
                lies[1]
            ),
            [coverage, largest_sigmas],
            lies[1] == 0,
        ),
        Claim::new(
            format!(
                "{covered} of them cover the reference, {:.1} %, and {:.0} % or more are to",
                100.0 * coverage,
                100.0 * MIN_COVERAGE
            ),
            [coverage],
            coverage >= MIN_COVERAGE,
        ),
    ]
}

/// The tables, and what they say.
pub(super) fn markdown(
    trials: &[Trial],
    known: &[RoomReferences],
    refused: &[RoomReferences],
    effort: &Effort,
    claims: &[Claim],
) -> String {
    let mut text = format!(
        "# The gauntlet\n\n\
         {} rooms of {} families, {} seeds, to a half-width of 3 % or for {} s. An interval lied \
         if it is more than 5 (6) standard errors off, its own and that of the reference together. \
         A withdrawn point has no interval. Points that are withdrawn, and lies, are \
         numbers; coverage is of points that have an interval, in %.\n\n",
        known.len(),
        families(),
        effort.seeds,
        effort.limit.as_secs_f64(),
    );
    let confidence = trials.iter().find_map(Trial::done).map_or(f64::NAN, |run| run.confidence);
    write!(text, "Intervals are to cover with {} %.\n\n", 100.0 * confidence)
        .expect("strings grow");
    text.push_str(
        "| family | estimator | points | withdrawn | off by 5 (6) sigma | worst sigma | coverage | \
         tolerance reached | s a run |\n|---|---|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    let mut names: Vec<&str> = Vec::new();
    for trial in trials {
        if !names.contains(&trial.family) {
            names.push(trial.family);
        }
    }
    for family in names.into_iter().map(Some).chain([None]) {
        for estimator in ESTIMATORS {
            text.push_str(&row(trials, family, estimator));
        }
    }
    text.push_str(&left_out(trials, refused));
    text.push_str(&Claim::markdown(claims));
    text
}

fn row(trials: &[Trial], family: Option<&str>, estimator: EstimatorKind) -> String {
    let count = Count::new(trials, estimator, family);
    if count.runs == 0 {
        return String::new();
    }
    let coverage = if count.intervals() > 0 {
        format!("{:.1}", 100.0 * count.coverage())
    } else {
        "-".to_owned()
    };
    format!(
        "| {} | {} | {} | {} | {} ({}) | {:.1} | {coverage} | {} of {} | {:.2} |\n",
        family.unwrap_or("all"),
        estimator.name(),
        count.points,
        count.withdrawn,
        count.lies[0],
        count.lies[1],
        count.largest_sigmas,
        count.reached,
        count.runs,
        count.seconds / f64::from(count.runs),
    )
}

/// What was not run, and why.
fn left_out(trials: &[Trial], refused: &[RoomReferences]) -> String {
    let mut text = "\n".to_owned();
    for room in refused {
        writeln!(
            text,
            "- Room {} is left out: its references are of another generator.",
            room.number
        )
        .expect("strings grow");
    }
    for estimator in ESTIMATORS {
        let why = |trial: &&Trial| {
            trial.estimator == estimator && matches!(trial.result, TrialResult::Refused(_))
        };
        let own: Vec<&Trial> = trials.iter().filter(why).collect();
        if let Some(TrialResult::Refused(error)) = own.first().map(|trial| &trial.result) {
            writeln!(
                text,
                "- {} runs of `{}` are left out, the first because: {error}.",
                own.len(),
                estimator.name()
            )
            .expect("strings grow");
        }
    }
    text
}
