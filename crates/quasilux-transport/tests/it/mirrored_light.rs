//! Point-like lights in rooms with mirrors: paths that see images agree with photons that are
//! counted, which know nothing of them.
//!
//! Means over the four cells of a floor grid, at 1 %: each pair of intervals must overlap when both
//! are half as wide again. Per cell that fails for right programs once in some 2000 cases; the seed
//! is fixed. What mirrors add is far more than that in every cell, which is asserted.

use crate::images::{add_panel, empty};
use crate::materials::add_ball;
use crate::scenes::{diffuse, mirror, point_light, room};
use glam::DVec3;
use quasilux_scene::bsdf::{Dielectric, Diffuse, Mirror};
use quasilux_scene::light::PointLight;
use quasilux_scene::{Bsdf, Grid, Light, Material, Quantity, Rgb, Scene, Sensor, SensorShape};
use quasilux_transport::{Caveat, Estimates, EstimatorKind, Settings, UnshownWay, simulate};

/// A box of 4 m by 3 m by 2.5 m with two lamps and a grid over the floor.
fn lit_room(reflectance: f64) -> Scene {
    let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(reflectance));
    scene.lights.push(point_light(DVec3::new(0.9, 1.0, 1.9), 300.0));
    scene.lights.push(point_light(DVec3::new(2.9, 2.2, 1.2), 100.0));
    let grid = Grid {
        origin: DVec3::new(0.5, 0.5, 0.3),
        u: DVec3::X * 3.0,
        v: DVec3::Y * 2.0,
        counts: [2, 2],
        normal: DVec3::Z,
        quantity: Quantity::Mean,
        target_lx: None,
    };
    scene.sensors.push(Sensor { name: "floor".to_owned(), shape: SensorShape::Grid(grid) });
    scene
}

/// Makes the wall of the triangles from `first` on of this material.
pub(crate) fn make_wall(scene: &mut Scene, first: usize, bsdf: Bsdf) {
    scene.mesh.material_of[first..first + 2].fill(scene.materials.len() as u32);
    scene.materials.push(Material { name: format!("wall {first}"), bsdf });
}

fn run(scene: &Scene, estimator: EstimatorKind, max_bounces: Option<u32>) -> Estimates {
    let settings = Settings { estimator, max_bounces, rel_tol: 0.01, ..Settings::default() };
    let estimates = simulate(scene, &settings, &mut ());
    assert!(estimates.tolerance_reached, "{estimator:?}: {:?}", estimates.caveats);
    assert_eq!(estimates.invalid_contributions, 0, "{estimator:?}");
    estimates
}

/// All estimators that gather.
const GATHERING: [EstimatorKind; 3] =
    [EstimatorKind::Path, EstimatorKind::Bidirectional, EstimatorKind::BidirectionalMap];

/// Compares them with photons.
fn assert_agree(
    scene: &Scene,
    estimators: &[EstimatorKind],
    biased: bool,
    max_bounces: &[Option<u32>],
) {
    for &max_bounces in max_bounces {
        let photons = run(scene, EstimatorKind::Photon, max_bounces);
        for &estimator in estimators {
            let paths = run(scene, estimator, max_bounces);
            let expected = match estimator {
                EstimatorKind::Bidirectional => false,
                EstimatorKind::BidirectionalMap => true,
                _ => biased,
            };
            assert_eq!(paths.biased, expected, "{:?}", paths.caveats);
            for (x, y) in photons.point_intervals(0).iter().zip(paths.point_intervals(0)) {
                let allowed = 1.5 * (x.half_width.unwrap() + y.half_width.unwrap());
                let what = format!("{estimator:?}, {max_bounces:?}: {x:?} against {y:?}");
                assert!((x.value - y.value).abs() <= allowed, "{what}");
            }
        }
    }
}

/// The least share of the light after at most one bounce that mirrors alone make, by photons: the
/// rest of the room is black.
fn mirrored_share(black: &Scene) -> f64 {
    let [none, one] = [Some(0), Some(1)].map(|n| run(black, EstimatorKind::Photon, n));
    let pairs = none.point_intervals(0).into_iter().zip(one.point_intervals(0));
    pairs.map(|(none, one)| 1.0 - none.value / one.value).fold(1.0, f64::min)
}

#[test]
fn one_mirror_wall() {
    let mirrored = |reflectance| {
        let mut scene = lit_room(reflectance);
        make_wall(&mut scene, 6, mirror(0.9));
        scene
    };
    assert!(mirrored_share(&mirrored(0.0)) > 0.02);
    assert_agree(&mirrored(0.5), &GATHERING, false, &[Some(1), Some(2)]);
}

/// Facing walls and a third, all coloured, and a screen in the middle.
#[test]
fn coloured_mirrors_and_a_screen() {
    let mut scene = lit_room(0.4);
    let coloured = Bsdf::Mirror(Mirror { reflectance: Rgb([0.6, 0.3, 0.1]) });
    for first in [4, 6, 8] {
        make_wall(&mut scene, first, coloured.clone());
    }
    let red = Bsdf::Diffuse(Diffuse { reflectance: Rgb([0.7, 0.2, 0.2]) });
    add_panel(&mut scene, DVec3::new(2.0, 0.5, 0.0), DVec3::Y * 1.5, DVec3::Z * 1.5, red);
    assert_agree(&scene, &GATHERING[..2], false, &[Some(2), None]);
}

