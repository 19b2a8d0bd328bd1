//! Cones of directions from one point, which bound the part of space that sees a mirror image.

use glam::DVec3;
use std::f64::consts::PI;

/// Half-angles are drawn this much too large, in rad: images are left out only where that is
/// certain.
const MARGIN_RAD: f64 = 1e-6;

/// All directions no farther than an angle from an axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cone {
    axis: DVec3,
    half_rad: f64,
    /// Cosine of the half-angle; -1 holds everything.
    cos: f64,
}

impl Cone {
    pub(crate) const EVERYWHERE: Self = Self { axis: DVec3::Z, half_rad: PI, cos: -1.0 };

    /// A cone around convex polygons with these corners, seen from `apex`.
    pub(crate) fn around(apex: DVec3, corners: &[DVec3]) -> Self {
        let directions = || corners.iter().map(|&corner| (corner - apex).normalize_or_zero());
        let axis = directions().sum::<DVec3>().normalize_or_zero();
        let least = directions().map(|direction| direction.dot(axis)).fold(1.0, f64::min);
        // A polygon seen under less than a half-space lies between its corners.
        if least > 0.0 { Self::new(axis, libm::acos(least)) } else { Self::EVERYWHERE }
    }

    /// A cone around convex polygons for light that starts no farther than `radius_m` from the
    /// apex: holds the directions in which it leaves, and those from the apex to all that it
    /// reaches through the polygons.
    pub(crate) fn around_ball(apex: DVec3, radius_m: f64, corners: &[DVec3]) -> Self {
        let cone = Self::around(apex, corners);
        let along = corners.iter().map(|&corner| (corner - apex).dot(cone.axis));
        let near_m = along.fold(f64::INFINITY, f64::min);
        match radius_m {
            0.0 => cone,
            _ if cone.cos > 0.0 && near_m > radius_m => {
                Self::new(cone.axis, cone.half_rad + libm::asin(radius_m / near_m))
            }
            _ => Self::EVERYWHERE,
        }
    }

    fn new(axis: DVec3, half_rad: f64) -> Self {
        let half_rad = (half_rad + MARGIN_RAD).min(PI);
        Self { axis, half_rad, cos: libm::cos(half_rad) }
    }

    /// The narrower of two cones.
    pub(crate) fn narrower(self, other: Self) -> Self {
        if other.half_rad < self.half_rad { other } else { self }
    }

    /// The cone as a mirror with this unit normal shows it.
    pub(crate) fn mirrored(self, normal: DVec3) -> Self {
        Self { axis: self.axis - normal * (2.0 * normal.dot(self.axis)), ..self }
    }

    /// The least cosine of its directions with an axis, either way; 0 where some are square to it.
    pub(crate) fn min_cos_with(&self, axis: DVec3) -> f64 {
        let between_rad = libm::acos(self.axis.dot(axis).abs().min(1.0));
        let max_rad = between_rad + self.half_rad;
        if max_rad < std::f64::consts::FRAC_PI_2 { libm::cos(max_rad) } else { 0.0 }
    }

    pub(crate) fn meets(&self, other: &Self) -> bool {
        let between_rad = libm::acos(self.axis.dot(other.axis).clamp(-1.0, 1.0));
        between_rad <= self.half_rad + other.half_rad
    }

    /// Whether it holds the direction of `toward`, of any length.
    pub(crate) fn holds(&self, toward: DVec3) -> bool {
        self.axis.dot(toward) >= self.cos * toward.length()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_holds_its_polygon() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 1.0));
        let apex = DVec3::new(-0.5, 0.3, -0.2);
        let cone = Cone::around(apex, &corners);
        for i in 0..10 {
            for j in 0..10 - i {
                let (a, b) = (f64::from(i) / 9.0, f64::from(j) / 9.0);
                let place =
                    corners[0] + (corners[1] - corners[0]) * a + (corners[2] - corners[0]) * b;
                assert!(cone.holds(place - apex), "{place}");
            }
        }
        let least = corners.iter().map(|&corner| (corner - apex).normalize().z).fold(1.0, f64::min);
        for axis in [DVec3::Z, DVec3::NEG_Z] {
            let found = cone.min_cos_with(axis);
            assert!(found <= least && found > 0.3 * least, "{found}, {least}");
        }
        assert_eq!(cone.min_cos_with(DVec3::Y), 0.0);
        assert!(!cone.holds(DVec3::NEG_X) && !cone.holds(DVec3::NEG_Z));
        let other = |z: f64| Cone::around(apex, &corners.map(|corner| corner - DVec3::Z * z));
        assert!(cone.meets(&other(0.1)) && !cone.meets(&other(5.0)));
        assert!(Cone::around(apex, &[apex, DVec3::X]).holds(DVec3::NEG_Y));
    }

    /// All places that light of a ball reaches through a window, at any distance, are in its cone.
    #[test]
    fn a_cone_holds_what_a_ball_lights_through_a_window() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 1.0));
        let (apex, radius_m) = (DVec3::new(0.9, 0.3, -0.2), 0.6);
        let cone = Cone::around_ball(apex, radius_m, &corners);
        assert!(!cone.holds(DVec3::NEG_Z));
        for (axis, sign) in DVec3::AXES.into_iter().flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
            let start = apex + axis * (sign * radius_m);
            for corner in corners {
                for distance in [1.0, 3.0, 1e3] {
                    let place = start + (corner - start) * distance;
                    assert!(cone.holds(place - apex), "{start} {place}");
                }
            }
        }
        assert!(Cone::around_ball(apex, 1.3, &corners).holds(DVec3::NEG_Z));
    }
}
