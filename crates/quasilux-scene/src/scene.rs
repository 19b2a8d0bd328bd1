//! The scene: built once, checked once, then immutable.

use crate::environment::Environment;
use crate::{Bsdf, Camera, Light, Mesh, Sensor};
use quasilux_sky::Weather;

/// Everything that exists in a room.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The triangles.
    pub mesh: Mesh,
    /// The materials that triangles refer to.
    pub materials: Vec<Material>,
    /// The lights; at least one with a positive flux where nothing shines from outside.
    pub lights: Vec<Light>,
    /// Light from outside.
    pub environment: Option<Environment>,
    /// The weather file that the sky is of: all of it, of which `environment` has one interval or,
    /// where the project names no time, a sky of 0 lx.
    pub weather: Option<Weather>,
    /// The sensors; names are unique among sensors and cameras.
    pub sensors: Vec<Sensor>,
    /// The cameras; at least one where there is no sensor.
    pub cameras: Vec<Camera>,
}

/// A named surface material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The name in the geometry file and the project file.
    pub name: String,
    /// How it scatters light, on both sides.
    pub bsdf: Bsdf,
}

impl Scene {
    /// The material of a triangle.
    #[must_use]
    pub fn material(&self, triangle: u32) -> &Material {
        &self.materials[self.mesh.material_of[triangle as usize] as usize]
    }

    /// Total emitted flux of all lights in lm.
    #[must_use]
    pub fn flux_lm(&self) -> f64 {
        self.lights.iter().map(Light::flux_lm).sum()
    }
}
