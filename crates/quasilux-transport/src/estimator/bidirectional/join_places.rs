//! What decides whether light vertices are joined to a target, coordinate by coordinate, so that
//! several are decided on at a time.

use glam::DVec3;
use std::ops::Range;

/// Of a light vertex.
pub(super) struct JoinPlace {
    pub(super) position: DVec3,
    /// Unit normal of the surface.
    pub(super) n: DVec3,
    pub(super) is_narrow: bool,
}

/// Of some light vertices.
#[derive(Default)]
pub(super) struct JoinPlaces {
    positions: [Vec<f64>; 3],
    normals: [Vec<f64>; 3],
    /// Numbers of those on narrow surfaces, in ascending order.
    narrow: Vec<usize>,
}

impl JoinPlaces {
    pub(super) fn push(&mut self, JoinPlace { position, n, is_narrow }: JoinPlace) {
        if is_narrow {
            self.narrow.push(self.positions[0].len());
        }
        for axis in 0..3 {
            self.positions[axis].push(position[axis]);
            self.normals[axis].push(n[axis]);
        }
    }

    /// The cosines over squared distance, in m^-2, between a place with the normal `n` and each
    /// with these numbers; 0 of those behind it. Narrow surfaces may send more the lower, so of
    /// them the cosine is left out.
    pub(super) fn per_m2(
        &self,
        numbers: Range<usize>,
        n: DVec3,
        from: DVec3,
        found: &mut Vec<f64>,
    ) {
        let [x, y, z] = self.positions.each_ref().map(|axis| &axis[numbers.clone()]);
        let [nx, ny, nz] = self.normals.each_ref().map(|axis| &axis[numbers.clone()]);
        found.clear();
        found.resize(numbers.len(), 0.0);
        for (i, found) in found.iter_mut().enumerate() {
            let (dx, dy, dz) = (x[i] - from.x, y[i] - from.y, z[i] - from.z);
            let front = n.x * dx + n.y * dy + n.z * dz;
            let behind = (nx[i] * dx + ny[i] * dy + nz[i] * dz).abs();
            let square_m2 = dx * dx + dy * dy + dz * dz;
            let per_m2 = front * behind / (square_m2 * square_m2);
            *found = if front > 0.0 { per_m2 } else { 0.0 };
        }
        let first = self.narrow.partition_point(|it| *it < numbers.start);
        for number in self.narrow[first..].iter().take_while(|it| **it < numbers.end) {
            let i = number - numbers.start;
            let way = DVec3::new(x[i], y[i], z[i]) - from;
            let square_m2 = way.length_squared();
            found[i] = n.dot(way).max(0.0) / (square_m2 * square_m2.sqrt());
        }
    }
}
