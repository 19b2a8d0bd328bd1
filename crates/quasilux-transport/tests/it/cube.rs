//! The diffuse cube, whose luminance is known from two independent solves.

use crate::scenes::diffuse_cube;
use quasilux_transport::{Estimates, Estimator, Settings, simulate};
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
    for estimator in [Estimator::Path, Estimator::Bidirectional, Estimator::BidirectionalMap] {
        // Next to an edge a point sees a few map elements, which a map without correction leaves
        // noisy for very long.
        let known = if estimator == Estimator::BidirectionalMap { &KNOWN[..3] } else { &KNOWN[..] };
        let settings = Settings { estimator, rel_tol: 0.005, ..Settings::default() };
        let estimates = run(&settings, known);
        assert!(estimates.tolerance_reached && estimates.invalid_contributions == 0);
        assert_eq!(estimates.biased, estimator == Estimator::BidirectionalMap);
        for (interval, (place, luminance)) in estimates.point_intervals(0).iter().zip(known) {
            let wanted = luminance * PI * 1.5;
            let allowed = interval.half_width.unwrap() + 0.003 * wanted;
            let found = format!("{estimator:?} {place:?}: {interval:?}, wanted {wanted}");
            assert!((interval.value - wanted).abs() < allowed, "{found}");
        }
    }
}

#[test]
fn counted_photons_agree_on_the_wall() {
    let settings = Settings {
        estimator: Estimator::Photon,
        rel_tol: 0.02,
        map_element_m: Some(2.0),
        ..Settings::default()
    };
    let estimates = run(&settings, &KNOWN[..3]);
    assert!(estimates.tolerance_reached && estimates.biased);
    for (interval, (_, luminance)) in estimates.point_intervals(0).iter().zip(&KNOWN) {
        let wanted = luminance * PI * 1.5;
        // Elements of 2 m see up to 2 % less than the point in their middle.
        let allowed = interval.half_width.unwrap() + 0.02 * wanted;
        assert!((interval.value - wanted).abs() < allowed, "{interval:?}, wanted {wanted}");
    }
}

/// The mean path of a photon has three hits; by superposition it uses two coordinates at its start,
/// one at each hit and one more at each of the two reflections: 7.
#[test]
fn photons_use_seven_coordinates() {
    let settings = Settings {
        estimator: Estimator::Photon,
        max_samples: Some(1 << 14),
        rel_tol: 0.0,
        ..Settings::default()
    };
    let dimension = run(&settings, &KNOWN[..1]).mean_dimension.photon.unwrap();
    assert!((dimension - 7.0).abs() < 0.02, "{dimension}");
}