/// Chains that images do not follow come from photon density, without bias in cells that hang in
/// the room: a depth of one leaves all longer chains to it.
#[test]
fn chains_past_the_depth_are_not_lost() {
    let mut scene = lit_room(0.0);
    for first in [4, 6] {
        make_wall(&mut scene, first, mirror(0.5));
    }
    let photons = run(&scene, EstimatorKind::Photon, None);
    let estimator = EstimatorKind::Path;
    let settings = Settings { estimator, image_depth: Some(1), ..Settings::default() };
    let paths = simulate(&scene, &settings, &mut ());
    assert!(paths.biased && paths.tolerance_reached);
    let ways = vec![UnshownWay::OverManyMirrors { depth: 1 }];
    assert!(paths.caveats.contains(&Caveat::Caustics { ways }), "{:?}", paths.caveats);
    for (x, y) in photons.point_intervals(0).iter().zip(paths.point_intervals(0)) {
        let allowed = 1.5 * (x.half_width.unwrap() + y.half_width.unwrap());
        assert!((x.value - y.value).abs() <= allowed, "{x:?} against {y:?}");
    }
}

/// A mirrored half cylinder of many facets focuses light on a wall: density finds it at vertices,
/// cells and points, blurred over an element.
#[test]
fn a_curved_mirror_focuses() {
    let mut scene = lit_room(0.6);
    let Light::Point(PointLight { position, .. }) = scene.lights[0] else { unreachable!() };
    let at = |i: u32| {
        let (sin, cos) = libm::sincos(f64::from(i) / 200.0 * std::f64::consts::PI);
        DVec3::new(position.x - 0.4 * sin, position.y + 0.4 * cos, position.z - 0.6)
    };
    for i in 0..200 {
        add_panel(&mut scene, at(i), at(i + 1) - at(i), DVec3::Z * 0.9, mirror(0.95));
    }
    assert_agree(&scene, &GATHERING, true, &[Some(1), None]);
}

/// Light of lamps that a ball of glass gathers: through it, and by reflection inside and out.
#[test]
fn a_ball_of_glass_gathers_light() {
    let mut scene = lit_room(0.5);
    let glass = Bsdf::Dielectric(Dielectric { eta: 1.5 });
    add_ball(&mut scene, DVec3::new(1.2, 1.1, 1.0), 0.4, glass);
    assert_agree(&scene, &GATHERING, true, &[Some(2), None]);
}

/// A pane across the room, with a lamp on either side of it, and a mirror wall: light goes straight
/// through, by the pane, and over both.
#[test]
fn a_pane_and_a_mirror_wall() {
    let mut scene = lit_room(0.5);
    make_wall(&mut scene, 6, mirror(0.9));
    let pane = Bsdf::Pane(quasilux_scene::bsdf::Pane::Clear { eta: 1.5 });
    add_panel(&mut scene, DVec3::new(2.0, 0.0, 0.0), DVec3::Y * 3.0, DVec3::Z * 2.5, pane);
    assert_agree(&scene, &GATHERING[..2], false, &[Some(0), Some(1), Some(2)]);
}

/// Light that a mirror sends up through a grid whose normal is tilted so far that it counts: as the
/// images say, where the depth of these is 0 and photons find it. A sixth of the light comes so; a
/// tenth of that would be missed. On a panel nothing comes so.
#[test]
fn a_tilted_grid_is_lit_through_its_back() {
    let mut scene = empty();
    let corner = DVec3::new(-9.0, -9.0, 0.0);
    add_panel(&mut scene, corner, DVec3::X * 18.0, DVec3::Y * 18.0, mirror(0.9));
    scene.lights.push(point_light(DVec3::Z * 2.0, 1000.0));
    let grid = Grid {
        origin: DVec3::new(1.5, -0.5, 1.0),
        u: DVec3::X,
        v: DVec3::Y,
        counts: [1, 1],
        normal: DVec3::new(-1.0, 0.0, 1e-3).normalize(),
        quantity: Quantity::Mean,
        target_lx: None,
    };
    scene.sensors.push(Sensor { name: "tilted".to_owned(), shape: SensorShape::Grid(grid) });
    let value = |scene: &Scene, image_depth| {
        let estimator = EstimatorKind::Path;
        let settings = Settings { estimator, image_depth, rel_tol: 0.005, ..Settings::default() };
        let interval = simulate(scene, &settings, &mut ()).point_intervals(0)[0];
        assert!(interval.half_width.unwrap() <= 0.005 * interval.value, "{interval:?}");
        interval.value
    };
    let [images, photons] = [None, Some(0)].map(|image_depth| value(&scene, image_depth));
    assert!((photons / images - 1.0).abs() < 0.015, "{photons}, {images}");
    add_panel(&mut scene, grid.origin, grid.u, grid.v, diffuse(0.0));
    let [shaded_images, shaded] = [None, Some(0)].map(|image_depth| value(&scene, image_depth));
    assert!((shaded / shaded_images - 1.0).abs() < 0.015, "{shaded}, {shaded_images}");
    assert!(shaded < 0.85 * photons, "{shaded} of {photons}");
}
