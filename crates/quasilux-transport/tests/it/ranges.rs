//! Settings out of range: numbers that mean nothing are refused before a run.

use crate::element_size::room_with_points;
use quasilux_sampling::{Randomization, Sequence};
use quasilux_transport::{
    CheckError, EstimatorKind, IntervalKind, Settings, UnseenTolerance, check,
};

#[test]
fn numbers_that_mean_nothing_are_refused() {
    let scene = room_with_points();
    let good = Settings::default();
    assert_eq!(check(&scene, &good), Ok(()));
    let bad = [
        ("rel_tol", Settings { rel_tol: f64::NAN, ..good.clone() }),
        ("rel_tol", Settings { rel_tol: -0.01, ..good.clone() }),
        ("abs_tol_lx", Settings { abs_tol_lx: f64::INFINITY, ..good.clone() }),
        ("unseen_tol", Settings { unseen_tol: UnseenTolerance::Share(-0.1), ..good.clone() }),
        ("unseen_tol", Settings { unseen_tol: UnseenTolerance::Share(f64::NAN), ..good.clone() }),
        ("confidence", Settings { confidence: 1.0, ..good.clone() }),
        ("confidence", Settings { confidence: f64::NAN, ..good.clone() }),
        ("replicates", Settings { replicates: 0, ..good.clone() }),
        ("max_samples", Settings { max_samples: Some(0), ..good.clone() }),
        ("max_rays", Settings { max_rays: Some(0), ..good.clone() }),
        ("map_element_m", Settings { map_element_m: Some(0.0), ..good.clone() }),
        ("map_elements", Settings { map_elements: 0, ..good.clone() }),
        ("map_photons", Settings { map_photons: 0, ..good.clone() }),
    ];
    for (name, settings) in bad {
        let refused = check(&scene, &settings);
        assert!(
            matches!(refused, Err(CheckError::OutOfRange { setting, .. }) if setting == name),
            "{name}: {refused:?}"
        );
    }
}

/// Where nothing is known of contributions, or no replicates differ, there is no certified
/// interval.
#[test]
fn certified_intervals_want_bounds_and_replicates() {
    let scene = room_with_points();
    let asked = Settings { interval: IntervalKind::Certified, ..Settings::default() };
    assert_eq!(check(&scene, &asked), Ok(()));
    let path = Settings { estimator: EstimatorKind::Path, ..asked.clone() };
    let refusal = CheckError::NothingCertified { estimator: "path" };
    assert_eq!(check(&scene, &path), Err(refusal));
    let single = Settings { replicates: 1, ..asked.clone() };
    let unrandomised = Settings { randomization: Randomization::None, ..asked };
    for settings in [single, unrandomised] {
        assert_eq!(check(&scene, &settings), Err(CheckError::NoReplicates));
    }
}

#[test]
fn the_points_of_hammersley_are_those_of_the_run() {
    let scene = room_with_points();
    let run = |points, max_samples| {
        let sequence = Sequence::Hammersley { points };
        check(&scene, &Settings { sequence, max_samples, ..Settings::default() })
    };
    assert_eq!(run(64, Some(64)), Ok(()));
    let refusal = CheckError::OtherNumberOfPoints { sequence: "hammersley" };
    assert_eq!(run(64, Some(63)), Err(refusal.clone()));
    assert_eq!(run(64, None), Err(refusal));
}
