//! Triangles that do not shine.

use super::Scene;
use super::words::Words;
use crate::{Bsdf, Light};
use std::collections::HashSet;

/// How far in m the back of a mirror lies behind its front.
const BEHIND_M: f64 = 0.0005;

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
        let (name, corners) = (format!("t{triangle}"), mesh.corners(triangle));
        words.polygon(material, &name, &corners);
        if matches!(scene.material(triangle).bsdf, Bsdf::Mirror(_)) {
            // Mirrors of Radiance have a front alone.
            let behind = mesh.front_normal(triangle) * -BEHIND_M;
            let [a, b, c] = corners.map(|corner| corner + behind);
            words.polygon(material, &format!("{name}b"), &[a, c, b]);
        }
    }
}
