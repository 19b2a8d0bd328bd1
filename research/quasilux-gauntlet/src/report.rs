//! The counts as tables, and what is claimed.

use crate::count::{Count, Filter, Truths};
use crate::families;
use crate::likelihood;
use crate::record::{RunOutcome, RunRecord};
use crate::truth::Truth;
use quasilux_transport::EstimatorKind;
use std::fmt::Write;

/// What both numbers together are to cover at least.
const COVERED_WITH_BOUND: f64 = 0.95;
/// Between which shares the half-width alone is to cover, where little is unseen.
const COVERED: [f64; 2] = [0.94, 0.97];
/// Fewer runs than this say nothing of coverage.
const FEW_RUNS: u32 = 20;

/// What is reported.
pub struct Report {
    /// The tables and the claims, as Markdown.
    pub markdown: String,
    /// Whether all claims hold.
    pub holds: bool,
}

/// What a report is about.
pub struct Subject<'a> {
    /// The runs.
    pub runs: &'a [RunRecord],
    /// What they are held against.
    pub truths: &'a [Truth],
    /// The estimators, in the order of the report.
    pub estimators: &'a [EstimatorKind],
    /// The limits in s.
    pub limits_s: &'a [f64],
    /// Rooms without references.
    pub rooms_left_out: &'a [String],
}

/// A claim, and whether it holds.
struct Claim {
    text: String,
    holds: bool,
}

impl Report {
    /// The report of the runs.
    #[must_use]
    pub fn new(subject: &Subject<'_>) -> Self {
        let known: Truths<'_> =
            subject.truths.iter().map(|it| (it.points.digest.as_str(), it)).collect();
        let mut markdown = "# The gauntlet\n\n".to_owned();
        let mut holds = true;
        for &estimator in subject.estimators {
            let count = |family: Option<&str>, limit_s: Option<f64>| {
                Count::new(subject.runs, &known, Filter { estimator, family, limit_s })
            };
            put(&mut markdown, format_args!("## `{}`\n\n", estimator.name()));
            by_family(&mut markdown, &count);
            by_limit(&mut markdown, subject.limits_s, &count);
            let claims = claims(subject, &count);
            for Claim { text, holds: own } in &claims {
                let told = if *own { "holds" } else { "FAILS" };
                put(&mut markdown, format_args!("- {told}: {text}\n"));
                holds &= own;
            }
            told_outcomes(&mut markdown, subject.runs, estimator);
            markdown.push('\n');
        }
        for room in subject.rooms_left_out {
            put(&mut markdown, format_args!("- left out, no reference: {room}\n"));
        }
        Self { markdown, holds }
    }
}

/// What counts: the runs of a family at a limit, of all where they are `None`.
type Columns<'a> = dyn Fn(Option<&str>, Option<f64>) -> Count + 'a;

