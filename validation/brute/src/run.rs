//! Paths or walks of one world, in batches.

use crate::estimate::Estimate;
use crate::mode::Mode;
use crate::random::Xoshiro;
use crate::start::Starts;
use crate::world::World;
use rayon::prelude::*;

/// Batches of each sensor: the spread of their means gives the error.
const BATCHES: usize = 64;

/// What a run has found so far.
pub(crate) struct Run<'w> {
    world: &'w World<'w>,
    mode: Mode,
    starts: Starts,
    /// Of each sensor, what point lights give directly: no sampling.
    direct_lx: Vec<f64>,
    /// Of paths, by sensor and batch; of walks, by batch.
    randoms: Vec<Xoshiro>,
    /// By sensor and batch.
    sums: Vec<[Sum; BATCHES]>,
}

/// A batch of one sensor.
#[derive(Clone, Copy, Default)]
struct Sum {
    lx: f64,
    largest_lx: f64,
    paths: u64,
}

impl Sum {
    fn add(&mut self, lx: f64) {
        self.lx += lx;
        self.largest_lx = self.largest_lx.max(lx);
        self.paths += 1;
    }

    fn join(&mut self, other: &Self) {
        self.lx += other.lx;
        self.largest_lx = self.largest_lx.max(other.largest_lx);
        self.paths += other.paths;
    }
}

impl<'w> Run<'w> {
    pub(crate) const BATCHES: u64 = BATCHES as u64;

    pub(crate) fn new(world: &'w World<'w>, mode: Mode, seed: u64) -> Self {
        let sensors = &world.scene.sensors;
        let streams = if mode == Mode::Paths { sensors.len().max(1) * BATCHES } else { BATCHES };
        let direct_lx = sensors.iter().map(|sensor| {
            let is_known = !sensor.has_area() && !mode.counts_direct(sensor);
            if is_known { world.direct_point_lx(sensor) } else { 0.0 }
        });
        Self {
            world,
            mode,
            starts: Starts::new(world),
            direct_lx: direct_lx.collect(),
            randoms: (0..streams as u64).map(|stream| Xoshiro::new(seed, stream)).collect(),
            sums: vec![[Sum::default(); BATCHES]; sensors.len()],
        }
    }

    /// Traces this many more of each batch, paths for the sensors that ask for them or walks if one
    /// does; tells whether there was any.
    pub(crate) fn trace(&mut self, paths: u64, asks: impl Fn(usize) -> bool) -> bool {
        let asking: Vec<usize> = (0..self.sums.len()).filter(|&number| asks(number)).collect();
        if asking.is_empty() {
            return false;
        }
        if self.mode == Mode::Paths {
            asking.iter().for_each(|&sensor| self.trace_paths(sensor, paths));
        } else {
            self.walk(paths);
        }
        true
    }

    fn trace_paths(&mut self, number: usize, paths: u64) {
        let (world, sensor) = (self.world, &self.world.scene.sensors[number]);
        let randoms = &mut self.randoms[number * BATCHES..(number + 1) * BATCHES];
        let batches = self.sums[number].par_iter_mut().zip(randoms);
        batches.for_each(|(sum, random)| {
            for _ in 0..paths {
                sum.add(world.path_lx(sensor, random));
            }
        });
    }

    fn walk(&mut self, walks: u64) {
        let (world, starts, mode) = (self.world, &self.starts, self.mode);
        let sensors = self.sums.len();
        let batch = |random: &mut Xoshiro| {
            let mut sums = vec![Sum::default(); sensors];
            let mut found_lx = vec![0.0; sensors];
            for _ in 0..walks {
                found_lx.fill(0.0);
                world.walk(starts, mode, random, &mut found_lx);
                sums.iter_mut().zip(&found_lx).for_each(|(sum, &lx)| sum.add(lx));
            }
            sums
        };
        let found: Vec<Vec<Sum>> = self.randoms.par_iter_mut().map(batch).collect();
        for (batch, sums) in found.iter().enumerate() {
            for (all, own) in self.sums.iter_mut().zip(sums) {
                all[batch].join(own);
            }
        }
    }

    /// What is known of each sensor; of those without any path, what needs none.
    pub(crate) fn estimates(&self) -> Vec<Estimate> {
        self.sums.iter().zip(&self.direct_lx).map(|(sums, &lx)| estimate(sums, lx)).collect()
    }
}

fn estimate(sums: &[Sum], direct_lx: f64) -> Estimate {
    let paths: u64 = sums.iter().map(|sum| sum.paths).sum();
    if paths == 0 {
        return Estimate { lx: direct_lx, ..Estimate::default() };
    }
    let means: Vec<f64> = sums.iter().map(|sum| sum.lx / sum.paths as f64).collect();
    let n = means.len() as f64;
    let mean = means.iter().sum::<f64>() / n;
    let squares: f64 = means.iter().map(|x| (x - mean) * (x - mean)).sum();
    let lx = mean + direct_lx;
    let largest_lx = sums.iter().fold(0.0, |lx: f64, sum| lx.max(sum.largest_lx));
    Estimate {
        lx,
        standard_error_lx: (squares / (n * (n - 1.0))).sqrt(),
        largest_share: if lx > 0.0 { largest_lx / (lx * paths as f64) } else { 0.0 },
        paths,
    }
}
