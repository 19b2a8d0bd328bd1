//! Windows of Klems matrices under an even sky and in the sun, in black rooms: against sums over
//! patches of the matrix and midpoints of the window, for facets that face either way.

use crate::images::add_panel;
use crate::measured::measured;
use crate::scenes::{diffuse, points, room};
use glam::DVec3;
use quasilux_bsdf::{AngleBasis, BandDefinition, Distribution, KlemsTable, ScatteringMode, Side};
use quasilux_scene::{Bsdf, Environment, Scene, Sun};
use quasilux_sky::{Distribution as SkyDistribution, Sky, SkyLevel, SkyPoint};
use quasilux_transport::{EstimatorKind, Settings, simulate};
use std::f64::consts::{PI, TAU};

/// Bands by their upper ends in degrees, and patches in each.
const BANDS: [(f64, usize); 3] = [(25.0, 1), (55.0, 4), (90.0, 8)];
const PATCHES: usize = 13;

const SIZE: DVec3 = DVec3::new(3.0, 4.0, 2.5);

struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Values in sr^-1 by incident and exit patch.
type Matrix = [[f64; PATCHES]; PATCHES];

/// Less than all light passes: projected solid angles add up to pi.
fn matrix(numbers: &mut Numbers) -> Matrix {
    std::array::from_fn(|_| std::array::from_fn(|_| 0.3 * numbers.next()))
}

fn distribution(matrix: &Matrix) -> Distribution {
    let bands = BANDS.map(|(upper_deg, patches)| BandDefinition::new(upper_deg, patches));
    let basis = AngleBasis::new("made up", &bands).unwrap();
    let values = matrix.iter().flatten().copied().collect();
    Distribution::Klems(KlemsTable::new(basis.clone(), basis, values).unwrap())
}

/// The patch of light that goes on at a polar angle and an azimuth, the first of a band around
/// azimuth 0, and its projected solid angle.
fn patch(cos: f64, azimuth_rad: f64) -> usize {
    let theta_deg = libm::acos(cos.clamp(0.0, 1.0)).to_degrees();
    let mut first = 0;
    for (upper_deg, patches) in BANDS {
        if theta_deg < upper_deg || upper_deg == 90.0 {
            let turn = (azimuth_rad / TAU + 1.0 + 0.5 / patches as f64) * patches as f64;
            return first + turn as usize % patches;
        }
        first += patches;
    }
    unreachable!("bands end at 90 degrees")
}

fn projected_sr() -> Vec<f64> {
    let mut lower = 0.0;
    BANDS
        .iter()
        .flat_map(|&(upper_deg, patches)| {
            let sin = libm::sin(upper_deg.to_radians());
            let sr = PI * (sin * sin - lower) / patches as f64;
            lower = sin * sin;
            vec![sr; patches]
        })
        .collect()
}

/// A black room whose wall y = 0 is a window, with the front of its facets outdoors or indoors;
/// the other side's table is another one, which must not matter.
fn scene(sheet: Bsdf, is_front_outdoors: bool) -> Scene {
    let mut scene = room(SIZE, diffuse(0.0));
    scene.mesh.triangles.drain(8..10);
    scene.mesh.material_of.truncate(10);
    scene.mesh.object_of.truncate(10);
    let (across, up) = (DVec3::X * SIZE.x, DVec3::Z * SIZE.z);
    let [u, v] = if is_front_outdoors { [across, up] } else { [up, across] };
    add_panel(&mut scene, DVec3::ZERO, u, v, sheet);
    let places = [
        (DVec3::new(1.2, 0.9, 0.0), DVec3::Z),
        (DVec3::new(0.4, 3.0, 0.8), DVec3::NEG_Y),
        (DVec3::new(3.0, 1.5, 1.4), DVec3::NEG_X),
        (DVec3::new(2.0, 2.0, 2.5), DVec3::NEG_Z),
    ];
    scene.sensors.push(points("places", &places));
    scene
}

/// The luminance of the window in the direction `away` from it, by that of each exit patch.
fn luminance(of_patch: &[f64], away: DVec3, is_front_outdoors: bool) -> f64 {
    // Seen from the back, y upward, x is on the right.
    let x = if is_front_outdoors { DVec3::NEG_X } else { DVec3::X };
    of_patch[patch(away.y, libm::atan2(away.z, away.dot(x)))]
}

