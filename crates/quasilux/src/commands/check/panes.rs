//! Panes of a scene: how many there are of a material.

use glam::DVec3;
use quasilux_drawing::picture::first_of_each;
use quasilux_scene::Mesh;

/// The number of separate panes of a material: triangles that share a corner are of one.
pub(super) fn panes(mesh: &Mesh, material: u32) -> usize {
    let of_material = mesh.triangles.iter().zip(&mesh.material_of);
    let triangles: Vec<[DVec3; 3]> = of_material
        .filter(|(_, own)| **own == material)
        .map(|(corners, _)| corners.map(|corner| mesh.positions[corner as usize]))
        .collect();
    let firsts = first_of_each(&triangles);
    firsts.into_iter().enumerate().filter(|(number, first)| number == first).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// Two panes of two triangles each, the first with corners of its own in each triangle, and a
    /// wall between them.
    #[test]
    fn panes_that_touch_nowhere_are_counted() {
        let square = |x: f64| {
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[s, z]| DVec3::new(x + s, 0.0, z))
        };
        let [a, b, c, d] = square(0.0);
        let mesh = Mesh {
            positions: [vec![a, b, c, a, c, d], square(1.0).to_vec(), square(2.0).to_vec()]
                .concat(),
            triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8], [6, 8, 9], [10, 11, 12], [10, 12, 13]],
            material_of: vec![1, 1, 0, 0, 1, 1],
            ..Mesh::default()
        };
        assert_eq!((panes(&mesh, 1), panes(&mesh, 0), panes(&mesh, 2)), (2, 1, 0));
    }
}
