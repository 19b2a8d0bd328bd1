//! Hierarchies over meshes on which builders have failed are valid, and no larger than others.

use crate::degenerate_meshes::degenerate_meshes;
use crate::meshes::{NamedMesh, Numbers, hard_meshes};
use glam::DVec3;
use quasilux_bvh::{Ray, TriangleBvh};

#[test]
fn hard_meshes_have_valid_hierarchies_at_every_size() {
    let numbers = &mut Numbers(4);
    for size in [1, 50, 150] {
        for NamedMesh { name, mesh } in hard_meshes(numbers, size) {
            assert_eq!(TriangleBvh::build(mesh).validate(), Ok(()), "{name}, size {size}");
        }
    }
}

#[test]
fn crowds_of_triangles_have_valid_hierarchies() {
    for NamedMesh { name, mesh } in degenerate_meshes(&mut Numbers(5), 20_000) {
        let count = mesh.len();
        let [a, b, c] = mesh[count - 1];
        let bvh = TriangleBvh::build(mesh);
        assert_eq!(bvh.validate(), Ok(()), "{name}");
        // Aside, where a flat triangle is not met.
        let ray = Ray::new((a + b + c) / 3.0 + DVec3::new(0.0, 0.0, 9.0), DVec3::X);
        assert_eq!(bvh.closest_hit(&ray, &[]), None, "{name}");
    }
}
