//! Photons in waves against photons one by one: the same integers, whatever the order and the
//! threads.

use crate::agreement::coloured_room_with_mirror;
use crate::scenes::{diffuse, diffuse_cube, mirror, point_light, room, wall_grid};
use glam::DVec3;
use quasilux_sampling::Sequence;
use quasilux_scene::Scene;
use quasilux_stats::deep;
use quasilux_transport::trial::{PhotonOrder, Traced, try_photons};
use quasilux_transport::{EstimatorKind, Settings};
use std::ops::Range;

/// What the sensors counted, and what it took.
#[derive(Debug, PartialEq)]
struct Outcome {
    counters: Vec<u64>,
    traced: Traced,
}

fn outcome(scene: &Scene, settings: &Settings, order: PhotonOrder, indices: Range<u64>) -> Outcome {
    let mut outcome = None;
    try_photons(scene, settings, None, |trial| {
        let traced = trial.trace(order, indices);
        outcome = Some(Outcome { traced, counters: trial.counters() });
    });
    outcome.expect("a trial was made")
}

fn settings(sequence: Sequence, max_bounces: Option<u32>) -> Settings {
    let estimator = EstimatorKind::Photon;
    Settings { estimator, sequence, max_bounces, replicates: 3, ..Settings::default() }
}

/// An area light in a coloured room with a mirror, where photons of one wave come to be at
/// different coordinates; a point light in a grey room; and a hall of mirrors, open to one side.
fn scenes() -> [Scene; 3] {
    let mut cube = diffuse_cube(&[(0.5, 0.0)]);
    cube.sensors.push(wall_grid([5, 7]));
    let mut hall = room(DVec3::splat(10.0), mirror(0.7));
    hall.lights.push(point_light(DVec3::new(3.0, 4.0, 2.0), 100.0));
    hall.sensors.push(wall_grid([3, 3]));
    hall.materials.push(quasilux_scene::Material { name: "floor".to_owned(), bsdf: diffuse(0.9) });
    hall.mesh.material_of[0] = 1;
    hall.mesh.triangles.pop();
    [coloured_room_with_mirror(), cube, hall]
}

/// Each sequence in the first scene, which has all kinds of surfaces, and two in the others; in the
/// deep variant each in each.
#[test]
fn waves_count_what_single_photons_count() {
    let sequences = [
        Sequence::Sobol,
        Sequence::Faure4,
        Sequence::Halton,
        Sequence::Hammersley { points: 6000 },
        Sequence::Independent,
    ];
    for (number, scene) in scenes().iter().enumerate() {
        for (place, sequence) in sequences.into_iter().enumerate() {
            if !deep() && number > 0 && place % 2 == number % 2 {
                continue;
            }
            for (indices, max_bounces) in [(0..4096, None), (1000..5003, Some(1))] {
                let settings = settings(sequence, max_bounces);
                let alone = outcome(scene, &settings, PhotonOrder::OneByOne, indices.clone());
                assert_eq!(alone.traced.photons, 3 * (indices.end - indices.start));
                assert!(alone.counters.iter().any(|photons| *photons > 0), "scene {number}");
                for order in [PhotonOrder::Waves, PhotonOrder::CoherentWaves] {
                    let together = outcome(scene, &settings, order, indices.clone());
                    assert!(alone == together, "scene {number}, {sequence:?}, {order:?}");
                }
            }
        }
    }
}

/// The counters above do tell photons apart: one photon more or other photons are seen.
#[test]
fn other_photons_give_other_counts() {
    let settings = settings(Sequence::Sobol, None);
    for scene in scenes() {
        let of = |indices| outcome(&scene, &settings, PhotonOrder::CoherentWaves, indices);
        let first = of(0..4096);
        assert!(first != of(0..4097) && first.counters != of(4096..8192).counters);
    }
}

#[test]
fn threads_do_not_change_counts() {
    let [scene, ..] = scenes();
    let settings = settings(Sequence::Sobol, None);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| outcome(&scene, &settings, PhotonOrder::CoherentWaves, 0..10_000))
    };
    assert_eq!(on(1), on(3));
}
