//! Point lamps over surfaces with narrow lobes, which paths from the sensors hardly ever meet.

use crate::images::{add_panel, empty};
use crate::scenes::{point_light, points};
use glam::DVec3;
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
    let (estimator, max_samples) = (EstimatorKind::Bidirectional, Some(samples));
    let settings = Settings { estimator, rel_tol: 0.02, max_samples, ..Settings::default() };
    simulate(scene, &settings, &mut ())
}

/// The lobe of a nearly perfect mirror is bright on a spot of the ceiling that few paths meet: what
/// is said of the value holds whether they did or not, from the start.
#[test]
fn what_few_paths_meet_is_within_both_numbers() {
    let bsdf = metal(0.03);
    let expected_lx = expected_lx(&bsdf);
    let scene = ceiling(bsdf);
    for samples in [16, 128, 1 << 12] {
        let estimates = run(&scene, samples);
        let unseen_lx = estimates.sensors[0].unseen.as_ref().expect("a bound").point_lx[0];
        let known = estimates.point_intervals(0)[0];
        let half_width_lx = 1.5 * known.half_width.expect("an interval");
        let found = format!("{known:?}, unseen {unseen_lx}, expected {expected_lx}");
        assert!(known.value - half_width_lx < expected_lx, "{samples}: {found}");
        assert!(known.value + half_width_lx + unseen_lx > expected_lx, "{samples}: {found}");
        assert!(samples < 1024 || unseen_lx < 0.2 * expected_lx, "{samples}: {found}");
    }
}
