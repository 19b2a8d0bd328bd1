//! A triangle as it is seen from a place: its solid angle, and points spread evenly over that.
//!
//! The solid angle E of a triangle whose corners are seen in the unit directions a, b, c follows
//! `tan(E / 2) = |a . (b x c)| / (1 + a.b + b.c + c.a)` (A. Van Oosterom, J. Strackee, "The solid
//! angle of a plane triangle", IEEE Trans. Biomed. Eng. 30, 1983). Directions uniform over it are
//! drawn as by J. Arvo, "Stratified sampling of spherical triangles", SIGGRAPH 1995: one number
//! cuts the triangle a, b, q with the wanted share of E off, q on the arc from a to c; another
//! goes along the arc from b to q. Here q is a, mirrored at a direction `o = x a + y c`: put for c
//! into the formula above, that asks for `y G0 cos h = (x G2 + y G1) sin h` with h half of the
//! wanted solid angle, `G0 = |a . (b x c)|`, `G1 = (a + b).c` and `G2 = 1 + a.b`. Inverse
//! trigonometric functions are needed for E alone, as in C. Peters, "BRDF importance sampling for
//! polygonal lights", ACM Trans. Graph. 40(4), 2021.

use glam::DVec3;
use quasilux_sampling::warp::sample_triangle;
use std::array;

/// A triangle that reaches less far from its centre than this part of its distance gets points
/// uniform over its area: distances vary by a sixteenth to either side, light by an eighth.
const MIN_SIZE: f64 = 1.0 / 16.0;
/// So does one of a smaller solid angle in sr, a sliver or one seen from its side.
const MIN_SOLID_ANGLE_SR: f64 = 1e-6;

/// The front of a triangle, seen from a place.
pub(super) struct SeenTriangle {
    place: DVec3,
    /// The corners in m, from the place on, and the unit directions to them.
    ways_m: [DVec3; 3],
    corners: [DVec3; 3],
    /// Unit normal of the front.
    n: DVec3,
    /// Of the place over the triangle's plane.
    height_m: f64,
    /// The numerator of the formula at the head of this module, and its denominator.
    ratio: [f64; 2],
}

impl SeenTriangle {
    /// `None` where the front, with the unit normal `n`, cannot be seen.
    pub(super) fn new(corners: [DVec3; 3], n: DVec3, place: DVec3) -> Option<Self> {
        let ways_m = corners.map(|corner| corner - place);
        let height_m = -n.dot(ways_m[0]);
        if height_m <= 0.0 {
            return None;
        }
        let per_m = ways_m.map(|way_m| way_m.length().recip());
        let [a, b, c]: [DVec3; 3] = array::from_fn(|corner| ways_m[corner] * per_m[corner]);
        // Edges span the same volume as ways to corners do, and lose no digits from afar.
        let spanned_m3 = twice_area_m2(ways_m).dot(ways_m[0]).abs();
        let numerator = spanned_m3 * (per_m[0] * per_m[1] * per_m[2]);
        let ratio = [numerator, 1.0 + a.dot(b) + b.dot(c) + c.dot(a)];
        Some(Self { place, ways_m, corners: [a, b, c], n, height_m, ratio })
    }

    pub(super) fn solid_angle_sr(&self) -> f64 {
        let [y, x] = self.ratio;
        2.0 * libm::atan2(y, x)
    }

    /// The solid angle, where points are spread over that.
    fn spread_over_sr(&self) -> Option<f64> {
        let centre_m = (self.ways_m[0] + self.ways_m[1] + self.ways_m[2]) / 3.0;
        let [a, b, c] = self.ways_m.map(|way_m| (way_m - centre_m).length_squared());
        let is_near = a.max(b).max(c) > MIN_SIZE * MIN_SIZE * centre_m.length_squared();
        is_near.then(|| self.solid_angle_sr()).filter(|sr| *sr > MIN_SOLID_ANGLE_SR)
    }

    /// A point of it.
    pub(super) fn sample_point(&self, u: [f64; 2]) -> DVec3 {
        let Some(solid_angle_sr) = self.spread_over_sr() else {
            let [a, b, c] = sample_triangle(u);
            return self.place + self.ways_m[0] * a + self.ways_m[1] * b + self.ways_m[2] * c;
        };
        let [a, b, c] = self.corners;
        let (sin, cos) = libm::sincos(0.5 * solid_angle_sr * u[0]);
        let [g0, g1, g2] = [self.ratio[0], (a + b).dot(c), 1.0 + a.dot(b)];
        let o = a * (g0 * cos - g1 * sin) + c * (g2 * sin);
        let q = o * (2.0 * a.dot(o) / o.length_squared()) - a;
        // One less the cosine of the angle from b: differences of cosines would lose digits.
        let short = u[1] * 0.5 * (q - b).length_squared();
        let across = (q - b * b.dot(q)).normalize_or_zero();
        let direction = b * (1.0 - short) + across * (short * (2.0 - short)).sqrt();
        self.place + direction * (self.height_m / -self.n.dot(direction))
    }

    /// Density in m^-2 of [`Self::sample_point`].
    pub(super) fn pdf_m2(&self, point: DVec3) -> f64 {
        let Some(solid_angle_sr) = self.spread_over_sr() else {
            return 2.0 / twice_area_m2(self.ways_m).length();
        };
        let square_m2 = (point - self.place).length_squared();
        self.height_m / (square_m2 * square_m2.sqrt() * solid_angle_sr)
    }
}

