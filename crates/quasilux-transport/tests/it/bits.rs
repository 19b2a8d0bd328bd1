//! The same bits from every build and every ray kernel: debug and release, this machine and
//! another, scalar and vector.
//!
//! Digests of all replicates' values are written down here. They are no statement about light:
//! where a change is meant to move values, they change with it; where only the compiler, its
//! options or the processor differ, they must not.

use crate::scenes::{diffuse, level_grid, mirror, point_light, points, room};
use glam::DVec3;
use quasilux_sampling::{Randomization, Sequence};
use quasilux_scene::{Material, Scene};
use quasilux_transport::trial::{SimdLevel, simulate_with};
use quasilux_transport::{EstimatorKind, Settings};

/// A room with a mirror wall, a lamp, two places and a grid.
fn scene() -> Scene {
    let mut scene = room(DVec3::new(3.0, 4.0, 2.5), diffuse(0.6));
    scene.materials.push(Material { name: "mirror".to_owned(), bsdf: mirror(0.9) });
    scene.mesh.material_of[..2].fill(1);
    scene.lights.push(point_light(DVec3::new(1.1, 1.7, 2.2), 150.0));
    let places = [(DVec3::new(0.4, 3.1, 0.8), DVec3::Z), (DVec3::new(2.9, 0.3, 1.2), DVec3::NEG_X)];
    scene.sensors.push(points("places", &places));
    scene.sensors.push(level_grid(DVec3::new(0.5, 0.5, 0.7), [2.0, 3.0], [2, 3]));
    scene
}

/// A corridor with a lamp at one end and a place at the other: light subpaths go on in copies.
fn corridor() -> Scene {
    let mut scene = room(DVec3::new(20.0, 1.5, 2.0), diffuse(0.6));
    scene.lights.push(point_light(DVec3::new(0.8, 0.7, 1.7), 150.0));
    scene.sensors.push(points("end", &[(DVec3::new(19.5, 0.4, 0.8), DVec3::Z)]));
    scene
}

/// FNV-1a (Fowler, Noll and Vo) over the bits of all values.
fn digest(simd: SimdLevel, scene: &Scene, settings: &Settings) -> String {
    let estimates = simulate_with(simd, scene, settings);
    let sensors = estimates.sensors.iter().flat_map(|sensor| &sensor.replicate_lx);
    let bytes = sensors.flatten().flat_map(|lx| lx.to_bits().to_le_bytes());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    format!("{hash:016x}")
}

/// Of all runs, in the order of [`KNOWN`].
fn digests(simd: SimdLevel) -> [String; 6] {
    let sobol = (Sequence::Sobol, Randomization::Owen);
    let halton = (Sequence::Halton, Randomization::CranleyPattersonRotation);
    let random = (Sequence::Independent, Randomization::None);
    let room = scene();
    let grid_alone = Scene { sensors: room.sensors[1..].to_vec(), ..room.clone() };
    [
        (EstimatorKind::Path, sobol, &room),
        (EstimatorKind::Path, random, &room),
        (EstimatorKind::Photon, halton, &grid_alone),
        (EstimatorKind::BidirectionalMap, halton, &room),
        (EstimatorKind::Auto, sobol, &room),
        (EstimatorKind::Auto, sobol, &corridor()),
    ]
    .map(|(estimator, (sequence, randomization), scene)| {
        let settings = Settings {
            estimator,
            sequence,
            randomization,
            rel_tol: 0.0,
            max_samples: Some(64),
            ..Settings::default()
        };
        digest(simd, scene, &settings)
    })
}

#[test]
fn all_builds_and_ray_kernels_give_the_same_bits() {
    let kernels = SimdLevel::all();
    assert!(kernels.contains(&SimdLevel::Portable) && kernels.contains(&SimdLevel::fastest()));
    for simd in kernels {
        println!("{simd:?}");
        assert_eq!(digests(simd), KNOWN, "{simd:?}");
    }
}

/// In the order of the runs.
const KNOWN: [&str; 6] = [
    "583d2f82490a2400",
    "e2006d5de6bc7648",
    "0fa5f8e77f24593d",
    "994502bd6a2375ab",
    "e4362dd71042f42b",
    "086f9fc419a25a42",
];
