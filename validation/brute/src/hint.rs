//! Parallelograms that are worth looking at.

use glam::DVec3;

/// A parallelogram that directions may be drawn through, uniform in area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lookout {
    corner: DVec3,
    u: DVec3,
    v: DVec3,
    /// Along the normal, as long as the area.
    area: DVec3,
    /// Places between these corners of a box look there.
    within: [DVec3; 2],
}

/// Places on the sides of the box belong to it.
const MARGIN_M: f64 = 1e-6;
/// Farther than all scenes reach.
const FAR_M: f64 = 1e7;

impl Lookout {
    /// The parallelogram with edges `u` and `v` from a corner, in m; either side may be looked at.
    #[must_use]
    pub fn new(corner: DVec3, u: DVec3, v: DVec3) -> Self {
        let within = [DVec3::NEG_INFINITY, DVec3::INFINITY];
        Self { corner, u, v, area: u.cross(v), within }
    }

    /// The same for places in a box alone.
    #[must_use]
    pub fn from_within(self, low: DVec3, high: DVec3) -> Self {
        Self { within: [low - MARGIN_M, high + MARGIN_M], ..self }
    }

    /// The same for all places.
    pub(crate) const fn seen_everywhere(self) -> Self {
        Self { within: [DVec3::NEG_INFINITY, DVec3::INFINITY], ..self }
    }

    /// A parallelogram far away that covers the disk of a half angle about a unit direction: for
    /// the sun, and for where mirrors show it.
    #[must_use]
    pub fn around(direction: DVec3, half_angle_rad: f64) -> Self {
        let (s, t) = direction.any_orthonormal_pair();
        let reach = FAR_M * libm::tan(half_angle_rad);
        let corner = direction * FAR_M - (s + t) * reach;
        Self::new(corner, s * (2.0 * reach), t * (2.0 * reach))
    }

    /// Whether a place looks there: it is not seen edge-on, and some of it is above the horizon
    /// where there is a normal.
    pub(crate) fn is_seen(&self, position: DVec3, normal: Option<DVec3>) -> bool {
        let [low, high] = self.within;
        if position.cmplt(low).any() || position.cmpgt(high).any() {
            return false;
        }
        let to = self.corner - position;
        let is_above = normal.is_none_or(|normal| {
            let height = to.dot(normal);
            let (du, dv) = (self.u.dot(normal), self.v.dot(normal));
            height + du.max(0.0) + dv.max(0.0) > 1e-9
        });
        is_above && to.dot(self.area).abs() > 1e-9 * self.area.length()
    }

    /// Along the normal, as long as the area in m^2.
    pub(crate) const fn area(&self) -> DVec3 {
        self.area
    }

    /// The place at `uv` in [0, 1)^2.
    pub(crate) fn place(&self, uv: [f64; 2]) -> DVec3 {
        self.corner + self.u * uv[0] + self.v * uv[1]
    }

    /// The unit direction from `position` to the place at `uv` in [0, 1)^2.
    pub(crate) fn sample(&self, position: DVec3, uv: [f64; 2]) -> DVec3 {
        (self.place(uv) - position).normalize()
    }

    /// The density of that direction in solid angle: d^2 / (area cos).
    pub(crate) fn pdf(&self, position: DVec3, direction: DVec3) -> f64 {
        let slope = direction.dot(self.area);
        match self.crossing_m(position, direction) {
            Some(distance) if distance > 0.0 => distance * distance / slope.abs(),
            _ => 0.0,
        }
    }

    /// How far along a unit direction a line crosses it, in m; negative behind the place.
    pub(crate) fn crossing_m(&self, position: DVec3, direction: DVec3) -> Option<f64> {
        let slope = direction.dot(self.area);
        if slope.abs() < 1e-300 {
            return None;
        }
        let distance = (self.corner - position).dot(self.area) / slope;
        let from_corner = position + direction * distance - self.corner;
        let square = self.area.length_squared();
        let s = from_corner.cross(self.v).dot(self.area) / square;
        let t = self.u.cross(from_corner).dot(self.area) / square;
        let is_inside = (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
        is_inside.then_some(distance)
    }
}
