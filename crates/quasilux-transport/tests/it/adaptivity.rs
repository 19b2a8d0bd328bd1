//! Points that are done stop costing, and keep what they had.
//!
//! A bright and a dim place need different numbers of samples. Whatever the estimator, a point ends
//! with the bits of a run that is limited to its own number of samples.

use crate::images::add_panel;
use crate::scenes::{diffuse, mirror, point_light, points, room};
use glam::DVec3;
use quasilux_scene::Scene;
use quasilux_transport::{Estimates, EstimatorKind, Settings, ToleranceOn, simulate};

/// A lamp behind a screen: the first place is open to it, the others get what comes around.
pub(crate) fn screened() -> Scene {
    let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(0.5));
    let corner = DVec3::new(1.5, 0.0, 0.0);
    add_panel(&mut scene, corner, DVec3::Y * 2.4, DVec3::Z * 2.5, diffuse(0.3));
    scene.lights.push(point_light(DVec3::new(0.6, 1.0, 1.9), 300.0));
    let at = |x: f64, y: f64| (DVec3::new(x, y, 0.8), DVec3::Z);
    scene.sensors.push(points("near", &[at(0.7, 1.1), at(1.2, 2.2)]));
    scene.sensors.push(points("far", &[at(3.5, 0.4), at(2.0, 1.0)]));
    scene
}

fn settings(estimator: EstimatorKind) -> Settings {
    Settings { estimator, rel_tol: 0.04, list_terms: 2, ..Settings::default() }
}

/// The values of a point in all replicates, with its terms.
fn bits(estimates: &Estimates, sensor: usize, point: usize) -> Vec<u64> {
    let figures = &estimates.sensors[sensor];
    let terms = figures.terms.iter().map(|term| &term.replicate_lx);
    let rows = std::iter::once(&figures.replicate_lx).chain(terms).flatten();
    rows.map(|row| row[point].to_bits()).collect()
}

fn is_each_point_that_of_a_limited_run(scene: &Scene, settings: &Settings) {
    let estimates = simulate(scene, settings, &mut ());
    assert!(estimates.tolerance_reached, "{:?}", settings.estimator);
    let mut counts: Vec<u64> = estimates.sensors.iter().flat_map(|s| s.samples.clone()).collect();
    counts.sort_unstable();
    counts.dedup();
    assert!(counts.len() > 1, "all points end together: nothing is tested, {counts:?}");
    assert_eq!(counts.last(), Some(&estimates.samples));
    for samples in counts {
        let limited = Settings { max_samples: Some(samples), ..settings.clone() };
        let limited = simulate(scene, &limited, &mut ());
        for (sensor, figures) in estimates.sensors.iter().enumerate() {
            for point in (0..figures.samples.len()).filter(|&p| figures.samples[p] == samples) {
                assert_eq!(bits(&estimates, sensor, point), bits(&limited, sensor, point));
                assert_eq!(limited.sensors[sensor].samples[point], samples);
                let of = |estimates: &Estimates| estimates.point_intervals(sensor)[point];
                assert_eq!(of(&estimates), of(&limited));
            }
        }
    }
}

#[test]
fn a_point_that_is_done_is_as_in_a_run_that_ends_there() {
    for estimator in
        [EstimatorKind::Path, EstimatorKind::Bidirectional, EstimatorKind::BidirectionalMap]
    {
        let settings = Settings { rel_tol: 0.06, ..settings(estimator) };
        is_each_point_that_of_a_limited_run(&screened(), &settings);
    }
}

/// Light of a lamp over a mirror and a diffuse wall is hidden from paths: photons grow for it.
#[test]
fn what_photons_bring_ends_with_the_point() {
    let mut scene = screened();
    let corner = DVec3::new(0.0, 2.9, 0.5);
    add_panel(&mut scene, corner, DVec3::X, DVec3::Z, mirror(0.9));
    let settings = Settings { image_depth: Some(0), ..settings(EstimatorKind::Path) };
    is_each_point_that_of_a_limited_run(&scene, &settings);
}

/// One point in ten needs a hundred times the samples of the others: rays are saved.
#[test]
fn points_that_are_done_cost_nothing() {
    let scene = screened();
    let adaptive = simulate(&scene, &settings(EstimatorKind::Path), &mut ());
    let never = Settings {
        rel_tol: 0.0,
        max_samples: Some(adaptive.samples),
        ..settings(EstimatorKind::Path)
    };
    let all = simulate(&scene, &never, &mut ());
    assert_eq!(all.samples, adaptive.samples);
    let share = adaptive.rays as f64 / all.rays as f64;
    let samples: Vec<u64> = adaptive.sensors.iter().flat_map(|s| s.samples.clone()).collect();
    let expected = samples.iter().sum::<u64>() as f64 / (4 * adaptive.samples) as f64;
    assert!(expected < 0.9 && share < expected + 0.15, "{share} of the rays, {samples:?}");
}

#[test]
fn averages_alone_may_decide() {
    let scene = screened();
    let points = simulate(&scene, &settings(EstimatorKind::Path), &mut ());
    let tolerance_on = ToleranceOn::Summary;
    let summary = Settings { tolerance_on, ..settings(EstimatorKind::Path) };
    let averages = simulate(&scene, &summary, &mut ());
    assert!(averages.tolerance_reached && averages.rays < points.rays);
    for (sensor, figures) in averages.sensors.iter().enumerate() {
        assert!(averages.average(sensor).relative_half_width() <= Some(0.04));
        assert!(figures.samples.windows(2).all(|pair| pair[0] == pair[1]), "a sensor ends as one");
    }
    assert!(averages.samples < points.samples, "{} {}", averages.samples, points.samples);
}

/// With an absolute tolerance dim points are done sooner.
#[test]
fn a_half_width_in_lx_is_enough() {
    let abs_tol_lx = 1.0;
    let settings = Settings { rel_tol: 0.001, abs_tol_lx, ..settings(EstimatorKind::Path) };
    let estimates = simulate(&screened(), &settings, &mut ());
    assert!(estimates.tolerance_reached);
    for sensor in 0..2 {
        for point in estimates.point_intervals(sensor) {
            assert!(point.half_width.unwrap() <= abs_tol_lx.max(0.001 * point.value), "{point:?}");
        }
    }
}

/// A limit on rays ends a run at a checkpoint before it, with the bits of a run that is limited to
/// the samples there.
#[test]
fn rays_only_pick_the_last_checkpoint() {
    let scene = screened();
    for estimator in [EstimatorKind::Path, EstimatorKind::Bidirectional] {
        let never = Settings { rel_tol: 0.0, ..settings(estimator) };
        let limit = 1_000_000;
        let limited =
            simulate(&scene, &Settings { max_rays: Some(limit), ..never.clone() }, &mut ());
        assert!(!limited.tolerance_reached && limited.rays <= limit);
        assert!(limited.rays > limit / 8, "{} of {limit} rays", limited.rays);
        let max_samples = Some(limited.samples);
        let again = simulate(&scene, &Settings { max_samples, ..never }, &mut ());
        assert_eq!((&again.sensors, again.rays), (&limited.sensors, limited.rays));
    }
}
