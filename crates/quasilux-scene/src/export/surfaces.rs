//! Triangles that do not shine.

use super::Scene;
use super::words::Words;
use crate::Light;
use std::collections::HashSet;

/// Writes all triangles but those of lights, each with the identifier of its material.
pub(super) fn write(scene: &Scene, materials: &[String], words: &mut Words) {
    let lights = scene.lights.iter().flat_map(|light| match light {
        Light::Area(light) => light.triangles.as_slice(),
        Light::Point(_) | Light::Luminaire(_) => &[],
    });
    let lights: HashSet<u32> = lights.copied().collect();
    let mesh = &scene.mesh;
    for triangle in (0..mesh.triangles.len() as u32).filter(|it| !lights.contains(it)) {
        let material = &materials[mesh.material_of[triangle as usize] as usize];
        words.polygon(material, &format!("t{triangle}"), &mesh.corners(triangle));
    }
}
