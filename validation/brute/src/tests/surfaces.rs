//! What surfaces do with light.

use super::*;
use crate::metal::Metal;

fn even_sky() -> Option<Sky> {
    Some(Sky {
        model: SkyModel::Uniform,
        zenith_luminance_cd_m2: 1000.0,
        ground_luminance_cd_m2: 0.0,
    })
}

/// A horizontal square so wide that its edge is not seen.
fn wide(z: f64, surface: Surface) -> [Triangle; 2] {
    let corners = [[-1e4, -1e4], [1e4, -1e4], [1e4, 1e4], [-1e4, 1e4]];
    quad(corners.map(|[x, y]| DVec3::new(x, y, z)), surface, 0.0)
}

/// What a face reflects of each polarisation, by Fresnel's sines and tangents.
fn face(theta: f64, eta: f64) -> [f64; 2] {
    let behind = libm::asin(libm::sin(theta) / eta);
    let [less, more] = [theta - behind, theta + behind];
    let across = libm::sin(less) / libm::sin(more);
    let within = libm::tan(less) / libm::tan(more);
    [across * across, within * within]
}

/// What two faces let through that reflect r: the sum of all inner reflections.
fn through(r: f64) -> f64 {
    let passes = (1.0 - r) * (1.0 - r);
    (0..60).fold((0.0, passes), |(sum, term), _| (sum + term, term * r * r)).0
}

/// What a pane lets through: the mean of both polarisations.
fn pane_transmittance(theta: f64, eta: f64) -> f64 {
    0.5 * face(theta, eta).map(through).iter().sum::<f64>()
}

/// What a slab lets through whose faces meet unpolarised light each time.
fn slab_transmittance(theta: f64, eta: f64) -> f64 {
    through(0.5 * face(theta, eta).iter().sum::<f64>())
}

/// The mean over diffuse light: the integral of `T sin 2 theta`.
fn diffuse(transmittance: impl Fn(f64) -> f64) -> f64 {
    let steps = 4000;
    let value = |i| {
        let theta = (f64::from(i) + 0.5) / f64::from(steps) * PI / 2.0;
        transmittance(theta) * libm::sin(2.0 * theta)
    };
    (0..steps).map(value).sum::<f64>() * PI / 2.0 / f64::from(steps)
}

#[test]
fn a_lamp_behind_a_pane_is_dimmed_by_its_angle() {
    let theta = libm::atan2(3.0, 4.0);
    let mut scene = Scene { sensors: vec![up(3.0, 0.0, 0.0)], ..Scene::default() };
    scene.lights.push(PointLight {
        position: DVec3::new(0.0, 0.0, 4.0),
        aim: DVec3::NEG_Z,
        candela: Candela::Constant(100.0),
    });
    scene.triangles.extend(wide(1.0, Surface::clear_pane(1.52)));
    let clear_lx = 100.0 * 0.8 / 25.0 * pane_transmittance(theta, 1.52);
    assert!((direct_point_lx(&scene)[0] / clear_lx - 1.0).abs() < 1e-9);
    scene.triangles = wide(1.0, Surface::tinted_pane(1.52, 0.5)).to_vec();
    let clear = pane_transmittance(1e-6, 1.52);
    let tinted_lx = clear_lx * 0.5 / clear;
    assert!((direct_point_lx(&scene)[0] / tinted_lx - 1.0).abs() < 1e-6);
    // Counted on a disc, whose mean is that of its middle to a part in 10^3.
    scene.sensors[0] = Sensor::disc(DVec3::new(3.0, 0.0, 0.0), DVec3::Z, 0.2);
    scene.aims = vec![Lookout::new(DVec3::new(2.8, -0.2, 0.0), DVec3::X * 0.4, DVec3::Y * 0.4)];
    scene.aim_share = 0.9;
    for mode in [Mode::Joins, Mode::Photons] {
        let found = solve_by(&scene, mode, 200_000, 1)[0];
        assert!((found.lx / tinted_lx - 1.0).abs() < 0.01, "{mode:?} {found:?}");
    }
}

