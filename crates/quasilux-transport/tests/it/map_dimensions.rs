//! Maps without photons that took many coordinates: the paper's balance of dimensions.

use crate::element_size::room_with_points;
use quasilux_transport::{
    Caveat, CheckError, Estimates, EstimatorKind, Settings, Switch, check, simulate,
};

fn run(map_dimensions: Option<u32>) -> Estimates {
    let settings = Settings {
        estimator: EstimatorKind::BidirectionalMap,
        map_dimensions,
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
    let all = run(None);
    let ascending = [Some(1), Some(6), Some(12), None].map(|most| values_lx(&run(most)));
    for pair in ascending.windows(2) {
        let found = format!("{pair:?}");
        assert!(pair[0].iter().zip(&pair[1]).all(|(less, more)| *less < 0.98 * more), "{found}");
    }
    assert_eq!(run(Some(10_000)).sensors, all.sensors);
    let says = |estimates: &Estimates| {
        estimates.caveats.contains(&Caveat::MapDimensions { map_dimensions: 6 })
    };
    assert!(says(&run(Some(6))) && !says(&all));
}

#[test]
fn it_is_refused_where_there_is_no_map() {
    let of = |estimator| {
        let settings = Settings { estimator, map_dimensions: Some(8), ..Settings::default() };
        check(&room_with_points(), &settings)
    };
    for estimator in [EstimatorKind::Auto, EstimatorKind::Path, EstimatorKind::Photon] {
        let refused = of(estimator);
        assert!(matches!(refused, Err(CheckError::NoMapToLeaveOutOf { .. })), "{refused:?}");
    }
    assert_eq!(of(EstimatorKind::BidirectionalMap), Ok(()));
}
