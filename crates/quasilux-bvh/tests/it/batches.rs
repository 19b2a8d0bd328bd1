//! Many rays at once are answered as one by one, to the last bit.

use crate::meshes::{Numbers, Triangles, hard_meshes, hard_query};
use glam::DVec3;
use quasilux_bvh::{Hit, Kernel, Ray, Shot, TriangleBvh};

/// Sizes of batches: fewer rays than are in flight, as many, more, and very many.
const SIZES: [usize; 9] = [0, 1, 2, 7, 23, 24, 25, 100, 5000];

fn shots(mesh: &Triangles, count: usize, numbers: &mut Numbers) -> Vec<Shot> {
    (0..count)
        .map(|i| {
            let query = hard_query(mesh, i, numbers);
            let at = |i: usize| query.excluded.get(i).copied().unwrap_or(Shot::NONE);
            let ray = if i % 7 == 3 { query.short } else { query.ray };
            Shot { ray, excluded: [at(0), at(1)] }
        })
        .collect()
}

fn assert_same(bvh: &TriangleBvh, shots: &[Shot], name: &str) {
    // Answers that must be overwritten.
    let wrong = Hit { triangle: 77, distance: -1.0, barycentric: [9.0; 3] };
    let (mut hits, mut occluded) = (vec![Some(wrong); shots.len()], vec![true; shots.len()]);
    bvh.closest_hits(shots, &mut hits);
    bvh.are_occluded(shots, &mut occluded);
    for (i, Shot { ray, excluded }) in shots.iter().enumerate() {
        assert_eq!(hits[i], bvh.closest_hit(ray, excluded), "{name}, ray {i}: {ray:?}");
        assert_eq!(occluded[i], hits[i].is_some(), "{name}, ray {i}: {ray:?}");
    }
}

#[test]
fn batches_of_all_sizes_are_answered_as_one_by_one() {
    let numbers = &mut Numbers(5);
    for (name, mesh) in hard_meshes(numbers, 3) {
        for kernel in Kernel::all() {
            let bvh = TriangleBvh::build_for(mesh.clone(), kernel);
            for size in SIZES {
                assert_same(&bvh, &shots(&mesh, size, numbers), name);
            }
        }
    }
}

/// So many triangles at one place that more children wait than a flight has room for.
#[test]
fn rays_that_need_more_room_are_answered_too() {
    let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let mesh: Triangles = vec![face; 60_000];
    let shots: Vec<Shot> = (0..40)
        .map(|i| {
            let x = 0.01 * f64::from(i);
            let ray = Ray::new(DVec3::new(x, 0.4, 1.0), DVec3::NEG_Z);
            Shot { ray, excluded: [i as u32 % 3, 1] }
        })
        .collect();
    for kernel in Kernel::all() {
        assert_same(&TriangleBvh::build_for(mesh.clone(), kernel), &shots, "one place");
    }
}
