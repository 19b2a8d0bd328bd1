//! Luminaires that shine from their luminous shape, against closed forms and plain sums.
//!
//! Where a reference is given, a value may be off by 1.5 half-widths of its 95 % interval and the
//! stated share: a right program fails once in some 200 such comparisons at most (16 replicates),
//! and seeds are fixed. Half-widths are below 0.2 %, so an error of 0.5 % is found nearly always;
//! in the deep variant below 0.05 %, and an error of 0.15 % is.

use crate::scenes::{diffuse, points, room};
use glam::{DMat3, DVec3};
use quasilux_photometry::{Axis, LuminousShape, Solid, read_ies};
use quasilux_scene::light::{Luminaire, Placement};
use quasilux_scene::{Grid, Light, Quantity, Scene, Sensor, SensorShape};
use quasilux_stats::deep;
use quasilux_transport::{Caveat, Estimates, EstimatorKind, Settings, simulate};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

const NADIR_CD: f64 = 1000.0;

/// How the intensity depends on the angle from nadir.
#[derive(Clone, Copy)]
enum Beam {
    /// The cosine, in steps of 1 degree: chords err by up to 3.8e-5.
    Lambertian,
    Isotropic,
}

fn luminaire(beam: Beam, shape: LuminousShape, position: DVec3) -> Luminaire {
    let (angles, values): (Vec<String>, Vec<String>) = (0..=180)
        .map(|degrees| {
            let cosine = libm::cos(f64::from(degrees).to_radians()).max(0.0);
            let cosine = if degrees == 90 { 0.0 } else { cosine };
            let candela = match beam {
                Beam::Lambertian => NADIR_CD * cosine,
                Beam::Isotropic => NADIR_CD,
            };
            (degrees.to_string(), candela.to_string())
        })
        .unzip();
    let text = format!(
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 181 1 1 2 0 0 0\n1 1 1\n{}\n0\n{}\n",
        angles.join(" "),
        values.join(" ")
    );
    Luminaire {
        photometry: Arc::new(read_ies(text.as_bytes()).unwrap().photometry),
        position,
        world_from_luminaire: DMat3::IDENTITY,
        dimming: 1.0,
        shape,
    }
}

fn rectangle(x: f64, y: f64) -> LuminousShape {
    LuminousShape::new(Solid::Cuboid, DVec3::new(x, y, 0.0))
}

fn disk(diameter: f64) -> LuminousShape {
    LuminousShape::new(Solid::Cylinder(Axis::Z), DVec3::new(diameter, diameter, 0.0))
}

/// One of each kind, about `size` m large.
fn shapes(size: f64) -> Vec<LuminousShape> {
    let extents = DVec3::new(1.0, 0.6, 0.3) * size;
    let flat = DVec3::new(1.0, 0.6, 0.0) * size;
    let mut shapes = vec![
        LuminousShape::new(Solid::Cuboid, DVec3::X * size),
        LuminousShape::new(Solid::Cuboid, flat),
        LuminousShape::new(Solid::Cylinder(Axis::Z), flat),
        LuminousShape::new(Solid::Cuboid, extents),
        LuminousShape::new(Solid::Ellipsoid, extents),
    ];
    shapes.extend(
        [Axis::X, Axis::Y, Axis::Z].map(|a| LuminousShape::new(Solid::Cylinder(a), extents)),
    );
    shapes
}

/// A large black room around the origin of the luminaire, which is at (50, 50, 50).
fn in_the_dark(luminaire: Luminaire, sensors: &[(DVec3, DVec3)]) -> Scene {
    let mut scene = room(DVec3::splat(100.0), diffuse(0.0));
    scene.lights.push(Light::Luminaire(luminaire));
    scene.sensors.push(points("points", sensors));
    scene
}

const CENTRE: DVec3 = DVec3::splat(50.0);

