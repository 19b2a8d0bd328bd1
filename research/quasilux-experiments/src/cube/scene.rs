//! The cube, and the places where it is looked at.

use crate::building::{grey, lamp, points, room};
use glam::DVec3;
use quasilux_scene::Scene;
use std::f64::consts::PI;

/// Half a side.
pub(super) const HALF_M: f64 = 5.0;
/// Of the light in the middle.
pub(super) const INTENSITY_CD: f64 = 50_000.0;
/// Of all walls.
pub(super) const REFLECTANCE: f64 = 2.0 / 3.0;
/// Places of a wall that symmetry leaves different, in units of half a side.
pub(super) const CLASSES: [[f64; 2]; 6] =
    [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [1.0, 0.0], [1.0, 0.5], [1.0, 1.0]];
/// Places on an edge belong to two walls or three. Each is read once for each wall, as a place of
/// that wall that is so far from the edge, in units of half a side: 5 micrometres.
pub(super) const INSET: f64 = 1e-6;
/// Along a line of places.
const LINE: [f64; 5] = [-1.0, -0.5, 0.0, 0.5, 1.0];

/// Where illuminance is asked for.
#[derive(Clone)]
pub(super) struct Places {
    places: Vec<WallPoint>,
}

/// A place on a wall.
#[derive(Clone, Copy)]
pub(super) struct WallPoint {
    position: DVec3,
    normal: DVec3,
    /// Number of its class.
    pub(super) class: usize,
    /// How many places it stands for.
    pub(super) weight: f64,
}

impl Places {
    /// The paper's: 5 x 5 on each of the six walls.
    pub(super) fn all() -> Self {
        let walls = (0..6).map(|wall| (wall % 3, if wall < 3 { -1.0 } else { 1.0 }));
        let on_wall = |(axis, side): (usize, f64)| {
            LINE.into_iter().flat_map(move |u| LINE.map(|v| place(axis, side, [u, v])))
        };
        Self { places: walls.flat_map(on_wall).collect() }
    }

    /// One of each class, which stands for all of it: the norm of the error is the same on average.
    pub(super) fn one_of_each_class() -> Self {
        let all = Self::all();
        let size = |class: usize| all.iter().filter(|place| place.class == class).count() as f64;
        let one = |(class, at): (usize, &[f64; 2])| WallPoint {
            weight: size(class),
            ..place(0, 1.0, *at)
        };
        Self { places: CLASSES.iter().enumerate().map(one).collect() }
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &WallPoint> {
        self.places.iter()
    }

    /// The cube with its light, and a sensor at the places.
    pub(super) fn scene(&self) -> Scene {
        let mut scene = room(DVec3::splat(2.0 * HALF_M), grey(REFLECTANCE));
        lamp(&mut scene, DVec3::splat(HALF_M), INTENSITY_CD);
        let places: Vec<_> = self.iter().map(|place| (place.position, place.normal)).collect();
        scene.sensors.push(points(&places));
        scene
    }
}

/// Where the sensor of a class stands on its wall.
pub(super) fn inset(class: usize) -> [f64; 2] {
    CLASSES[class].map(|x| x.clamp(INSET - 1.0, 1.0 - INSET))
}

/// Luminance in cd/m^2 of a wall by its illuminance in lx.
pub(super) fn luminance_cd_m2(illuminance_lx: f64) -> f64 {
    REFLECTANCE / PI * illuminance_lx
}

/// The place at `at` on the wall across an axis, at its low or high end.
fn place(axis: usize, side: f64, at: [f64; 2]) -> WallPoint {
    let mut position = DVec3::ZERO;
    position[axis] = side;
    for (shift, x) in (1..).zip(at) {
        position[(axis + shift) % 3] = x.clamp(INSET - 1.0, 1.0 - INSET);
    }
    let mut normal = DVec3::ZERO;
    normal[axis] = -side;
    let [u, v] = at.map(f64::abs);
    let own = [u.max(v), u.min(v)];
    let class = CLASSES.iter().position(|class| *class == own).expect("each has a class");
    WallPoint { position: (position + 1.0) * HALF_M, normal, class, weight: 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_have_their_sizes() {
        let all = Places::all();
        let size = |class: usize| all.iter().filter(|place| place.class == class).count();
        assert_eq!([0, 1, 2, 3, 4, 5].map(size), [6, 24, 24, 24, 48, 24]);
        let few = Places::one_of_each_class();
        assert_eq!(few.iter().map(|place| place.weight).sum::<f64>(), 150.0);
    }
}
