//! Measured sheets with odd tables: such that tell one way of light apart from the other, or give
//! more than they get.

use crate::cameras::{assert_luminances, camera, quadrature, share};
use crate::images::{add_panel, empty};
use crate::materials::tells_of_trapped_light;
use crate::measured::{
    Mean, REPLICATES, assert_alike, assert_estimators_agree, divided, estimates, measured, table,
};
use crate::scenes::{diffuse, point_light, points, room};
use glam::DVec3;
use quasilux_bsdf::{Distribution, ScatteringMode, Side};
use quasilux_scene::{Bsdf, Grid, Quantity, Scene, Sensor, SensorShape};
use quasilux_transport::{EstimatorKind, Settings, Switch, simulate};
use std::f64::consts::FRAC_1_PI;

const DARK: fn() -> Distribution = || table(|_, _| 0.0);

/// Whether a direction is between these polar angles.
fn is_between(direction: DVec3, [low_deg, high_deg]: [f64; 2]) -> bool {
    let angle_deg = libm::acos(direction.z).to_degrees();
    (low_deg..high_deg).contains(&angle_deg)
}

/// Light of one band goes on into another one, and of no other: paths that ask the table which
/// light leaves as they do find none.
#[test]
fn photons_and_paths_agree_where_light_goes_from_band_to_band() {
    let through = table(|wi, wo| {
        let goes = is_between(wi, [35.0, 70.0]) && is_between(wo, [5.0, 35.0]);
        if goes { 0.8 } else { 0.0 }
    });
    let scene = divided(measured([
        (Side::Front, ScatteringMode::Transmission, through.clone()),
        (Side::Back, ScatteringMode::Transmission, through),
    ]));
    assert_estimators_agree("bands", &scene, 1 << 11, 0.08);
}

/// A sheet through which light goes one way alone.
#[test]
fn photons_and_paths_agree_where_one_side_lets_nothing_through() {
    for open in Side::ALL {
        let through = |side| {
            if side == open { table(|_, _| 0.7 * FRAC_1_PI) } else { DARK() }
        };
        let tables = Side::ALL.map(|side| (side, ScatteringMode::Transmission, through(side)));
        let scene = divided(measured(tables));
        assert_estimators_agree("one way", &scene, 1 << 10, 0.06);
    }
}

/// Cosine toward one side, in the frame of a table, from which a table below takes light.
const MIN_X: f64 = 0.1;
/// What that table gives of it.
const SHARE: f64 = 0.9;

/// A wall that shines only where the lamp is to one side of it: the lit part of each facet is not
/// where its centroid is.
fn half_dark_wall() -> Scene {
    let shines = table(|wi, _| if wi.x < -MIN_X { SHARE * FRAC_1_PI } else { 0.0 });
    let wall = measured([(Side::Front, ScatteringMode::Reflection, shines)]);
    let mut scene = room(DVec3::splat(2.0), diffuse(0.3));
    let corner = DVec3::new(0.01, 0.1, 0.1);
    add_panel(&mut scene, corner, DVec3::Y * 1.8, DVec3::Z * 1.8, wall);
    scene.lights.push(point_light(DVec3::new(0.8, 0.6, 1.0), 500.0));
    let places = [(0.4, 0.6), (1.0, 1.0), (1.5, 1.3)];
    let places = places.map(|(y, z)| (DVec3::new(1.5, y, z), DVec3::NEG_X));
    scene.sensors.push(points("opposite", &places));
    scene
}

#[test]
fn first_shot_finds_light_on_facets_whose_middle_is_dark() {
    let scene = half_dark_wall();
    let run = |estimator, first_shot, samples| {
        let settings = Settings {
            estimator,
            first_shot,
            replicates: REPLICATES,
            max_samples: Some(samples),
            rel_tol: 0.0,
            ..Settings::default()
        };
        Mean::all(&simulate(&scene, &settings, &mut ()))
    };
    let paths = run(EstimatorKind::Path, Switch::Off, 1 << 10);
    for first_shot in [Switch::On, Switch::Off] {
        let both = run(EstimatorKind::Bidirectional, first_shot, 1 << 8);
        let pairs: Vec<(Mean, Mean)> = paths.iter().copied().zip(both).collect();
        assert_alike(&format!("first shot {first_shot:?}"), &pairs, 0.05);
        let map = run(EstimatorKind::BidirectionalMap, first_shot, 1 << 8);
        for (path, map) in paths.iter().zip(map) {
            // Elements of maps cause some bias.
            let off = (path.value_lx / map.value_lx - 1.0).abs();
            assert!(off < 0.05, "first shot {first_shot:?}: {path:?} by paths, {map:?} by maps");
        }
    }
}

