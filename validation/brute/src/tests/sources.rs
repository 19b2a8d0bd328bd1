//! What lights, sky and sun give without any surface.

use super::*;
use crate::emission::Emission;

const EVERYWHERE: [Mode; 4] = [Mode::Paths, Mode::Joins, Mode::BeamsAndJoins, Mode::Photons];

fn lamp(position: DVec3, candela: Candela) -> PointLight {
    PointLight { position, aim: DVec3::NEG_Z, candela }
}

/// The solid angle of a rectangle across from a place at distance `d` (Khadjavi 1968), from
/// `[x0, x1] x [y0, y1]` about its foot.
fn solid_angle_sr([[x0, x1], [y0, y1]]: [[f64; 2]; 2], d: f64) -> f64 {
    let corner = |x: f64, y: f64| libm::atan2(x * y, d * (x * x + y * y + d * d).sqrt());
    corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)
}

fn cell([x0, y0]: [f64; 2], [x1, y1]: [f64; 2], z: f64) -> Sensor {
    let corner = DVec3::new(x0, y0, z);
    Sensor::cell(corner, DVec3::X * (x1 - x0), DVec3::Y * (y1 - y0), DVec3::Z)
}

#[test]
fn a_lamp_on_a_cell_gives_its_solid_angle() {
    let mut scene = Scene::default();
    scene.lights.push(lamp(DVec3::new(0.0, 0.0, 2.0), Candela::Constant(80.0)));
    scene.sensors = vec![cell([0.5, -0.3], [1.5, 0.9], 0.5)];
    let wanted_lx = 80.0 * solid_angle_sr([[0.5, 1.5], [-0.3, 0.9]], 1.5) / 1.2;
    for mode in EVERYWHERE {
        assert_near(&solve_by(&scene, mode, 400_000, 1)[0], wanted_lx, 0.01);
    }
}

/// On a disc of radius r, an even lamp at the height d gives `2 pi (1 - cos)` of its intensity.
#[test]
fn a_lamp_on_a_disc_gives_its_solid_angle() {
    let mut scene = Scene::default();
    scene.lights.push(lamp(DVec3::new(0.0, 0.0, 0.4), Candela::Constant(80.0)));
    scene.sensors = vec![Sensor::disc(DVec3::ZERO, DVec3::Z, 0.3)];
    let wanted_lx = 80.0 * 2.0 * PI * (1.0 - 0.8) / (PI * 0.09);
    for mode in EVERYWHERE {
        assert_near(&solve_by(&scene, mode, 100_000, 1)[0], wanted_lx, 0.01);
    }
    // Aimed at, nearly all walks are counted.
    scene.aims = vec![Lookout::new(DVec3::new(-0.3, -0.3, 0.0), DVec3::X * 0.6, DVec3::Y * 0.6)];
    scene.aim_share = 0.8;
    assert_near(&solve_by(&scene, Mode::Photons, 100_000, 1)[0], wanted_lx, 0.003);
}

/// A beam of 0.1 degrees that ends on a cell gives its flux over the area.
#[test]
fn a_narrow_beam_on_a_cell_gives_its_flux() {
    let row = |gamma_deg: f64, intensity_cd| CandelaRow {
        gamma_rad: gamma_deg.to_radians(),
        intensity_cd,
    };
    let table = vec![row(0.0, 1e5), row(0.05, 1e5), row(0.1, 0.0), row(90.0, 0.0)];
    // Of the slope, by parts: 2 pi I (cos g0 - (sin g1 - sin g0) / (g1 - g0)), less 2 pi I cos g0.
    let [g0, g1] = [0.05_f64, 0.1].map(f64::to_radians);
    let flux_lm = 2.0 * PI * 1e5 * (1.0 - (libm::sin(g1) - libm::sin(g0)) / (g1 - g0));
    let light = lamp(DVec3::new(0.2, 0.1, 3.0), Candela::Table(table));
    let emitted_lm = Emission::new(&light).flux_lm;
    assert!((emitted_lm / flux_lm - 1.0).abs() < 0.003, "{emitted_lm} {flux_lm}");
    let scene = Scene {
        lights: vec![light],
        sensors: vec![cell([-0.5, -0.5], [0.5, 0.5], 0.0)],
        ..Scene::default()
    };
    for mode in [Mode::BeamsAndJoins, Mode::Photons] {
        assert_near(&solve_by(&scene, mode, 100_000, 1)[0], flux_lm, 0.003);
    }
}

