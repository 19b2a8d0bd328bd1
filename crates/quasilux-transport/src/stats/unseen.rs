//! Light that no sample met: a bound beside each value, `docs/unseen.md`.
//!
//! With n independent trials, of which each expects at most K samples in a set of paths that it has
//! one in, and samples that add at most W, a set of paths with more light than ln(1/d) K W is left
//! without any sample with a probability of at most d.

use crate::stats::certified::IndexTotals;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Confidence of the bounds on unseen light: 1 - d.
pub const UNSEEN_CONFIDENCE: f64 = 0.95;

/// Bounds on light at one sensor that may come by ways on which no sample lay.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct UnseenLight {
    /// At each point, the illuminance in lx at most that may come by ways on which no sample lay,
    /// with [`UNSEEN_CONFIDENCE`]; never negative, infinite where nothing is known.
    pub point_lx: Vec<f64>,
    /// Illuminance in lx at most, in the average over all points, that may come by ways on which no
    /// sample lay, with [`UNSEEN_CONFIDENCE`]: never more than the mean of `point_lx`.
    pub average_lx: f64,
    /// The part of each value that photons on the disc around the point brought, in lx: it is known
    /// as a mean over that disc.
    pub merged_lx: Vec<f64>,
    /// Radius of that disc in m; `None` for cells, and where there is none.
    pub disc_radius_m: Vec<Option<f64>>,
    /// Bounds that certified intervals are made of, where they were asked for.
    pub totals: Option<IndexTotals>,
}

impl UnseenLight {
    /// Nothing is known of any point.
    #[must_use]
    pub fn unknown(points: usize) -> Self {
        Self {
            point_lx: vec![f64::INFINITY; points],
            average_lx: f64::INFINITY,
            merged_lx: vec![0.0; points],
            disc_radius_m: vec![None; points],
            totals: None,
        }
    }

    /// Whether it has a row for each point.
    pub(crate) fn has_points(&self, points: usize) -> bool {
        [self.point_lx.len(), self.merged_lx.len(), self.disc_radius_m.len()] == [points; 3]
            && self.totals.as_ref().is_none_or(|totals| totals.has_points(points))
    }

    /// That of some of its points: of their average no more is known than of each.
    pub(crate) fn part(&self, points: Range<usize>) -> Self {
        let point_lx = self.point_lx[points.clone()].to_vec();
        Self {
            average_lx: mean(&point_lx),
            point_lx,
            merged_lx: self.merged_lx[points.clone()].to_vec(),
            disc_radius_m: self.disc_radius_m[points.clone()].to_vec(),
            totals: self.totals.as_ref().map(|totals| totals.part(points)),
        }
    }
}

/// Light in lx at most, with [`UNSEEN_CONFIDENCE`], by ways on which none of this many trials had a
/// sample; `most_lx` is what a sample adds times the samples that a trial expects. Infinite where
/// nothing is known.
#[must_use]
pub(crate) fn unseen_lx(most_lx: f64, trials: f64) -> f64 {
    let lx = -libm::log(1.0 - UNSEEN_CONFIDENCE) * most_lx / trials;
    if lx.is_nan() { f64::INFINITY } else { lx }
}

/// A bound for one of `points` points, times this, holds for all of them at once: ln(1/d) becomes
/// ln(m/d).
#[must_use]
pub(crate) fn factor_of_all(points: usize) -> f64 {
    let miss = 1.0 - UNSEEN_CONFIDENCE;
    libm::log(points.max(1) as f64 / miss) / libm::log(1.0 / miss)
}

fn mean(lx: &[f64]) -> f64 {
    if lx.is_empty() { 0.0 } else { lx.iter().sum::<f64>() / lx.len() as f64 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codec::{Reader, Writer};

    fn two() -> UnseenLight {
        UnseenLight {
            point_lx: vec![0.2, 0.4],
            average_lx: 0.05,
            merged_lx: vec![0.0, 3.0],
            disc_radius_m: vec![Some(0.1), None],
            totals: Some(IndexTotals::unknown(2)),
        }
    }

    #[test]
    fn parts_claim_no_more_than_their_points() {
        assert_eq!(two().part(1..2).average_lx, 0.4);
        assert_eq!(two().part(1..2).merged_lx, [3.0]);
        assert!(two().has_points(2) && !two().has_points(1));
    }

    /// In the bytes of a checkpoint, where nothing is known, too.
    #[test]
    fn bounds_come_back() {
        for unseen in [two(), UnseenLight::unknown(3)] {
            let mut out = Writer::default();
            out.value(&Some(&unseen));
            let bytes = out.finish();
            let read: Option<UnseenLight> = Reader::new(&bytes).value().unwrap();
            assert_eq!(read, Some(unseen));
        }
    }

    /// ln(1 / 0.05) = 2.9957: the rule of three.
    #[test]
    fn nothing_seen_is_three_at_most() {
        assert!((unseen_lx(10.0, 100.0) - 0.29957).abs() < 1e-5);
        assert_eq!(unseen_lx(0.0, 1.0), 0.0);
        assert!([unseen_lx(0.0, 0.0), unseen_lx(1.0, 0.0)].iter().all(|lx| *lx == f64::INFINITY));
    }

    /// ln(196 / 0.05) = 8.27: the bound in W where 196 points are to hold at once.
    #[test]
    fn many_points_widen_the_bound_by_a_logarithm() {
        let one = libm::log(20.0);
        assert!((factor_of_all(196) * one - 8.274).abs() < 1e-3);
        assert!((factor_of_all(1) - 1.0).abs() < 1e-12 && factor_of_all(0) == factor_of_all(1));
    }
}
