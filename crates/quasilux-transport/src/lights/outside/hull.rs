//! The box around a scene that light from outside comes into.

use glam::DVec3;
use quasilux_sampling::choose_weights;
use std::array;

/// The box is larger than what it holds by this share of its size, and by this length in m.
const MARGIN: f64 = 1e-3;
const MIN_MARGIN_M: f64 = 1e-6;

/// A box with room between it and all that it holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hull {
    low: DVec3,
    high: DVec3,
}

impl Hull {
    /// Around some places; `None` around nothing.
    pub(super) fn around(places: impl Iterator<Item = DVec3>) -> Option<Self> {
        let box_of = |[low, high]: [DVec3; 2], place: DVec3| [low.min(place), high.max(place)];
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] = places.fold(empty, box_of);
        let margin = (MARGIN * (high - low).max_element()).max(MIN_MARGIN_M);
        low.is_finite().then_some(Self { low: low - margin, high: high + margin })
    }

    /// Its middle.
    pub(super) fn centre(&self) -> DVec3 {
        0.5 * (self.low + self.high)
    }

    /// The distance in m from its middle to its corners.
    pub(super) fn radius_m(&self) -> f64 {
        0.5 * (self.high - self.low).length()
    }

    /// Its silhouette in m^2, as seen along a unit vector.
    pub(super) fn silhouette_m2(&self, direction: DVec3) -> f64 {
        self.faces_m2(direction).iter().sum()
    }

    /// The largest silhouette in m^2 along directions within this angle in radians of one.
    pub(super) fn most_m2(&self, direction: DVec3, within: f64) -> f64 {
        self.silhouette_m2(direction) + within * self.faces_m2(DVec3::ONE).iter().sum::<f64>()
    }

    /// Silhouettes of the faces across each axis that light of this direction comes in by.
    fn faces_m2(&self, direction: DVec3) -> [f64; 3] {
        let [x, y, z] = (self.high - self.low).to_array();
        let areas_m2 = [y * z, z * x, x * y];
        array::from_fn(|axis| areas_m2[axis] * direction[axis].abs())
    }

    /// Where a line of this direction comes in, evenly over the silhouette, by two coordinates.
    pub(super) fn sample_entry(&self, direction: DVec3, u: [f64; 2]) -> Option<DVec3> {
        let choice = choose_weights(u[0], self.faces_m2(direction).into_iter())?;
        let (axis, size) = (choice.index, self.high - self.low);
        let mut entry = self.low;
        entry[(axis + 1) % 3] += choice.u_remapped * size[(axis + 1) % 3];
        entry[(axis + 2) % 3] += u[1] * size[(axis + 2) % 3];
        entry[axis] = if direction[axis] > 0.0 { self.low[axis] } else { self.high[axis] };
        Some(entry)
    }

    /// Where the line of this direction through a point comes in; `None` where it passes by.
    pub(super) fn entry(&self, point: DVec3, direction: DVec3) -> Option<DVec3> {
        let (mut first, mut last) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (at, along) = (point[axis], direction[axis]);
            if along == 0.0 {
                if at < self.low[axis] || at > self.high[axis] {
                    return None;
                }
                continue;
            }
            let [a, b] = [self.low[axis], self.high[axis]].map(|plane| (plane - at) / along);
            (first, last) = (first.max(a.min(b)), last.min(a.max(b)));
        }
        (first <= last).then(|| point + direction * first)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::radical_inverse;
    use quasilux_stats::jacobian_determinant;

    fn hull() -> Hull {
        let corners = [DVec3::new(1.0, -2.0, 0.5), DVec3::new(4.0, 3.0, 2.0)];
        Hull::around(corners.into_iter()).unwrap()
    }

    fn directions() -> impl Iterator<Item = DVec3> {
        (0..200_u64).map(|index| {
            let [x, y, z] = [2, 3, 5].map(|base| 2.0 * radical_inverse(base, index + 1) - 1.0);
            DVec3::new(x, y, z).normalize()
        })
    }

    /// Places are spread evenly over the silhouette: the map to the plane across the direction has
    /// its area for a Jacobian. 1e-6 of it is found.
    #[test]
    fn entries_are_even_over_the_silhouette() {
        let hull = hull();
        for (number, direction) in (0..).zip(directions()) {
            let a = direction.any_orthonormal_vector();
            let b = direction.cross(a);
            let across = |u: [f64; 2]| {
                let entry = hull.sample_entry(direction, u).unwrap();
                [a.dot(entry), b.dot(entry)]
            };
            let u = [7, 11].map(|base| 0.01 + 0.98 * radical_inverse(base, number + 1));
            let spread = jacobian_determinant(across, u, 1e-7).abs();
            let expected = hull.silhouette_m2(direction);
            // The two sides of a step belong to two faces now and then.
            assert!((spread / expected - 1.0).abs() < 1e-6 || spread > 1e3 * expected);
        }
    }

    /// A line comes in where it was drawn to, seen from any point of it.
    #[test]
    fn lines_come_in_where_they_are_drawn() {
        let hull = hull();
        for (number, direction) in (0..).zip(directions()) {
            let u = [7, 11].map(|base| radical_inverse(base, number + 1));
            let drawn = hull.sample_entry(direction, u).unwrap();
            let found = hull.entry(drawn + direction * 0.3, direction).unwrap();
            assert!((found - drawn).length() < 1e-9, "{found}, not {drawn}");
            assert!(hull.entry(hull.high + DVec3::ONE, DVec3::new(1.0, -1.0, 0.0)).is_none());
        }
    }

    #[test]
    fn there_is_none_around_nothing() {
        assert!(Hull::around(std::iter::empty()).is_none());
        let flat = Hull::around([DVec3::ZERO, DVec3::X, DVec3::Y].into_iter()).unwrap();
        assert!(flat.low.z < 0.0 && flat.high.z > 0.0);
        assert!((flat.silhouette_m2(DVec3::NEG_Z) - 1.0).abs() < 0.01);
    }
}
