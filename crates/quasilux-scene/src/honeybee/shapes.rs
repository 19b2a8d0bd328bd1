//! The document: polygons and meshes.

use super::document::{Facet, List, Point};
use serde::Deserialize;

/// A flat polygon.
#[derive(Debug, Deserialize)]
pub(crate) struct Face3D {
    pub(crate) boundary: Vec<Point>,
    #[serde(default)]
    pub(crate) holes: List<Vec<Point>>,
}

/// Triangles and quadrangles of shared vertices.
#[derive(Debug, Deserialize)]
pub(crate) struct Mesh3D {
    pub(crate) vertices: Vec<Point>,
    pub(crate) faces: Vec<Facet>,
}
