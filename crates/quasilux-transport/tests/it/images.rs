//! Point-like lights in mirrors, against closed forms: the light of an image is `I cos / d^2` times
//! what the mirrors reflect, d the way over all of them. All surfaces but mirrors are black, so
//! nothing is sampled and values are exact to rounding.

use crate::scenes::{all_walls_emit, diffuse, mirror, point_light, points, room};
use glam::{DMat3, DVec3};
use quasilux_photometry::{LuminousShape, read_ies};
use quasilux_scene::bsdf::{AngularNode, AngularTable, Mirror, Pane};
use quasilux_scene::light::Luminaire;
use quasilux_scene::{Bsdf, Light, Material, Mesh, Rgb, Scene};
use quasilux_transport::{Estimates, EstimatorKind, Settings, simulate};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// An empty scene.
pub(crate) fn empty() -> Scene {
    let mesh = Mesh { objects: vec!["all".into()], ..Mesh::default() };
    Scene { mesh, ..Scene::default() }
}

/// Adds a parallelogram from `corner` along `u` and `v`.
pub(crate) fn add_panel(scene: &mut Scene, corner: DVec3, u: DVec3, v: DVec3, bsdf: Bsdf) {
    let mesh = &mut scene.mesh;
    let first = mesh.positions.len() as u32;
    mesh.positions.extend([corner, corner + u, corner + u + v, corner + v]);
    mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
    mesh.material_of.extend([scene.materials.len() as u32; 2]);
    mesh.object_of.extend([0; 2]);
    scene.materials.push(Material { name: format!("panel {first}"), bsdf });
}

fn run(scene: &Scene, image_depth: Option<u32>) -> Estimates {
    let settings =
        Settings { image_depth, replicates: 2, max_samples: Some(4), ..Settings::default() };
    simulate(scene, &settings, &mut ())
}

fn assert_lx(scene: &Scene, expected_lx: &[f64]) {
    let estimates = run(scene, None);
    let intervals = estimates.point_intervals(0);
    assert_eq!(intervals.len(), expected_lx.len());
    for (interval, expected_lx) in intervals.iter().zip(expected_lx) {
        let error = (interval.value - expected_lx).abs();
        assert!(error <= 1e-6 * expected_lx, "{interval:?}, expected {expected_lx}");
    }
}

/// `I cos / d^2` of a light at `light` for the normal `n` at `place`.
fn from_point_lx(intensity_cd: f64, light: DVec3, place: DVec3, n: DVec3) -> f64 {
    let toward = light - place;
    intensity_cd * n.dot(toward).max(0.0) / (toward.length() * toward.length_squared())
}

