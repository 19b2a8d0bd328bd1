//! No ray leaves a closed mesh, not even through its edges and vertices.

use crate::meshes::{Numbers, Triangles, ball};
use glam::DVec3;
use quasilux_bvh::{Ray, TriangleBvh};

fn assert_closed(mesh: &Triangles, centre: DVec3, radius: f64, numbers: &mut Numbers) {
    let bvh = TriangleBvh::build(mesh.clone());
    for (i, &[a, b, c]) in mesh.iter().enumerate() {
        let origin = centre + numbers.direction() * (0.5 * radius);
        let along_edge = a + (b - a) * numbers.next();
        for target in [a, 0.5 * (a + b), along_edge, (a + b + c) / 3.0] {
            let ray = Ray::new(origin, (target - origin).normalize());
            assert!(bvh.closest_hit(&ray, &[]).is_some(), "leak at triangle {i} toward {target}");
        }
    }
}

#[test]
fn balls_near_and_far_are_closed() {
    let numbers = &mut Numbers(3);
    for (centre, radius) in [
        (DVec3::ZERO, 1.0),
        (DVec3::new(0.1, 0.2, 0.3), 1e-3),
        (DVec3::new(1e4, -2e4, 5e3), 2.0),
        (DVec3::splat(1.0 / 3.0), 1e5),
    ] {
        assert_closed(&ball(centre, radius, 5), centre, radius, numbers);
    }
}
