//! Rooms of many lights, of which a few are drawn as candidates, against the sums of rooms in which
//! the same lights hang a few at a time, and all are asked.

use crate::scenes::{diffuse, points, room};
use crate::spotlight::spotlight;
use glam::{DMat3, DVec3};
use quasilux_photometry::{LuminousShape, Solid};
use quasilux_scene::{Light, Scene};
use quasilux_stats::{SplitMix64, deep};
use quasilux_transport::{EstimatorKind, Interval, Settings, simulate};

/// Fewer than are drawn from.
const GROUP: usize = 10;
const GROUPS: usize = 4;

/// A place in a box.
fn place(numbers: &mut SplitMix64, low: DVec3, high: DVec3) -> DVec3 {
    low + DVec3::new(numbers.uniform(), numbers.uniform(), numbers.uniform()) * (high - low)
}

/// A room of 8 m x 6 m x 3 m under spots that look anywhere downward, some weak and some strong.
fn hall(numbers: &mut SplitMix64, has_area: bool) -> Scene {
    let mut scene = room(DVec3::new(8.0, 6.0, 3.0), diffuse(0.5));
    scene.lights = (0..GROUP * GROUPS)
        .map(|_| {
            let position = place(numbers, DVec3::new(0.3, 0.3, 2.0), DVec3::new(7.7, 5.7, 2.9));
            let Light::Luminaire(mut luminaire) = spotlight(position) else { unreachable!() };
            let turn = std::f64::consts::TAU * numbers.uniform();
            luminaire.world_from_luminaire =
                DMat3::from_rotation_z(turn) * DMat3::from_rotation_x(1.2 * numbers.uniform());
            luminaire.dimming = libm::exp(3.0 * numbers.uniform());
            if has_area {
                luminaire.shape = LuminousShape::new(Solid::Cuboid, DVec3::new(0.3, 0.1, 0.0));
            }
            Light::Luminaire(luminaire)
        })
        .collect();
    let normals = [DVec3::Z, DVec3::NEG_Z, DVec3::new(0.6, 0.0, 0.8), DVec3::X];
    let places: Vec<(DVec3, DVec3)> = normals
        .into_iter()
        .map(|normal| (place(numbers, DVec3::splat(0.3), DVec3::new(7.7, 5.7, 1.5)), normal))
        .collect();
    scene.sensors = vec![points("places", &places)];
    scene
}

fn intervals(scene: &Scene, seed: u64) -> Vec<Interval> {
    let settings = Settings {
        estimator: EstimatorKind::Path,
        max_samples: Some(1 << 11),
        rel_tol: 0.0,
        seed,
        ..Settings::default()
    };
    simulate(scene, &settings, &mut ()).point_intervals(0)
}

/// Two rooms, six in the deep variant: in each, half-widths of 5 % at most, so that an error of 11
/// % at any place is found.
#[test]
fn many_lights_give_what_they_give_by_the_few() {
    let (mut far, mut compared) = (0, 0);
    let rooms = if deep() { 6 } else { 2 };
    for seed in 0..rooms {
        let whole = hall(&mut SplitMix64::new(1000 * seed), seed % 2 == 1);
        let together = intervals(&whole, seed);
        let parts: Vec<Vec<Interval>> = whole
            .lights
            .chunks(GROUP)
            .map(|few| intervals(&Scene { lights: few.to_vec(), ..whole.clone() }, seed + 50))
            .collect();
        for (place, found) in together.iter().enumerate() {
            let expected_lx: f64 = parts.iter().map(|part| part[place].value).sum();
            // Narrow beams that few paths meet leave some places without an interval.
            let half_widths: Option<Vec<f64>> =
                parts.iter().map(|part| part[place].half_width).chain([found.half_width]).collect();
            let Some(half_widths) = half_widths else { continue };
            let joint_lx = half_widths.iter().map(|width| width * width).sum::<f64>().sqrt();
            let off = (found.value - expected_lx) / joint_lx;
            assert!(off.abs() < 2.2, "seed {seed}, place {place}: {found:?}, {expected_lx}");
            assert!(joint_lx < 0.05 * expected_lx, "{found:?} of {joint_lx} says too little");
            compared += 1;
            far += usize::from(off.abs() > 1.0);
        }
    }
    assert!(compared >= if deep() { 10 } else { 4 }, "only {compared} places have intervals");
    assert!(far <= compared / 5, "{far} of {compared} differ by more than a half-width");
}
