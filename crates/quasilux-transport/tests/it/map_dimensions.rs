//! Maps without photons that took many coordinates: the paper's balance of dimensions.

use crate::element_size::room_with_points;
use quasilux_transport::{CheckError, Estimates, EstimatorKind, Settings, Switch, check, simulate};

fn run(estimator: EstimatorKind, map_dimensions: Option<u32>) -> Estimates {
    let settings = Settings {
        estimator,
        map_dimensions,
        connections: Switch::Off,
        importance: Switch::Off,
        rel_tol: 0.0,
        max_samples: Some(1 << 10),
        ..Settings::default()
    };
    simulate(&room_with_points(), &settings, &mut ())
}

fn values_lx(estimates: &Estimates) -> Vec<f64> {
    estimates.point_intervals(0).iter().map(|interval| interval.value).collect()
}

/// The more coordinates photons may have used, the more of the light is on the map, up to all of
/// it.
#[test]
fn the_paper_s_map_goes_without_what_is_left_out() {
    let of = |most| run(EstimatorKind::BidirectionalMap, most);
    let all = of(None);
    let ascending = [Some(1), Some(6), Some(12), None].map(|most| values_lx(&of(most)));
    for pair in ascending.windows(2) {
        let found = format!("{pair:?}");
        assert!(pair[0].iter().zip(&pair[1]).all(|(less, more)| *less < 0.98 * more), "{found}");
    }
    assert_eq!(of(Some(10_000)).sensors, all.sensors);
    let says =
        |estimates: &Estimates| estimates.warnings.iter().any(|w| w.contains("may be too low"));
    assert!(says(&of(Some(6))) && !says(&all));
}

/// Paths that correct the map find what is not on it.
#[test]
fn the_corrected_map_finds_it() {
    let path = run(EstimatorKind::Path, None).point_intervals(0);
    for most in [1, 8] {
        let corrected = run(EstimatorKind::Selected, Some(most));
        assert!(!corrected.biased);
        for (a, b) in corrected.point_intervals(0).iter().zip(&path) {
            let joint = libm::hypot(a.half_width.unwrap(), b.half_width.unwrap());
            let found = format!("{most}: {a:?}, by paths {b:?}");
            assert!((a.value - b.value).abs() < 1.5 * joint && joint < 0.03 * b.value, "{found}");
        }
    }
}

#[test]
fn it_is_refused_where_there_is_no_map() {
    let of = |estimator, connections| {
        let settings =
            Settings { estimator, connections, map_dimensions: Some(8), ..Settings::default() };
        check(&room_with_points(), &settings)
    };
    for (estimator, connections) in [
        (EstimatorKind::Path, Switch::Auto),
        (EstimatorKind::Photon, Switch::Auto),
        (EstimatorKind::Selected, Switch::On),
    ] {
        let refused = of(estimator, connections);
        assert!(matches!(refused, Err(CheckError::NoMapToLeaveOutOf { .. })), "{refused:?}");
    }
    assert_eq!(of(EstimatorKind::Selected, Switch::Auto), Ok(()));
    assert_eq!(of(EstimatorKind::BidirectionalMap, Switch::Auto), Ok(()));
}
