//! What is counted over many runs.
//!
//! Points of a run share photons, so coverage is counted in runs (rooms x seeds) at a limit: each
//! has weight one, its points evenly. False intervals are counted one by one, and the runs that
//! have any: how rare that is by chance is asked of runs.

use crate::judgement::Judgement;
use crate::likelihood;
use crate::record::{LookRecord, RunOutcome, RunRecord};
use crate::truth::Truth;
use quasilux_transport::EstimatorKind;
use std::collections::{BTreeMap, BTreeSet};

/// What belongs to a count.
#[derive(Clone, Copy)]
pub(crate) struct Filter<'a> {
    pub(crate) estimator: EstimatorKind,
    /// One family, unless it is `None`.
    pub(crate) family: Option<&'a str>,
    /// One limit, unless it is `None`.
    pub(crate) limit_s: Option<f64>,
}

/// A share, each run with weight one.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Share {
    sum: f64,
    pub(crate) runs: u32,
}

/// Runs of one estimator.
#[derive(Clone, Debug, Default)]
pub(crate) struct Count {
    pub(crate) rooms: BTreeSet<String>,
    pub(crate) runs: u32,
    pub(crate) refused: u32,
    pub(crate) crashed: u32,
    /// Looks at which all that was wanted was reached.
    pub(crate) done: u32,
    pub(crate) looks: u32,
    pub(crate) points: u32,
    pub(crate) withdrawn: u32,
    /// Points whose reference is too weak or unsound.
    pub(crate) left_out: u32,
    pub(crate) intervals: u32,
    pub(crate) is_false: u32,
    pub(crate) is_false_with_bound: u32,
    /// Runs that have any, at any limit.
    pub(crate) false_runs: u32,
    pub(crate) much_unseen: u32,
    pub(crate) largest_sigmas: f64,
    /// Of points where little is unseen, the share that the half-width alone covers.
    pub(crate) covered: Share,
    pub(crate) covered_with_bound: Share,
}

/// What values are held against, by the digest of their room.
pub(crate) type Truths<'a> = BTreeMap<&'a str, &'a Truth>;

impl Count {
    pub(crate) fn new(runs: &[RunRecord], known: &Truths<'_>, filter: Filter<'_>) -> Self {
        let mut count = Self::default();
        let is_own = |run: &&RunRecord| {
            run.key.estimator == filter.estimator
                && filter.family.is_none_or(|family| run.key.family == family)
        };
        for run in runs.iter().filter(is_own) {
            let Some(truth) = known.get(run.key.digest.as_str()) else { continue };
            match &run.outcome {
                RunOutcome::Refused(_) => count.refused += 1,
                RunOutcome::Crashed(_) => count.crashed += 1,
                RunOutcome::Done(looks) => {
                    count.rooms.insert(run.key.digest.clone());
                    count.runs += 1;
                    let before = count.is_false_with_bound;
                    let is_own = |look: &&LookRecord| {
                        filter.limit_s.map_or(!look.is_repeated, |limit_s| look.limit_s == limit_s)
                    };
                    for look in looks.iter().filter(is_own) {
                        count.add_look(look, truth, run.key.rel_tol);
                    }
                    count.false_runs += u32::from(count.is_false_with_bound > before);
                }
            }
        }
        count
    }

    fn add_look(&mut self, look: &LookRecord, truth: &Truth, rel_tol: f64) {
        self.looks += 1;
        self.done += u32::from(look.is_done);
        let mut judged = Vec::new();
        for (place, point) in look.points.iter().enumerate() {
            self.points += 1;
            let reference = truth.at_place(place, point, rel_tol);
            let Some(reference) = reference.filter(|it| it.can_judge(rel_tol)) else {
                self.left_out += 1;
                continue;
            };
            match Judgement::new(point, &reference, rel_tol) {
                Some(judgement) => judged.push(judgement),
                None => self.withdrawn += 1,
            }
        }
        let count = |is: fn(&Judgement) -> bool| judged.iter().filter(|it| is(it)).count() as u32;
        self.intervals += judged.len() as u32;
        self.is_false += count(|it| it.is_false);
        self.is_false_with_bound += count(|it| it.is_false_with_bound);
        self.much_unseen += count(|it| it.is_much_unseen);
        self.covered
            .add(count(|it| it.is_little_unseen && it.covers), count(|it| it.is_little_unseen));
        self.covered_with_bound.add(count(|it| it.covers_with_bound), judged.len() as u32);
        let sigmas = judged.iter().map(|it| it.sigmas);
        self.largest_sigmas = sigmas.fold(self.largest_sigmas, f64::max);
    }

