//! The values of a rectangular grid, and the words around its picture.

use super::caption::Caption;
use super::plan::{PlanAreaLight, PlanLuminaire, Plane, Surfaces};
use glam::DVec3;

/// A grid is level where its normal's part along z is more than this.
const LEVEL: f64 = 0.9;

/// A grid to be drawn in false colours.
#[derive(Clone, Copy, Debug, Default)]
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
    /// The cells of all pictures that share the scale of colours; none where it is for this one.
    pub scale_cells: &'a [Cell],
    /// A value that is required everywhere, drawn as a contour line of its own.
    pub target: Option<f64>,
    /// What stands around the grid.
    pub surroundings: Surroundings<'a>,
}

/// What is drawn over a grid: surfaces that its plane cuts, edges of those behind it, and
/// lights before it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Surroundings<'a> {
    /// The surfaces.
    pub surfaces: Surfaces<'a>,
    /// The luminaires.
    pub luminaires: &'a [PlanLuminaire],
    /// Lights without extent and direction.
    pub point_lights_m: &'a [DVec3],
    /// Luminous surfaces.
    pub area_lights: &'a [PlanAreaLight<'a>],
    /// Openings to the outside, the corners of each in turn.
    pub openings_m: &'a [[DVec3; 4]],
    /// Where north is, if it is known: degrees from +y, counter-clockwise seen from above.
    pub north_deg: Option<f64>,
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

    /// Unit directions of both edges.
    pub(super) fn directions(&self) -> [DVec3; 2] {
        [self.u_m, self.v_m].map(|edge| DVec3::from(edge).normalize_or_zero())
    }

    /// Whether its picture is a plan.
    pub(super) fn is_level(&self) -> bool {
        self.plane().normal.z.abs() > LEVEL
    }

    /// The plane of the grid; above it is where its picture is seen from.
    pub(super) fn plane(&self) -> Plane {
        let [u, v] = self.directions();
        let normal = u.cross(v).normalize_or_zero();
        Plane { normal, offset_m: normal.dot(DVec3::from(self.origin_m)) }
    }
}
