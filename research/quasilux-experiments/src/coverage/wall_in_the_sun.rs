//! A wall in the open, and what places before it get of the sky, of the ground and of the wall: at
//! a moment, and over hours.
//!
//! All of the wall sees the same half of the sky and of the ground and the same sun, so that it has
//! one luminance, and what it gives is a contour integral.

use super::known_scene::{KnownScene, polygon_lx};
use crate::building::{add_material, add_quad, grey, points};
use glam::DVec3;
use quasilux_scene::{Environment, Scene, Sun};
use quasilux_sky::{CieType, Distribution, Sky, SkyLevel, SkyPoint, WeatherSky};
use quasilux_transport::EstimatorKind;
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// Corners in m, counter-clockwise as its south side shows them.
const WALL: [DVec3; 4] = [
    DVec3::new(-2.0, 3.0, 0.0),
    DVec3::new(2.0, 3.0, 0.0),
    DVec3::new(2.0, 3.0, 3.0),
    DVec3::new(-2.0, 3.0, 3.0),
];
const WALL_REFLECTANCE: f64 = 0.6;
const GROUND_REFLECTANCE: f64 = 0.2;
/// Places on the ground that face it.
const PLACES: [DVec3; 2] = [DVec3::new(0.3, 1.4, 0.0), DVec3::new(-1.1, 0.2, 0.0)];
/// Rows of a quadrature, and twice as many columns.
const ROWS: usize = 200;

/// Numbers of CIE skies, altitudes and azimuths of the sun, illuminances of sky and sun across its
/// rays in lx. The sun is in the south, where it lights the wall and no place.
const HOURS: [[f64; 5]; 8] = [
    [12.0, 38.0, 171.0, 14_000.0, 71_000.0],
    [1.0, 22.0, 140.0, 9000.0, 0.0],
    [13.0, 17.0, 122.0, 8000.0, 38_000.0],
    [7.0, 51.0, 201.0, 26_000.0, 31_000.0],
    [4.0, 30.0, 225.0, 15_000.0, 2000.0],
    [11.0, 61.0, 158.0, 19_000.0, 80_000.0],
    [15.0, 12.0, 236.0, 7000.0, 22_000.0],
    [5.0, 8.0, 112.0, 2500.0, 0.0],
];

/// At the first of the hours.
pub(super) fn moment() -> KnownScene {
    let mut scene = wall();
    let hour = hours().swap_remove(0);
    let lx = hour.sun_normal_illuminance_lx;
    let sun = Some(Sun { centre: hour.sun, normal_illuminance_lx: lx });
    scene.environment = Some(Environment { sun, ..environment(&hour) });
    KnownScene {
        name: "wall",
        why: "a contour integral for a wall in the sun, a quadrature for the sky",
        truth_lx: PLACES.iter().map(|place| truth_lx(*place, &hour)).collect(),
        scene,
        hours: Vec::new(),
        estimator: EstimatorKind::Path,
        rel_tol: [0.004, 0.013],
    }
}

/// At all of them: of each place, hour by hour.
pub(super) fn year() -> KnownScene {
    let mut scene = wall();
    let hours = hours();
    scene.environment = Some(environment(&hours[0]));
    let place = |place: &DVec3| hours.iter().map(|hour| truth_lx(*place, hour)).collect::<Vec<_>>();
    KnownScene {
        name: "hours",
        why: "the same for hours of a year, each a point",
        truth_lx: PLACES.iter().flat_map(place).collect(),
        scene,
        hours,
        estimator: EstimatorKind::Path,
        rel_tol: [0.01, 0.024],
    }
}

fn wall() -> Scene {
    let mut scene = Scene::default();
    let material = add_material(&mut scene, grey(WALL_REFLECTANCE));
    add_quad(&mut scene, WALL, material);
    scene.sensors.push(points(&PLACES.map(|place| (place, DVec3::Y))));
    scene
}

