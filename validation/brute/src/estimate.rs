//! Means and errors from independent batches.

use crate::path::World;
use crate::random::Xoshiro;
use crate::scene::Scene;
use rayon::prelude::*;

/// Batches of each sensor: the spread of their means gives the error.
const BATCHES: u64 = 64;
/// Paths of a batch in the first round; then the number doubles.
const FIRST_PATHS: u64 = 64;
/// Most paths of a batch in a round, so that limits are heeded.
const MAX_PATHS: u64 = 1024;

/// What is known of one sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The mean in lx.
    pub lx: f64,
    /// Its standard error in lx.
    pub standard_error_lx: f64,
    /// The largest contribution of a single path over the sum of all: near 1 where chance rules.
    pub largest_share: f64,
    /// Paths behind it.
    pub paths: u64,
}

/// When enough is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Standard error over the mean that is enough.
    pub relative_error: f64,
    /// Most paths of a sensor.
    pub paths: u64,
}

/// A batch of one sensor.
#[derive(Clone)]
struct Batch {
    random: Xoshiro,
    sum_lx: f64,
    largest_lx: f64,
    paths: u64,
}

/// All batches of one sensor.
struct Batches {
    sensor: usize,
    /// What point lights give directly: no sampling.
    direct_lx: f64,
    batches: Vec<Batch>,
}

/// Traces so many paths for each sensor, rounded up to full batches.
#[must_use]
pub fn solve(scene: &Scene, paths_per_sensor: u64, seed: u64) -> Vec<Estimate> {
    let world = World::new(scene);
    let mut all = Batches::start(&world, seed);
    let paths = paths_per_sensor.div_ceil(BATCHES);
    all.iter_mut().for_each(|batches| batches.trace(&world, paths));
    all.iter().map(Batches::estimate).collect()
}

/// Traces until all sensors are within the limits, or `may_go_on` says no.
#[must_use]
pub fn solve_until(
    scene: &Scene,
    limits: Limits,
    seed: u64,
    mut may_go_on: impl FnMut() -> bool,
) -> Vec<Estimate> {
    let world = World::new(scene);
    let mut all = Batches::start(&world, seed);
    let mut paths = FIRST_PATHS;
    loop {
        let is_open = |batches: &Batches| {
            let Estimate { lx, standard_error_lx, paths, .. } = batches.estimate();
            let is_known = lx > 0.0 && standard_error_lx <= limits.relative_error * lx;
            paths == 0 || (!is_known && paths < limits.paths)
        };
        let mut is_done = true;
        for batches in all.iter_mut().filter(|batches| is_open(batches)) {
            batches.trace(&world, paths);
            is_done = false;
        }
        if is_done || !may_go_on() {
            return all.iter().map(Batches::estimate).collect();
        }
        paths = (2 * paths).min(MAX_PATHS);
    }
}

/// What point lights give to each sensor without any bounce, in lx.
#[must_use]
pub fn direct_point_lx(scene: &Scene) -> Vec<f64> {
    let world = World::new(scene);
    scene.sensors.iter().map(|sensor| world.direct_point_lx(sensor)).collect()
}

impl Batches {
    fn start(world: &World, seed: u64) -> Vec<Self> {
        let sensors = world.scene.sensors.iter().enumerate();
        let own = |(sensor, place)| {
            let batch = |batch: u64| Batch {
                random: Xoshiro::new(seed, sensor as u64 * BATCHES + batch),
                sum_lx: 0.0,
                largest_lx: 0.0,
                paths: 0,
            };
            let batches = (0..BATCHES).map(batch).collect();
            Self { sensor, direct_lx: world.direct_point_lx(place), batches }
        };
        sensors.map(own).collect()
    }

    fn trace(&mut self, world: &World, paths: u64) {
        let sensor = &world.scene.sensors[self.sensor];
        self.batches.par_iter_mut().for_each(|batch| {
            for _ in 0..paths {
                let lx = world.path_lx(sensor, &mut batch.random);
                batch.sum_lx += lx;
                batch.largest_lx = batch.largest_lx.max(lx);
            }
            batch.paths += paths;
        });
    }

    fn estimate(&self) -> Estimate {
        let means: Vec<f64> = self.batches.iter().map(|b| b.sum_lx / b.paths as f64).collect();
        let n = means.len() as f64;
        let mean = means.iter().sum::<f64>() / n;
        let squares: f64 = means.iter().map(|x| (x - mean) * (x - mean)).sum();
        let paths = self.batches.iter().map(|batch| batch.paths).sum();
        let lx = mean + self.direct_lx;
        let largest_lx = self.batches.iter().fold(0.0, |lx: f64, batch| lx.max(batch.largest_lx));
        Estimate {
            lx,
            standard_error_lx: (squares / (n * (n - 1.0))).sqrt(),
            largest_share: largest_lx / (lx * paths as f64),
            paths,
        }
    }
}
