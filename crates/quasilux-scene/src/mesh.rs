//! All triangles of a scene, and where they come from.

use glam::DVec3;
use std::sync::Arc;

/// A triangle soup with shared vertices; all lengths in metres, z up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Vertex indices of each triangle, counter-clockwise seen from the front side.
    pub triangles: Vec<[u32; 3]>,
    /// Index into `Scene::materials` for each triangle.
    pub material_of: Vec<u32>,
    /// Index into `objects` for each triangle.
    pub object_of: Vec<u32>,
    /// Object names as the geometry files give them; instances share theirs.
    pub objects: Vec<Arc<str>>,
}

impl Mesh {
    /// The three corners of a triangle.
    #[must_use]
    pub fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    /// Twice the area vector of a triangle: along the front normal, length twice the area in m^2.
    #[must_use]
    pub fn double_area_vector(&self, triangle: u32) -> DVec3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(c - a)
    }

    /// The area of a triangle in m^2.
    #[must_use]
    pub fn area_m2(&self, triangle: u32) -> f64 {
        0.5 * self.double_area_vector(triangle).length()
    }

    /// The unit normal of a triangle's front side.
    #[must_use]
    pub fn front_normal(&self, triangle: u32) -> DVec3 {
        self.double_area_vector(triangle).normalize()
    }

    /// The corners of the box around all positions, `None` for an empty mesh.
    #[must_use]
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        let first = *self.positions.first()?;
        Some(
            self.positions.iter().fold([first, first], |[low, high], &p| [low.min(p), high.max(p)]),
        )
    }
}
