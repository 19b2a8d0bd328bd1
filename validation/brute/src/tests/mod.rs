//! Against closed forms.

mod modes;
mod sources;
mod surfaces;

use super::*;
use glam::DVec3;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

fn quad(corners: [DVec3; 4], surface: Surface, luminance_cd_m2: f64) -> [Triangle; 2] {
    let [a, b, c, d] = corners;
    [[a, b, c], [a, c, d]].map(|corners| Triangle { corners, surface, luminance_cd_m2 })
}

fn grey(reflectance: f64) -> Surface {
    Surface::grey(reflectance)
}

/// A cube from the origin, its normals inward.
fn cube(size_m: f64, reflectance: f64, luminance_cd_m2: f64) -> Scene {
    let sides: [[u32; 4]; 6] =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 2, 6, 4], [1, 5, 7, 3], [0, 4, 5, 1], [2, 3, 7, 6]];
    let corner = |number: u32| {
        let axis = |bit: u32| f64::from(number >> bit & 1) * size_m;
        DVec3::new(axis(0), axis(1), axis(2))
    };
    let side = |side: [u32; 4]| quad(side.map(corner), grey(reflectance), luminance_cd_m2);
    Scene { triangles: sides.into_iter().flat_map(side).collect(), ..Scene::default() }
}

/// A square of half side 1 at a height of 1 that shines down.
fn square(luminance_cd_m2: f64) -> [Triangle; 2] {
    let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
    quad(corners.map(|[x, y]| DVec3::new(x, y, 1.0)), grey(0.0), luminance_cd_m2)
}

/// Configuration factor of such a square from below its middle (Howell's catalogue, B-3).
fn factor() -> f64 {
    4.0 / PI * FRAC_1_SQRT_2 * libm::atan(FRAC_1_SQRT_2)
}

fn up(x: f64, y: f64, z: f64) -> Sensor {
    Sensor::point(DVec3::new(x, y, z), DVec3::Z)
}

/// Seed 1; 5 standard errors, which chance exceeds once in a million.
fn assert_near(found: &Estimate, wanted_lx: f64, most_relative: f64) {
    let error = found.standard_error_lx;
    assert!(error <= most_relative * found.lx, "{found:?} is not known well enough");
    assert!((found.lx - wanted_lx).abs() <= 5.0 * error + 1e-9 * wanted_lx, "{found:?}");
}

#[test]
fn an_area_light_is_that_of_lambert() {
    let mut scene = Scene { sensors: vec![up(0.0, 0.0, 0.0)], ..Scene::default() };
    scene.triangles.extend(square(100.0));
    assert_near(&solve(&scene, 20_000, 1)[0], 100.0 * PI * factor(), 0.01);
    scene.sensors[0].normal = DVec3::NEG_Z;
    assert_eq!(solve(&scene, 1000, 1)[0].lx, 0.0);
}

#[test]
fn a_furnace_is_filled_evenly() {
    let mut scene = cube(2.0, 0.8, 10.0);
    scene.sensors = vec![up(0.3, 0.9, 0.4)];
    assert_near(&solve(&scene, 20_000, 1)[0], PI * 10.0 / 0.2, 0.02);
}

#[test]
fn a_point_light_falls_off_with_the_square() {
    let mut scene = Scene { sensors: vec![up(3.0, 0.0, 0.0)], ..Scene::default() };
    let rows = [[0.0, 500.0], [90.0, 100.0], [180.0, 0.0]];
    let rows = rows.map(|[gamma_deg, intensity_cd]: [f64; 2]| CandelaRow {
        gamma_rad: gamma_deg.to_radians(),
        intensity_cd,
    });
    let position = DVec3::new(0.0, 0.0, 4.0);
    scene.lights.push(PointLight {
        position,
        aim: DVec3::NEG_Z,
        candela: Candela::Table(rows.into()),
    });
    let gamma_deg = libm::atan2(3.0, 4.0).to_degrees();
    let intensity_cd = 500.0 - gamma_deg / 90.0 * 400.0;
    let wanted_lx = intensity_cd * 0.8 / 25.0;
    assert!((direct_point_lx(&scene)[0] - wanted_lx).abs() < 1e-9);
    scene.lights[0].candela = Candela::Cone { intensity_cd: 100.0, half_angle_rad: 0.6 };
    assert_eq!(direct_point_lx(&scene)[0], 0.0);
    scene.lights[0].candela = Candela::Cosine(100.0);
    assert!((direct_point_lx(&scene)[0] - 80.0 * 0.8 / 25.0).abs() < 1e-9);
}

