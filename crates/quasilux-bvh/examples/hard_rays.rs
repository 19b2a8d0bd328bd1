//! cargo run --release -p quasilux-bvh --example hard_rays [RAYS]
//!
//! Random rays, ten million unless told, at meshes that are hard on a ray kernel: every kernel of this
//! machine against trying every triangle, closest hits and occlusion, to the last bit. The tests do
//! the same with fewer rays.

#[path = "../tests/it/meshes.rs"]
mod meshes;

use meshes::{Numbers, hard_meshes, hard_query};
use quasilux_bvh::{Kernel, TriangleBvh};
use rayon::prelude::*;

const RAYS_A_TASK: usize = 10_000;

fn main() {
    let rays = std::env::args().nth(1).map_or(Ok(10_000_000), |word| word.parse::<usize>());
    let rays = rays.expect("the number of rays is a number");
    let meshes = hard_meshes(&mut Numbers(17), 1);
    let bvhs: Vec<(&str, Vec<TriangleBvh>)> = meshes
        .iter()
        .map(|(name, mesh)| {
            let build = |kernel| TriangleBvh::build_for(mesh.clone(), kernel);
            (*name, Kernel::all().into_iter().map(build).collect())
        })
        .collect();
    let tasks = rays.div_ceil(RAYS_A_TASK * meshes.len());
    let mut all_differ = 0;
    for ((name, mesh), (_, bvhs)) in meshes.iter().zip(&bvhs) {
        let counts = (0..tasks as u64).into_par_iter().map(|task| {
            let numbers = &mut Numbers(task.wrapping_mul(0x5851_f42d_4c95_7f2d));
            let (mut hits, mut differ) = (0_u64, 0_u64);
            for i in 0..RAYS_A_TASK {
                let query = hard_query(mesh, i, numbers);
                let slow = bvhs[0].closest_hit_by_brute_force(&query.ray, &query.excluded);
                let blocked = slow.is_some_and(|hit| hit.distance < query.short.t_max);
                hits += u64::from(slow.is_some());
                for bvh in bvhs {
                    let same = bvh.closest_hit(&query.ray, &query.excluded) == slow
                        && bvh.is_occluded(&query.short, &query.excluded) == blocked;
                    if !same && differ < 3 {
                        println!(
                            "{name}: {:?} {slow:?} {:?}",
                            query,
                            bvh.closest_hit(&query.ray, &query.excluded)
                        );
                    }
                    differ += u64::from(!same);
                }
            }
            (hits, differ)
        });
        let (hits, differ) = counts.reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
        println!("{name:<24}{:>10} rays{hits:>10} hits{differ:>6} differ", tasks * RAYS_A_TASK);
        all_differ += differ;
    }
    assert_eq!(all_differ, 0, "the hierarchy differs from its slow twin");
}
