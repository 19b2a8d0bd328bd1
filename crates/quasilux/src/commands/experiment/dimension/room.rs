//! A closed box whose walls reflect diffusely, its walls in cells: simple enough for rays without a tree.

use crate::commands::experiment::batwing::Luminaire;
use glam::DVec3;
use quasilux_sampling::Discrete;

/// Half the side of the cube, which has its middle at the origin.
const HALF_M: f64 = 5.0;
/// Cells along each side of a wall.
const PER_SIDE: usize = 4;
/// Cells of all walls.
pub(super) const CELLS: usize = 6 * PER_SIDE * PER_SIDE;
/// Of all walls.
pub(super) const REFLECTANCE: f64 = 2.0 / 3.0;

/// The box and what lights it.
pub(super) struct Room {
    pub(super) sources: Vec<DVec3>,
    /// Which source a photon comes from.
    pub(super) by_flux: Discrete,
    /// What all sources are; `None` for isotropic ones.
    pub(super) luminaire: Option<Luminaire>,
}

/// Where a ray ends.
pub(super) struct Hit {
    pub(super) position: DVec3,
    /// Into the room.
    pub(super) normal: DVec3,
    pub(super) cell: usize,
}

impl Room {
    /// With four measured luminaires below the ceiling.
    pub(super) fn furnished() -> Self {
        let places = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        let sources: Vec<DVec3> = places
            .iter()
            .map(|(x, y)| DVec3::new(0.5 * HALF_M * x, 0.5 * HALF_M * y, 0.8 * HALF_M))
            .collect();
        let by_flux = Discrete::new(&[1.0; 4]).expect("weights above 0");
        Self { sources, by_flux, luminaire: Some(Luminaire::batwing()) }
    }

    /// The paper's: one isotropic source in the middle.
    pub(super) fn cube() -> Self {
        let by_flux = Discrete::new(&[1.0]).expect("a weight above 0");
        Self { sources: vec![DVec3::ZERO], by_flux, luminaire: None }
    }

    /// The wall that a ray from within meets.
    pub(super) fn hit(&self, origin: DVec3, direction: DVec3) -> Hit {
        let distance = |axis: usize| {
            let wall = HALF_M.copysign(direction[axis]);
            let distance = (wall - origin[axis]) / direction[axis];
            if distance.is_nan() { f64::INFINITY } else { distance.max(0.0) }
        };
        let axis = (0..3).min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap_or(0);
        let mut position = origin + direction * distance(axis);
        position[axis] = HALF_M.copysign(direction[axis]);
        let mut normal = DVec3::ZERO;
        normal[axis] = -1.0_f64.copysign(direction[axis]);
        let place = |axis: usize| {
            let share = (0.5 * (position[axis] / HALF_M + 1.0)).clamp(0.0, 1.0);
            ((share * PER_SIDE as f64) as usize).min(PER_SIDE - 1)
        };
        let wall = 2 * axis + usize::from(direction[axis] > 0.0);
        let (u, v) = (place((axis + 1) % 3), place((axis + 2) % 3));
        Hit { position, normal, cell: (wall * PER_SIDE + v) * PER_SIDE + u }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_end_on_the_wall_that_they_point_to() {
        let room = Room::cube();
        let hit = room.hit(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.0, -1.0));
        assert_eq!((hit.position, hit.normal), (DVec3::new(1.0, 2.0, -5.0), DVec3::Z));
        let hit = room.hit(DVec3::ZERO, DVec3::new(1.0, 0.5, 0.25).normalize());
        assert!((hit.position - DVec3::new(5.0, 2.5, 1.25)).length() < 1e-12);
        assert_eq!(hit.normal, DVec3::NEG_X);
        assert!(hit.cell < CELLS);
    }
}
