//! Rooms of every material.

use crate::scenes::{all_walls_emit, diffuse, level_grid, mirror, point_light, points, room};
use glam::DVec3;
use quasilux_scene::bsdf::{Conductor, Dielectric, Pane, Plastic, Translucent};
use quasilux_scene::{Bsdf, Grid, Material, Quantity, Rgb, Scene, Sensor, SensorShape};
use quasilux_stats::deep;
use quasilux_transport::{Caveat, Estimates, EstimatorKind, Settings, UnseenTolerance, simulate};
use std::f64::consts::PI;

pub(crate) fn conductor(reflectance: f64, alpha: f64) -> Bsdf {
    Bsdf::Conductor(Conductor { reflectance: Rgb::grey(reflectance), alpha })
}

pub(crate) fn plastic(reflectance: f64, alpha: f64) -> Bsdf {
    Bsdf::Plastic(Plastic { reflectance: Rgb::grey(reflectance), eta: 1.5, alpha })
}

pub(crate) fn translucent(reflectance: f64, transmittance: f64) -> Bsdf {
    let [reflectance, transmittance] = [reflectance, transmittance].map(Rgb::grey);
    Bsdf::Translucent(Translucent { reflectance, transmittance })
}

/// Adds a box of one material, its normals outward.
pub(crate) fn add_box(scene: &mut Scene, low: DVec3, high: DVec3, bsdf: Bsdf) {
    let inner = room(high - low, bsdf.clone());
    let material = scene.materials.len() as u32;
    scene.materials.push(Material { name: format!("box {material}"), bsdf });
    let first = scene.mesh.positions.len() as u32;
    scene.mesh.positions.extend(inner.mesh.positions.iter().map(|&position| position + low));
    for [a, b, c] in inner.mesh.triangles {
        scene.mesh.triangles.push([first + a, first + c, first + b]);
        scene.mesh.material_of.push(material);
        scene.mesh.object_of.push(0);
    }
}

/// What stands in a furnace absorbs nothing, whatever it is: all illuminances stay those of the
/// empty furnace, pi L / (1 - r), in front of it, beside it and behind it, to 0.6 %, in the deep
/// variant to 0.1 %.
#[test]
fn white_bodies_vanish_in_a_furnace() {
    let allowed = if deep() { 1e-3 } else { 6e-3 };
    let rel_tol = 0.7 * allowed;
    let bodies = [
        mirror(1.0),
        Bsdf::Dielectric(Dielectric { eta: 1.5 }),
        Bsdf::Pane(Pane::Clear { eta: 1.5 }),
        translucent(0.3, 0.7),
        conductor(1.0, 0.05),
        conductor(1.0, 0.6),
        plastic(1.0, 0.05),
        plastic(1.0, 0.6),
    ];
    for body in bodies {
        let mut scene = room(DVec3::new(2.0, 2.0, 2.0), diffuse(0.5));
        all_walls_emit(&mut scene, 100.0);
        add_box(&mut scene, DVec3::splat(0.7), DVec3::new(1.3, 1.2, 1.4), body.clone());
        let places = [
            (DVec3::new(0.69, 1.0, 1.0), DVec3::X),
            (DVec3::new(1.0, 1.0, 0.5), DVec3::Z),
            (DVec3::new(1.6, 1.9, 0.1), DVec3::new(-0.6, -0.8, 0.0)),
        ];
        scene.sensors.push(points("probes", &places));
        // Where all is kept nothing bounds what no sample met.
        let unseen_tol = UnseenTolerance::Off;
        let settings = Settings { rel_tol, unseen_tol, ..Settings::default() };
        let estimates = simulate(&scene, &settings, &mut ());
        for interval in estimates.point_intervals(0) {
            let wanted = PI * 100.0 / 0.5;
            let found = format!("{body:?}: {interval:?}, wanted {wanted}");
            assert!(interval.half_width.unwrap() <= rel_tol * interval.value, "{found}");
            assert!((interval.value - wanted).abs() <= allowed * wanted, "{found}");
        }
    }
}

/// Whatever stands in a black room and absorbs nothing, all light ends on the walls.
#[test]
fn photons_leave_white_bodies_for_the_walls() {
    let grid = |origin: DVec3, u: DVec3, v: DVec3, normal: DVec3| {
        let quantity = Quantity::Mean;
        SensorShape::Grid(Grid { origin, u, v, counts: [1, 1], normal, quantity, target_lx: None })
    };
    for body in [
        mirror(1.0),
        Bsdf::Dielectric(Dielectric { eta: 1.5 }),
        Bsdf::Pane(Pane::Clear { eta: 1.5 }),
        translucent(0.3, 0.7),
        conductor(1.0, 0.05),
        conductor(1.0, 0.6),
        plastic(1.0, 0.05),
        plastic(1.0, 0.6),
    ] {
        let mut scene = room(DVec3::ONE, diffuse(0.0));
        add_box(&mut scene, DVec3::splat(0.3), DVec3::splat(0.7), body.clone());
        scene.lights.push(point_light(DVec3::new(0.12, 0.15, 0.2), 10.0));
        for (axis, side) in [(0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0), (2, 0.0), (2, 1.0)] {
            let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z];
            let (n, u, v) = [(x, y, z), (y, z, x), (z, x, y)][axis];
            let normal = if side == 0.0 { n } else { -n };
            // A hair in front of the wall.
            let origin = n * side + normal * 1e-6;
            let shape = grid(origin, u, v, normal);
            scene.sensors.push(Sensor { name: format!("{axis} {side}"), shape });
        }
        let settings = Settings {
            estimator: EstimatorKind::Photon,
            max_samples: Some(1 << 12),
            ..Settings::default()
        };
        let estimates = simulate(&scene, &settings, &mut ());
        let flux_lm: f64 = (0..6).map(|sensor| estimates.point_intervals(sensor)[0].value).sum();
        let wanted = 4.0 * PI * 10.0;
        // 2^16 photons in all; weights of rough surfaces vary by a tenth or so.
        let found = format!("{body:?}: {flux_lm}, wanted {wanted}");
        assert!((flux_lm / wanted - 1.0).abs() < 2e-3, "{found}");
    }
}