/// The luminance of a measured wall is what its table gives of the lamp's illuminance, line of
/// sight by line of sight.
#[test]
fn a_measured_wall_in_a_picture() {
    let toward = DVec3::new(0.3, 0.4, 0.8).normalize();
    let gloss = table(move |wi, wo| 0.1 + 0.5 * wo.dot(toward).max(0.0) * (1.0 + wi.y));
    let wall = measured([(Side::Front, ScatteringMode::Reflection, gloss.clone())]);
    let mut scene = empty();
    add_panel(&mut scene, DVec3::ZERO, DVec3::Y * 4.0, DVec3::Z * 4.0, wall);
    let (lamp, intensity_cd) = (DVec3::new(2.5, 1.0, 3.0), 800.0);
    scene.lights.push(point_light(lamp, intensity_cd));
    let camera = camera(DVec3::new(2.0, 2.5, 1.5), DVec3::new(0.0, 2.0, 2.0));
    // The wall's z in its table is the world's x, its y the world's z, and its x the world's -y.
    let in_table = |world: DVec3| DVec3::new(-world.y, world.z, world.x);
    let wanted = quadrature(&camera, 256, |w| {
        let place = camera.position - w * (camera.position.x / w.x);
        let to_light = lamp - place;
        let wi = to_light.normalize();
        let lx = intensity_cd * wi.x / to_light.length_squared();
        lx * gloss.evaluate(in_table(wi), in_table(-w))[0]
    });
    scene.cameras.push(camera);
    let settings = Settings { max_samples: Some(share(1024)), ..Settings::default() };
    assert_luminances(&simulate(&scene, &settings, &mut ()), &wanted);
}

/// A sheet that gives many times what it gets is taken at its word: in a black room it is a hundred
/// times as bright as a diffuse one that gives a hundredth of that.
#[test]
fn a_sheet_that_gives_more_than_it_gets_is_used_as_it_is() {
    let with = |sheet: Bsdf| {
        let mut scene = room(DVec3::ONE, diffuse(0.0));
        let corner = DVec3::new(0.2, 0.2, 0.01);
        add_panel(&mut scene, corner, DVec3::X * 0.6, DVec3::Y * 0.6, sheet);
        scene.lights.push(point_light(DVec3::new(0.5, 0.5, 0.9), 10.0));
        // They see the sheet alone.
        scene.sensors = [0.1, 0.5].map(|x| grid_below(DVec3::new(x, 0.2, 0.6))).to_vec();
        scene
    };
    let bright = table(|_, _| 60.0 * FRAC_1_PI);
    let bright = with(measured([(Side::Front, ScatteringMode::Reflection, bright)]));
    let known = with(diffuse(0.6));
    for (estimator, samples) in [(EstimatorKind::Path, 1 << 10), (EstimatorKind::Photon, 1 << 14)] {
        let [found, expected] = [&bright, &known].map(|scene| estimates(scene, estimator, samples));
        let expected = expected.iter().map(|mean| mean.times(100.0));
        let pairs: Vec<(Mean, Mean)> = expected.zip(found).collect();
        assert_alike(estimator.name(), &pairs, 0.05);
    }
}

/// A cell that looks down.
pub(crate) fn grid_below(origin: DVec3) -> Sensor {
    let grid = Grid {
        origin,
        u: DVec3::X * 0.4,
        v: DVec3::Y * 0.6,
        counts: [1, 1],
        normal: DVec3::NEG_Z,
        quantity: Quantity::Mean,
        target_lx: None,
    };
    Sensor { name: "down".to_owned(), shape: SensorShape::Grid(grid) }
}

/// Two such sheets face each other, or one faces a bright room: the series of bounces has no sum.
/// All estimators end, soon, and say so.
#[test]
fn light_that_grows_for_ever_ends_with_a_warning() {
    let bright = || table(|_, _| 60.0 * FRAC_1_PI);
    let mut scene =
        divided(measured(Side::ALL.map(|side| (side, ScatteringMode::Reflection, bright()))));
    for material in &mut scene.materials[..1] {
        material.bsdf = diffuse(0.8);
    }
    for estimator in [
        EstimatorKind::Path,
        EstimatorKind::Bidirectional,
        EstimatorKind::BidirectionalMap,
        EstimatorKind::Photon,
    ] {
        let settings =
            Settings { estimator, replicates: 2, max_samples: Some(64), ..Settings::default() };
        if estimator == EstimatorKind::Photon {
            scene.sensors.truncate(2);
        }
        let found = simulate(&scene, &settings, &mut ());
        assert!(tells_of_trapped_light(&found), "{estimator:?}: {:?}", found.caveats);
    }
}
