//! A value held against its reference.

use crate::likelihood::{FALSE_FROM, HALF_WIDTH_PER_ERROR, UNSEEN_FROM};
use crate::record::PointRecord;
use crate::references::Reference;

/// Unseen light over value that a point may have and be done, where the tolerance is smaller.
const UNSEEN_TOL: f64 = 0.05;
/// Where less of the half-width is unseen, the half-width alone has to hold.
const LITTLE_UNSEEN: f64 = 0.1;
/// Where nothing is drawn, all the error of a value is that a sensor stands a hair before its
/// place: 2^-30 of the room's size, which counts a millimetre from a lamp.
const ROUNDING: f64 = 1e-5;

/// What is said of a value that has an interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Judgement {
    /// Distance from the reference over the standard error of both together.
    pub(crate) sigmas: f64,
    /// Whether the interval alone is false.
    pub(crate) is_false: bool,
    /// Whether it is false with the bound on what is unseen, where there is one.
    pub(crate) is_false_with_bound: bool,
    /// Whether the interval alone, widened by the error of the reference, holds it.
    pub(crate) covers: bool,
    /// Whether value - half-width <= reference <= value + half-width + unseen.
    pub(crate) covers_with_bound: bool,
    /// Whether the half-width alone is to hold: so little is unseen.
    pub(crate) is_little_unseen: bool,
    /// Whether more is unseen than a point that is done may have.
    pub(crate) is_much_unseen: bool,
}

impl Judgement {
    /// `None` where the point was withdrawn.
    pub(crate) fn new(point: &PointRecord, reference: &Reference, rel_tol: f64) -> Option<Self> {
        let half_width = point.half_width_lx?;
        let own = half_width / HALF_WIDTH_PER_ERROR;
        let both = libm::hypot(own, reference.standard_error_lx).max(ROUNDING * reference.lx);
        let above = (reference.lx - point.lx) / both;
        let unseen_lx = point.unseen_lx.unwrap_or(0.0);
        let unseen = unseen_lx / both;
        let covers = above.abs() <= HALF_WIDTH_PER_ERROR;
        Some(Self {
            sigmas: above.abs(),
            is_false: above.abs() > FALSE_FROM,
            is_false_with_bound: above < -FALSE_FROM || above > FALSE_FROM + UNSEEN_FROM * unseen,
            covers,
            covers_with_bound: covers || (above > 0.0 && above <= HALF_WIDTH_PER_ERROR + unseen),
            is_little_unseen: unseen_lx <= LITTLE_UNSEEN * half_width,
            is_much_unseen: unseen_lx > UNSEEN_TOL.max(rel_tol) * point.lx,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(lx: f64, half_width_lx: f64, unseen_lx: Option<f64>) -> Judgement {
        let half_width_lx = Some(half_width_lx);
        let point =
            PointRecord { lx, half_width_lx, unseen_lx, merged_lx: 0.0, disc_radius_m: None };
        let reference = Reference { lx: 100.0, standard_error_lx: 0.0, is_sound: true };
        Judgement::new(&point, &reference, 0.03).unwrap()
    }

    #[test]
    fn intervals_are_false_beyond_five_standard_errors() {
        // A half-width of 1.96 is a standard error of 1.
        assert!(!judged(95.1, 1.96, None).is_false);
        assert!(judged(94.9, 1.96, None).is_false);
        assert!(judged(105.1, 1.96, None).is_false_with_bound);
        let bounded = judged(80.0, 1.96, Some(5.0));
        assert!(bounded.is_false && !bounded.is_false_with_bound, "21 = 5 + 3.2 x 5");
        assert!(judged(78.9, 1.96, Some(5.0)).is_false_with_bound);
        assert!(judged(121.0, 1.96, Some(5.0)).is_false_with_bound, "no bound below");
    }

    #[test]
    fn both_numbers_cover_what_either_covers() {
        assert!(judged(98.1, 1.96, None).covers && judged(101.9, 1.96, None).covers);
        let unseen = judged(95.0, 1.96, Some(4.0));
        assert!(!unseen.covers && unseen.covers_with_bound);
        assert!(!judged(105.0, 1.96, Some(4.0)).covers_with_bound);
        assert!(judged(100.0, 1.96, Some(0.1)).is_little_unseen);
        assert!(!judged(100.0, 1.96, Some(0.3)).is_little_unseen);
        assert!(judged(100.0, 1.96, Some(5.1)).is_much_unseen);
    }

    #[test]
    fn nothing_found_with_a_bound_is_an_answer() {
        let dark = judged(0.0, 0.0, Some(40.0));
        assert!(!dark.is_false_with_bound && !dark.covers_with_bound && dark.is_much_unseen);
        assert!(judged(0.0, 0.0, Some(120.0)).covers_with_bound);
        assert!(judged(0.0, 0.0, Some(20.0)).is_false_with_bound);
    }
}