/// A lamp in the middle of a cube: all walls together get its flux over 1 - reflectance.
#[test]
fn a_lamp_in_a_cube_gives_what_its_flux_says() {
    let mut scene = cube(1.0, 0.5, 0.0);
    let candela = Candela::Constant(10.0);
    scene.lights.push(PointLight { position: DVec3::splat(0.5), aim: DVec3::X, candela });
    let mut random = Xoshiro::new(3, 0);
    let place = |_| up(random.uniform(), random.uniform(), 0.0);
    scene.sensors = (0..4000).map(place).collect();
    let found = solve(&scene, 64, 1);
    let mean = found.iter().map(|found| found.lx).sum::<f64>() / 4000.0;
    let wanted_lx = 4.0 * PI * 10.0 / 6.0 / 0.5;
    assert!((mean / wanted_lx - 1.0).abs() < 0.01, "{mean} is not {wanted_lx}");
}

#[test]
fn a_mirror_shows_a_second_light_with_hints_and_without() {
    let mut scene = Scene { sensors: vec![up(0.0, 0.0, 0.0)], ..Scene::default() };
    scene.triangles.extend(square(100.0));
    let corners = [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]];
    let mirror = Surface::Mirror { reflectance: 0.5 };
    let wall = corners.map(|[y, z]| DVec3::new(-1.0, y, z));
    scene.triangles.extend(quad(wall, mirror, 0.0));
    // The image stands beside the light.
    let image_lx = rectangle_lx([[-3.0, -1.0], [-1.0, 1.0]]);
    let wanted_lx = 100.0 * PI * factor() + 0.5 * 100.0 * image_lx;
    let plain = solve(&scene, 40_000, 1)[0];
    assert_near(&plain, wanted_lx, 0.01);
    let corner = DVec3::new(-3.0, -1.0, 1.0);
    scene.hints.push(Lookout::new(corner, DVec3::X * 2.0, DVec3::Y * 2.0));
    (scene.hint_share, scene.late_hint_share) = (0.5, 0.1);
    let hinted = solve(&scene, 40_000, 1)[0];
    assert_near(&hinted, wanted_lx, 0.01);
}

/// Of unit luminance at a height of 1, from the origin: a midpoint sum of cos^4 over x and y.
fn rectangle_lx([[x0, x1], [y0, y1]]: [[f64; 2]; 2]) -> f64 {
    let steps = 400;
    let at = |low: f64, high: f64, i: u32| low + (high - low) * (f64::from(i) + 0.5) / 400.0;
    let cell = (x1 - x0) * (y1 - y0) / f64::from(steps * steps);
    let row = |i| {
        let x = at(x0, x1, i);
        let value = |j| {
            let y = at(y0, y1, j);
            let square = 1.0 + x * x + y * y;
            cell / (square * square)
        };
        (0..steps).map(value).sum::<f64>()
    };
    (0..steps).map(row).sum()
}

/// Hints to nowhere, to a wall, through each other: the furnace stays as it is.
#[test]
fn hints_do_not_change_the_mean() {
    let mut scene = cube(2.0, 0.5, 10.0);
    scene.sensors = vec![up(0.3, 0.9, 0.4)];
    scene.hints = vec![
        Lookout::new(DVec3::new(0.5, 0.5, 1.5), DVec3::X, DVec3::Y * 0.2),
        Lookout::new(DVec3::new(0.4, 0.4, 1.0), DVec3::X, DVec3::new(0.0, 0.3, 0.4)),
        Lookout::new(DVec3::new(2.0, 0.0, 0.0), DVec3::Y * 2.0, DVec3::Z),
    ];
    (scene.hint_share, scene.late_hint_share) = (0.6, 0.3);
    assert_near(&solve(&scene, 60_000, 1)[0], PI * 10.0 / 0.5, 0.02);
}

#[test]
fn a_run_goes_on_until_it_is_told_to_stop() {
    let mut scene = cube(2.0, 0.5, 10.0);
    scene.sensors = vec![up(0.3, 0.9, 0.4)];
    let limits = Limits { relative_error: 0.02, paths: 1 << 20 };
    let found = solve_until(&scene, limits, 1, || true)[0];
    assert!(found.standard_error_lx <= 0.02 * found.lx);
    let first = solve_until(&scene, Limits { relative_error: 0.0, ..limits }, 1, || false)[0];
    assert_eq!(first.paths, 4096);
}