/// A pane and a slab of glass with two faces let through what their sums say. The slab forgets the
/// polarisation between its faces, which costs 0.7 % of diffuse light.
#[test]
fn slabs_and_panes_let_the_sky_through() {
    let pane_lx = 1000.0 * PI * diffuse(|theta| pane_transmittance(theta, 1.5));
    let slab_lx = 1000.0 * PI * diffuse(|theta| slab_transmittance(theta, 1.5));
    let mut scene = Scene { sensors: vec![up(0.0, 0.0, 0.0)], sky: even_sky(), ..Scene::default() };
    scene.triangles.extend(wide(1.0, Surface::clear_pane(1.5)));
    assert_near(&solve(&scene, 100_000, 1)[0], pane_lx, 0.01);
    assert_near(&solve_by(&scene, Mode::Joins, 100_000, 1)[0], pane_lx, 0.01);
    scene.triangles.clear();
    // The front of each face is outside of the body.
    scene.triangles.extend(wide(1.2, Surface::Glass { eta: 1.5 }));
    scene.triangles.extend(wide(1.0, Surface::Glass { eta: 1.5 }).map(turned));
    assert_near(&solve(&scene, 100_000, 1)[0], slab_lx, 0.01);
    // One face lets through what it does not reflect, and squeezes it into a cone that is brighter
    // by the square of the index.
    scene.sensors = vec![up(0.0, 0.0, 1.1)];
    scene.triangles.truncate(2);
    let face_lx = 1000.0 * PI * diffuse(|theta| 1.0 - 0.5 * face(theta, 1.5).iter().sum::<f64>());
    assert_near(&solve(&scene, 100_000, 1)[0], face_lx, 0.01);
}

fn turned(mut triangle: Triangle) -> Triangle {
    triangle.corners.swap(1, 2);
    triangle
}

/// The sun through a slab, counted by all that can: its disk is asked for by nobody.
#[test]
fn the_sun_comes_through_a_slab() {
    let altitude = 50.0_f64.to_radians();
    let direction = DVec3::new(libm::cos(altitude), 0.0, libm::sin(altitude));
    let sun = Sun { direction, normal_illuminance_lx: 60_000.0 };
    let mut scene = Scene { sun: Some(sun), ..Scene::default() };
    let size = 3.0;
    let body = cube(size, 0.0, 0.0).triangles.into_iter().map(turned).map(|mut triangle| {
        for corner in &mut triangle.corners {
            *corner = DVec3::new(corner.x - 1.5, corner.y - 1.5, 1.0 + 0.1 * corner.z);
        }
        triangle.surface = Surface::Glass { eta: 1.52 };
        triangle
    });
    scene.triangles.extend(body);
    let corner = DVec3::new(-0.7, -0.2, 0.6);
    scene.sensors = vec![
        Sensor::cell(corner, DVec3::X * 0.4, DVec3::Y * 0.4, DVec3::Z),
        Sensor::point_with_disc(corner, DVec3::Z, 0.2),
    ];
    scene.hints = vec![Lookout::around(direction, 0.005)];
    scene.hint_share = 0.5;
    let theta = PI / 2.0 - altitude;
    let wanted_lx = 60_000.0 * libm::sin(altitude) * slab_transmittance(theta, 1.52);
    for mode in [Mode::Paths, Mode::Joins, Mode::BeamsAndJoins, Mode::Photons] {
        let found = solve_by(&scene, mode, 200_000, 1);
        assert_near(&found[0], wanted_lx, 0.03);
        assert_near(&found[1], wanted_lx, 0.04);
    }
}

#[test]
fn a_sheet_under_the_sky_shines_on_both_sides() {
    let sensors = vec![up(0.0, 0.0, 0.5), Sensor::point(DVec3::new(0.0, 0.0, 1.5), DVec3::NEG_Z)];
    let mut scene = Scene { sensors, sky: even_sky(), ..Scene::default() };
    scene.triangles.extend(wide(1.0, Surface::Sheet { reflectance: 0.3, transmittance: 0.5 }));
    let found = solve(&scene, 100_000, 1);
    assert_near(&found[0], 0.5 * PI * 1000.0, 0.02);
    assert_near(&found[1], 0.3 * PI * 1000.0, 0.02);
}

