//! The diffuse cube, whose luminance is known from two independent solves.

use crate::scenes::{diffuse_cube, wall_grid};
use quasilux_transport::{Estimates, EstimatorKind, Settings, simulate};
use std::f64::consts::PI;

/// Luminance in cd/m^2 at interior places of a wall, in units of the half side: radiosity with
/// analytic form factors and graded elements, confirmed by a spectral solve to 0.003 cd/m^2; the
/// three first also printed by Voloboy, Dmitriev and Kopylov (2003), table 4.
const KNOWN: [((f64, f64), f64); 6] = [
    ((0.0, 0.0), 892.80),
    ((0.5, 0.0), 768.69),
    ((0.5, 0.5), 686.70),
    ((0.98, 0.0), 582.60),
    ((0.98, 0.5), 537.8),
    ((0.98, 0.98), 420.3),
];

fn run(settings: &Settings, known: &[((f64, f64), f64)]) -> Estimates {
    let places: Vec<(f64, f64)> = known.iter().map(|known| known.0).collect();
    simulate(&diffuse_cube(&places), settings, &mut ())
}

#[test]
fn known_luminances_lie_in_the_intervals() {
    for estimator in
        [EstimatorKind::Path, EstimatorKind::Bidirectional, EstimatorKind::BidirectionalMap]
    {
        // Next to an edge a point sees a few map elements, which stay noisy for very long.
        let known =
            if estimator == EstimatorKind::BidirectionalMap { &KNOWN[..3] } else { &KNOWN[..] };
        let settings = Settings { estimator, rel_tol: 0.005, ..Settings::default() };
        let estimates = run(&settings, known);
        assert!(estimates.tolerance_reached && estimates.invalid_contributions == 0);
        assert_eq!(estimates.biased, estimator == EstimatorKind::BidirectionalMap);
        for (interval, (place, luminance)) in estimates.point_intervals(0).iter().zip(known) {
            let wanted = luminance * PI * 1.5;
            let allowed = interval.half_width.unwrap() + 0.003 * wanted;
            let found = format!("{estimator:?} {place:?}: {interval:?}, wanted {wanted}");
            assert!((interval.value - wanted).abs() < allowed, "{found}");
        }
    }
}

/// Photons that pass through a grid on the wall, against paths from all over its cells, and against
/// the mean over all six walls: flux / (600 m^2 (1 - 2/3)). Joint intervals; the family has 17
/// tests.
#[test]
fn counted_photons_agree_with_paths_in_the_mean() {
    let mut scene = diffuse_cube(&[]);
    scene.sensors = vec![wall_grid([4, 4])];
    let run = |estimator| {
        let settings = Settings { estimator, rel_tol: 0.005, ..Settings::default() };
        simulate(&scene, &settings, &mut ())
    };
    let (photons, paths) = (run(EstimatorKind::Photon), run(EstimatorKind::Path));
    assert!(photons.tolerance_reached && !photons.biased);
    for (counted, contribution) in photons.point_intervals(0).iter().zip(paths.point_intervals(0)) {
        let allowed = 1.5 * (counted.half_width.unwrap() + contribution.half_width.unwrap());
        let found = format!("{counted:?} against {contribution:?}");
        assert!((counted.value - contribution.value).abs() < allowed, "{found}");
    }
    let average = photons.interval_of(0, |lx| lx.iter().sum::<f64>() / lx.len() as f64);
    let wanted = 4.0 * PI * 50_000.0 / 200.0;
    let allowed = 1.5 * average.half_width.unwrap();
    assert!((average.value - wanted).abs() < allowed, "{average:?}, wanted {wanted}");
}

/// The mean path of a photon has three hits; by superposition it uses two coordinates at its start,
/// one at each hit and one more at each of the two reflections: 7.
#[test]
fn photons_use_seven_coordinates() {
    let settings = Settings {
        estimator: EstimatorKind::Photon,
        max_samples: Some(1 << 14),
        rel_tol: 0.0,
        ..Settings::default()
    };
    let dimensions = run(&settings, &KNOWN[..1]).dimensions;
    assert_eq!(dimensions.photons, 16 << 14);
    let events = dimensions.photon_events as f64 / dimensions.photons as f64;
    let dimension = dimensions.photon.mean();
    assert!((dimension - 7.0).abs() < 0.02 && (events - 3.0).abs() < 0.01, "{dimension} {events}");
}
