//! cargo run --release -p quasilux-benches --bin groups [SCENE...]
//!
//! First hits a second on one core for the photons of a point source. Three ways take turns in
//! rounds of 2^14 photons each: one by one in natural order, one by one group by group, and by
//! `closest_hit_batch` group by group. The figures are medians over the rounds, in processor time;
//! the ratio is that of the first way to the others within a round.

use glam::DVec3;
use quasilux_benches::meshes::{self, Scene};
use quasilux_benches::{median, processor_time};
use quasilux_bvh::{Hit, Ray, RayQuery, TriangleBvh};
use quasilux_sampling::{CoherentGroups, PointSet, Randomization, Sequence};
use std::f64::consts::TAU;
use std::hint::black_box;
use std::path::Path;

const ROUND: usize = 1 << 14;
const TURNS: usize = 2;

/// Photons.
const COUNTS: [u64; 2] = [1 << 18, 1 << 20];

/// Members of a group, at least.
const MEMBERS: u64 = 64;

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let asked =
        |name: &str| wanted.is_empty() || wanted.iter().any(|word| name.starts_with(word.as_str()));
    let kitchen = meshes::kitchen();
    if kitchen.is_none() {
        println!("left out: kitchens, as QUASILUX_CORPUS=none asks");
    }
    let nine = kitchen.as_ref().map(meshes::kitchens);
    println!(
        "Mrays/s {:<30}{:>10}{:>6}{:>9}{:>9}{:>9}{:>8}{:>8}",
        "", "photons", "group", "natural", "grouped", "at once", "ratio", "ratio"
    );
    for scene in [office(), kitchen, nine].into_iter().flatten().chain([meshes::balls()]) {
        if asked(scene.name) {
            measure(&scene);
        }
    }
    if asked("relief") && !wanted.is_empty() {
        measure(&meshes::relief());
    }
}

/// The office of the examples, from below its second luminaire.
fn office() -> Option<Scene> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/office/office.obj");
    let corners = meshes::read_obj(&std::fs::read_to_string(file).ok()?);
    Some(Scene { name: "office", corners, source: DVec3::new(3.0, 1.25, 2.45) })
}

fn measure(scene: &Scene) {
    let bvh = TriangleBvh::build(scene.corners.clone());
    for (sequence, randomization, name) in [
        (Sequence::Halton, Randomization::None, "Halton"),
        (Sequence::Halton, Randomization::Owen, "Halton, scrambled"),
        (Sequence::Sobol, Randomization::Owen, "Sobol', scrambled"),
    ] {
        for count in COUNTS {
            let points = PointSet::new(sequence, randomization, 1);
            let groups =
                CoherentGroups::with_size(&points, count, &[0, 1], MEMBERS).expect("groups");
            let photon = |index| photon(scene.source, &points, index);
            let natural: Vec<RayQuery> = (0..count).map(photon).collect();
            let grouped: Vec<RayQuery> = groups.indices().map(photon).collect();
            let mut seconds = [const { Vec::new() }; 3];
            let mut hits = vec![None; ROUND];
            for round in 0..TURNS * natural.len() / ROUND {
                let start = round * ROUND % natural.len();
                let part = start..start + ROUND;
                let (one, other) = (&natural[part.clone()], &grouped[part]);
                seconds[0].push(processor_time(|| one_by_one(&bvh, one, &mut hits)));
                seconds[1].push(processor_time(|| one_by_one(&bvh, other, &mut hits)));
                seconds[2].push(processor_time(|| {
                    bvh.closest_hit_batch(other, &mut hits);
                    black_box(&hits);
                }));
            }
            let [a, b, c] =
                seconds.each_ref().map(|s| median(s.iter().map(|s| ROUND as f64 / s / 1e6)));
            let ratio = |way: usize| {
                median(seconds[0].iter().zip(&seconds[way]).map(|(first, s)| first / s))
            };
            println!(
                "{:<18}{name:<20}{count:>10}{:>8}{a:>9.2}{b:>9.2}{c:>9.2}{:>8.2}{:>8.2}",
                scene.name,
                count / groups.len(),
                ratio(1),
                ratio(2)
            );
        }
    }
}

/// A photon from a source that is equally bright in all directions.
#[expect(clippy::disallowed_methods, reason = "the bits of a benchmark's rays do not matter")]
fn photon(source: DVec3, points: &PointSet, index: u64) -> RayQuery {
    let z = 1.0 - 2.0 * points.coordinate(index, 0);
    let (y, x) = (TAU * points.coordinate(index, 1)).sin_cos();
    let s = (1.0 - z * z).sqrt();
    let ray = Ray::new(source, DVec3::new(s * x, s * y, z).normalize());
    RayQuery { ray, excluded: [RayQuery::NONE; 2] }
}

fn one_by_one(bvh: &TriangleBvh, shots: &[RayQuery], hits: &mut [Option<Hit>]) {
    for (shot, hit) in shots.iter().zip(&mut *hits) {
        *hit = bvh.closest_hit(&shot.ray, &shot.excluded);
    }
    black_box(hits);
}