fn at(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A mirror of 2 m by 2 m on the floor; sensors look down and lie in its beam, and beside it.
#[test]
fn one_mirror_shows_a_light_within_its_frame() {
    let mut scene = empty();
    add_panel(&mut scene, at(-1., -1., 0.), DVec3::X * 2., DVec3::Y * 2., mirror(0.8));
    let light = at(0.2, 0.1, 2.0);
    scene.lights.push(point_light(light, 1000.0));
    // The light meets the floor half-way to a sensor at its height: x = 1.9 lies beyond the edge
    // from x = 1.8 on.
    let places = [at(-0.7, 0.4, 1.0), at(1.79, 0.1, 2.0), at(1.81, 0.1, 2.0)];
    scene.sensors.push(points("p", &places.map(|place| (place, DVec3::NEG_Z))));
    let image = at(0.2, 0.1, -2.0);
    let seen = |place| 0.8 * from_point_lx(1000.0, image, place, DVec3::NEG_Z);
    assert_lx(&scene, &[seen(places[0]), seen(places[1]), 0.0]);

    // A black screen in the reflected half of the way, then in the other, then off it.
    for (x, hides) in [(-0.5, true), (0.0, true), (0.5, false)] {
        let mut scene = scene.clone();
        add_panel(&mut scene, at(x, -1., 0.2), DVec3::Y * 2., DVec3::Z * 2., diffuse(0.0));
        let shown = run(&scene, None).point_intervals(0)[0].value;
        assert_eq!(shown == 0.0, hides, "{x}: {shown}");
    }
}

/// Mirrors at x = 0 and x = 3 show a light at x = 1 at 6 m + 1 and 6 m - 1, for all whole m; chains
/// that reflect less than 1e-4 count no more.
#[test]
fn two_facing_mirrors_show_a_series() {
    let mut scene = empty();
    for (x, reflectance) in [(0.0, 0.5), (3.0, 0.4)] {
        let corner = at(x, -200., -200.);
        add_panel(&mut scene, corner, DVec3::Y * 400., DVec3::Z * 400., mirror(reflectance));
    }
    scene.lights.push(point_light(at(1., 0., 2.), 500.0));
    let place = at(2.2, 0.5, 0.0);
    scene.sensors.push(points("p", &[(place, DVec3::Z)]));
    let mut expected_lx = 0.0;
    // Of a chain of k mirrors that starts at either.
    for (first, second, starts_left) in [(0.5, 0.4, true), (0.4, 0.5, false)] {
        let (mut x, mut product, mut left) = (1.0, 1.0, starts_left);
        while product >= 1e-4 {
            if product < 1.0 || starts_left {
                expected_lx += product * from_point_lx(500.0, at(x, 0., 2.), place, DVec3::Z);
            }
            product *= if left == starts_left { first } else { second };
            x = if left { -x } else { 6.0 - x };
            left = !left;
        }
    }
    assert_lx(&scene, &[expected_lx]);
}

/// Three mirrors in a corner show seven images of a light anywhere, also where light and sensor are
/// on one diagonal and the ways go through the edges and the corner itself.
#[test]
fn a_corner_shows_seven_images() {
    let places = [at(0.5, 0.6, 0.7), at(0.9, 0.9, 0.9), at(0.8, 0.8, 0.3), at(0.31, 0.2, 0.9)];
    for light in [at(0.3, 0.2, 0.1), at(0.25, 0.25, 0.25), at(0.2, 0.2, 0.7)] {
        let mut scene = empty();
        for (u, v) in [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::Z), (DVec3::Z, DVec3::X)] {
            add_panel(&mut scene, DVec3::ZERO, u * 2., v * 2., mirror(1.0));
        }
        scene.lights.push(point_light(light, 100.0));
        let n = DVec3::NEG_ONE.normalize();
        scene.sensors.push(points("p", &places.map(|place| (place, n))));
        let expected_lx = places.map(|place| {
            let images = (0..8).map(|i: u32| light * sign_of_octant(i));
            images.map(|image| from_point_lx(100.0, image, place, n)).sum::<f64>()
        });
        assert_lx(&scene, &expected_lx);
    }
}

fn sign_of_octant(i: u32) -> DVec3 {
    let sign = |bit: u32| if i >> bit & 1 == 0 { 1.0 } else { -1.0 };
    at(sign(0), sign(1), sign(2))
}

/// The direct light of the sphere octant of Voloboy, Dmitriev and Kopylov (2003), as reconstructed:
/// 83.331125 cd at 0.36510375 m from the centre on the diagonal, R = 1 m. Eight images give 686.598
/// lx at the middle of the sphere's eighth, which is at 3^-1/2 in all coordinates.
#[test]
fn the_octant_has_its_direct_light() {
    let mut scene = empty();
    for (u, v) in [(DVec3::X, DVec3::Y), (DVec3::Y, DVec3::Z), (DVec3::Z, DVec3::X)] {
        add_panel(&mut scene, DVec3::ZERO, u, v, mirror(1.0));
    }
    scene.lights.push(point_light(DVec3::splat(0.210_792_8), 83.331_125));
    let n = DVec3::NEG_ONE.normalize();
    scene.sensors.push(points("p", &[(-n, n)]));
    let (s, i_cd) = (0.365_103_75_f64, 83.331_125);
    let term = |c: f64| (1.0 - s * c) / libm::pow(1.0 + s * s - 2.0 * s * c, 1.5);
    let exact_lx = i_cd * (term(1.) + 3. * term(1. / 3.) + 3. * term(-1. / 3.) + term(-1.));
    assert!((exact_lx - 686.598).abs() < 1e-3, "{exact_lx}");
    assert_lx(&scene, &[exact_lx]);
}

