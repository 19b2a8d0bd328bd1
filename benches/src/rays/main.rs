//! cargo run --release -p quasilux-benches --bin rays -- [builds] [SCENE...]
//!
//! Closest hits a second on one core for incoherent rays, those of photons that bounce five times,
//! one by one and in batches with each instruction set of the machine, against Embree 3
//! (`rtcIntersect1`) at both its qualities where `libembree3.so.3` is installed (Debian:
//! `libembree-dev`). All take turns in rounds of 2^14 rays each; the figures are medians over the
//! rounds, in processor time, and of the ratio within a round. Build times are of one build on all
//! cores; with `builds` they are measured with more care, and nothing else ([`builds`]).

mod builds;
mod photons;

use photons::{RayQuery, photon_rays};
use quasilux_benches::meshes::{self, Scene};
use quasilux_benches::{Timed, median, processor_time, timed};
use quasilux_bvh::{RayQuery as BvhShot, SimdLevel, TriangleBvh};
use quasilux_foreign::{Embree, Mesh, Quality, RayHit};
use std::hint::black_box;

const RAYS: usize = 1 << 20;
const ROUND: usize = 1 << 14;
const TURNS: usize = 3;

fn main() {
    let mut wanted: Vec<String> = std::env::args().skip(1).collect();
    let only_builds = wanted.first().is_some_and(|word| word == "builds");
    wanted.drain(..usize::from(only_builds));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let embree = Embree::open(threads);
    if embree.is_none() {
        println!("left out: Embree, since libembree3.so.3 is missing");
    }
    if only_builds {
        builds::headings();
    } else {
        println!("{:<16}{:<28}{:>10}{:>12}{:>10}", "", "", "build, s", "Mrays/s", "ratio");
    }
    let measure = |scene: Scene| {
        if only_builds {
            builds::measure(&scene, embree.as_ref());
        } else {
            measure(scene, embree.as_ref());
        }
    };
    let kitchen = meshes::kitchen();
    if kitchen.is_none() {
        println!("left out: kitchens, as QUASILUX_CORPUS=none asks");
    }
    let nine = kitchen.as_ref().map(meshes::kitchens);
    let asked =
        |name: &str| wanted.is_empty() || wanted.iter().any(|word| name.starts_with(word.as_str()));
    for scene in [kitchen, nine].into_iter().flatten().filter(|scene| asked(scene.name)) {
        measure(scene);
    }
    if asked("room of balls") {
        measure(meshes::balls());
    }
    if asked("relief") {
        measure(meshes::relief());
    }
}

/// Builds all hierarchies over a scene, shoots the same rays at them and prints the figures.
fn measure(scene: Scene, embree: Option<&Embree>) {
    let corners = scene.corners.clone();
    let Timed { seconds: own_build, result: own } = timed(|| TriangleBvh::build(corners));
    let kernels = kernels(&scene);
    let rays = photon_rays(&scene, &own, RAYS);
    let name = format!("quasilux, {} triangles", scene.corners.len());

    let narrow = scene.narrow();
    let shots: Vec<RayHit> = rays
        .iter()
        .map(|RayQuery { ray, .. }| {
            RayHit::new(ray.origin.as_vec3().to_array(), ray.direction.as_vec3().to_array())
        })
        .collect();
    let others: Vec<(&str, f64, Mesh<'_>)> = embree
        .into_iter()
        .flat_map(|embree| {
            [("Embree, medium", Quality::Medium), ("Embree, high", Quality::High)].map(
                |(name, quality)| {
                    let built = timed(|| embree.build(&narrow, quality));
                    (name, built.seconds, built.result)
                },
            )
        })
        .collect();

    let batch: Vec<BvhShot> = rays
        .iter()
        .map(|shot| BvhShot { ray: shot.ray, excluded: [shot.from, BvhShot::NONE] })
        .collect();
    let mut hits = vec![None; ROUND];
    let mut seconds = vec![Vec::new(); 1 + kernels.len() + others.len()];
    for round in 0..TURNS * (RAYS / ROUND) {
        let part = round * ROUND % RAYS..round * ROUND % RAYS + ROUND;
        seconds[0].push(processor_time(|| shoot(&own, &rays[part.clone()])));
        for (Contestant { bvh, .. }, seconds) in kernels.iter().zip(&mut seconds[1..]) {
            seconds.push(processor_time(|| {
                bvh.closest_hit_batch(&batch[part.clone()], &mut hits);
                black_box(&hits);
            }));
        }
        for ((_, _, mesh), seconds) in others.iter().zip(&mut seconds[1 + kernels.len()..]) {
            seconds.push(processor_time(|| shoot_embree(mesh, &shots[part.clone()])));
        }
    }
    let kernels = kernels.iter().map(|kernel| (kernel.name.as_str(), own_build));
    let builds = [(name.as_str(), own_build)].into_iter().chain(kernels);
    let builds = builds.chain(others.iter().map(|(name, s, _)| (*name, *s)));
    for ((name, build), own) in builds.zip(&seconds) {
        let rate = median(own.iter().map(|s| ROUND as f64 / s / 1e6));
        let ratio = median(own.iter().zip(&seconds[0]).map(|(s, first)| s / first));
        println!("{:<16}{name:<28}{build:>10.2}{rate:>12.2}{ratio:>10.3}", scene.name);
    }
}

/// A hierarchy of ours for one instruction set.
struct Contestant {
    name: String,
    bvh: TriangleBvh,
}

/// One for each instruction set of the machine.
fn kernels(scene: &Scene) -> Vec<Contestant> {
    let all = SimdLevel::all().into_iter().filter(|simd| *simd != SimdLevel::Portable);
    let build = |simd: SimdLevel| {
        let bvh = TriangleBvh::build_for(scene.corners.clone(), simd);
        Contestant { name: format!("quasilux, {simd:?}, batches"), bvh }
    };
    all.map(build).collect()
}

fn shoot(bvh: &TriangleBvh, shots: &[RayQuery]) {
    for RayQuery { ray, from } in shots {
        black_box(bvh.closest_hit(ray, &[*from]));
    }
}

fn shoot_embree(mesh: &Mesh<'_>, rays: &[RayHit]) {
    for ray in rays {
        let mut ray = *ray;
        mesh.closest_hit(&mut ray);
        black_box(&ray);
    }
}