fn assert_direct(scene: &Scene, wanted_lx: &[f64], share: f64, what: &str) {
    let rel_tol = if deep() { 5e-4 } else { 2e-3 };
    let settings = Settings { rel_tol, max_bounces: Some(0), ..Settings::default() };
    let estimates = simulate(scene, &settings, &mut ());
    assert!(estimates.tolerance_reached && estimates.invalid_contributions == 0, "{what}");
    for (i, (found, wanted)) in estimates.point_intervals(0).iter().zip(wanted_lx).enumerate() {
        let allowed = 1.5 * found.half_width.unwrap() + share * wanted;
        let text = format!("{what}, point {i}: {found:?}, wanted {wanted}");
        assert!((found.value - wanted).abs() <= allowed, "{text}");
        let direct_lx = estimates.sensors[0].direct_lx[i];
        assert!((direct_lx / found.value - 1.0).abs() < 1e-12, "{text}");
    }
}

/// E = pi L r^2 / (r^2 + d^2) under the centre, with L = I / (pi r^2).
#[test]
fn a_lambertian_disk_is_a_disk_of_equal_luminance() {
    let radius_m = 0.25;
    let distances = [0.1, 0.25, 0.5, 2.0];
    let sensors: Vec<_> = distances.iter().map(|d| (CENTRE - DVec3::Z * *d, DVec3::Z)).collect();
    let wanted: Vec<f64> =
        distances.iter().map(|d| NADIR_CD / (radius_m * radius_m + d * d)).collect();
    let light = luminaire(Beam::Lambertian, disk(2.0 * radius_m), CENTRE);
    assert_direct(&in_the_dark(light, &sensors), &wanted, 1e-4, "disk");
}

/// Under a corner of a rectangle: Siegel and Howell (1981), configuration 3.
#[test]
fn a_lambertian_rectangle_is_a_panel() {
    let (x, y): (f64, f64) = (1.2, 0.6);
    let distances: [f64; 3] = [0.2, 1.0, 3.0];
    let corner = CENTRE + DVec3::new(0.5 * x, 0.5 * y, 0.0);
    let sensors: Vec<_> = distances.iter().map(|d| (corner - DVec3::Z * *d, DVec3::Z)).collect();
    let wanted: Vec<f64> = distances
        .iter()
        .map(|d| {
            let term = |a: f64, b: f64| {
                let s = (a * a + d * d).sqrt();
                a / s * libm::atan(b / s)
            };
            0.5 * NADIR_CD / (x * y) * (term(x, y) + term(y, x))
        })
        .collect();
    let light = luminaire(Beam::Lambertian, rectangle(x, y), CENTRE);
    assert_direct(&in_the_dark(light, &sensors), &wanted, 1e-4, "rectangle");
}

/// A sphere of equal luminance gives I cos / d^2 however near, as long as all of it is in front.
#[test]
fn a_uniform_sphere_acts_from_its_centre() {
    let radius_m = 0.3;
    let sphere = LuminousShape::new(Solid::Ellipsoid, DVec3::splat(2.0 * radius_m));
    let slope = DVec3::new(0.36, 0.48, 0.8);
    let sensors = [
        (CENTRE - DVec3::Z * 0.33, DVec3::Z),
        (CENTRE - DVec3::Z * 0.6, slope),
        (CENTRE + DVec3::X * 1.0, DVec3::NEG_X),
    ];
    let wanted = [NADIR_CD / (0.33 * 0.33), 0.8 * NADIR_CD / 0.36, NADIR_CD];
    let light = luminaire(Beam::Isotropic, sphere, CENTRE);
    assert_direct(&in_the_dark(light, &sensors), &wanted, 1e-6, "sphere");
}