#[test]
fn the_sun_gives_the_sine_of_its_altitude() {
    let altitude = 35.0_f64.to_radians();
    let direction = DVec3::new(0.0, -libm::cos(altitude), libm::sin(altitude));
    let sensors = vec![
        cell([-0.5, -0.5], [0.5, 0.5], 0.0),
        up(0.1, 0.2, 0.0),
        Sensor::disc(DVec3::ZERO, direction, 0.4),
    ];
    let sun = Some(Sun { direction, normal_illuminance_lx: 60_000.0 });
    let scene = Scene { sensors, sun, ..Scene::default() };
    // Sine of the altitude, but for the curvature of the disk: a part in 10^5.
    for mode in EVERYWHERE {
        let found = solve_by(&scene, mode, 200_000, 1);
        assert_near(&found[0], 60_000.0 * libm::sin(altitude), 0.01);
        assert_near(&found[2], 60_000.0, 0.01);
        if mode != Mode::Photons {
            assert_near(&found[1], 60_000.0 * libm::sin(altitude), 0.01);
        }
    }
    assert!((Sun::solid_angle_sr() / 6.796_7e-5 - 1.0).abs() < 1e-4);
}

/// Open horizon: pi L of an even sky, 7/9 of it of an overcast one; from below, the ground.
#[test]
fn skies_give_what_their_integrals_say() {
    let sensors = vec![
        up(0.0, 0.0, 0.0),
        cell([0.0, 0.0], [1.0, 1.0], 0.0),
        Sensor::point(DVec3::ZERO, DVec3::NEG_Z),
    ];
    let mut scene = Scene { sensors, ..Scene::default() };
    let models = [(SkyModel::Uniform, 1.0), (SkyModel::Overcast, 7.0 / 9.0)];
    for (model, share) in models {
        let sky = Sky { model, zenith_luminance_cd_m2: 2000.0, ground_luminance_cd_m2: 0.0 };
        let wanted_lx = PI * 2000.0 * share;
        assert!((sky.horizontal_illuminance_lx() / wanted_lx - 1.0).abs() < 1e-6);
        let sky = sky.over_ground(0.2, None);
        scene.sky = Some(sky);
        for mode in EVERYWHERE {
            let found = solve_by(&scene, mode, 100_000, 1);
            assert_near(&found[1], wanted_lx, 0.03);
            if mode != Mode::Photons {
                assert_near(&found[0], wanted_lx, 0.01);
                assert_near(&found[2], 0.2 * wanted_lx, 0.01);
            }
        }
    }
}

/// 40 cm square seen by the sky alone through a hole in a black roof: two openings that lines can
/// cross one after the other count once.
#[test]
fn walks_through_openings_are_those_of_the_whole_sky() {
    let roof = |x0: f64, x1: f64, y0: f64, y1: f64| {
        let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
        quad(corners.map(|[x, y]| DVec3::new(x, y, 1.0)), grey(0.0), 0.0)
    };
    let far = 50.0;
    let mut scene = Scene { sensors: vec![cell([0.0, 0.0], [0.4, 0.4], 0.0)], ..Scene::default() };
    scene.triangles.extend(roof(-far, 0.0, -far, far));
    scene.triangles.extend(roof(0.5, far, -far, far));
    scene.triangles.extend(roof(0.0, 0.5, -far, 0.0));
    scene.triangles.extend(roof(0.0, 0.5, 0.5, far));
    let sky = Sky {
        model: SkyModel::Overcast,
        zenith_luminance_cd_m2: 3000.0,
        ground_luminance_cd_m2: 500.0,
    };
    scene.sky = Some(sky);
    let altitude = 80.0_f64.to_radians();
    let direction = DVec3::new(libm::cos(altitude), 0.0, libm::sin(altitude));
    scene.sun = Some(Sun { direction, normal_illuminance_lx: 1000.0 });
    let hole = Lookout::new(DVec3::new(0.0, 0.0, 1.0), DVec3::X * 0.5, DVec3::Y * 0.5);
    scene.hints = vec![hole];
    scene.hint_share = 0.9;
    let paths = solve(&scene, 200_000, 1);
    let above = Lookout::new(DVec3::new(-0.2, -0.2, 1.3), DVec3::X * 0.6, DVec3::Y * 0.6);
    scene.openings = vec![hole, above];
    for mode in [Mode::Joins, Mode::BeamsAndJoins, Mode::Photons] {
        let walks = solve_by(&scene, mode, 400_000, 1);
        assert!(walks[0].standard_error_lx < 0.01 * walks[0].lx, "{walks:?}");
        assert!(largest_disagreement(&paths, &walks) < 5.0, "{mode:?} {paths:?} {walks:?}");
    }
    // 23 cm of shade at the side of the sun, out of 40.
    let shade = libm::tan(PI / 2.0 - altitude);
    scene.sky = None;
    let wanted_lx = 1000.0 * libm::sin(altitude) * (0.5 - shade).min(0.4) / 0.4;
    let found = solve_by(&scene, Mode::Photons, 400_000, 1)[0];
    assert!((found.lx / wanted_lx - 1.0).abs() < 0.01, "{found:?} {wanted_lx}");
}
