//! Where light is asked for.

use crate::random::Xoshiro;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A place or a piece of a plane; its value is the illuminance there, or the mean over it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Where it is, or where its middle is, in m.
    pub position: DVec3,
    /// Unit normal: light from its side counts.
    pub normal: DVec3,
    /// What belongs to it.
    pub extent: Extent,
}

/// What belongs to a sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// The place alone. Light that only photons can bring is counted on a disc about it, and is the
    /// mean over that disc; with a radius of 0 m it is left out.
    Point {
        /// Radius of the disc in m.
        disc_radius_m: f64,
    },
    /// A disc: all light is a mean over it.
    Disc {
        /// Its radius in m.
        radius_m: f64,
    },
    /// A parallelogram about the position: all light is a mean over it.
    Cell {
        /// One edge in m, across the normal.
        u: DVec3,
        /// The other edge in m, across the normal.
        v: DVec3,
    },
}

impl Sensor {
    /// A place alone.
    #[must_use]
    pub const fn point(position: DVec3, normal: DVec3) -> Self {
        Self { position, normal, extent: Extent::Point { disc_radius_m: 0.0 } }
    }

    /// A place, with a disc for light that only photons can bring.
    #[must_use]
    pub const fn point_with_disc(position: DVec3, normal: DVec3, disc_radius_m: f64) -> Self {
        Self { position, normal, extent: Extent::Point { disc_radius_m } }
    }

    /// A disc.
    #[must_use]
    pub const fn disc(position: DVec3, normal: DVec3, radius_m: f64) -> Self {
        Self { position, normal, extent: Extent::Disc { radius_m } }
    }

    /// A parallelogram with edges `u` and `v` from a corner, seen from the side of a unit normal.
    #[must_use]
    pub fn cell(corner: DVec3, u: DVec3, v: DVec3, normal: DVec3) -> Self {
        Self { position: corner + 0.5 * (u + v), normal, extent: Extent::Cell { u, v } }
    }

    /// A place that belongs to it, all alike.
    pub(crate) fn place(&self, random: &mut Xoshiro) -> DVec3 {
        match self.extent {
            Extent::Point { .. } => self.position,
            Extent::Disc { radius_m } => {
                let radius = radius_m * random.uniform().sqrt();
                let (sin, cos) = libm::sincos(TAU * random.uniform());
                let (s, t) = self.normal.any_orthonormal_pair();
                self.position + s * (radius * cos) + t * (radius * sin)
            }
            Extent::Cell { u, v } => {
                let [a, b] = [random.uniform() - 0.5, random.uniform() - 0.5];
                self.position + u * a + v * b
            }
        }
    }

    /// Whether its value is a mean over an area.
    pub(crate) const fn has_area(&self) -> bool {
        !matches!(self.extent, Extent::Point { .. })
    }

    /// The area that photons are counted on, in m^2; 0 where there is none.
    pub(crate) fn area_m2(&self) -> f64 {
        match self.extent {
            Extent::Point { disc_radius_m: radius_m } | Extent::Disc { radius_m } => {
                PI * radius_m * radius_m
            }
            Extent::Cell { u, v } => u.cross(v).length(),
        }
    }

    /// How far along a unit direction the area is crossed from the side of the normal, in m.
    pub(crate) fn crossing_m(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let slope = direction.dot(self.normal);
        if slope >= 0.0 {
            return None;
        }
        let from_middle = origin - self.position;
        let distance = -from_middle.dot(self.normal) / slope;
        let place = from_middle + direction * distance;
        let is_inside = match self.extent {
            Extent::Point { disc_radius_m: radius_m } | Extent::Disc { radius_m } => {
                place.length_squared() < radius_m * radius_m
            }
            Extent::Cell { u, v } => {
                let area = u.cross(v);
                let square = area.length_squared();
                let a = place.cross(v).dot(area) / square;
                let b = u.cross(place).dot(area) / square;
                a.abs() <= 0.5 && b.abs() <= 0.5
            }
        };
        is_inside.then_some(distance)
    }
}
