//! Boxes along the axes, and how far something lies outside of them.

use super::model::Surfaces;
use glam::DVec3;

/// A box along the axes, in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

/// Which way something lies outside of a box, and how far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Outside {
    /// From the nearest point of the box, in m.
    pub(crate) offset_m: DVec3,
}

impl Bounds {
    /// The box around points, `None` without any.
    pub(crate) fn around(points: impl Iterator<Item = DVec3>) -> Option<Self> {
        points
            .filter(|point| point.is_finite())
            .map(|point| Self { low: point, high: point })
            .reduce(|a, b| Self { low: a.low.min(b.low), high: a.high.max(b.high) })
    }

    /// The box around all corners of triangles.
    pub(crate) fn of_surfaces(surfaces: Surfaces<'_>) -> Option<Self> {
        Self::around(surfaces.corners().flatten())
    }

    pub(crate) fn size_m(&self) -> DVec3 {
        self.high - self.low
    }

    pub(crate) fn centre_m(&self) -> DVec3 {
        0.5 * self.low + 0.5 * self.high
    }

    /// How far a point lies outside; `None` within a hair of the box.
    pub(crate) fn outside(&self, point_m: DVec3) -> Option<Outside> {
        let offset_m = point_m - point_m.clamp(self.low, self.high);
        let hair_m = 1e-6 * self.size_m().max_element();
        (offset_m.length() > hair_m).then_some(Outside { offset_m })
    }

    /// The box that also holds those of some points that are not too far from it: within `most`
    /// times its longest edge.
    pub(crate) fn with_near(&self, points: impl Iterator<Item = DVec3>, most: f64) -> Self {
        let reach_m = most * self.size_m().max_element();
        let near = |point: &DVec3| {
            self.outside(*point).is_none_or(|outside| outside.distance_m() <= reach_m)
        };
        Self::around(points.filter(near).chain([self.low, self.high])).unwrap_or(*self)
    }
}

impl Outside {
    pub(crate) fn distance_m(&self) -> f64 {
        self.offset_m.length()
    }

    /// Distance and direction in words.
    pub(crate) fn text(&self) -> String {
        format!("{} the geometry", self.brief_text())
    }

    /// The same where the geometry is in sight.
    pub(crate) fn brief_text(&self) -> String {
        let side = self.offset_m;
        let across = side.truncate().length();
        let way = match () {
            () if side.z > across => "above",
            () if -side.z > across => "below",
            () => "outside",
        };
        format!("{} {way}", length_text(self.distance_m()))
    }
}

/// A length with the unit in which it is read best.
pub(crate) fn length_text(length_m: f64) -> String {
    let (value, unit) = match length_m {
        x if x < 0.01 => (1e3 * x, "mm"),
        x if x < 1.0 => (1e2 * x, "cm"),
        x if x < 1000.0 => (x, "m"),
        x => (1e-3 * x, "km"),
    };
    format!("{} {unit}", crate::number::brief(value, 3))
}
