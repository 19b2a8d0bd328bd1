//! Many runs of one kind in one room, counted.

use super::Count;
use super::kinds::{INDICES, Kind, Limits};
use super::pool::Pool;
use super::stopping::{End, Rule};
use rayon::prelude::*;

pub(super) const FIXED: &str = "fixed N";
pub(super) const STOP: &str = "at the stop";

/// Of a fixed number of indices.
pub(super) fn fixed(pool: &Pool, kind: Kind, runs: u32) -> Count {
    let end = |run| End { limits: kind.limits(pool, run), samples: INDICES, is_narrow: false };
    let ends: Vec<End> = (0..runs).into_par_iter().map(end).collect();
    let truth = match kind {
        Kind::StudentT | Kind::BootstrapT | Kind::OrderStatistics => pool.large_nets.mean,
        Kind::BettingOnNets => pool.nets.mean,
        Kind::Bernstein | Kind::BettingOnTrials | Kind::Certified => pool.trials.mean,
    };
    count(pool, Label { kind: kind.name(), moment: FIXED }, truth, &ends)
}

/// Where runs end by themselves.
pub(super) fn looked_at(pool: &Pool, rule: Rule, runs: u32) -> Count {
    let ends: Vec<End> = (0..runs).into_par_iter().map(|run| rule.end(pool, run)).collect();
    count(pool, Label { kind: rule.name(), moment: STOP }, pool.trials.mean, &ends)
}

/// What is counted.
struct Label {
    kind: &'static str,
    moment: &'static str,
}

fn count(pool: &Pool, label: Label, truth: f64, ends: &[End]) -> Count {
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let half_width = median(ends.iter().map(|end| end.limits.half_width()).collect());
    let samples = median(ends.iter().map(|end| end.samples as f64).collect());
    let number = |is: &dyn Fn(&Limits) -> bool| ends.iter().filter(|end| is(&end.limits)).count();
    Count {
        room: pool.room,
        kind: label.kind,
        moment: label.moment,
        runs: ends.len(),
        covered: number(&|limits| limits.covers(truth)),
        too_high: number(&|limits| limits.lower > truth),
        half_width: Some(half_width / truth).filter(|share| share.is_finite()),
        samples: samples as u64,
        stopped: ends.iter().filter(|end| end.is_narrow).count(),
    }
}
