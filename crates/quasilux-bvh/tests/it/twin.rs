//! The hierarchy returns what trying every triangle returns, to the last bit.

use crate::meshes::{NamedMesh, Numbers, hard_meshes};
use crate::rays::{HardQuery, bits, hard_query};
use glam::DVec3;
use quasilux_bvh::{Ray, SimdLevel, TriangleBvh};

/// Rays at each mesh.
const RAYS: usize = 9_000;

#[test]
fn hard_meshes_are_hit_as_by_the_slow_twin() {
    let numbers = &mut Numbers(1);
    for NamedMesh { name, mesh } in hard_meshes(numbers, 3) {
        let build = |simd| TriangleBvh::build_for(mesh.clone(), simd);
        let bvhs: Vec<_> = SimdLevel::all().into_iter().map(build).collect();
        let mut hits = 0;
        for i in 0..RAYS {
            let HardQuery { ray, short, excluded } = &hard_query(&mesh, i, numbers);
            let slow = bvhs[0].closest_hit_by_brute_force(ray, excluded);
            let blocked = slow.is_some_and(|hit| hit.distance < short.t_max);
            let before = ray.up_to(slow.map_or(f64::INFINITY, |hit| hit.distance));
            for bvh in &bvhs {
                let hit = bvh.closest_hit(ray, excluded);
                assert_eq!(bits(hit), bits(slow), "{name}, ray {i}: {ray:?}");
                assert_eq!(bvh.is_occluded(short, excluded), blocked, "{name}, ray {i}: {short:?}");
                assert!(!bvh.is_occluded(&before, excluded), "{name}, ray {i}: {before:?}");
            }
            hits += usize::from(slow.is_some());
        }
        let enough = hits > RAYS / 1000 || name == "one point";
        assert!(enough, "{name}: the test shot past nearly everything ({hits} hits)");
    }
}

#[test]
fn hierarchies_are_valid() {
    let numbers = &mut Numbers(2);
    for NamedMesh { name, mesh } in hard_meshes(numbers, 20) {
        assert_eq!(TriangleBvh::build(mesh).validate(), Ok(()), "{name}");
    }
    assert_eq!(TriangleBvh::build(Vec::new()).validate(), Ok(()));
}

#[test]
fn many_candidates_at_one_distance_are_all_decided() {
    let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let bvh = TriangleBvh::build(vec![face; 100]);
    let ray = Ray::new(DVec3::new(0.2, 0.2, 1.0), DVec3::NEG_Z);
    let excluded: Vec<u32> = (0..99).collect();
    assert_eq!(bvh.closest_hit(&ray, &excluded).unwrap().triangle, 99);
    assert_eq!(bvh.closest_hit(&ray, &[]).unwrap().triangle, 0);
    assert!(bvh.is_occluded(&ray, &excluded) && !bvh.is_occluded(&ray.up_to(1.0), &[]));
}

#[test]
fn nothing_is_hit_where_nothing_is() {
    let bvh = TriangleBvh::build(Vec::new());
    let ray = Ray::new(DVec3::ZERO, DVec3::Z);
    assert!(bvh.is_empty() && bvh.closest_hit(&ray, &[]).is_none() && !bvh.is_occluded(&ray, &[]));
}

#[test]
fn ties_go_to_the_lowest_index() {
    let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let bvh = TriangleBvh::build(vec![face; 9]);
    let ray = Ray::new(DVec3::new(0.2, 0.2, 1.0), DVec3::NEG_Z);
    assert_eq!(bvh.closest_hit(&ray, &[]).unwrap().triangle, 0);
    assert_eq!(bvh.closest_hit(&ray, &[0, 1]).unwrap().triangle, 2);
}