/// A lamp over a mirror lights a cell once more from its image.
#[test]
fn a_mirror_shows_a_lamp_to_a_cell() {
    let corners = [[-3.0, -4.0], [3.0, -4.0], [3.0, 4.0], [-3.0, 4.0]];
    let mirror = quad(
        corners.map(|[x, y]| DVec3::new(x, y, 0.0)),
        Surface::Mirror { reflectance: 0.7 },
        0.0,
    );
    let mut scene = Scene::default();
    scene.triangles.extend(mirror);
    scene.lights.push(PointLight {
        position: DVec3::new(0.0, 0.0, 0.5),
        aim: DVec3::Z,
        candela: Candela::Constant(50.0),
    });
    // It looks down from a height of 1.5: the lamp is 1 below it, the image 2 below.
    let corner = DVec3::new(-0.2, -0.2, 1.5);
    scene.sensors = vec![Sensor::cell(corner, DVec3::X * 0.4, DVec3::Y * 0.4, DVec3::NEG_Z)];
    let solid_angle_sr = |d: f64| 4.0 * libm::atan2(0.04, d * (0.08 + d * d).sqrt());
    let wanted_lx = 50.0 / 0.16 * (solid_angle_sr(1.0) + 0.7 * solid_angle_sr(2.0));
    for mode in [Mode::Joins, Mode::BeamsAndJoins, Mode::Photons] {
        assert_near(&solve_by(&scene, mode, 400_000, 1)[0], wanted_lx, 0.02);
    }
}

/// Metal whose facets reflect all keeps all light, whatever its roughness: an even sky is seen in
/// it undimmed.
#[test]
fn white_metal_keeps_all_light() {
    for roughness in [0.06, 0.25, 0.5, 1.0] {
        let sensors = vec![Sensor::point(DVec3::new(0.0, 0.0, 1.0), DVec3::NEG_Z)];
        let mut scene = Scene { sensors, sky: even_sky(), ..Scene::default() };
        scene.triangles.extend(wide(0.0, Surface::metal(1.0, roughness)));
        let found = solve(&scene, 200_000, 1)[0];
        assert_near(&found, PI * 1000.0, 0.005);
    }
}

/// Directions of metal have the density that is said, and values are reciprocal.
#[test]
fn metal_is_drawn_by_its_density() {
    for alpha in [0.0625, 0.3, 1.0] {
        let metal = Metal::new(0.6, alpha);
        let n = DVec3::new(0.3, -0.2, 0.9).normalize();
        let wo = DVec3::new(0.9, 0.1, 0.4).normalize();
        let mut random = Xoshiro::new(3, 0);
        let (mut inverse, mut kept) = (0.0, 0.0);
        let samples = 400_000;
        for _ in 0..samples {
            let wi = metal.sample(n, wo, &mut random);
            let pdf = metal.pdf(n, wo, wi);
            if pdf > 0.0 && wi.dot(n) > 0.5 {
                inverse += 1.0 / pdf;
            }
            if pdf > 0.0 {
                kept += metal.value(n, wo, wi) / pdf;
                let there = metal.value(n, wo, wi) / wi.dot(n);
                let back = metal.value(n, wi, wo) / wo.dot(n);
                assert!((there / back - 1.0).abs() < 1e-9);
            }
        }
        // The cap above the cosine 1/2 has pi sr; none of it is seldom drawn at these alphas.
        let solid_angle_sr = inverse / f64::from(samples);
        let kept = kept / f64::from(samples);
        if alpha >= 0.3 {
            assert!((solid_angle_sr / PI - 1.0).abs() < 0.02, "{alpha} {solid_angle_sr}");
        }
        // Facets that reflect most twice or once.
        assert!((0.3..1.0).contains(&kept), "{alpha} {kept}");
    }
    // Heitz's closed case: 1 - log 2 at normal incidence with alpha = 1.
    let once = Metal::new(1.0, 1.0).value(DVec3::Z, DVec3::Z, DVec3::Z);
    assert!(once > 0.0);
    let single = Metal::new(0.5, 1.0).single(1.0);
    assert!((single - (1.0 - libm::log(2.0))).abs() < 1e-4, "{single}");
}