    /// How many intervals chance makes false.
    pub(crate) fn allowed(&self) -> f64 {
        f64::from(self.intervals) * likelihood::false_with_bound()
    }

    /// The probability that chance gives this many runs with false intervals, or more.
    pub(crate) fn probability(&self) -> f64 {
        if self.runs == 0 {
            return 1.0;
        }
        let intervals = f64::from(self.intervals) / f64::from(self.runs);
        let p = -libm::expm1(intervals * libm::log1p(-likelihood::false_with_bound()));
        likelihood::at_least(self.false_runs, self.runs, p)
    }
}

impl Share {
    fn add(&mut self, part: u32, all: u32) {
        if all > 0 {
            self.sum += f64::from(part) / f64::from(all);
            self.runs += 1;
        }
    }

    /// The share; not a number where nothing was counted.
    pub(crate) fn value(&self) -> f64 {
        self.sum / f64::from(self.runs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::{PointRecord, RunKey};
    use crate::references::{Reference, RoomReferences};

    fn look(limit_s: f64, is_repeated: bool, values: [f64; 2]) -> LookRecord {
        let point = |lx| PointRecord {
            lx,
            half_width_lx: Some(1.96),
            unseen_lx: None,
            merged_lx: 0.0,
            disc_radius_m: None,
        };
        let points = values.map(point).to_vec();
        LookRecord { limit_s, seconds: limit_s, samples: 1, is_done: false, is_repeated, points }
    }

    fn record(seed: u64, looks: Vec<LookRecord>) -> RunRecord {
        let key = RunKey {
            program: String::new(),
            family: "plain box".to_owned(),
            number: 0,
            digest: "d".to_owned(),
            estimator: EstimatorKind::Path,
            rel_tol: 0.03,
            limits_s: vec![1.0, 3.0],
            seed,
        };
        RunRecord { key, outcome: RunOutcome::Done(looks) }
    }

    #[test]
    fn runs_have_weight_one_and_repeated_looks_count_once() {
        let point = Reference { lx: 100.0, standard_error_lx: 0.0, is_sound: true };
        let weak = Reference { is_sound: false, ..point };
        let of = |points: Vec<Reference>| Truth {
            points: RoomReferences {
                family: "plain box".to_owned(),
                number: 0,
                digest: "d".to_owned(),
                relative_error: 0.006,
                seconds: 1.0,
                points,
            },
            discs: None,
        };
        let runs = [
            record(1, vec![look(1.0, false, [100.0, 103.0]), look(3.0, true, [100.0, 103.0])]),
            record(2, vec![look(1.0, false, [110.0, 110.0]), look(3.0, false, [100.0, 100.0])]),
        ];
        let filter = Filter { estimator: EstimatorKind::Path, family: None, limit_s: None };
        let references = of(vec![point, point]);
        let known = Truths::from([("d", &references)]);
        let count = Count::new(&runs, &known, filter);
        assert_eq!((count.runs, count.looks, count.intervals), (2, 3, 6));
        assert_eq!((count.is_false_with_bound, count.false_runs), (2, 1));
        assert!((count.covered.value() - 0.5).abs() < 1e-12, "a half, none and all");
        // One false run of two, of three intervals each.
        assert!((count.probability() / (6.0 * likelihood::false_with_bound()) - 1.0).abs() < 0.01);
        let last = Count::new(&runs, &known, Filter { limit_s: Some(3.0), ..filter });
        assert_eq!((last.looks, last.intervals, last.is_false), (2, 4, 0));
        let references = of(vec![point, weak]);
        let known = Truths::from([("d", &references)]);
        let count = Count::new(&runs, &known, filter);
        assert_eq!((count.points, count.left_out, count.intervals), (6, 3, 3));
        let other = Filter { estimator: EstimatorKind::Photon, ..filter };
        assert_eq!(Count::new(&runs, &known, other).runs, 0);
    }
}
