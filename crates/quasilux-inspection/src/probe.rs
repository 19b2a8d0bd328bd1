//! Rays through a scene: what they meet first, and whether two places see each other.
//!
//! Sheets that let light through (glass, panes, translucent and measured ones) are no obstacle
//! here: light finds its way.

use glam::DVec3;
use quasilux_bvh::{Ray, TriangleBvh};
use quasilux_sampling::radical_inverse;
use quasilux_sampling::warp::{sample_cosine_hemisphere, sample_uniform_sphere};
use quasilux_scene::{Material, Scene};

/// Rays start this share of the scene's size in front of their surface.
const HAIR: f64 = 1e-7;

/// Sheets that a ray goes through before it is given up as stopped.
const MAX_SHEETS: usize = 16;

/// A place on a surface, seen from one side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
    pub(crate) triangle: u32,
    pub(crate) position: DVec3,
    /// Unit normal on the side that is seen.
    pub(crate) normal: DVec3,
    pub(crate) distance_m: f64,
    /// Whether all light ends here.
    pub(crate) is_black: bool,
}

/// A scene that answers rays.
pub(crate) struct Probe<'a> {
    pub(crate) scene: &'a Scene,
    hierarchy: &'a TriangleBvh,
    /// The diagonal of the box around the geometry, in m.
    pub(crate) size_m: f64,
    pub(crate) hair_m: f64,
    /// Of each material, whether light passes through it.
    transmits: Vec<bool>,
    /// Of each material, whether all light ends at it.
    is_black: Vec<bool>,
}

impl<'a> Probe<'a> {
    pub(crate) fn new(scene: &'a Scene, hierarchy: &'a TriangleBvh) -> Self {
        let [low, high] = scene.mesh.bounds().unwrap_or_default();
        let size_m = (high - low).length();
        let transmits = scene.materials.iter().map(|material| material.bsdf.transmits()).collect();
        let is_black = |material: &Material| material.bsdf.most_kept().luminance() == 0.0;
        let is_black = scene.materials.iter().map(is_black).collect();
        Self { scene, hierarchy, size_m, hair_m: HAIR * size_m, transmits, is_black }
    }

    /// The first surface that stops light on its way.
    pub(crate) fn first(&self, origin: DVec3, direction: DVec3) -> Option<Surface> {
        self.within(&Ray::new(origin, direction))
    }

    /// Whether a ray meets anything, glass too.
    pub(crate) fn meets(&self, origin: DVec3, direction: DVec3) -> bool {
        self.hierarchy.is_occluded(&Ray::new(origin, direction), &[])
    }

    /// Whether light gets from one place to the other; both may lie on surfaces.
    pub(crate) fn sees(&self, a: DVec3, b: DVec3) -> bool {
        let between = b - a;
        let distance_m = between.length();
        // What lies on a surface is looked at from a hair before it.
        let end_m = distance_m - self.hair_m;
        end_m <= 0.0 || self.within(&Ray::new(a, between / distance_m).up_to(end_m)).is_none()
    }

    /// The share of directions in which nothing is met.
    pub(crate) fn escaping_share(&self, at: DVec3) -> f64 {
        const DIRECTIONS: u32 = 64;
        let escaping =
            (0..DIRECTIONS).filter(|&i| !self.meets(at, sphere_direction(i, DIRECTIONS))).count();
        escaping as f64 / f64::from(DIRECTIONS)
    }

    /// A triangle at the same place as the one that was met.
    pub(crate) fn twin(&self, origin: DVec3, direction: DVec3, met: &Surface) -> Option<u32> {
        let reach_m = met.distance_m + 0.01 * self.hair_m;
        let ray = Ray::new(origin, direction).up_to(reach_m);
        let hit = self.hierarchy.closest_hit(&ray, &[met.triangle])?;
        let is_there = (hit.distance - met.distance_m).abs() <= 0.01 * self.hair_m;
        let normal = self.scene.mesh.front_normal(hit.triangle);
        (is_there && normal.dot(met.normal).abs() > 1.0 - 1e-9).then_some(hit.triangle)
    }

    fn within(&self, ray: &Ray) -> Option<Surface> {
        let mesh = &self.scene.mesh;
        let mut passed: Vec<u32> = Vec::new();
        loop {
            let hit = self.hierarchy.closest_hit(ray, &passed)?;
            let material = mesh.material_of[hit.triangle as usize] as usize;
            // What starts in a surface is not stopped by it.
            let is_around = hit.distance < 1e-3 * self.hair_m;
            if !(self.transmits[material] || is_around) || passed.len() == MAX_SHEETS {
                let front_normal = mesh.front_normal(hit.triangle);
                let is_front = front_normal.dot(ray.direction) < 0.0;
                let normal = if is_front { front_normal } else { -front_normal };
                let position = ray.at(hit.distance) + normal * self.hair_m;
                let (triangle, distance_m) = (hit.triangle, hit.distance);
                let is_black = self.is_black[material];
                return Some(Surface { triangle, position, normal, distance_m, is_black });
            }
            passed.push(hit.triangle);
        }
    }
}

/// Direction number `i` of `count` that cover the sphere evenly.
pub(crate) fn sphere_direction(i: u32, count: u32) -> DVec3 {
    let along = (f64::from(i) + 0.5) / f64::from(count);
    DVec3::from_array(sample_uniform_sphere([along, radical_inverse(2, i.into())]))
}

/// Point `i` of a sequence that fills the square evenly (Halton's).
pub(crate) fn square(i: u32) -> [f64; 2] {
    [2, 3].map(|base| radical_inverse(base, u64::from(i) + 1))
}

/// A direction above a surface, in proportion to its cosine.
pub(crate) fn cosine_direction(normal: DVec3, u: [f64; 2]) -> DVec3 {
    let [x, y, z] = sample_cosine_hemisphere(u);
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    (tangent * x + bitangent * y + normal * z).normalize()
}
