//! The yardstick: light walks connected to every sensor, as plain as can be.
//!
//! Scalar numbers, pseudo-random points, no weight windows, no code shared with the simulator:
//! the corridor and its niche are two boxes, and a walk is a few divisions. Walks keep what
//! absorption leaves and end by roulette; from each place where one lands, all sensors get their
//! light in closed form, and what hides the niche is one rectangle. The sensors are the middles of
//! the cells, which is easier than their means: no walk lands close to one.

use quasilux_benches::meshes::Numbers;
use rayon::prelude::*;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// Low and high corner of the corridor, and of the niche in its side.
const CORRIDOR: [[f64; 3]; 2] = [[0.0; 3], [30.0, 2.0, 2.5]];
const NICHE: [[f64; 3]; 2] = [[1.0, 2.0, 0.0], [2.0, 3.0, 1.0]];
const LIGHT: [f64; 3] = [1.5, 2.8, 0.8];
const INTENSITY_CD: f64 = 200.0;
const SENSORS: usize = 30;
/// A walk that carries less goes on by chance, with twice this.
const LITTLE: f64 = 0.1;

/// The walks of one replicate, and what they gave.
pub(crate) struct Walks {
    numbers: Numbers,
    sums: [f64; SENSORS],
    walks: u64,
    pub(crate) rays: u64,
}

/// A place where a walk landed.
#[derive(Clone, Copy)]
struct WalkVertex {
    at: [f64; 3],
    in_niche: bool,
    /// The normal: along this axis, up or down it.
    axis: usize,
    up: f64,
}

impl Walks {
    pub(crate) fn new(replicate: u64) -> Self {
        Self { numbers: Numbers(replicate << 48), sums: [0.0; SENSORS], walks: 0, rays: 0 }
    }

    /// Goes on with all replicates until each has this many walks.
    pub(crate) fn grow(replicates: &mut [Self], walks: u64) {
        replicates.par_iter_mut().for_each(|replicate| {
            (replicate.walks..walks).for_each(|_| replicate.walk());
            replicate.walks = walks;
        });
    }

    /// What each sensor got, in lx, straight light included.
    pub(crate) fn lx(&self) -> Vec<f64> {
        let of_a_walk = INTENSITY_CD * 4.0 * PI / self.walks as f64;
        (0..SENSORS).map(|sensor| straight_lx(sensor) + self.sums[sensor] * of_a_walk).collect()
    }

    fn walk(&mut self) {
        let height = 1.0 - 2.0 * self.numbers.next();
        let (sin, cos) = libm::sincos(TAU * self.numbers.next());
        let across = (1.0 - height * height).sqrt();
        let mut place = land(LIGHT, [across * cos, across * sin, height], true);
        let mut weight = 1.0;
        loop {
            self.rays += 1;
            // The ceilings of both boxes, and all else.
            weight *= if place.axis == 2 && place.up < 0.0 { 0.6 } else { 0.5 };
            for (sensor, sum) in self.sums.iter_mut().enumerate() {
                *sum += weight * FRAC_1_PI * given(&place, sensor);
            }
            if weight < LITTLE {
                if self.numbers.next() * 2.0 * LITTLE >= weight {
                    return;
                }
                weight = 2.0 * LITTLE;
            }
            place = self.fly_on(&place);
        }
    }

    /// By the cosine distribution.
    fn fly_on(&mut self, place: &WalkVertex) -> WalkVertex {
        let square = self.numbers.next();
        let (sin, cos) = libm::sincos(TAU * self.numbers.next());
        let mut direction = [0.0; 3];
        direction[place.axis] = place.up * (1.0 - square).sqrt();
        direction[(place.axis + 1) % 3] = square.sqrt() * cos;
        direction[(place.axis + 2) % 3] = square.sqrt() * sin;
        land(place.at, direction, place.in_niche)
    }
}

/// Where a flight ends; through the opening of the niche it goes on.
fn land(mut from: [f64; 3], direction: [f64; 3], mut in_niche: bool) -> WalkVertex {
    loop {
        let [low, high] = if in_niche { NICHE } else { CORRIDOR };
        let wall = |axis: usize| if direction[axis] > 0.0 { high[axis] } else { low[axis] };
        let steps = |axis: usize| (wall(axis) - from[axis]) / direction[axis];
        // Along an axis that it does not fly along it never arrives.
        let steps =
            [0, 1, 2].map(|axis| if direction[axis] == 0.0 { f64::MAX } else { steps(axis) });
        let axis = (0..3).min_by(|&a, &b| steps[a].total_cmp(&steps[b])).unwrap_or(0);
        let mut at = [0, 1, 2].map(|i| from[i] + steps[axis] * direction[i]);
        at[axis] = wall(axis);
        let is_through = axis == 1 && at[1] == NICHE[0][1] && (in_niche || is_open(at));
        if !is_through {
            return WalkVertex { at, in_niche, axis, up: -direction[axis].signum() };
        }
        (from, in_niche) = (at, !in_niche);
    }
}

/// Whether a place in the plane of the opening lies in it.
fn is_open([x, _, z]: [f64; 3]) -> bool {
    let [low, high] = NICHE;
    low[0] < x && x < high[0] && z < high[2]
}

fn from_sensor(sensor: usize, at: [f64; 3]) -> [f64; 3] {
    [at[0] - (sensor as f64 + 0.5), at[1] - 1.0, at[2]]
}

/// Whether a sensor sees a place of the niche.
fn sees(way: [f64; 3], at: [f64; 3]) -> bool {
    let part = (at[1] - NICHE[0][1]) / way[1];
    is_open([0, 1, 2].map(|axis| at[axis] - part * way[axis]))
}

/// `cos cos' / d^2`, in m^-2, where nothing hides the place.
fn given(place: &WalkVertex, sensor: usize) -> f64 {
    let way = from_sensor(sensor, place.at);
    let facing = -place.up * way[place.axis];
    if facing <= 0.0 || (place.in_niche && !sees(way, place.at)) {
        return 0.0;
    }
    let square = way.iter().map(|x| x * x).sum::<f64>();
    facing * way[2] / (square * square)
}

fn straight_lx(sensor: usize) -> f64 {
    let way = from_sensor(sensor, LIGHT);
    let square = way.iter().map(|x| x * x).sum::<f64>();
    if sees(way, LIGHT) { INTENSITY_CD * way[2] / (square * square.sqrt()) } else { 0.0 }
}