/// A turned box of equal intensity to all sides, against a sum over its faces with 400 x 400 places
/// each, at points of which one sees the box only in part above its horizon.
#[test]
fn a_box_is_the_sum_over_its_faces() {
    let half_m = DVec3::new(0.4, 0.25, 0.15);
    let placement = Placement {
        aim: DVec3::new(0.3, -0.2, -1.0),
        c0: DVec3::new(1.0, 0.5, 0.2),
        rotation_rad: 0.3,
    };
    let world_from_luminaire = placement.world_from_luminaire().unwrap();
    let shape = LuminousShape::new(Solid::Cuboid, 2.0 * half_m);
    let light = Luminaire { world_from_luminaire, ..luminaire(Beam::Isotropic, shape, CENTRE) };
    let sensors = [
        (CENTRE + DVec3::new(0.1, 0.2, -0.5), DVec3::Z),
        (CENTRE + DVec3::new(1.0, -0.3, 0.05), DVec3::new(-0.6, 0.0, 0.8)),
        (CENTRE + DVec3::new(-0.3, 0.6, -0.1), DVec3::Z),
    ];
    let wanted = sensors.map(|(at, n)| {
        let to_local = world_from_luminaire.transpose();
        box_sum_lx(half_m, to_local * (at - CENTRE), to_local * n)
    });
    assert_direct(&in_the_dark(light, &sensors), &wanted, 1e-4, "box");
}

fn box_sum_lx(half_m: DVec3, at: DVec3, n: DVec3) -> f64 {
    const STEPS: u32 = 400;
    let middle = |i: u32| (2.0 * f64::from(i) + 1.0) / f64::from(STEPS) - 1.0;
    let face_m2 = |axis: usize| 4.0 * half_m[(axis + 1) % 3] * half_m[(axis + 2) % 3];
    let mut sum_lx = 0.0;
    for (axis, side) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
        for (i, j) in (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j))) {
            let mut place = DVec3::ZERO;
            place[axis] = side * half_m[axis];
            place[(axis + 1) % 3] = middle(i) * half_m[(axis + 1) % 3];
            place[(axis + 2) % 3] = middle(j) * half_m[(axis + 2) % 3];
            let w = (at - place).normalize();
            let silhouette_m2: f64 = (0..3).map(|axis| w[axis].abs() * face_m2(axis)).sum();
            let share = (side * w[axis]).max(0.0) / silhouette_m2;
            let area_m2 = face_m2(axis) / f64::from(STEPS * STEPS);
            let received = (-n.dot(w)).max(0.0) / (at - place).length_squared();
            sum_lx += NADIR_CD * share * received * area_m2;
        }
    }
    sum_lx
}

/// Beside the middle of a line of length l, with equal intensity to all sides:
/// E = (I / l) integral of d / (d^2 + t^2)^(3/2) dt = I / (d sqrt(d^2 + l^2 / 4)).
#[test]
fn a_line_is_seen_along_its_length() {
    let distances = [0.1, 0.5, 2.0];
    let sensors: Vec<_> =
        distances.iter().map(|d| (CENTRE + DVec3::Y * *d, DVec3::NEG_Y)).collect();
    let wanted: Vec<f64> =
        distances.iter().map(|d: &f64| NADIR_CD / (d * libm::hypot(*d, 0.6))).collect();
    let line = LuminousShape::new(Solid::Cuboid, DVec3::X * 1.2);
    let light = luminaire(Beam::Isotropic, line, CENTRE);
    assert_direct(&in_the_dark(light, &sensors), &wanted, 1e-4, "line");
}

/// Before the end of a tube, on its axis, only the end disk is seen; its luminance falls off
/// steeply, as the side widens the silhouette: A(w) = (pi a^2 h + 4 a c r) / sqrt(h^2 + r^2) toward
/// the place at distance r from the axis of a disk of radius a, with the half length c of the tube.
#[test]
fn a_tube_is_brightest_along_its_axis() {
    const STEPS: u32 = 100_000;
    let (a, c): (f64, f64) = (0.05, 0.3);
    let distances = [0.05, 0.2];
    let wanted = distances.map(|h: f64| {
        let part = |i: u32| {
            // r = a t^2 takes the kink at the axis.
            let t = (f64::from(i) + 0.5) / f64::from(STEPS);
            let r = a * t * t;
            let square = h * h + r * r;
            let area_m2 = (PI * a * a * h + 4.0 * a * c * r) / square.sqrt();
            let ring_m2 = TAU * r * 2.0 * a * t / f64::from(STEPS);
            NADIR_CD * (h / square.sqrt()) / area_m2 * (h / square.sqrt()) / square * ring_m2
        };
        (0..STEPS).map(part).sum::<f64>()
    });
    let sensors = distances.map(|h| (CENTRE + DVec3::X * (c + h), DVec3::NEG_X));
    let tube = LuminousShape::new(Solid::Cylinder(Axis::X), DVec3::new(2.0 * c, 2.0 * a, 2.0 * a));
    let light = luminaire(Beam::Isotropic, tube, CENTRE);
    assert_direct(&in_the_dark(light, &sensors), &wanted, 1e-4, "tube");
}

