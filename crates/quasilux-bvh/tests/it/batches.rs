//! Many rays at once get the answers that each of them gets alone.

use crate::meshes::{NamedMesh, Numbers, Triangles, hard_meshes};
use crate::rays::{BATCHES, bits, hard_shots};
use glam::DVec3;
use quasilux_bvh::{Hit, Ray, RayQuery, SimdLevel, TriangleBvh};

#[test]
fn batches_of_all_sizes_are_answered_as_by_the_slow_twin() {
    // What an answer holds before must not matter.
    let before = Some(Hit { triangle: 5, distance: 1e-9, barycentric: [1.0, 0.0, 0.0] });
    let numbers = &mut Numbers(7);
    for NamedMesh { name, mesh } in hard_meshes(numbers, 1) {
        let build = |simd| TriangleBvh::build_for(mesh.clone(), simd);
        let bvhs: Vec<_> = SimdLevel::all().into_iter().map(build).collect();
        for count in BATCHES {
            let shots = hard_shots(&mesh, count, numbers);
            let slow =
                |shot: &RayQuery| bvhs[0].closest_hit_by_brute_force(&shot.ray, &shot.excluded);
            let wanted: Vec<_> = shots.iter().map(slow).collect();
            for bvh in &bvhs {
                let (mut hits, mut occluded) =
                    (vec![before; count], vec![count.is_multiple_of(2); count]);
                bvh.closest_hit_batch(&shots, &mut hits);
                bvh.occluded_batch(&shots, &mut occluded);
                for (i, shot) in shots.iter().enumerate() {
                    let place = || format!("{name}, {i} of {count}: {shot:?}");
                    assert_eq!(bits(hits[i]), bits(wanted[i]), "{}", place());
                    assert_eq!(occluded[i], wanted[i].is_some(), "{}", place());
                }
            }
        }
    }
}

#[test]
fn nothing_is_hit_where_nothing_is() {
    let bvh = TriangleBvh::build(Vec::new());
    let shots = hard_shots(&vec![[DVec3::ZERO, DVec3::X, DVec3::Y]], 100, &mut Numbers(3));
    let before = Some(Hit { triangle: 0, distance: 1.0, barycentric: [1.0, 0.0, 0.0] });
    let (mut hits, mut occluded) = (vec![before; 100], vec![true; 100]);
    bvh.closest_hit_batch(&shots, &mut hits);
    bvh.occluded_batch(&shots, &mut occluded);
    assert!(hits.iter().all(Option::is_none) && !occluded.contains(&true));
}

/// So many triangles at one place that more children wait than a flight has room for.
#[test]
fn rays_that_need_more_room_are_answered_too() {
    let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let mesh: Triangles = vec![face; 60_000];
    let shots: Vec<RayQuery> = (0..40)
        .map(|i| {
            let x = 0.01 * f64::from(i);
            let ray = Ray::new(DVec3::new(x, 0.4, 1.0), DVec3::NEG_Z);
            RayQuery { ray, excluded: [i as u32 % 3, 1] }
        })
        .collect();
    for simd in SimdLevel::all() {
        let bvh = TriangleBvh::build_for(mesh.clone(), simd);
        let (mut hits, mut occluded) = ([None; 40], [false; 40]);
        bvh.closest_hit_batch(&shots, &mut hits);
        bvh.occluded_batch(&shots, &mut occluded);
        for (RayQuery { ray, excluded }, hit) in shots.iter().zip(hits) {
            assert_eq!(bits(hit), bits(bvh.closest_hit(ray, excluded)), "{ray:?}");
        }
        assert!(!occluded.contains(&false));
    }
}
