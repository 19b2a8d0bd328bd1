//! Point lamps over surfaces with narrow lobes: what paths hardly ever meet is not called known.

use crate::images::{add_panel, empty};
use crate::measured::measured;
use crate::measured_known::lobes;
use crate::scenes::{diffuse, point_light, points};
use glam::DVec3;
use quasilux_bsdf::{ScatteringMode, Side};
use quasilux_scene::{Bsdf, Rgb, Scene, bsdf};
use quasilux_transport::{Estimates, EstimatorKind, Scattering, Settings, simulate};

const LAMP: DVec3 = DVec3::new(1.2, 1.0, 1.0);
const PLACE: DVec3 = DVec3::new(0.6, 0.9, 0.2);
const CEILING_M: f64 = 2.0;
const INTENSITY_CD: f64 = 100.0;

/// A ceiling of this material over a lamp and a place that looks up.
fn ceiling(bsdf: Bsdf) -> Scene {
    let mut scene = empty();
    let (x, y) = (DVec3::X * CEILING_M, DVec3::Y * CEILING_M);
    add_panel(&mut scene, DVec3::Z * CEILING_M, y, x, bsdf);
    scene.lights.push(point_light(LAMP, INTENSITY_CD));
    scene.sensors.push(points("below", &[(PLACE, DVec3::Z)]));
    scene
}

fn metal(alpha: f64) -> Bsdf {
    Bsdf::Conductor(bsdf::Conductor { reflectance: Rgb::grey(0.8), alpha })
}

/// The illuminance by the midpoint rule over the ceiling, in lx, with straight light.
fn expected_lx(bsdf: &Bsdf) -> f64 {
    const SIDE: u32 = 1500;
    let scattering = Scattering::from_material(bsdf);
    let step_m = CEILING_M / f64::from(SIDE);
    let given = |from: DVec3, to: DVec3| (from - to).normalize();
    let lx_of = |i: u32, j: u32| {
        let middle = |k: u32| (f64::from(k) + 0.5) * step_m;
        let at = DVec3::new(middle(i), middle(j), CEILING_M);
        let (toward_lamp, toward_place) = (given(LAMP, at), given(PLACE, at));
        // The ceiling's frame looks down.
        let local = |way: DVec3| DVec3::new(way.x, -way.y, -way.z);
        let f_sr = scattering.evaluate(local(toward_lamp), local(toward_place)).luminance();
        let lit_lx = INTENSITY_CD * -toward_lamp.z / (LAMP - at).length_squared();
        let cos_sr = toward_place.z * toward_place.z / (PLACE - at).length_squared();
        f_sr * lit_lx * cos_sr * step_m * step_m
    };
    let reflected_lx: f64 =
        (0..SIDE).flat_map(|i| (0..SIDE).map(move |j| (i, j))).map(|(i, j)| lx_of(i, j)).sum();
    let way = LAMP - PLACE;
    reflected_lx + INTENSITY_CD * way.normalize().z / way.length_squared()
}

fn run(scene: &Scene, samples: u64) -> Estimates {
    let (estimator, max_samples) = (EstimatorKind::Path, Some(samples));
    let settings = Settings { estimator, rel_tol: 0.02, max_samples, ..Settings::default() };
    simulate(scene, &settings, &mut ())
}

fn is_told(estimates: &Estimates) -> bool {
    estimates.warnings.iter().any(|warning| warning.contains("lobes so narrow"))
}

/// The lobe of a nearly perfect mirror is bright on a spot of the ceiling that few paths meet:
/// nothing is said of the error until they have, and then what is said holds.
#[test]
fn what_few_paths_meet_has_no_interval() {
    let bsdf = metal(0.03);
    let expected_lx = expected_lx(&bsdf);
    let scene = ceiling(bsdf);
    let few = run(&scene, 128);
    assert!(few.point_intervals(0)[0].half_width.is_none() && !few.tolerance_reached);
    assert!(is_told(&few), "{:?}", few.warnings);
    let enough = run(&scene, 1 << 20);
    let known = enough.point_intervals(0)[0];
    let half_width_lx = known.half_width.expect("an interval");
    assert!(enough.tolerance_reached && !is_told(&enough) && enough.samples > 128);
    assert!(
        (known.value - expected_lx).abs() < 1.5 * half_width_lx,
        "{} +- {half_width_lx}, expected {expected_lx}",
        known.value
    );
}

/// A sheet that lets light through in narrow lobes, of which the file knows the side with the lamp
/// alone: paths do not draw their directions from it.
#[test]
fn lobes_that_paths_do_not_draw_from_are_missed_too() {
    let sheet = measured([(Side::Front, ScatteringMode::Transmission, lobes(0.03, 16))]);
    let mut scene = empty();
    let corner = DVec3::new(-1.0, 1.0, -1.0);
    add_panel(&mut scene, corner, DVec3::X * 2.0, DVec3::Z * 2.0, sheet);
    scene.lights.push(point_light(DVec3::new(0.1, 0.0, 0.2), INTENSITY_CD));
    scene.sensors.push(points("behind", &[(DVec3::Y * 3.0, DVec3::NEG_Y)]));
    let few = run(&scene, 128);
    assert!(is_told(&few) && few.point_intervals(0)[0].half_width.is_none());
}

/// Broad lobes, and narrow ones that bring next to nothing, keep nobody waiting.
#[test]
fn lobes_that_do_not_matter_hide_nothing() {
    let mut dotted = ceiling(diffuse(0.8));
    let corner = DVec3::new(0.5, 0.5, CEILING_M - 0.01);
    add_panel(&mut dotted, corner, DVec3::Y * 0.01, DVec3::X * 0.01, metal(0.01));
    let scenes =
        [("diffuse", ceiling(diffuse(0.8))), ("rough", ceiling(metal(0.5))), ("dotted", dotted)];
    for (name, scene) in scenes {
        let estimates = run(&scene, 128);
        let is_known = estimates.point_intervals(0)[0].half_width.is_some();
        assert!(!is_told(&estimates) && is_known, "{name}: {:?}", estimates.warnings);
    }
}
