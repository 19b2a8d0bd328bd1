//! How wide a luminaire shines in a plane: beam and field angles.
//!
//! CIE S 017 (International Lighting Vocabulary): half-peak divergence is the angular extent of all
//! directions of the plane with more than half the maximum. So for a batwing the *outermost*
//! crossings count, and the dip between the wings is part of the beam. Two rules make the extent
//! definite on the whole circle:
//!
//! 1. It is the smallest arc that contains all those directions: the circle without its largest
//!    gap.
//! 2. Where no horizontal direction is among them, light up and light down are two beams, and the
//!    arc is that of the one with the maximum.

use super::{PlaneCurve, PlanePoint};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// An arc of directions in a plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Where it begins: gamma, signed as in [`PlaneCurve`].
    pub start_rad: f64,
    /// Where it ends; above pi where the arc passes zenith.
    pub end_rad: f64,
}

/// Directions between two values of gamma.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Arc {
    start_rad: f64,
    end_rad: f64,
}

impl Spread {
    /// From end to end.
    pub fn angle_rad(&self) -> f64 {
        self.end_rad - self.start_rad
    }
}

impl PlaneCurve {
    /// The arc of the directions with at least this intensity, by the rules above, exact for the
    /// piecewise linear curve; `None` where the threshold is not positive or nothing reaches it.
    pub fn spread(&self, threshold_cd: f64) -> Option<Spread> {
        if threshold_cd <= 0.0 {
            return None;
        }
        let mut arcs = self.arcs_above(threshold_cd);
        let reaches_horizon = |arc: &Arc| {
            let contains = |gamma_rad| arc.start_rad <= gamma_rad && gamma_rad <= arc.end_rad;
            contains(-FRAC_PI_2) || contains(FRAC_PI_2)
        };
        if !arcs.iter().any(reaches_horizon) {
            let is_downward = self.is_brightest_below();
            arcs.retain(|arc| (arc.start_rad.abs() < FRAC_PI_2) == is_downward);
        }
        without_largest_gap(&arcs)
    }

    /// Arcs of at least this intensity, in ascending order, none touching the next one but at
    /// zenith.
    fn arcs_above(&self, threshold_cd: f64) -> Vec<Arc> {
        let mut arcs: Vec<Arc> = Vec::new();
        for pair in self.points().windows(2) {
            let Some(arc) = piece_above(pair[0], pair[1], threshold_cd) else {
                continue;
            };
            match arcs.last_mut() {
                Some(last) if arc.start_rad <= last.end_rad => last.end_rad = arc.end_rad,
                _ => arcs.push(arc),
            }
        }
        arcs
    }

    fn is_brightest_below(&self) -> bool {
        let brightest = |is_below: bool| {
            let points = self.points().iter();
            let inside = points.filter(|point| (point.gamma_rad.abs() <= FRAC_PI_2) == is_below);
            inside.map(|point| point.intensity_cd).fold(0.0, f64::max)
        };
        brightest(true) >= brightest(false)
    }
}

/// The part of a straight piece that is at least at the threshold.
fn piece_above(from: PlanePoint, to: PlanePoint, threshold_cd: f64) -> Option<Arc> {
    let crossing = || {
        let share = (threshold_cd - from.intensity_cd) / (to.intensity_cd - from.intensity_cd);
        from.gamma_rad + share * (to.gamma_rad - from.gamma_rad)
    };
    let (start_rad, end_rad) =
        match (from.intensity_cd >= threshold_cd, to.intensity_cd >= threshold_cd) {
            (true, true) => (from.gamma_rad, to.gamma_rad),
            (true, false) => (from.gamma_rad, crossing()),
            (false, true) => (crossing(), to.gamma_rad),
            (false, false) => return None,
        };
    Some(Arc { start_rad, end_rad })
}

