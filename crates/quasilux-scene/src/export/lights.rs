//! Points and emitting triangles.

use super::words::Words;
use super::{Exported, LM_PER_W, Scene};
use crate::light::{AreaLight, PointLight};
use glam::DVec3;
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
    let mut are_even = true;
    let mut left = light.triangles.as_slice();
    while let [first, others @ ..] = left {
        let corners = scene.mesh.corners(*first);
        let next = others.first().map(|next| scene.mesh.corners(*next));
        let pair = next.and_then(|next| parallelogram(corners, next));
        let part = format!("{name}.{first}");
        match pair {
            Some(corners) => words.polygon(&name, &part, &corners),
            None => words.polygon(&name, &part, &corners),
        }
        are_even &= pair.is_some();
        left = if pair.is_some() { &others[1..] } else { others };
    }
    if !are_even {
        exported.note(
            "lights that are no parallelograms are sampled unevenly there: near them values are \
             too large",
        );
    }
    let material = &scene.materials[light.material as usize];
    exported.note(format!(
        "material \"{}\": what shines is black in Radiance, and reflects in quasilux",
        material.name
    ));
}

/// The parallelogram that two triangles make which turn the same way round.
fn parallelogram(first: [DVec3; 3], second: [DVec3; 3]) -> Option<[DVec3; 4]> {
    let size = (first[1] - first[0]).length() + (first[2] - first[0]).length();
    let is_same = |a: DVec3, b: DVec3| (a - b).length() <= 1e-9 * size;
    (0..3).find_map(|turn| {
        let [a, b, c] = [0, 1, 2].map(|corner| first[(corner + turn) % 3]);
        // The edge from c to a is the other's from a to c.
        let shared = (0..3)
            .find(|&corner| is_same(second[corner], a) && is_same(second[(corner + 1) % 3], c))?;
        let d = second[(shared + 2) % 3];
        is_same(b - a, c - d).then_some([a, b, c, d])
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_of_a_rectangle_are_put_together() {
        let [a, b, c, d] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]
            .map(|[x, y]: [f64; 2]| DVec3::new(x, y, 3.0));
        for (first, second) in
            [([a, b, c], [a, c, d]), ([b, c, a], [d, a, c]), ([c, a, b], [c, d, a])]
        {
            let found = parallelogram(first, second).expect("a parallelogram");
            assert_eq!(found, [a, b, c, d]);
        }
        let off = d + DVec3::X;
        assert_eq!(parallelogram([a, b, c], [a, c, off]), None);
        assert_eq!(parallelogram([a, b, c], [a, d, c]), None);
    }
}
