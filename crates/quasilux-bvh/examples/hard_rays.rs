//! cargo run --release -p quasilux-bvh --example hard_rays [RAYS [SEED]]
//!
//! Random rays, ten million unless told, at meshes that are hard on a ray kernel: every kernel of
//! this machine against trying every triangle, closest hits and occlusion, one by one and in
//! batches of all sizes, to the last bit. The tests do the same with fewer rays.

#[path = "../tests/it/meshes.rs"]
mod meshes;
#[path = "../tests/it/rays.rs"]
mod rays;

use meshes::{NamedMesh, Numbers, Triangles, hard_meshes};
use quasilux_bvh::{Hit, RayQuery, SimdLevel, TriangleBvh};
use rayon::prelude::*;
use rays::{BATCHES, HardQuery, bits, hard_query, hard_shots};

const RAYS_A_TASK: usize = 10_000;

/// A mesh, and its hierarchies for all kernels.
struct Case {
    name: &'static str,
    mesh: Triangles,
    bvhs: Vec<TriangleBvh>,
}

/// What came of rays.
#[derive(Clone, Copy, Default)]
struct Counts {
    rays: usize,
    hits: usize,
    differ: usize,
}

fn main() {
    let mut words = std::env::args().skip(1);
    let mut number = |default: u64| {
        words.next().map_or(default, |word| word.parse().expect("arguments are numbers"))
    };
    let (rays, seed) = (number(10_000_000) as usize, number(17));
    let cases: Vec<Case> = hard_meshes(&mut Numbers(seed), 1)
        .into_iter()
        .map(|NamedMesh { name, mesh }| {
            let build = |simd| TriangleBvh::build_for(mesh.clone(), simd);
            let bvhs = SimdLevel::all().into_iter().map(build).collect();
            Case { name, mesh, bvhs }
        })
        .collect();
    println!("kernels: {:?}", SimdLevel::all());
    let tasks = rays.div_ceil(RAYS_A_TASK * cases.len()) as u64;
    let mut all = Counts::default();
    for case in &cases {
        let counts = (0..tasks).into_par_iter().map(|task| {
            let numbers = &mut Numbers(seed ^ task.wrapping_mul(0x5851_f42d_4c95_7f2d));
            // Batches are one half of all rays.
            if task.is_multiple_of(2) { case.alone(numbers) } else { case.in_batches(numbers) }
        });
        let Counts { rays, hits, differ } = counts.reduce(Counts::default, Counts::plus);
        println!("{:<24}{rays:>10} rays{hits:>10} hits{differ:>6} differ", case.name);
        all = all.plus(Counts { rays, hits, differ });
    }
    println!("{:<24}{:>10} rays{:>10} hits{:>6} differ", "all", all.rays, all.hits, all.differ);
    assert_eq!(all.differ, 0, "the hierarchy differs from its slow twin");
}

impl Case {
    fn alone(&self, numbers: &mut Numbers) -> Counts {
        let mut counts = Counts::default();
        for i in 0..RAYS_A_TASK {
            let HardQuery { ray, short, excluded } = &hard_query(&self.mesh, i, numbers);
            let slow = self.bvhs[0].closest_hit_by_brute_force(ray, excluded);
            let blocked = slow.is_some_and(|hit| hit.distance < short.t_max);
            let same = self.bvhs.iter().all(|bvh| {
                bits(bvh.closest_hit(ray, excluded)) == bits(slow)
                    && bvh.is_occluded(short, excluded) == blocked
            });
            counts.add(slow, same, || format!("{}: {ray:?} or {short:?}", self.name));
        }
        counts
    }

    fn in_batches(&self, numbers: &mut Numbers) -> Counts {
        let mut counts = Counts::default();
        let mut sizes = BATCHES.into_iter().cycle();
        while counts.rays < RAYS_A_TASK {
            let size = sizes.next().unwrap_or(0).min(RAYS_A_TASK - counts.rays);
            let shots = hard_shots(&self.mesh, size, numbers);
            let answers: Vec<(Vec<Option<Hit>>, Vec<bool>)> = self
                .bvhs
                .iter()
                .map(|bvh| {
                    let (mut hits, mut occluded) = (vec![None; size], vec![false; size]);
                    bvh.closest_hit_batch(&shots, &mut hits);
                    bvh.occluded_batch(&shots, &mut occluded);
                    (hits, occluded)
                })
                .collect();
            for (i, RayQuery { ray, excluded }) in shots.iter().enumerate() {
                let slow = self.bvhs[0].closest_hit_by_brute_force(ray, excluded);
                let same = answers.iter().all(|(hits, occluded)| {
                    bits(hits[i]) == bits(slow) && occluded[i] == slow.is_some()
                });
                counts.add(slow, same, || format!("{}: {i} of {size}: {ray:?}", self.name));
            }
        }
        counts
    }
}

impl Counts {
    fn add(&mut self, slow: Option<Hit>, same: bool, place: impl Fn() -> String) {
        if !same && self.differ < 3 {
            println!("{} {slow:?}", place());
        }
        self.rays += 1;
        self.hits += usize::from(slow.is_some());
        self.differ += usize::from(!same);
    }

    fn plus(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            hits: self.hits + other.hits,
            differ: self.differ + other.differ,
        }
    }
}