fn by_family(text: &mut String, count: &Columns<'_>) {
    text.push_str(
        "| family | witness | rooms | runs | intervals | false | with bound | by chance | \
         worst s.e. | half-width covers | both cover | much unseen | withdrawn | left out |\n\
         |---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    let names = families::ALL.iter().map(|family| Some(family.name)).chain([None]);
    for name in names {
        let own = count(name, None);
        if own.runs + own.refused + own.crashed == 0 {
            continue;
        }
        let room = name.and_then(|name| crate::families::room_of(name, 0));
        let witness = room.map(|room| room.witness().join(", ")).unwrap_or_default();
        put(
            text,
            format_args!(
                "| {} | {} | {} | {} | {} | {} | {} | {:.2} | {:.1} | {} | {} | {} | {} | {} |\n",
                name.unwrap_or("all"),
                witness,
                own.rooms.len(),
                own.runs,
                own.intervals,
                own.is_false,
                own.is_false_with_bound,
                own.allowed(),
                own.largest_sigmas,
                per_cent(own.covered.value()),
                per_cent(own.covered_with_bound.value()),
                own.much_unseen,
                own.withdrawn,
                own.left_out,
            ),
        );
    }
    text.push('\n');
}

fn by_limit(text: &mut String, limits_s: &[f64], count: &Columns<'_>) {
    text.push_str(
        "| limit in s | runs | done | intervals | with bound | half-width covers | both cover | \
         much unseen | withdrawn |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
    );
    for &limit_s in limits_s {
        let own = count(None, Some(limit_s));
        put(
            text,
            format_args!(
                "| {limit_s} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
                own.looks,
                own.done,
                own.intervals,
                own.is_false_with_bound,
                per_cent(own.covered.value()),
                per_cent(own.covered_with_bound.value()),
                own.much_unseen,
                own.withdrawn,
            ),
        );
    }
    text.push('\n');
}

fn claims(subject: &Subject<'_>, count: &Columns<'_>) -> Vec<Claim> {
    let mut claims = claims_of_falsehood(count);
    claims.extend(subject.limits_s.iter().flat_map(|&limit_s| claims_of_coverage(limit_s, count)));
    let crashed = count(None, None).crashed;
    if crashed > 0 {
        claims.push(Claim { text: format!("{crashed} runs crashed"), holds: false });
    }
    claims
}

/// False intervals are as rare as by chance, in all families together and in each.
fn claims_of_falsehood(count: &Columns<'_>) -> Vec<Claim> {
    let all = count(None, None);
    let probability = all.probability();
    let mut claims = vec![Claim {
        text: format!(
            "{} of {} intervals are false, in {} of {} runs; chance gives {:.2} (probability of \
             so many runs: {probability:.1e})",
            all.is_false_with_bound,
            all.intervals,
            all.false_runs,
            all.runs,
            all.allowed(),
        ),
        holds: probability >= likelihood::RARE,
    }];
    for family in &families::ALL {
        let own = count(Some(family.name), None);
        let probability = own.probability();
        if probability < likelihood::RARE {
            let (name, bad, runs) = (family.name, own.false_runs, own.runs);
            let text = format!(
                "{name}: {bad} of {runs} runs have false intervals, of probability \
                 {probability:.1e}"
            );
            claims.push(Claim { text, holds: false });
        }
    }
    claims
}

/// What both numbers and the half-width alone cover at a limit, two binomial deviations allowed.
fn claims_of_coverage(limit_s: f64, count: &Columns<'_>) -> Vec<Claim> {
    let own = count(None, Some(limit_s));
    let mut claims = Vec::new();
    let both = own.covered_with_bound;
    if both.runs >= FEW_RUNS {
        let least = COVERED_WITH_BOUND - 2.0 * likelihood::deviation(COVERED_WITH_BOUND, both.runs);
        let text = format!(
            "at {limit_s} s both numbers cover {} in {} runs, at least {} is wanted",
            per_cent(both.value()),
            both.runs,
            per_cent(least)
        );
        claims.push(Claim { text, holds: both.value() >= least });
    }
    let alone = own.covered;
    if alone.runs >= FEW_RUNS {
        let [least, most] = COVERED;
        let least = least - 2.0 * likelihood::deviation(least, alone.runs);
        let most = most + 2.0 * likelihood::deviation(most, alone.runs);
        let text = format!(
            "at {limit_s} s the half-width alone covers {} in {} runs where little is unseen, {} \
             to {} is wanted",
            per_cent(alone.value()),
            alone.runs,
            per_cent(least),
            per_cent(most.min(1.0))
        );
        claims.push(Claim { text, holds: (least..=most).contains(&alone.value()) });
    }
    claims
}

/// Runs that were refused or crashed, the first of each family.
fn told_outcomes(text: &mut String, runs: &[RunRecord], estimator: EstimatorKind) {
    let mut told: Vec<&str> = Vec::new();
    for run in runs.iter().filter(|run| run.key.estimator == estimator) {
        let (what, why) = match &run.outcome {
            RunOutcome::Refused(why) => ("refused", why),
            RunOutcome::Crashed(why) => ("crashed", why),
            RunOutcome::Done(_) => continue,
        };
        let (family, number) = (run.key.family.as_str(), run.key.number);
        if !told.contains(&family) {
            told.push(family);
            put(text, format_args!("- {what}: {family} {number}: {why}\n"));
        }
    }
}

fn per_cent(share: f64) -> String {
    if share.is_finite() { format!("{:.1} %", 100.0 * share) } else { "-".to_owned() }
}

fn put(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("strings grow");
}