/// In glass of index n in equilibrium with a furnace, radiance is n^2 times as high. At the centre
/// of a ball no direction is trapped by total reflection.
#[test]
fn radiance_rises_with_the_square_of_the_index() {
    let mut scene = room(DVec3::splat(2.0), diffuse(0.5));
    all_walls_emit(&mut scene, 100.0);
    add_ball(&mut scene, DVec3::ONE, 0.6, Bsdf::Dielectric(Dielectric { eta: 1.5 }));
    scene.sensors.push(points("centre", &[(DVec3::ONE, DVec3::new(0.48, 0.6, 0.64))]));
    let wanted = 1.5 * 1.5 * PI * 100.0 / 0.5;
    for estimator in [EstimatorKind::Auto, EstimatorKind::Bidirectional] {
        let unseen_tol = UnseenTolerance::Off;
        let settings = Settings { estimator, rel_tol: 0.004, unseen_tol, ..Settings::default() };
        let interval = simulate(&scene, &settings, &mut ()).point_intervals(0)[0];
        let allowed = 1.5 * interval.half_width.unwrap() + 1e-3 * wanted;
        assert!((interval.value - wanted).abs() <= allowed, "{interval:?}, wanted {wanted}");
    }
}

/// Nothing absorbs light in a hall of perfect mirrors, alone or around a ball of glass: photons and
/// paths are cut, and whoever reads the values is told that they mean little.
#[test]
fn halls_of_perfect_mirrors_end_with_a_warning() {
    let mut hall = room(DVec3::new(4.0, 3.0, 2.0), mirror(1.0));
    hall.lights.push(point_light(DVec3::new(0.4, 0.3, 0.3), 10.0));
    hall.sensors.push(level_grid(DVec3::new(0.0, 0.0, 0.4), [4.0, 3.0], [2, 2]));
    let with_glass = |mut scene: Scene| {
        let glass = Bsdf::Dielectric(Dielectric { eta: 1.5 });
        add_ball(&mut scene, DVec3::new(2.0, 1.5, 1.0), 0.5, glass);
        scene
    };
    assert_warns_of_trapped_light(&hall, EstimatorKind::Photon);
    assert_warns_of_trapped_light(&hall, EstimatorKind::Path);
    assert_warns_of_trapped_light(&with_glass(hall.clone()), EstimatorKind::Photon);
    // Each photon flies until it is given up, and pilots have many: where one of 512 is trapped
    // they must tell, too.
    add_box(&mut hall, DVec3::new(5.0, 0.0, 0.0), DVec3::new(6.0, 1.0, 1.0), diffuse(0.0));
    hall.lights.push(point_light(DVec3::new(5.5, 0.5, 0.5), 5110.0));
    for scene in [hall.clone(), with_glass(hall)] {
        for estimator in [EstimatorKind::Path, EstimatorKind::BidirectionalMap] {
            assert_warns_of_trapped_light(&scene, estimator);
        }
    }
}

fn assert_warns_of_trapped_light(scene: &Scene, estimator: EstimatorKind) {
    let settings = Settings {
        estimator,
        replicates: 2,
        max_samples: Some(4),
        map_photons: 4,
        map_adaptive: false,
        ..Settings::default()
    };
    let estimates = simulate(scene, &settings, &mut ());
    assert!(tells_of_trapped_light(&estimates), "{estimator:?}: {:?}", estimates.caveats);
}

/// Whether values are called biased because photons or paths had to be terminated.
pub(crate) fn tells_of_trapped_light(estimates: &Estimates) -> bool {
    let is_of_it = |caveat: &Caveat| {
        matches!(caveat, Caveat::PhotonsTerminated { .. } | Caveat::PathsTerminated { .. })
    };
    estimates.biased && estimates.caveats.iter().any(is_of_it)
}

/// Adds a ball of 128 facets: an octahedron with its edges halved twice, its normals outward.
pub(crate) fn add_ball(scene: &mut Scene, centre: DVec3, radius_m: f64, bsdf: Bsdf) {
    let material = scene.materials.len() as u32;
    scene.materials.push(Material { name: format!("ball {material}"), bsdf });
    let axes = [DVec3::X, DVec3::Y, DVec3::NEG_X, DVec3::NEG_Y];
    let mut facets = Vec::new();
    for i in 0..4 {
        facets.push([axes[i], axes[(i + 1) % 4], DVec3::Z]);
        facets.push([axes[(i + 1) % 4], axes[i], DVec3::NEG_Z]);
    }
    for _ in 0..2 {
        let halve = |[a, b, c]: [DVec3; 3]| {
            let [p, q, r] = [(a + b).normalize(), (b + c).normalize(), (c + a).normalize()];
            [[a, p, r], [p, b, q], [r, q, c], [p, q, r]]
        };
        facets = facets.into_iter().flat_map(halve).collect();
    }
    for facet in facets {
        let first = scene.mesh.positions.len() as u32;
        scene.mesh.positions.extend(facet.map(|corner| centre + corner * radius_m));
        scene.mesh.triangles.push([first, first + 1, first + 2]);
        scene.mesh.material_of.push(material);
        scene.mesh.object_of.push(0);
    }
}
