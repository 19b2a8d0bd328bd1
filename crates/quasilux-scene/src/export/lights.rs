//! Points and emitting triangles.

use super::words::Words;
use super::{Exported, LM_PER_W, Scene};
use crate::light::{AreaLight, PointLight};
use std::f64::consts::PI;

/// Radius in m of the sphere that stands for a point, as ies2rad has it.
pub(super) const POINT_RADIUS_M: f64 = 0.0005;

/// A small sphere of the intensity of the point.
pub(super) fn point(light: &PointLight, number: usize, words: &mut Words) {
    let name = format!("point{number}");
    let radiance = light.intensity_cd / LM_PER_W / (PI * POINT_RADIUS_M * POINT_RADIUS_M);
    words.of_numbers("void", "light", &name, &[radiance; 3]);
    let [x, y, z] = light.position.to_array();
    words.of_numbers(&name, "sphere", &format!("{name}.s"), &[x, y, z, POINT_RADIUS_M]);
}

/// Polygons that shine to the front.
pub(super) fn area(
    scene: &Scene,
    light: &AreaLight,
    number: usize,
    words: &mut Words,
    exported: &mut Exported,
) {
    let name = format!("area{number}");
    words.of_numbers("void", "light", &name, &[light.luminance_cd_m2 / LM_PER_W; 3]);
    for triangle in &light.triangles {
        words.polygon(&name, &format!("{name}.{triangle}"), &scene.mesh.corners(*triangle));
    }
    let material = &scene.materials[light.material as usize];
    exported.note(format!(
        "material \"{}\": what shines is black in Radiance, and reflects in quasilux",
        material.name
    ));
}