/// At a hundred times its largest extent each flat shape is a point to 1e-4; the second order is
/// about (half extent / distance)^2 = 2.5e-5. The side of a solid that is seen is nearer than its
/// centre, by up to a half extent: of first order, so these are a hundred times as far.
#[test]
fn from_afar_every_shape_is_a_point() {
    let toward = DVec3::new(0.48, 0.36, -0.8);
    for (flat, solid) in shapes(0.2).into_iter().zip(shapes(0.002)) {
        let shape = if solid.is_solid() { solid } else { flat };
        for beam in [Beam::Lambertian, Beam::Isotropic] {
            let sensors = [(CENTRE + toward * 20.0, -toward), (CENTRE - DVec3::Z * 20.0, DVec3::Z)];
            let light = luminaire(beam, shape, CENTRE);
            let wanted = sensors.map(|(at, _)| {
                let direction = at - CENTRE;
                light.intensity_cd(direction.normalize()) / direction.length_squared()
            });
            assert_direct(&in_the_dark(light, &sensors), &wanted, 1e-4, shape.name());
        }
    }
}

/// A disk in the very plane of a ceiling shines down as one below it.
#[test]
fn an_opening_flush_with_the_ceiling_shines() {
    let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(0.0));
    let light = luminaire(Beam::Lambertian, disk(0.4), DVec3::new(2.0, 1.5, 2.5));
    scene.lights.push(Light::Luminaire(light));
    scene.sensors.push(points("floor", &[(DVec3::new(2.0, 1.5, 0.0), DVec3::Z)]));
    let wanted = NADIR_CD / (0.04 + 6.25);
    assert_direct(&scene, &[wanted], 1e-4, "flush");
}

/// Photons and paths, with and without maps, of each shape near the ceiling of a room. All light
/// stays in it.
#[test]
fn photons_and_paths_agree() {
    for (i, shape) in shapes(0.5).into_iter().enumerate() {
        let mut scene = room(DVec3::new(3.0, 2.0, 2.0), diffuse(0.4));
        let beam = if i % 2 == 0 { Beam::Isotropic } else { Beam::Lambertian };
        let placement = Placement { aim: DVec3::NEG_Z, c0: DVec3::X, rotation_rad: 0.4 };
        let world_from_luminaire = placement.world_from_luminaire().unwrap();
        let light = luminaire(beam, shape, DVec3::new(1.2, 0.9, 1.7));
        scene.lights.push(Light::Luminaire(Luminaire { world_from_luminaire, ..light }));
        scene.sensors.push(grid());
        let photons = run(&scene, EstimatorKind::Photon);
        let flux = photons.flux;
        assert_eq!(flux.lost_lm, 0.0, "{}", shape.name());
        assert!((flux.absorbed_lm / flux.emitted_lm - 1.0).abs() < 1e-12);
        for estimator in
            [EstimatorKind::Path, EstimatorKind::Bidirectional, EstimatorKind::BidirectionalMap]
        {
            let paths = run(&scene, estimator);
            for (x, y) in photons.point_intervals(0).iter().zip(paths.point_intervals(0)) {
                let allowed = 1.5 * (x.half_width.unwrap() + y.half_width.unwrap());
                let text = format!("{}, {estimator:?}: {x:?} against {y:?}", shape.name());
                assert!((x.value - y.value).abs() <= allowed, "{text}");
            }
            let (a, b) = (&photons.sensors[0].direct_lx, &paths.sensors[0].direct_lx);
            for (x, y) in a.iter().zip(b) {
                assert!((x / y - 1.0).abs() < 0.03, "{}: direct {x} and {y}", shape.name());
            }
        }
    }
}

