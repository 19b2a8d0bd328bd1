//! The bias of a map without correction: it shrinks with its elements, and faster if they are
//! linear.

use crate::scenes::{diffuse_cube, points};
use glam::DVec3;
use quasilux_sampling::Sequence;
use quasilux_scene::Scene;
use quasilux_stats::student_t_quantile;
use quasilux_transport::{EstimatorKind, Interval, Reconstruction, Settings, Switch, simulate};
use std::f64::consts::PI;

/// Luminance at the middle of a wall of the diffuse cube (see `cube.rs`), as illuminance in lx.
const KNOWN_LX: f64 = 892.80 * PI * 1.5;

fn settings(map_reconstruction: Reconstruction, map_element_m: f64) -> Settings {
    Settings {
        estimator: EstimatorKind::BidirectionalMap,
        map_reconstruction,
        map_element_m: Some(map_element_m),
        map_adaptive: false,
        max_samples: Some(1 << 14),
        rel_tol: 0.0,
        ..Settings::default()
    }
}

/// Relative error at the middle of the wall, and the half-width at 95 % of what was found: where
/// the map is so coarse that the witness contradicts it, there is no interval.
fn error(settings: &Settings) -> (f64, f64) {
    let estimates = simulate(&diffuse_cube(&[(0.0, 0.0)]), settings, &mut ());
    let values: Vec<f64> = estimates.sensors[0].replicate_lx.iter().map(|row| row[0]).collect();
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / (n - 1.0);
    let half_width = student_t_quantile(0.95, n - 1.0) * (variance / n).sqrt();
    (mean / KNOWN_LX - 1.0, half_width / KNOWN_LX)
}

/// Seed 1, three intervals of 95 % each. With elements that are whole halves of walls the map is
/// 0.6 % low; with those of a quarter of the edge, constant ones are 0.16 % low and linear ones
/// less than half as much: at least the first and the second order, over two halvings.
#[test]
fn bias_shrinks_with_the_elements() {
    let large = error(&settings(Reconstruction::Constant, 14.2));
    let constant = error(&settings(Reconstruction::Constant, 3.55));
    let linear = error(&settings(Reconstruction::Linear, 3.55));
    let found = format!("{large:?}, {constant:?}, {linear:?}");
    assert!(large.0 < -0.004 && large.1 < 0.001, "{found}");
    assert!(constant.0.abs() < 0.25 * large.0.abs() + constant.1, "{found}");
    assert!(linear.0.abs() < 0.0625 * large.0.abs() + linear.1, "{found}");
    assert!(constant.1 < 0.0012 && linear.1 < 0.0012, "{found}");
}

/// The root mean square of relative errors at some points, and of their joint half-widths.
fn error_in_room(reconstruction: Reconstruction, element_m: f64, known: &[Interval]) -> (f64, f64) {
    let found = simulate(&room_with_points(), &settings(reconstruction, element_m), &mut ());
    let found = found.point_intervals(0);
    let root_mean = |of: &dyn Fn(&Interval, &Interval) -> f64| {
        let squares =
            found.iter().zip(known).map(|(x, y)| of(x, y) * of(x, y) / (y.value * y.value));
        (squares.sum::<f64>() / known.len() as f64).sqrt()
    };
    let joint = |x: &Interval, y: &Interval| {
        libm::hypot(x.half_width.expect("light was found"), y.half_width.expect("light was found"))
    };
    (root_mean(&|x, y| x.value - y.value), root_mean(&joint))
}

/// A room without symmetry, and points in a corner, on the ceiling and on a wall.
pub(crate) fn room_with_points() -> Scene {
    let mut scene = crate::dozen_scenes::closed(0.6);
    let places = [
        (DVec3::new(0.3, 0.2, 0.0), DVec3::Z),
        (DVec3::new(3.0, 2.0, 2.5), DVec3::NEG_Z),
        (DVec3::new(4.0, 1.0, 0.5), DVec3::NEG_X),
    ];
    scene.sensors = vec![points("points", &places)];
    scene
}

/// Against paths, seed 1: constant elements of 3 m err by 1 %, linear ones of 6 m, which are whole
/// halves of walls, by 2 %. Two halvings leave at most a quarter of the former, the first order,
/// and one halving a quarter of the latter, the second.
#[test]
fn bias_shrinks_where_there_is_no_symmetry() {
    let of_path = Settings {
        estimator: EstimatorKind::Path,
        max_samples: Some(1 << 14),
        rel_tol: 0.0,
        ..Settings::default()
    };
    let known = simulate(&room_with_points(), &of_path, &mut ()).point_intervals(0);
    for (reconstruction, large_m, small_m) in
        [(Reconstruction::Constant, 3.0, 0.75), (Reconstruction::Linear, 6.0, 3.0)]
    {
        let large = error_in_room(reconstruction, large_m, &known);
        let small = error_in_room(reconstruction, small_m, &known);
        let found = format!("{reconstruction:?}: {large:?}, {small:?}");
        assert!(large.0 > 0.008 && small.1 < 0.003, "{found}");
        assert!(small.0 < 0.25 * large.0 + small.1, "{found}");
    }
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

/// Every path of the sensor point comes with 64 photons: 64 paths in 16 replicates with 2^16, which
/// know the middle of the wall to about 1 %.
#[test]
fn maps_get_the_photons_that_are_asked_for() {
    for sequence in [Sequence::Sobol, Sequence::Hammersley { points: 64 }] {
        let settings = Settings {
            sequence,
            map_photons: 64,
            first_shot: Switch::Off,
            importance: Switch::Off,
            max_samples: Some(64),
            ..settings(Reconstruction::Constant, 3.55)
        };
        let estimates = simulate(&diffuse_cube(&[(0.0, 0.0)]), &settings, &mut ());
        assert_eq!(estimates.dimensions.photon.samples(), 1 << 16);
        let value_lx = estimates.point_intervals(0)[0].value;
        assert!((value_lx / KNOWN_LX - 1.0).abs() < 0.04, "{value_lx}");
    }
}
