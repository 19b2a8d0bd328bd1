//! Scenes whose illuminances are known.
//!
//! In each of them every point has noise: what is computed without sampling has no interval to
//! test.

use super::known_scene::{KnownScene, polygon_lx};
use super::wall_in_the_sun;
use crate::building::{add_material, add_quad, grey, lamp, points, room, shine};
use glam::DVec3;
use quasilux_scene::bsdf::{Diffuse, Mirror};
use quasilux_scene::{Bsdf, Grid, Quantity, Rgb, Scene, Sensor, SensorShape};
use quasilux_transport::EstimatorKind;
use std::f64::consts::PI;

/// Luminance of what shines, in cd/m^2.
const LUMINANCE_CD_M2: f64 = 100.0;
/// Corners of the panel, as (x, y) in m, and their height.
const PANEL: [[f64; 2]; 4] = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
const PANEL_Z_M: f64 = 1.5;
/// Of the mirror beside the panel.
const MIRROR: f64 = 0.8;
/// Of the walls that photons are counted on.
const WALLS: f64 = 0.5;

/// The scenes.
pub(super) fn all() -> Vec<KnownScene> {
    vec![
        furnace(),
        coloured_furnace(),
        panel(),
        mirror(),
        cube(),
        walls(),
        unequal(),
        wall_in_the_sun::moment(),
        wall_in_the_sun::year(),
    ]
}

/// Walls of reflectance a that all have the luminance L give pi L / (1 - a) everywhere.
fn furnace() -> KnownScene {
    KnownScene {
        name: "furnace",
        why: "pi L / (1 - reflectance), at points that are all equal",
        rel_tol: [0.005, 0.007],
        ..furnace_with(Rgb::grey(0.5))
    }
}

/// The same for each channel.
fn coloured_furnace() -> KnownScene {
    furnace_with(Rgb([0.7, 0.5, 0.2]))
}

fn furnace_with(reflectance: Rgb) -> KnownScene {
    let mut scene = room(DVec3::splat(2.0), Bsdf::Diffuse(Diffuse { reflectance }));
    shine(&mut scene, 0, 0, LUMINANCE_CD_M2);
    let places = [
        (DVec3::new(0.7, 0.9, 0.4), DVec3::Z),
        (DVec3::new(1.6, 0.3, 1.1), DVec3::X),
        (DVec3::new(0.2, 1.5, 1.7), DVec3::NEG_Z),
    ];
    scene.sensors.push(points(&places));
    let Rgb(channels) = reflectance;
    let lx = Rgb(channels.map(|share| PI * LUMINANCE_CD_M2 / (1.0 - share))).luminance();
    KnownScene {
        name: "coloured furnace",
        why: "the same for each colour",
        scene,
        hours: Vec::new(),
        truth_lx: vec![lx; places.len()],
        estimator: EstimatorKind::Path,
        rel_tol: [0.007, 0.007],
    }
}

/// A panel of 1 m by 1 m that shines down from 1.5 m, and nothing else.
fn panel() -> KnownScene {
    let mut scene = Scene::default();
    let corners = add_panel(&mut scene);
    let places = add_places(&mut scene, [[0.5, 0.5], [1.1, 0.2], [0.1, 1.3], [1.5, 1.2]]);
    let truth_lx = places.iter().map(|&(at, n)| panel_lx(at, n, &corners)).collect();
    let why = "the contour integral of Lambert (1760)";
    KnownScene {
        name: "panel",
        why,
        scene,
        hours: Vec::new(),
        truth_lx,
        estimator: EstimatorKind::Path,
        rel_tol: [0.0012, 0.003],
    }
}

/// The same beside a mirror, which shows a second panel.
fn mirror() -> KnownScene {
    let mut scene = Scene::default();
    let corners = add_panel(&mut scene);
    // Wide enough to show all of it from everywhere below.
    let mirror = [[-2.0, -0.5], [3.0, -0.5], [3.0, 2.5], [-2.0, 2.5]];
    let image = add_mirror(&mut scene, -0.5, mirror);
    // Near the mirror: where only few paths find the image, 16 of them are too few for Student's t.
    let places = add_places(&mut scene, [[-0.3, 0.5], [0.2, 0.2], [0.1, 1.3], [-0.2, 1.1]]);
    let truth_lx = places
        .iter()
        .map(|&(at, n)| panel_lx(at, n, &corners) + MIRROR * panel_lx(at, n, &image))
        .collect();
    let why = "the contour integral for the panel and its image";
    KnownScene {
        name: "mirror",
        why,
        scene,
        hours: Vec::new(),
        truth_lx,
        estimator: EstimatorKind::Path,
        rel_tol: [0.0007, 0.003],
    }
}

/// The panel over two places beside a mirror, which they get 41 % of their light from and which few
/// paths find, and two that get about as much from the panel alone and have the mirror below their
/// horizon: the lowest of four that are within 0.3 % is known worse than the next.
fn unequal() -> KnownScene {
    let mut scene = Scene::default();
    let corners = add_panel(&mut scene);
    let mirror = [[-0.5, 0.2], [1.5, 0.2], [1.5, 0.78], [-0.5, 0.78]];
    let image = add_mirror(&mut scene, -0.1, mirror);
    let up = |[x, y, z]: [f64; 3]| (DVec3::new(x, y, z), DVec3::Z);
    let beside = [[-0.06, 0.5, 0.3], [-0.04, 0.5, 0.3]].map(up);
    let above = [[1.025, 0.3, 0.8], [1.056, 0.5, 0.8]].map(up);
    scene.sensors.push(points(&[beside, above].concat()));
    let direct_lx = |(at, n)| panel_lx(at, n, &corners);
    let with_image_lx = |(at, n)| panel_lx(at, n, &corners) + MIRROR * panel_lx(at, n, &image);
    let truth_lx = [beside.map(with_image_lx), above.map(direct_lx)].concat();
    let why = "the contour integral, at two of four points for the image as well";
    let rel_tol = [0.0014, 0.0085];
    let hours = Vec::new();
    KnownScene {
        name: "unequal",
        why,
        scene,
        hours,
        truth_lx,
        estimator: EstimatorKind::Path,
        rel_tol,
    }
}

