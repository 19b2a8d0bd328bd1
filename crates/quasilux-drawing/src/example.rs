//! Small made-up grids that the tests of this crate share.

use crate::picture::{Caption, Cell, GridPicture, Surroundings};

/// The cells of a grid in the xy plane with its corner at (0.5, 0.5, 0.8).
pub(crate) struct Grid {
    pub(crate) edges_m: [f64; 2],
    pub(crate) counts: [u32; 2],
    pub(crate) cells: Vec<Cell>,
    pub(crate) facts: Vec<String>,
}

impl Grid {
    /// Values are `lx` of the place in the unit square, their half-widths the relative `noise`.
    pub(crate) fn new(
        edges_m: [f64; 2],
        counts: [u32; 2],
        noise: f64,
        lx: impl Fn(f64, f64) -> f64,
    ) -> Self {
        let [columns, rows] = counts;
        let place = |cell: u32| {
            let x = (f64::from(cell % columns) + 0.5) / f64::from(columns);
            let y = (f64::from(cell / columns) + 0.5) / f64::from(rows);
            lx(x, y)
        };
        let cell = |value: f64| Cell { value: Some(value), half_width: Some(noise * value.abs()) };
        Self {
            edges_m,
            counts,
            cells: (0..columns * rows).map(place).map(cell).collect(),
            facts: vec!["average 498.0 ± 1.1 lx".into(), "uniformity 0.43 ± 0.01".into()],
        }
    }

    pub(crate) fn picture<'a>(&'a self, title: &'a str) -> GridPicture<'a> {
        GridPicture {
            caption: Caption {
                title,
                project: "office",
                facts: &self.facts,
                method: "path, sobol, owen, 16 \u{d7} 1 024 samples, 95 % intervals",
                caution: "stopped before the wanted tolerance was reached",
            },
            unit: "lx",
            origin_m: [0.5, 0.5, 0.8],
            u_m: [self.edges_m[0], 0.0, 0.0],
            v_m: [0.0, self.edges_m[1], 0.0],
            counts: self.counts,
            cells: &self.cells,
            scale_cells: &[],
            target: None,
            surroundings: Surroundings::default(),
        }
    }
}

/// Six soft spots with a dip below each, brighter in the middle of the room.
pub(crate) fn batwing(x: f64, y: f64) -> f64 {
    let mut lx = 140.0;
    for lamp in 0..6 {
        let dx = (x - (0.5 + f64::from(lamp % 3)) / 3.0) * 5.0;
        let dy = (y - (0.5 + f64::from(lamp / 3)) / 2.0) * 4.0;
        let squared = dx * dx + dy * dy;
        lx += 420.0 * (1.0 + 0.9 * squared) / ((1.0 + squared) * (1.0 + squared))
            - 60.0 * libm::exp(-6.0 * squared);
    }
    lx
}
