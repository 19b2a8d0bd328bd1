//! Runs until enough is known.

use crate::estimate::Estimate;
use crate::mode::Mode;
use crate::run::Run;
use crate::scene::{Scene, Source};
use crate::world::World;

/// Paths of a batch in the first round; then the number doubles.
const FIRST_PATHS: u64 = 64;
/// Most paths of a batch in a round, so that limits are heeded.
const MAX_PATHS: u64 = 1024;
/// A part of the light whose error is below this share of the error that is allowed may rest.
const RESTING_SHARE: f64 = 0.2;

/// Some of the light of a scene, and how it is found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// What shines.
    pub sources: Vec<Source>,
    /// How its light is found.
    pub mode: Mode,
}

/// When enough is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Standard error over the mean that is enough.
    pub relative_error: f64,
    /// Most paths of a sensor, or walks of all, in each part.
    pub paths: u64,
}

/// Traces this many paths for each sensor, rounded up to full batches.
#[must_use]
pub fn solve(scene: &Scene, paths_per_sensor: u64, seed: u64) -> Vec<Estimate> {
    solve_by(scene, Mode::Paths, paths_per_sensor, seed)
}

/// The same in any mode: paths for each sensor, or walks for all.
#[must_use]
pub fn solve_by(scene: &Scene, mode: Mode, paths: u64, seed: u64) -> Vec<Estimate> {
    let world = World::new(scene);
    let mut run = Run::new(&world, mode, seed);
    run.trace(paths.div_ceil(Run::BATCHES), |_| true);
    run.estimates()
}

/// Traces paths until all sensors are within the limits, or `may_go_on` says no.
#[must_use]
pub fn solve_until(
    scene: &Scene,
    limits: Limits,
    seed: u64,
    may_go_on: impl FnMut() -> bool,
) -> Vec<Estimate> {
    solve_by_until(scene, Mode::Paths, limits, seed, may_go_on)
}

/// The same in any mode.
#[must_use]
pub fn solve_by_until(
    scene: &Scene,
    mode: Mode,
    limits: Limits,
    seed: u64,
    may_go_on: impl FnMut() -> bool,
) -> Vec<Estimate> {
    solve_parts(scene, &[Part { sources: scene.sources(), mode }], limits, seed, may_go_on)
}

/// The sum of parts, each found by its own mode, until all sensors are within the limits together.
/// A source that is in no part does not shine.
#[must_use]
pub fn solve_parts(
    scene: &Scene,
    parts: &[Part],
    limits: Limits,
    seed: u64,
    mut may_go_on: impl FnMut() -> bool,
) -> Vec<Estimate> {
    let scenes: Vec<Scene> = parts.iter().map(|part| scene.lit_by(&part.sources)).collect();
    let worlds: Vec<World> = scenes.iter().map(World::new).collect();
    let runs = worlds.iter().zip(parts).zip(0..);
    let mut runs: Vec<Run> = runs
        .map(|((world, part), number)| Run::new(world, part.mode, seed ^ (number << 48)))
        .collect();
    let mut paths = FIRST_PATHS;
    loop {
        let sum = sum(scene.sensors.len(), &runs);
        let is_open = |number: usize| {
            let Estimate { lx, standard_error_lx, .. } = sum[number];
            !(lx > 0.0 && standard_error_lx <= limits.relative_error * lx)
        };
        let mut is_done = true;
        for run in &mut runs {
            let own = run.estimates();
            let asks_more = |number: usize| {
                let Estimate { standard_error_lx, paths, .. } = own[number];
                let allowed_lx = RESTING_SHARE * limits.relative_error * sum[number].lx;
                let rests = standard_error_lx > 0.0 && standard_error_lx <= allowed_lx;
                paths == 0 || (is_open(number) && !rests && paths < limits.paths)
            };
            is_done &= !run.trace(paths, asks_more);
        }
        if is_done || !may_go_on() {
            return self::sum(scene.sensors.len(), &runs);
        }
        paths = (2 * paths).min(MAX_PATHS);
    }
}

fn sum(sensors: usize, runs: &[Run]) -> Vec<Estimate> {
    let mut sum = vec![Estimate::default(); sensors];
    for run in runs {
        for (all, own) in sum.iter_mut().zip(run.estimates()) {
            *all = all.plus(&own);
        }
    }
    sum
}

/// What point lights give to the middle of each sensor without any bounce, in lx.
#[must_use]
pub fn direct_point_lx(scene: &Scene) -> Vec<f64> {
    let world = World::new(scene);
    scene.sensors.iter().map(|sensor| world.direct_point_lx(sensor)).collect()
}