/// The diffuse cube of Voloboy, Dmitriev and Kopylov (2003), at three places of a wall whose
/// luminance is known to 1e-5 from the solution of its integral equation.
fn cube() -> KnownScene {
    let mut scene = room(DVec3::splat(10.0), grey(2.0 / 3.0));
    lamp(&mut scene, DVec3::splat(5.0), 50_000.0);
    let known = [((5.0, 5.0), 892.80), ((7.5, 5.0), 768.69), ((7.5, 7.5), 686.70)];
    let place = |((y, z), _): ((f64, f64), f64)| (DVec3::new(0.0, y, z), DVec3::X);
    scene.sensors.push(points(&known.map(place)));
    let truth_lx = known.iter().map(|(_, luminance_cd_m2)| luminance_cd_m2 * PI * 1.5).collect();
    let why = "the integral equation of the diffuse cube, solved to 1e-5";
    KnownScene {
        name: "cube",
        why,
        scene,
        hours: Vec::new(),
        truth_lx,
        estimator: EstimatorKind::Auto,
        rel_tol: [0.0025, 0.005],
    }
}

/// A cube with a lamp in its middle: a quarter of a wall gets 1/24 of the light, the reflected too.
fn walls() -> KnownScene {
    let mut scene = room(DVec3::splat(2.0), grey(WALLS));
    lamp(&mut scene, DVec3::ONE, 100.0);
    let (u, v) = (DVec3::Y * 2.0, DVec3::Z * 2.0);
    let (origin, normal, quantity) = (DVec3::ZERO, DVec3::X, Quantity::Mean);
    let grid = Grid { origin, u, v, counts: [2, 2], normal, quantity, target_lx: None };
    scene.sensors.push(Sensor { name: "wall".to_owned(), shape: SensorShape::Grid(grid) });
    let truth_lx = vec![4.0 * PI * 100.0 / (24.0 * (1.0 - WALLS)); 4];
    let why = "flux over area over 1 - reflectance, by symmetry in all quarters of a wall";
    KnownScene {
        name: "walls",
        why,
        scene,
        hours: Vec::new(),
        truth_lx,
        estimator: EstimatorKind::Photon,
        rel_tol: [0.065, 0.09],
    }
}

/// The same of a polygon that shines as all lights do.
fn panel_lx(at: DVec3, n: DVec3, corners: &[DVec3]) -> f64 {
    polygon_lx(at, n, corners, LUMINANCE_CD_M2)
}

/// The panel's corners.
fn add_panel(scene: &mut Scene) -> [DVec3; 4] {
    let corners = PANEL.map(|[x, y]| DVec3::new(x, y, PANEL_Z_M));
    let material = add_material(scene, grey(0.0));
    let first = scene.mesh.triangles.len() as u32;
    add_quad(scene, corners, material);
    shine(scene, material, first, LUMINANCE_CD_M2);
    corners
}

/// A mirror in the plane of one x, its corners as (y, z); returns the corners of the panel's image
/// in it.
fn add_mirror(scene: &mut Scene, x_m: f64, corners: [[f64; 2]; 4]) -> [DVec3; 4] {
    let bsdf = Bsdf::Mirror(Mirror { reflectance: Rgb::grey(MIRROR) });
    let material = add_material(scene, bsdf);
    add_quad(scene, corners.map(|[y, z]| DVec3::new(x_m, y, z)), material);
    let mut image = PANEL.map(|[x, y]| DVec3::new(2.0 * x_m - x, y, PANEL_Z_M));
    image.reverse();
    image
}

/// Four places at z = 0, looking up.
fn add_places(scene: &mut Scene, at: [[f64; 2]; 4]) -> Vec<(DVec3, DVec3)> {
    let places: Vec<_> = at.iter().map(|&[x, y]| (DVec3::new(x, y, 0.0), DVec3::Z)).collect();
    scene.sensors.push(points(&places));
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unequal_points_get_nearly_the_same() {
        let truth_lx = unequal().truth_lx;
        let lowest_lx = truth_lx[0];
        let is_near = |lx: &f64| (1.0005..1.003).contains(&(lx / lowest_lx));
        assert!(truth_lx[1..].iter().all(is_near), "{truth_lx:?}");
    }

    /// Below the middle of a square of half side a at height a, the configuration factor is 4/pi
    /// times 1/sqrt 2 times atan(1/sqrt 2) (Howell's catalogue, B-3, four times).
    #[test]
    fn the_contour_integral_is_right_for_a_square() {
        let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let corners = corners.map(|[x, y]| DVec3::new(x, y, 1.0));
        let root = std::f64::consts::FRAC_1_SQRT_2;
        let factor = 4.0 / PI * root * libm::atan(root);
        let got = panel_lx(DVec3::ZERO, DVec3::Z, &corners);
        assert!((got / (PI * LUMINANCE_CD_M2 * factor) - 1.0).abs() < 1e-12, "{got}");
    }
}
