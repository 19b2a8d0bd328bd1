//! Panes of a scene: how many there are of a material.

use quasilux_scene::Mesh;
use std::collections::HashMap;

/// The number of separate panes of a material: triangles that share a corner are of one.
pub(super) fn panes(mesh: &Mesh, material: u32) -> usize {
    let of_material = mesh.triangles.iter().zip(&mesh.material_of);
    let triangles = of_material.filter(|(_, own)| **own == material).map(|(corners, _)| corners);
    let mut parents: Vec<usize> = Vec::new();
    let mut at: HashMap<[u64; 3], usize> = HashMap::new();
    for corners in triangles {
        let this = parents.len();
        parents.push(this);
        for &corner in corners {
            // Adding zero makes one of both zeros.
            let place = (mesh.positions[corner as usize] + 0.0).to_array().map(f64::to_bits);
            let other = *at.entry(place).or_insert(this);
            let [a, b] = [other, this].map(|triangle| root(&mut parents, triangle));
            parents[a.max(b)] = a.min(b);
        }
    }
    (0..parents.len()).filter(|&triangle| parents[triangle] == triangle).count()
}

/// The first triangle of a pane, by halving the path to it.
fn root(parents: &mut [usize], mut triangle: usize) -> usize {
    while parents[triangle] != triangle {
        parents[triangle] = parents[parents[triangle]];
        triangle = parents[triangle];
    }
    triangle
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
