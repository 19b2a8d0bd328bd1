//! A closed box, its walls in cells: simple enough for rays without a tree.

use glam::DVec3;

/// Half the side of the cube, which has its middle at the origin.
pub(super) const HALF_M: f64 = 5.0;
/// Cells along each side of a wall.
const PER_SIDE: usize = 4;
/// Cells of all walls.
pub(super) const CELLS: usize = 6 * PER_SIDE * PER_SIDE;
/// A box around the origin.
pub(super) struct ClosedBox;

/// Where a ray ends.
pub(super) struct Hit {
    pub(super) position: DVec3,
    /// Into the room.
    pub(super) normal: DVec3,
    pub(super) cell: usize,
}

impl ClosedBox {
    /// The wall that a ray from within meets.
    pub(super) fn hit(origin: DVec3, direction: DVec3) -> Hit {
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
        let hit = ClosedBox::hit(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.0, -1.0));
        assert_eq!((hit.position, hit.normal), (DVec3::new(1.0, 2.0, -5.0), DVec3::Z));
        let hit = ClosedBox::hit(DVec3::ZERO, DVec3::new(1.0, 0.5, 0.25).normalize());
        assert!((hit.position - DVec3::new(5.0, 2.5, 1.25)).length() < 1e-12);
        assert_eq!(hit.normal, DVec3::NEG_X);
        assert!(hit.cell < CELLS);
    }
}