fn without_largest_gap(arcs: &[Arc]) -> Option<Spread> {
    let (first, last) = (arcs.first()?, arcs.last()?);
    let through_zenith = first.start_rad + TAU - last.end_rad;
    let mut widest = through_zenith;
    let mut spread = Spread { start_rad: first.start_rad, end_rad: last.end_rad };
    for pair in arcs.windows(2) {
        let gap = pair[1].start_rad - pair[0].end_rad;
        if gap > widest {
            widest = gap;
            spread = Spread { start_rad: pair[1].start_rad, end_rad: pair[0].end_rad + TAU };
        }
    }
    // An arc that lies wholly beyond zenith is named from the other side.
    if spread.start_rad >= PI {
        spread = Spread { start_rad: spread.start_rad - TAU, end_rad: spread.end_rad - TAU };
    }
    Some(spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread_deg(points: &[(f64, f64)], threshold_cd: f64) -> Option<[f64; 2]> {
        let spread = PlaneCurve::through(points).spread(threshold_cd)?;
        Some([spread.start_rad, spread.end_rad].map(|x| x / PI * 180.0))
    }

    fn assert_near(found: Option<[f64; 2]>, expected: [f64; 2]) {
        let found = found.expect("an arc");
        assert!((0..2).all(|i| (found[i] - expected[i]).abs() < 1e-12), "{found:?} {expected:?}");
    }

    #[test]
    fn a_triangle_is_cut_where_it_is_crossed() {
        let triangle = [(-180.0, 0.0), (-40.0, 0.0), (0.0, 8.0), (20.0, 0.0), (180.0, 0.0)];
        assert_near(spread_deg(&triangle, 4.0), [-20.0, 10.0]);
        assert_near(spread_deg(&triangle, 0.8), [-36.0, 18.0]);
        assert_eq!(spread_deg(&triangle, 9.0), None);
        assert_eq!(spread_deg(&triangle, 0.0), None);
    }

    #[test]
    fn a_dip_belongs_to_the_beam() {
        let batwing = [
            (-180.0, 0.0),
            (-70.0, 0.0),
            (-50.0, 10.0),
            (0.0, 1.0),
            (50.0, 10.0),
            (70.0, 0.0),
            (180.0, 0.0),
        ];
        assert_near(spread_deg(&batwing, 5.0), [-60.0, 60.0]);
    }

    #[test]
    fn light_upwards_is_one_arc_through_zenith() {
        let upwards = [(-180.0, 9.0), (-150.0, 0.0), (0.0, 0.0), (120.0, 0.0), (180.0, 9.0)];
        assert_near(spread_deg(&upwards, 4.5), [150.0, 195.0]);
    }

    #[test]
    fn light_up_and_down_is_two_beams_unless_it_meets_at_the_horizon() {
        let apart = [
            (-180.0, 4.0),
            (-140.0, 0.0),
            (-30.0, 0.0),
            (0.0, 8.0),
            (30.0, 0.0),
            (140.0, 0.0),
            (180.0, 4.0),
        ];
        assert_near(spread_deg(&apart, 2.0), [-22.5, 22.5]);
        let meeting = [(-180.0, 0.0), (-90.0, 1.0), (0.0, 4.0), (90.0, 2.0), (180.0, 0.0)];
        assert_near(spread_deg(&meeting, 2.0), [-60.0, 90.0]);
        assert_near(spread_deg(&meeting, 1.0), [-90.0, 135.0]);
    }

    #[test]
    fn light_on_every_side_is_a_full_turn() {
        let everywhere = [(-180.0, 3.0), (0.0, 4.0), (180.0, 3.0)];
        assert_near(spread_deg(&everywhere, 2.0), [-180.0, 180.0]);
    }

    #[test]
    fn jumps_end_an_arc() {
        let hemisphere =
            [(-180.0, 0.0), (-90.0, 0.0), (-90.0, 5.0), (90.0, 5.0), (90.0, 0.0), (180.0, 0.0)];
        assert_near(spread_deg(&hemisphere, 2.5), [-90.0, 90.0]);
        let nadir =
            [(-180.0, 0.0), (-10.0, 0.0), (0.0, 2.0), (0.0, 6.0), (10.0, 0.0), (180.0, 0.0)];
        assert_near(spread_deg(&nadir, 3.0), [0.0, 5.0]);
    }
}
