//! Area lights all around sensor points, all else black: the sum of closed forms for polygons. Few
//! facets are weighed, many drawn by tables; some are very near, some partly behind.

use crate::images::{add_panel, empty};
use crate::mirrored_area_lights::{Dice, Panel, add_light, assert_lx, polygon_lx};
use crate::scenes::{diffuse, level_grid, points, room};
use glam::DVec3;
use quasilux_scene::bsdf::Translucent;
use quasilux_scene::light::AreaLight;
use quasilux_scene::{Bsdf, Light, Rgb};
use quasilux_transport::{EstimatorKind, Settings, simulate};

/// The part of a polygon that is before the side `n` of a place.
fn before(corners: &[DVec3], place: DVec3, n: DVec3) -> Vec<DVec3> {
    let height = |corner: DVec3| n.dot(corner - place);
    let mut kept = Vec::new();
    for (number, a) in corners.iter().enumerate() {
        let b = corners[(number + 1) % corners.len()];
        let (at_a, at_b) = (height(*a), height(b));
        if at_a >= 0.0 {
            kept.push(*a);
        }
        if at_a * at_b < 0.0 {
            kept.push(*a + (b - *a) * (at_a / (at_a - at_b)));
        }
    }
    kept
}

/// Panels that touch a ball of 2 m from outside, none before another, and look into it.
fn panels(dice: &mut Dice, count: usize) -> Vec<Panel> {
    let mut centres: Vec<DVec3> = Vec::new();
    while centres.len() < count {
        let centre = dice.point(DVec3::splat(-1.0), DVec3::ONE).normalize();
        if centres.iter().all(|other| centre.angle_between(*other) > 0.35) {
            centres.push(centre);
        }
    }
    let panel = |centre: DVec3| {
        let (a, b) = centre.any_orthonormal_pair();
        let edge = |axis: DVec3, dice: &mut Dice| axis * libm::exp(dice.between(-4.0, -0.7));
        let (u, v) = (edge(b, dice), edge(a, dice));
        Panel { corner: 2.0 * centre - 0.5 * (u + v), u, v }
    };
    centres.into_iter().map(panel).collect()
}

#[test]
fn light_of_panels_adds_up() {
    for (seed, count) in [(0, 1), (1, 2), (2, 7), (3, 8), (4, 40), (5, 3), (6, 60), (7, 5)] {
        let mut dice = Dice(70 + seed);
        let panels = panels(&mut dice, count);
        let mut scene = empty();
        for Panel { corner, u, v } in &panels {
            add_light(&mut scene, Panel { corner: *corner, u: *u, v: *v });
        }
        // One place a centimetre before the first panel, others anywhere.
        let Panel { corner, u, v } = &panels[0];
        let inward = u.cross(*v).normalize();
        let near = (*corner + 0.4 * *u + 0.7 * *v + 0.01 * inward, -inward);
        let mut anywhere = || {
            let toward = *corner + 0.5 * (*u + *v);
            let place = dice.point(DVec3::splat(-0.8), DVec3::splat(0.8));
            let tilt = dice.point(DVec3::splat(-0.9), DVec3::splat(0.9));
            (place, ((toward - place).normalize() + tilt).normalize())
        };
        let places = [near, anywhere(), anywhere(), anywhere()];
        let expected_lx: Vec<f64> = places
            .iter()
            .map(|(place, n)| {
                let of_panel = |Panel { corner, u, v }: &Panel| {
                    let corners = [*corner, *corner + *u, *corner + *u + *v, *corner + *v];
                    let seen = before(&corners, *place, *n);
                    if seen.len() < 3 { 0.0 } else { polygon_lx(&seen, *place, *n) }
                };
                panels.iter().map(of_panel).sum()
            })
            .collect();
        scene.sensors.push(points("probes", &places));
        assert_lx(&scene, seed, &expected_lx);
    }
}

/// Opal panels that shine from one side and let light through: what lies on one side of a panel is
/// before it, however near, but a panel does not light itself. One is weighed, nine are drawn by
/// tables; against photons, which ask nobody.
#[test]
fn opal_panels_do_not_light_themselves() {
    for (seed, count) in [(0, 1), (1, 9)] {
        let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(0.5));
        for number in 0..count {
            let corner = DVec3::new(0.3 + 0.4 * f64::from(number), 0.5, 1.6);
            let (u, v) = (DVec3::new(0.0, 2.0, 0.2), DVec3::new(0.35, 0.0, 0.1));
            let share = Rgb::grey(0.45);
            let sheet = Translucent { reflectance: share, transmittance: share };
            let first = scene.mesh.triangles.len() as u32;
            add_panel(&mut scene, corner, u, v, Bsdf::Translucent(sheet));
            scene.lights.push(Light::Area(AreaLight {
                material: scene.mesh.material_of[first as usize],
                triangles: vec![first, first + 1],
                area_m2: u.cross(v).length(),
                luminance_cd_m2: 1000.0,
            }));
        }
        scene.sensors.push(level_grid(DVec3::new(0.5, 0.5, 0.7), [3.0, 2.0], [2, 2]));
        scene.sensors.push(level_grid(DVec3::new(0.5, 0.5, 2.2), [3.0, 2.0], [2, 2]));
        let settings = Settings { rel_tol: 0.01, seed, ..Settings::default() };
        let by = |estimator| simulate(&scene, &Settings { estimator, ..settings.clone() }, &mut ());
        let photons = by(EstimatorKind::Photon);
        for (what, other) in
            [("paths", by(EstimatorKind::Path)), ("both ways", by(EstimatorKind::Bidirectional))]
        {
            for sensor in 0..2 {
                let pairs = photons.point_intervals(sensor);
                for (a, b) in pairs.iter().zip(other.point_intervals(sensor)) {
                    let allowed = 1.5 * (a.half_width.unwrap() + b.half_width.unwrap());
                    assert!((a.value - b.value).abs() < allowed, "{count}, {what}: {a:?} {b:?}");
                }
            }
        }
    }
}