fn hours() -> Vec<WeatherSky> {
    let hour = |[kind, altitude_deg, azimuth_deg, sky_lx, sun_lx]: [f64; 5]| {
        let sun = SkyPoint { altitude_deg, azimuth_deg };
        let kind = CieType::new(kind as i64).expect("a number of a CIE sky");
        let level = SkyLevel::HorizontalIlluminance { lx: sky_lx };
        let sky = Sky::new(Distribution::cie(kind, sun), level).expect("a level of a sky");
        WeatherSky { sky, sun, sun_normal_illuminance_lx: sun_lx }
    };
    HOURS.map(hour).to_vec()
}

fn environment(hour: &WeatherSky) -> Environment {
    Environment {
        sky: hour.sky.clone(),
        sun: None,
        ground_reflectance: GROUND_REFLECTANCE,
        north_deg: 0.0,
        openings: Vec::new(),
    }
}

/// What a place gets that faces the wall, which is to the north of it.
fn truth_lx(place: DVec3, hour: &WeatherSky) -> f64 {
    let half_of_ground_lx = 0.5 * GROUND_REFLECTANCE * hour.horizontal_illuminance_lx();
    let sun = DVec3::from_array(hour.sun.to_direction());
    let sun_lx = hour.sun_normal_illuminance_lx * DVec3::NEG_Y.dot(sun);
    let wall_lx = half_of_sky_lx(&hour.sky, DVec3::NEG_Y) + half_of_ground_lx + sun_lx;
    let hidden_lx = behind_wall_lx(&hour.sky, place);
    let luminance_cd_m2 = FRAC_1_PI * WALL_REFLECTANCE * wall_lx;
    half_of_sky_lx(&hour.sky, DVec3::Y) - hidden_lx
        + half_of_ground_lx
        + polygon_lx(place, DVec3::Y, &WALL, luminance_cd_m2)
}

/// What the sky gives to a vertical plane, by midpoints in altitude and azimuth.
fn half_of_sky_lx(sky: &Sky, n: DVec3) -> f64 {
    let (across, step) = (n.cross(DVec3::Z), FRAC_PI_2 / ROWS as f64);
    let mut sum = 0.0;
    for row in 0..ROWS {
        let (sine, cosine) = libm::sincos((row as f64 + 0.5) * step);
        for column in 0..2 * ROWS {
            let (aside, ahead) = libm::sincos((column as f64 + 0.5) * step - FRAC_PI_2);
            let direction = (n * ahead + across * aside) * cosine + DVec3::Z * sine;
            sum += sky.luminance_cd_m2(direction.to_array()) * n.dot(direction) * cosine;
        }
    }
    sum * step * step
}

/// What it would give to a place through the wall, by midpoints on the wall.
fn behind_wall_lx(sky: &Sky, place: DVec3) -> f64 {
    let [corner, u, v] = [WALL[0], WALL[1] - WALL[0], WALL[3] - WALL[0]];
    let part = |k: usize| (k as f64 + 0.5) / ROWS as f64;
    let mut sum = 0.0;
    for row in 0..ROWS {
        for column in 0..ROWS {
            let way = corner + u * part(column) + v * part(row) - place;
            let direction = way.normalize();
            let cos = direction.y;
            sum += sky.luminance_cd_m2(direction.to_array()) * cos * cos / way.length_squared();
        }
    }
    sum * u.length() * v.length() / (ROWS * ROWS) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Under an even sky both quadratures have closed forms.
    #[test]
    fn quadratures_are_right_under_an_even_sky() {
        let level = SkyLevel::ZenithLuminance { cd_m2: 300.0 };
        let sky = Sky::new(Distribution::uniform(), level).unwrap();
        let half_lx = half_of_sky_lx(&sky, DVec3::NEG_Y);
        assert!((half_lx / (300.0 * FRAC_PI_2) - 1.0).abs() < 1e-4, "{half_lx}");
        for place in PLACES {
            let wall_lx = behind_wall_lx(&sky, place) / polygon_lx(place, DVec3::Y, &WALL, 300.0);
            assert!((wall_lx - 1.0).abs() < 1e-4, "{wall_lx}");
        }
    }
}