/// A mirror of three channels, and two of them: luminance is the weighted sum of the products.
#[test]
fn mirrors_colour_what_they_show() {
    let colour = [0.9, 0.5, 0.2];
    let coloured = Bsdf::Mirror(Mirror { reflectance: Rgb(colour) });
    let mut scene = empty();
    add_panel(&mut scene, at(-9., -9., 0.), DVec3::X * 18., DVec3::Y * 18., coloured.clone());
    add_panel(&mut scene, at(-9., -9., 0.), DVec3::X * 18., DVec3::Z * 18., coloured);
    // Mirrors at z = 0 and y = -9.
    let light = at(0.3, -8.0, 1.5);
    scene.lights.push(point_light(light, 1000.0));
    let place = at(1.0, -7.0, 1.0);
    scene.sensors.push(points("p", &[(place, DVec3::NEG_Z)]));
    let share = |power: i32| Rgb(colour.map(|c: f64| libm::pow(c, f64::from(power)))).luminance();
    let below = from_point_lx(1000.0, at(0.3, -8.0, -1.5), place, DVec3::NEG_Z);
    let corner = from_point_lx(1000.0, at(0.3, -10.0, -1.5), place, DVec3::NEG_Z);
    assert_lx(&scene, &[share(1) * below + share(2) * corner]);
}

/// A luminaire with no symmetry, in one mirror and over two: the table is read where the light
/// really leaves, which no turned luminaire in the image's place would give.
#[test]
fn luminaires_are_mirrored_not_turned() {
    // Candela at C0, C90, C180, C270 and nadir angles 0, 90, 180 degrees, linear between.
    let text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 5 1 2 0 0 0\n1 1 100\n0 90 180\n\
                0 90 180 270 360\n50 100 20\n50 300 20\n50 700 20\n50 40 20\n50 100 20\n";
    let photometry = read_ies(text.as_bytes()).unwrap().photometry;
    let world_from_luminaire = DMat3::from_cols(
        at(0.36, 0.48, -0.8),
        at(-0.8, 0.6, 0.0),
        at(0.36, 0.48, -0.8).cross(at(-0.8, 0.6, 0.0)),
    );
    let luminaire = Luminaire {
        photometry: Arc::new(photometry),
        position: at(0.4, 0.6, 1.1),
        world_from_luminaire,
        dimming: 1.0,
        shape: LuminousShape::POINT,
    };
    let mut scene = empty();
    add_panel(&mut scene, DVec3::ZERO, DVec3::X * 9., DVec3::Y * 9., mirror(0.9));
    add_panel(&mut scene, DVec3::ZERO, DVec3::Y * 9., DVec3::Z * 9., mirror(0.7));
    let place = at(1.3, 0.8, 0.9);
    scene.sensors.push(points("p", &[(place, DVec3::NEG_X), (place, DVec3::NEG_Z)]));
    let position = luminaire.position;
    let seen = |signs: DVec3, n: DVec3| {
        let image = position * signs;
        // The light leaves toward the place mirrored back.
        let leaves = (place * signs - position).normalize();
        from_point_lx(luminaire.intensity_cd(leaves), image, place, n)
    };
    let expected_lx = [DVec3::NEG_X, DVec3::NEG_Z].map(|n| {
        seen(DVec3::ONE, n)
            + 0.9 * seen(at(1., 1., -1.), n)
            + 0.7 * seen(at(-1., 1., 1.), n)
            + 0.63 * seen(at(-1., 1., -1.), n)
    });
    scene.lights.push(Light::Luminaire(luminaire.clone()));
    assert_lx(&scene, &expected_lx);
}

/// The refractive index of glass.
const ETA: f64 = 1.5;

fn clear_pane() -> Bsdf {
    Bsdf::Pane(Pane::Clear { eta: ETA })
}

