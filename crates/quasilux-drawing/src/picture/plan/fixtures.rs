//! Small made-up rooms that the tests of plans share.

use super::model::{PlanLuminaire, PlanPicture, Surfaces};
use glam::DVec3;

/// The surfaces of a room, owned.
#[derive(Clone, Default)]
pub(crate) struct Shell {
    pub(crate) positions_m: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

impl Shell {
    /// Adds a box, two triangles a side, each side with corners of its own.
    pub(crate) fn with_box(mut self, low: DVec3, high: DVec3) -> Self {
        for axis in 0..3 {
            for end in [low, high] {
                let first = self.positions_m.len() as u32;
                for [s, t] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                    let mut corner = end;
                    let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
                    corner[u] = low[u] + s * (high[u] - low[u]);
                    corner[v] = low[v] + t * (high[v] - low[v]);
                    self.positions_m.push(corner);
                }
                self.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| first + k)));
            }
        }
        self
    }

    /// A ball of triangles: bands between parallels, each cut into as many pieces.
    pub(crate) fn with_ball(mut self, centre: DVec3, radius_m: f64, pieces: u32) -> Self {
        let first = self.positions_m.len() as u32;
        for i in 0..=pieces {
            let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(i) / f64::from(pieces));
            for j in 0..pieces {
                let angle = std::f64::consts::TAU * f64::from(j) / f64::from(pieces);
                let (y, x) = libm::sincos(angle);
                self.positions_m.push(centre + radius_m * DVec3::new(sin * x, sin * y, cos));
            }
        }
        for (i, j) in (0..pieces).flat_map(|i| (0..pieces).map(move |j| (i, j))) {
            let at = |i: u32, j: u32| first + i * pieces + j % pieces;
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            self.triangles.extend([[a, b, c], [a, c, d]]);
        }
        self
    }

    pub(crate) fn surfaces(&self) -> Surfaces<'_> {
        Surfaces { positions_m: &self.positions_m, triangles: &self.triangles }
    }

    /// A picture of the room with luminaires.
    pub(crate) fn picture<'a>(&'a self, luminaires: &'a [PlanLuminaire]) -> PlanPicture<'a> {
        PlanPicture {
            title: "room",
            surfaces: self.surfaces(),
            luminaires,
            ..PlanPicture::default()
        }
    }
}

/// A room of 6 m x 4 m x 3 m with a table.
pub(crate) fn room() -> Shell {
    let table = [DVec3::new(2.0, 1.0, 0.0), DVec3::new(3.5, 2.0, 0.7)];
    Shell::default().with_box(DVec3::ZERO, DVec3::new(6.0, 4.0, 3.0)).with_box(table[0], table[1])
}

/// A luminaire of 1.2 m x 0.2 m, aimed straight down.
pub(crate) fn luminaire(position_m: DVec3) -> PlanLuminaire {
    PlanLuminaire {
        name: "lamp.ies".to_owned(),
        position_m,
        aim: DVec3::NEG_Z,
        c0: DVec3::X,
        opening_m: DVec3::new(1.2, 0.2, 0.0),
        is_round: false,
    }
}
