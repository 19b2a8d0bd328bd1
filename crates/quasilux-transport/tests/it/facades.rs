//! Black rooms with a facade opposite: what the facade reflects through a small window is rare
//! among paths, and no interval may be without it.

use crate::images::add_panel;
use crate::outside::{Numbers, Room, outside, room_with_window};
use crate::scenes::diffuse;
use glam::DVec3;
use quasilux_scene::{Environment, Opening, Scene};
use quasilux_stats::deep;
use quasilux_transport::{EstimatorKind, Interval, Settings, simulate};
use std::f64::consts::TAU;

/// A wall that faces the window, lit by sky and ground.
struct Facade {
    corner: DVec3,
    width_m: f64,
    height_m: f64,
    reflectance: f64,
}

/// A black room with a view of a facade.
struct View {
    scene: Scene,
    environment: Environment,
    window: Opening,
    /// Of the room: rays from the facade that come in or hit its walls get nothing.
    size: DVec3,
    facade: Facade,
}

fn view(numbers: &mut Numbers) -> View {
    let Room { mut scene, window } = room_with_window(numbers, 0.0);
    let mut environment = outside(numbers);
    environment.openings.push(window);
    let facade = Facade {
        corner: DVec3::new(-20.0, numbers.within(-12.0, -3.0), 0.0),
        width_m: 45.0,
        height_m: numbers.within(2.0, 15.0),
        reflectance: numbers.within(0.1, 0.9),
    };
    let corners = scene.mesh.triangles.iter().flatten();
    let size = corners.map(|at| scene.mesh.positions[*at as usize]).fold(DVec3::ZERO, DVec3::max);
    let (u, v) = (DVec3::X * facade.width_m, DVec3::Z * facade.height_m);
    add_panel(&mut scene, facade.corner, u, v, diffuse(facade.reflectance));
    scene.environment = Some(environment.clone());
    View { scene, environment, window, size, facade }
}

impl Facade {
    /// Where a ray meets it.
    fn met(&self, from: DVec3, direction: DVec3) -> Option<DVec3> {
        let distance_m = (self.corner.y - from.y) / direction.y;
        let at = from + direction * distance_m;
        let on = at - self.corner;
        let is_on = (0.0..=self.width_m).contains(&on.x) && (0.0..=self.height_m).contains(&on.z);
        (distance_m > 0.0 && is_on).then_some(at)
    }
}

impl View {
    fn meets_room(&self, from: DVec3, direction: DVec3) -> bool {
        let [a, b] = [DVec3::ZERO, self.size].map(|corner| (corner - from) / direction);
        a.min(b).max_element().max(0.0) < a.max(b).min_element()
    }

    /// What a point gets through the window: of each of many parts of it, and of what the facade
    /// sees in one direction at random where that is seen in the part.
    fn expected(&self, [position, n]: [DVec3; 2], numbers: &mut Numbers) -> f64 {
        const N: usize = 400;
        let Opening { origin, u, v } = self.window;
        let across = u.cross(v);
        let mut sum = 0.0;
        for part in 0..N * N {
            let at = [part % N, part / N].map(|k| (k as f64 + numbers.next()) / N as f64);
            let way = origin + u * at[0] + v * at[1] - position;
            let direction = way.normalize();
            let cos = n.dot(direction).max(0.0);
            let lx_of_luminance = cos * across.dot(direction).abs() / way.length_squared();
            sum += lx_of_luminance * self.luminance(position, direction, numbers);
        }
        sum / (N * N) as f64
    }

    fn luminance(&self, from: DVec3, direction: DVec3, numbers: &mut Numbers) -> f64 {
        let Some(at) = self.facade.met(from, direction) else {
            return self.environment.luminance_cd_m2(direction);
        };
        // Towards the room, evenly over the projected hemisphere.
        let (radius, angle) = (numbers.next().sqrt(), TAU * numbers.next());
        let (sin, cos) = libm::sincos(angle);
        let (x, z) = (radius * cos, radius * sin);
        let on = DVec3::new(x, (1.0 - radius * radius).sqrt(), z);
        if self.meets_room(at, on) {
            return 0.0;
        }
        self.facade.reflectance * self.environment.luminance_cd_m2(on)
    }
}

/// What intervals say beside what is.
#[derive(Debug, Default)]
struct Count {
    known: u32,
    missed: u32,
    missed_by_far: u32,
}

impl Count {
    fn add(&mut self, found: Interval, expected_lx: f64) {
        let Some(half_width) = found.half_width else { return };
        let off = (found.value - expected_lx).abs();
        let known_lx = half_width + 2e-3 * expected_lx;
        self.known += 1;
        self.missed += u32::from(off > known_lx);
        self.missed_by_far += u32::from(off > 1.6 * known_lx);
    }
}

/// Runs of 2^10 samples at most, 2^14 in the deep variant: the fewer, the rarer are the paths that
/// meet the facade, but the wider the intervals. By 80 of 95 % a coverage of 81 % is found in 95 of
/// 100 cases, by 160 in the deep variant one of 86 %.
#[test]
fn no_interval_is_without_what_a_facade_reflects() {
    let max_samples = Some(if deep() { 1 << 14 } else { 1 << 10 });
    let (seeds, most) = if deep() { (40, 16) } else { (20, 10) };
    let estimators = [EstimatorKind::Path, EstimatorKind::Auto];
    let mut counts = [(); 2].map(|()| Count::default());
    for seed in 0..seeds {
        let seed = 100 + seed;
        let mut numbers = Numbers::from_seed(seed);
        let view = view(&mut numbers);
        let places = view.scene.sensors[0].points();
        let expected_lx: Vec<f64> = places
            .iter()
            .map(|place| view.expected([place.position, place.normal], &mut numbers))
            .collect();
        for (estimator, count) in estimators.iter().zip(&mut counts) {
            let settings = Settings {
                estimator: *estimator,
                rel_tol: 0.01,
                abs_tol_lx: 0.3,
                max_samples,
                seed,
                ..Settings::default()
            };
            let found = simulate(&view.scene, &settings, &mut ()).point_intervals(0);
            for (found, expected_lx) in found.into_iter().zip(&expected_lx) {
                count.add(found, *expected_lx);
            }
        }
    }
    // Of 80 intervals of 95 %, 4 miss on average, and 10 once in two hundred; of 160, 8 and 16.
    for count in counts {
        let Count { known, missed, missed_by_far } = count;
        let least = 15 * seeds as u32 / 4;
        assert!(known > least && missed < most && missed_by_far < 2, "{count:?}");
    }
}

/// Where no bounce counts, walls are dark, and what hides all of the sky leaves 0 lx for sure.
#[test]
fn without_bounces_hidden_skies_are_dark() {
    let mut dark = 0;
    for seed in 100..110 {
        let View { scene, .. } = view(&mut Numbers::from_seed(seed));
        let settings = Settings {
            estimator: EstimatorKind::Path,
            max_bounces: Some(0),
            max_samples: Some(1 << 9),
            seed,
            ..Settings::default()
        };
        for found in simulate(&scene, &settings, &mut ()).point_intervals(0) {
            dark += u32::from(found.value == 0.0);
            assert!(found.value > 0.0 || found.half_width == Some(0.0), "{seed}: {found:?}");
        }
    }
    assert!(dark > 0);
}