/// A clear pane passes `T = (1 - r) / (1 + r)` of each polarisation, r by Fresnel.
fn transmittance(cos: f64) -> f64 {
    let cos_t = (1.0 - (1.0 - cos * cos) / (ETA * ETA)).sqrt();
    let across = (cos - ETA * cos_t) / (cos + ETA * cos_t);
    let within = (ETA * cos - cos_t) / (ETA * cos + cos_t);
    [across, within].map(|r| r * r).map(|r| 0.5 * (1.0 - r) / (1.0 + r)).iter().sum()
}

/// It mirrors the rest.
fn reflectance(cos: f64) -> f64 {
    1.0 - transmittance(cos)
}

/// Two panes and a light on their far side give the straight light through both.
#[test]
fn panes_let_light_through_in_one_line() {
    let mut scene = empty();
    add_panel(&mut scene, at(-9., -9., 1.), DVec3::X * 18., DVec3::Y * 18., clear_pane());
    let (light, place) = (at(0.7, -0.4, 2.0), at(-0.3, 0.2, 0.0));
    scene.lights.push(point_light(light, 1000.0));
    scene.sensors.push(points("p", &[(place, DVec3::Z), (at(-0.3, 0.2, 1.5), DVec3::NEG_Z)]));
    let cos = (light - place).normalize().z;
    let through_lx = transmittance(cos) * from_point_lx(1000.0, light, place, DVec3::Z);
    let image = at(0.7, -0.4, 0.0);
    let above = at(-0.3, 0.2, 1.5);
    let mirrored_lx = reflectance((above - image).normalize().z)
        * from_point_lx(1000.0, image, above, DVec3::NEG_Z);
    assert_lx(&scene, &[through_lx, mirrored_lx]);

    // A second pane across the way: through both, and what goes to and fro between them by images.
    add_panel(&mut scene, at(-9., -9., 0.5), DVec3::X * 18., DVec3::Y * 18., clear_pane());
    let expected_lx: f64 = (0..4)
        .map(|bounces: u32| {
            let image = light + DVec3::Z * f64::from(bounces);
            let cos = (image - place).normalize().z;
            let product = libm::pow(reflectance(cos), f64::from(2 * bounces));
            let passed = transmittance(cos) * transmittance(cos);
            passed * product * from_point_lx(1000.0, image, place, DVec3::Z)
        })
        .sum();
    let value = run(&scene, None).point_intervals(0)[0].value;
    assert!((value / expected_lx - 1.0).abs() < 2e-4, "{value}, expected {expected_lx}");
}

/// A measured pane lets through and mirrors what its tables say, between their angles in a straight
/// line; what it does not mirror at normal incidence it may mirror at others.
#[test]
fn measured_panes_do_as_their_tables_say() {
    let table = |rows: &[[f64; 2]]| {
        let node = |row: &[f64; 2]| {
            // 90 degrees are a right angle to the last bit.
            let theta_rad = if row[0] == 90.0 { FRAC_PI_2 } else { row[0].to_radians() };
            AngularNode { theta_rad, share: row[1] }
        };
        AngularTable::new(rows.iter().map(node).collect()).expect("a table")
    };
    let transmittance = table(&[[0.0, 0.8], [60.0, 0.5], [90.0, 0.0]]);
    let reflectance = table(&[[0.0, 0.0], [60.0, 0.3], [90.0, 1.0]]);
    let pane = Bsdf::Pane(Pane::measured(transmittance, reflectance));
    let mut scene = empty();
    add_panel(&mut scene, at(-9., -9., 1.), DVec3::X * 18., DVec3::Y * 18., pane);
    let (light, below, above) = (at(1.0, 0.0, 2.0), at(-1.0, 0.0, 0.0), at(-1.0, 0.0, 2.0));
    scene.lights.push(point_light(light, 1000.0));
    scene.sensors.push(points("p", &[(below, DVec3::Z), (above, DVec3::NEG_Z)]));
    // Both ways meet the pane at 45 degrees.
    let through_lx = 0.575 * from_point_lx(1000.0, light, below, DVec3::Z);
    let mirrored_lx = 0.225 * from_point_lx(1000.0, at(1.0, 0.0, 0.0), above, DVec3::NEG_Z);
    assert_lx(&scene, &[through_lx, mirrored_lx]);
}

