//! The bias of a map without correction: it shrinks with its elements, and faster if they are linear.

use crate::scenes::diffuse_cube;
use quasilux_transport::{Estimator, Reconstruction, Settings, simulate};
use std::f64::consts::PI;

/// Luminance at the middle of a wall of the diffuse cube (see `cube.rs`), as illuminance in lx.
const KNOWN_LX: f64 = 892.80 * PI * 1.5;

fn settings(map_reconstruction: Reconstruction, map_element_m: f64) -> Settings {
    Settings {
        estimator: Estimator::BidirectionalMap,
        map_reconstruction,
        map_element_m: Some(map_element_m),
        map_adaptive: false,
        max_samples: Some(1 << 14),
        rel_tol: 0.0,
        ..Settings::default()
    }
}

/// Relative error at the middle of the wall, and the half-width of its interval.
fn error(settings: &Settings) -> (f64, f64) {
    let estimates = simulate(&diffuse_cube(&[(0.0, 0.0)]), settings, &mut ());
    let interval = estimates.point_intervals(0)[0];
    (interval.value / KNOWN_LX - 1.0, interval.half_width.unwrap() / KNOWN_LX)
}

/// Seed 1, three intervals of 95 % each. With elements that are whole halves of walls the map is 0.6 %
/// low; with those of a quarter of the edge, constant ones are 0.16 % low and linear ones less than
/// half as much: at least the first and the second order, over two halvings.
#[test]
fn bias_shrinks_with_the_elements() {
    let large = error(&settings(Reconstruction::Constant, 14.2));
    let constant = error(&settings(Reconstruction::Constant, 3.55));
    let linear = error(&settings(Reconstruction::Linear, 3.55));
    let found = format!("{large:?}, {constant:?}, {linear:?}");
    assert!(large.0 < -0.004 && large.1 < 0.001, "{found}");
    assert!(constant.0.abs() < 0.5 * large.0.abs() + constant.1, "{found}");
    assert!(linear.0.abs() < 0.0625 * large.0.abs() + linear.1, "{found}");
    assert!(constant.1 < 0.0012 && linear.1 < 0.0012, "{found}");
}

#[test]
fn refined_maps_give_the_same_bits_on_any_number_of_threads() {
    let settings = Settings {
        map_adaptive: true,
        map_element_m: None,
        max_samples: Some(1 << 8),
        replicates: 4,
        ..settings(Reconstruction::Linear, 1.0)
    };
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let scene = diffuse_cube(&[(0.0, 0.0), (0.9, 0.9)]);
        pool.install(|| simulate(&scene, &settings, &mut ()).point_intervals(0))
    };
    assert_eq!(run(1), run(2));
}
