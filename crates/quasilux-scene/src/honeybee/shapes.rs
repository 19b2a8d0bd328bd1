//! The document: polygons and meshes.

use super::document::{Facet, List, Point};
use glam::DVec3;
use serde::Deserialize;

/// A flat polygon.
#[derive(Debug, PartialEq, Deserialize)]
pub(crate) struct Face3D {
    pub(crate) boundary: Vec<Point>,
    #[serde(default)]
    pub(crate) holes: List<Vec<Point>>,
}

impl Face3D {
    /// The area inside its outline, in the square of the unit.
    pub(crate) fn area(&self) -> f64 {
        let Some(origin) = self.boundary.first() else { return 0.0 };
        let across = |pair: &[Point]| (pair[0].0 - origin.0).cross(pair[1].0 - origin.0);
        0.5 * self.boundary.windows(2).map(across).sum::<DVec3>().length()
    }
}

/// Triangles and quadrangles of shared vertices.
#[derive(Debug, Deserialize)]
pub(crate) struct Mesh3D {
    pub(crate) vertices: Vec<Point>,
    pub(crate) faces: Vec<Facet>,
}