/// The sides of a measured pane mirror each as its table says: as images show it, and as paths find
/// it.
#[test]
fn sides_of_a_pane_mirror_differently() {
    let table = |share: f64| AngularTable::constant(share);
    let (t, front, back) = (0.3, 0.6, 0.1);
    let pane = Bsdf::Pane(Pane::Measured {
        transmittance: table(t),
        front_reflectance: table(front),
        back_reflectance: table(back),
    });
    // Its front looks up.
    let mut scene = empty();
    add_panel(&mut scene, at(-9., -9., 1.), DVec3::X * 18., DVec3::Y * 18., pane.clone());
    for up in [1.0, -1.0] {
        let mut scene = scene.clone();
        let (light, place) = (at(1.0, 0.0, 1.0 + up), at(-1.0, 0.0, 1.0 + up));
        scene.lights.push(point_light(light, 1000.0));
        let n = DVec3::Z * -up;
        scene.sensors.push(points("p", &[(place, n)]));
        let share = if up > 0.0 { front } else { back };
        let image = at(1.0, 0.0, 1.0 - up);
        assert_lx(&scene, &[share * from_point_lx(1000.0, image, place, n)]);
    }
    // In a room of even luminance: what is let through and what is mirrored, close to the pane.
    let mut scene = room(DVec3::splat(4.0), diffuse(0.0));
    all_walls_emit(&mut scene, 100.0);
    add_panel(&mut scene, at(0.1, 0.1, 2.0), DVec3::X * 3.8, DVec3::Y * 3.8, pane);
    let [above, below] = [0.005, -0.005].map(|up| at(2.0, 2.0, 2.0 + up));
    scene.sensors.push(points("p", &[(above, DVec3::NEG_Z), (below, DVec3::Z)]));
    for estimator in [EstimatorKind::Path, EstimatorKind::Auto] {
        let max_samples = Some(1024);
        let settings = Settings { estimator, rel_tol: 0.01, max_samples, ..Settings::default() };
        let found = simulate(&scene, &settings, &mut ()).point_intervals(0);
        for (interval, share) in found.iter().zip([t + front, t + back]) {
            let expected_lx = share * 100.0 * std::f64::consts::PI;
            let off = (interval.value / expected_lx - 1.0).abs();
            assert!(off < 0.03, "{estimator:?}: {interval:?}, expected {expected_lx}");
        }
    }
}

/// Between two panes light that grazes them goes far: what is seldom reflected at normal incidence
/// counts there. After k reflections it comes from k m beside the light; the fifth is more than 1 %
/// of the straight light.
#[test]
fn panes_lead_grazing_light() {
    let mut scene = empty();
    for x in [-0.5, 0.5] {
        let corner = at(x, -200., -200.);
        add_panel(&mut scene, corner, DVec3::Y * 400., DVec3::Z * 400., clear_pane());
    }
    scene.lights.push(point_light(DVec3::ZERO, 1e4));
    let place = at(0.0, 20.0, 0.0);
    scene.sensors.push(points("p", &[(place, DVec3::NEG_Y)]));
    let from_image_lx = |beside: f64| from_point_lx(1e4, at(beside, 0., 0.), place, DVec3::NEG_Y);
    let of_chains_lx = |count: u32| {
        let beside = f64::from(count);
        let product = libm::pow(reflectance(beside / libm::hypot(beside, 20.0)), beside);
        2.0 * product * from_image_lx(beside)
    };
    assert!(of_chains_lx(5) > 0.01 * from_image_lx(0.0));
    let expected_lx = from_image_lx(0.0) + (1..40).map(of_chains_lx).sum::<f64>();
    let value = run(&scene, None).point_intervals(0)[0].value;
    assert!((value / expected_lx - 1.0).abs() < 2e-4, "{value}, expected {expected_lx}");
}