fn run(scene: &Scene, estimator: EstimatorKind) -> Estimates {
    let settings = Settings { estimator, rel_tol: 0.02, ..Settings::default() };
    let estimates = simulate(scene, &settings, &mut ());
    assert!(estimates.tolerance_reached && estimates.invalid_contributions == 0);
    estimates
}

/// Means over four cells half a metre under the luminaire.
fn grid() -> Sensor {
    Sensor {
        name: "cells".to_owned(),
        shape: SensorShape::Grid(Grid {
            origin: DVec3::new(0.5, 0.4, 1.2),
            u: DVec3::X * 1.6,
            v: DVec3::Y * 1.2,
            counts: [2, 2],
            normal: DVec3::Z,
            quantity: Quantity::Mean,
            target_lx: None,
        }),
    }
}

/// Several luminaires share their samples in proportion to what they give.
#[test]
fn one_of_many_is_chosen_by_what_it_gives() {
    let mut scene = room(DVec3::new(30.0, 4.0, 3.0), diffuse(0.0));
    let at = DVec3::new(10.0, 2.0, 0.8);
    let mut wanted = 0.0;
    for i in 0..12 {
        let position = DVec3::new(1.5 + 2.5 * f64::from(i), 2.0, 2.8);
        let sphere = LuminousShape::new(Solid::Ellipsoid, DVec3::splat(0.3));
        scene.lights.push(Light::Luminaire(luminaire(Beam::Isotropic, sphere, position)));
        let toward = position - at;
        wanted += NADIR_CD * toward.normalize().z / toward.length_squared();
    }
    scene.sensors.push(points("desk", &[(at, DVec3::Z)]));
    assert_direct(&scene, &[wanted], 1e-6, "hall");
}

#[test]
fn a_shape_that_a_ceiling_cuts_is_warned_of() {
    let warned = |height_m: f64, shape: LuminousShape| {
        let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(0.5));
        let position = DVec3::new(2.0, 1.5, height_m);
        scene.lights.push(Light::Luminaire(luminaire(Beam::Isotropic, shape, position)));
        scene.sensors.push(points("floor", &[(DVec3::new(2.0, 1.5, 0.0), DVec3::Z)]));
        let settings = Settings { max_samples: Some(16), ..Settings::default() };
        let caveats = simulate(&scene, &settings, &mut ()).caveats;
        caveats.contains(&Caveat::CutShapes { luminaires: 1 })
    };
    for shape in shapes(0.5) {
        assert_eq!(warned(2.5, shape), shape.is_solid(), "{} in the ceiling", shape.name());
        let under = 2.5 - 0.5 * shape.size_m().z;
        assert!(!warned(under, shape), "{} under the ceiling", shape.name());
    }
}

/// Seen edge on, a flat opening has the intensity that the file gives it.
#[test]
fn an_opening_seen_edge_on_has_the_intensity_of_the_file() {
    let sensors = [DVec3::X, DVec3::Y].map(|side| (CENTRE + side * 20.0, -side));
    let light = luminaire(Beam::Isotropic, disk(0.2), CENTRE);
    assert_direct(&in_the_dark(light, &sensors), &[NADIR_CD / 400.0; 2], 1e-4, "edge on");
}

/// A point that looks away from all openings gets no direct light for certain: nothing is left to
/// be found.
#[test]
fn a_point_that_looks_away_is_known_to_be_dark() {
    let mut scene = room(DVec3::splat(4.0), diffuse(0.0));
    scene.lights.push(Light::Luminaire(luminaire(Beam::Lambertian, disk(0.5), CENTRE)));
    let below = CENTRE - DVec3::Z;
    scene.sensors.push(points("probes", &[(below, DVec3::Z), (below, DVec3::NEG_Z)]));
    let estimates = simulate(&scene, &Settings::default(), &mut ());
    assert!(estimates.tolerance_reached && estimates.unresolved_points == 0);
    let [lit, dark] = [0, 1].map(|point| estimates.interval_of(0, |values| values[point]));
    assert!(lit.value > 0.0, "{lit:?}");
    assert_eq!((dark.value, dark.half_width), (0.0, Some(0.0)));
}