/// Along the normal.
fn twice_area_m2([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::radical_inverse;
    use std::f64::consts::PI;

    fn numbers(index: u64) -> [f64; 6] {
        [2, 3, 5, 7, 11, 13].map(|base| 2.0 * radical_inverse(base, index + 1) - 1.0)
    }

    /// Triangles of all shapes about a metre away, and one in four far away or near a corner.
    fn seen(index: u64) -> (SeenTriangle, [DVec3; 3]) {
        let [ax, ay, bx, by, cx, cy] = numbers(index);
        let [z, turn, px, py, pz, flat] = numbers(index + 1000);
        let squeeze = if index.is_multiple_of(5) { 1e-3 } else { 0.5 + 0.5 * flat };
        let tilt = DVec3::new(turn, z, 1.0).normalize();
        let (u, v) = tilt.any_orthonormal_pair();
        let point = |x: f64, y: f64| u * x + v * (y * squeeze);
        let corners = [point(ax, ay), point(bx, by), point(cx, cy)];
        let away_m = [1.0, 0.05, 1.0, 30.0][index as usize % 4];
        let place = corners[0] + (DVec3::new(px, py, pz) + tilt) * away_m;
        let n = if tilt.dot(place - corners[0]) > 0.0 { tilt } else { -tilt };
        (SeenTriangle::new(corners, n, place).unwrap(), corners)
    }

    /// The sum of the angles less pi (Girard), of angles between the planes of the sides.
    fn excess_sr([a, b, c]: [DVec3; 3]) -> f64 {
        let angle = |at: DVec3, one: DVec3, other: DVec3| {
            let (one, other) = (at.cross(one), at.cross(other));
            libm::atan2(one.cross(other).length(), one.dot(other))
        };
        angle(a, b, c) + angle(b, c, a) + angle(c, a, b) - PI
    }

    #[test]
    fn solid_angles_are_those_of_girard() {
        for (seen, _) in (0..2000).map(seen) {
            let (exact, excess) = (seen.solid_angle_sr(), excess_sr(seen.corners));
            assert!((exact - excess).abs() < 1e-9, "{exact} {excess}");
        }
    }

    /// Points lie on the triangle, and each of the three parts into which its centre cuts it gets
    /// the solid angle that it has: points and density agree.
    #[test]
    fn points_have_their_density() {
        const SIDE: u32 = 128;
        for (seen, corners) in (0..200).map(seen) {
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
            let share = |point: DVec3, at: usize| {
                let [b, c] = [corners[(at + 1) % 3] - point, corners[(at + 2) % 3] - point];
                b.cross(c).dot(normal) / normal.length_squared()
            };
            let mut parts_sr = [0.0; 3];
            for i in 0..SIDE * SIDE {
                let u = [i % SIDE, i / SIDE].map(|i| (f64::from(i) + 0.5) / f64::from(SIDE));
                let point = seen.sample_point(u);
                let shares = [0, 1, 2].map(|at| share(point, at));
                let on_it = shares.iter().all(|share| *share > -1e-6);
                assert!(on_it && (point - corners[0]).dot(normal).abs() < 1e-6, "{shares:?}");
                let least = (0..3).min_by(|a, b| shares[*a].total_cmp(&shares[*b])).unwrap();
                let (way, all) = (point - seen.place, f64::from(SIDE * SIDE));
                let cube_m3 = way.length_squared() * way.length();
                parts_sr[least] += seen.height_m / (cube_m3 * seen.pdf_m2(point) * all);
            }
            for (at, part_sr) in parts_sr.into_iter().enumerate() {
                let of_part = [corners[(at + 1) % 3], corners[(at + 2) % 3], centre];
                let exact_sr = excess_sr(of_part.map(|corner| (corner - seen.place).normalize()));
                let off = (part_sr - exact_sr).abs();
                assert!(off < 0.01 * seen.solid_angle_sr() + 1e-9, "{part_sr} {exact_sr}");
            }
        }
    }

    /// Every point stands for the same solid angle, however near the place is.
    #[test]
    fn light_from_nearby_has_no_noise() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        let seen = SeenTriangle::new(corners, DVec3::Z, DVec3::new(0.3, 0.3, 0.01)).unwrap();
        let solid_angle_sr = |u: [f64; 2]| {
            let way = seen.sample_point(u) - seen.place;
            let cos = way.normalize().dot(-DVec3::Z);
            cos / (way.length_squared() * seen.pdf_m2(seen.place + way))
        };
        let all: Vec<f64> = (0..500)
            .map(|i| solid_angle_sr([radical_inverse(2, i), radical_inverse(3, i)]))
            .collect();
        assert!(all.iter().all(|sr| (sr - all[0]).abs() < 1e-9 * all[0]), "{all:?}");
        assert!((all[0] - excess_sr(seen.corners)).abs() < 1e-12);
    }

    #[test]
    fn nothing_is_seen_from_behind() {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
        assert!(SeenTriangle::new(corners, DVec3::Z, DVec3::new(0.2, 0.2, -1.0)).is_none());
        assert!(SeenTriangle::new(corners, DVec3::Z, DVec3::ZERO).is_none());
        assert!(SeenTriangle::new(corners, DVec3::Z, DVec3::new(0.2, 0.2, 1.0)).is_some());
    }
}
