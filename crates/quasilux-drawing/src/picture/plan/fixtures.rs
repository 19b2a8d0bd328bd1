//! Small made-up rooms that the tests of plans share.

use super::model::{PlanLuminaire, PlanPicture, Surfaces};
use glam::DVec3;

/// The surfaces of a room, owned.
#[derive(Clone, Default)]
pub(crate) struct Shell {
    pub(crate) positions_m: Vec<DVec3>,
    pub(crate) triangles: Vec<[u32; 3]>,
    /// 1 for glass, and 0 where there is no entry.
    pub(crate) material_of: Vec<u32>,
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

    /// Adds a flat quadrilateral with corners of its own.
    pub(crate) fn with_sheet(mut self, corners: [DVec3; 4], material: u32) -> Self {
        let first = self.positions_m.len() as u32;
        self.positions_m.extend(corners);
        self.material_of.resize(self.triangles.len(), 0);
        self.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|k| first + k)));
        self.material_of.extend([material; 2]);
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
        Surfaces {
            positions_m: &self.positions_m,
            triangles: &self.triangles,
            material_of: &self.material_of,
            lets_through: &[false, true],
        }
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

/// A rectangle in the plane y = `y` between two corners (x, z).
pub(crate) fn upright(y: f64, low: [f64; 2], high: [f64; 2]) -> [DVec3; 4] {
    let [[x0, z0], [x1, z1]] = [low, high];
    [[x0, z0], [x1, z0], [x1, z1], [x0, z1]].map(|[x, z]| DVec3::new(x, y, z))
}

/// A room of 6 m x 4 m x 3 m of sheets, with a hole of 2 m x 1 m in its wall to the south, whose
/// sill is 1.2 m high, and a material in the hole, if any.
pub(crate) fn room_with_window(material: Option<u32>) -> Shell {
    let (x, y, z) = (6.0, 4.0, 3.0);
    let level = |z: f64| [[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]].map(|[x, y]| DVec3::new(x, y, z));
    let side = |x: f64| [[0.0, 0.0], [y, 0.0], [y, z], [0.0, z]].map(|[y, z]| DVec3::new(x, y, z));
    let wall = [
        upright(0.0, [0.0, 0.0], [2.0, z]),
        upright(0.0, [4.0, 0.0], [x, z]),
        upright(0.0, [2.0, 0.0], [4.0, 1.2]),
        upright(0.0, [2.0, 2.2], [4.0, z]),
    ];
    let rest = [level(0.0), level(z), side(0.0), side(x), upright(y, [0.0, 0.0], [x, z])];
    let sheets = wall.into_iter().chain(rest).map(|sheet| (sheet, 0));
    let pane = material.map(|material| (upright(0.0, [2.0, 1.2], [4.0, 2.2]), material));
    sheets
        .chain(pane)
        .fold(Shell::default(), |shell, (corners, material)| shell.with_sheet(corners, material))
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
