//! The values of a rectangular grid, and the words around its picture.

use super::frame::Caption;
use glam::DVec3;

/// A grid to be drawn in false colours.
#[derive(Clone, Copy, Debug)]
pub struct GridPicture<'a> {
    /// The words around the picture.
    pub caption: Caption<'a>,
    /// Unit of the values.
    pub unit: &'a str,
    /// The corner of the rectangle in m.
    pub origin_m: [f64; 3],
    /// The edge of the rectangle that runs to the right, in m.
    pub u_m: [f64; 3],
    /// The edge that runs upward, in m.
    pub v_m: [f64; 3],
    /// Numbers of cells along both edges.
    pub counts: [u32; 2],
    /// The cells, `u` fastest.
    pub cells: &'a [Cell],
}

/// The value of one cell, as far as it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cell {
    /// The value; `None` where it is undefined.
    pub value: Option<f64>,
    /// Half the width of its confidence interval.
    pub half_width: Option<f64>,
}

impl GridPicture<'_> {
    /// Lengths of both edges in m.
    pub(super) fn edges_m(&self) -> [f64; 2] {
        [self.u_m, self.v_m].map(|edge| DVec3::from(edge).length())
    }
}
