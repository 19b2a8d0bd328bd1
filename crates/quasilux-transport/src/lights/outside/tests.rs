//! Directions to openings against their density.

use super::*;
use crate::scenes::{diffuse, room};
use glam::DVec3;
use quasilux_bvh::SimdLevel;
use quasilux_scene::Opening;
use quasilux_sky::{CieType, Distribution, Sky, SkyLevel, SkyPoint};
use quasilux_stats::SplitMix64;
use quasilux_stats::sphere_jacobian;
use std::f64::consts::PI;

fn direction(random: &mut SplitMix64) -> DVec3 {
    let z = 2.0 * random.uniform() - 1.0;
    let (sin, cos) = libm::sincos(TAU * random.uniform());
    DVec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + DVec3::Z * z
}

/// Three openings around the origin, none before another, under a sky at random.
fn scene(random: &mut SplitMix64) -> Scene {
    let opening = |k: usize, random: &mut SplitMix64| {
        let (sin, cos) = libm::sincos(TAU * (k as f64 + 0.3 * random.uniform()) / 3.0);
        let way = DVec3::new(cos, sin, random.uniform() - 0.2);
        let [u, v] = [0, 1].map(|_| direction(random) * (0.3 + random.uniform()));
        Opening { origin: way * (3.0 + 2.0 * random.uniform()), u, v }
    };
    let openings = (0..3).map(|k| opening(k, random)).collect();
    let sun = SkyPoint { altitude_deg: 60.0 * random.uniform(), azimuth_deg: 70.0 };
    let kind = CieType::new(1 + random.below(15) as i64).unwrap();
    let level = SkyLevel::HorizontalIlluminance { lx: 10_000.0 };
    let sky = Sky::new(Distribution::cie(kind, sun), level).unwrap();
    let (ground_reflectance, north_deg) = (0.2 + 0.3 * random.uniform(), 360.0 * random.uniform());
    let environment = Environment { sky, sun: None, ground_reflectance, north_deg, openings };
    Scene { environment: Some(environment), ..room(DVec3::ONE, diffuse(0.5)) }
}

/// `pdf * |det J| = 1` where directions nearby go through the same part of an opening, and the
/// density is 1 in all.
#[test]
fn the_density_of_openings_is_one_over_the_jacobian() {
    let mut random = SplitMix64::new(9);
    let (mut count, mut off) = (0, 0);
    for _ in 0..12 {
        let scene = scene(&mut random);
        let world = World::<f64>::new(&scene, SimdLevel::fastest());
        let outside = OutsideLight::new(&scene, &world).unwrap();
        let position = direction(&mut random) * 0.5;
        let side = Some(direction(&mut random)).filter(|_| random.below(2) == 0);
        let place = Asking { position, side, own: None };
        let seen = outside.seen(place);
        if seen.total <= 0.0 {
            continue;
        }
        let sample = |u| outside.sample_direction(&seen, place, u).unwrap().to_array();
        for _ in 0..200 {
            let u = [random.uniform(), random.uniform()];
            let pdf_sr = outside.pdf_sr(place, DVec3::from_array(sample(u)));
            let product = pdf_sr * sphere_jacobian(sample, u, 1e-7);
            off += usize::from((product - 1.0).abs() > 1e-4);
            count += 1;
        }
        const DIRECTIONS: usize = 1 << 17;
        let density = |_| 4.0 * PI * outside.pdf_sr(place, direction(&mut random));
        let densities: Vec<f64> = (0..DIRECTIONS).map(density).collect();
        let mean =
            |power| densities.iter().map(|x| libm::pow(*x, power)).sum::<f64>() / DIRECTIONS as f64;
        let deviation = (mean(2.0) / DIRECTIONS as f64).sqrt();
        assert!((mean(1.0) - 1.0).abs() < 4.5 * deviation, "{} ± {deviation}", mean(1.0));
    }
    // Steps across an edge between two parts are rare.
    assert!(count >= 1600 && off <= count / 200, "{off} of {count}");
}