fn assert_room(scene: &Scene, of_patch: &[f64], is_front_outdoors: bool) {
    let settings = Settings {
        estimator: EstimatorKind::Path,
        rel_tol: 0.004,
        max_samples: Some(1 << 14),
        ..Settings::default()
    };
    let found = simulate(scene, &settings, &mut ()).point_intervals(0);
    for (place, interval) in scene.sensors[0].points().iter().zip(found) {
        const N: usize = 600;
        let mut expected = 0.0;
        for i in 0..N * N {
            let part = |k: usize| (k as f64 + 0.5) / N as f64;
            let at = DVec3::new(part(i % N) * SIZE.x, 0.0, part(i / N) * SIZE.z);
            let way = place.position - at;
            let away = way.normalize();
            let cos = place.normal.dot(-away).max(0.0);
            let cd_m2 = luminance(of_patch, away, is_front_outdoors);
            expected += cd_m2 * cos * away.y / way.length_squared();
        }
        expected *= SIZE.x * SIZE.z / (N * N) as f64;
        let off = (interval.value - expected).abs();
        let allowed = 2.0 * interval.half_width.unwrap_or(0.0) + 0.002 * expected;
        assert!(off <= allowed && allowed < 0.03 * expected, "{interval:?} not {expected}");
    }
}

fn sheet(matrix: &Matrix, other: &Matrix, is_front_outdoors: bool) -> Bsdf {
    let [front, back] = if is_front_outdoors { [matrix, other] } else { [other, matrix] };
    measured([
        (Side::Front, ScatteringMode::Transmission, distribution(front)),
        (Side::Back, ScatteringMode::Transmission, distribution(back)),
    ])
}

fn environment(cd_m2: f64, sun: Option<Sun>) -> Environment {
    let level = SkyLevel::ZenithLuminance { cd_m2 };
    Environment {
        sky: Sky::new(SkyDistribution::uniform(), level).unwrap(),
        sun,
        ground_reflectance: if sun.is_some() { 0.0 } else { 1.0 },
        north_deg: 0.0,
        openings: Vec::new(),
    }
}

#[test]
fn an_even_sky_shines_through_by_the_sum_over_incident_patches() {
    let mut numbers = Numbers(5);
    for is_front_outdoors in [true, false] {
        let (matrix, other) = (matrix(&mut numbers), matrix(&mut numbers));
        let mut scene = scene(sheet(&matrix, &other, is_front_outdoors), is_front_outdoors);
        scene.environment = Some(environment(1000.0, None));
        let projected_sr = projected_sr();
        let of_exit = |exit: usize| -> f64 {
            (0..PATCHES).map(|i| 1000.0 * matrix[i][exit] * projected_sr[i]).sum()
        };
        let of_patch: Vec<f64> = (0..PATCHES).map(of_exit).collect();
        assert_room(&scene, &of_patch, is_front_outdoors);
    }
}

#[test]
fn the_sun_shines_through_once() {
    let mut numbers = Numbers(6);
    for is_front_outdoors in [true, false] {
        for (altitude_deg, azimuth_deg) in [(35.0, 165.0_f64), (20.0, 230.0), (5.0, 185.0)] {
            let (matrix, other) = (matrix(&mut numbers), matrix(&mut numbers));
            let mut scene = scene(sheet(&matrix, &other, is_front_outdoors), is_front_outdoors);
            let centre = SkyPoint { altitude_deg, azimuth_deg };
            let sun = Sun { centre, normal_illuminance_lx: 50_000.0 };
            scene.environment = Some(environment(0.0, Some(sun)));
            let (altitude, azimuth) = (altitude_deg.to_radians(), azimuth_deg.to_radians());
            let level = libm::cos(altitude);
            let onward = -DVec3::new(
                libm::sin(azimuth) * level,
                libm::cos(azimuth) * level,
                libm::sin(altitude),
            );
            let x = if is_front_outdoors { DVec3::NEG_X } else { DVec3::X };
            let incident = patch(onward.y, libm::atan2(onward.z, onward.dot(x)));
            let lx = 50_000.0 * onward.y;
            let of_patch: Vec<f64> = matrix[incident].iter().map(|f| f * lx).collect();
            assert_room(&scene, &of_patch, is_front_outdoors);
        }
    }
}
