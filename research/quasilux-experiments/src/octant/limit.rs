//! From three meshes to the sphere: our estimator on each, and the limit where facets become small.
//!
//! What a mesh of n facets along an edge leaves is `E(n) = E + c / n^2 + d / n^4`, for facets
//! around a place keep their shape where n grows fourfold. Two meshes give `E = E(4 n) + (E(4 n) -
//! E(n)) / 15` (Richardson 1911), in each replicate by itself: the spread of replicates then is
//! that of the limit. A third mesh shows the order, and what is left.
//!
//! Light in mirrors is direct here, as in the paper, though it bounced: a black sphere tells what
//! comes so.

use super::sphere::Octant;
use crate::course::{Course, mean_interval};
use quasilux_transport::{Interval, Settings, simulate};
use std::time::Duration;

/// Meshes.
pub(super) const LEVELS: usize = 3;
/// How many times as fine each is as the one before.
const FINER: f64 = 4.0;

/// Runs on the three meshes.
pub(super) struct Ladder {
    pub(super) octants: [Octant; LEVELS],
    pub(super) courses: [Course; LEVELS],
    /// Of each place, straight from the light and its images: nothing of it is sampled.
    direct_lx: [Vec<f64>; LEVELS],
}

/// What is asked for at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Straight from the light and its images.
    Direct,
    /// What was reflected by the sphere.
    Indirect,
    /// Both.
    Total,
}

impl Part {
    pub(super) const ALL: [Self; 3] = [Self::Direct, Self::Indirect, Self::Total];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::Indirect => "indirect",
            Self::Total => "total",
        }
    }
}

impl Ladder {
    /// Runs the same settings on all meshes.
    pub(super) fn climb(settings: &Settings, limit: Option<Duration>) -> Self {
        let octants = [0, 1, 2].map(Octant::new);
        let courses = [0, 1, 2].map(|l: usize| Course::run(&octants[l].scene, settings, limit));
        let few = Settings { replicates: 2, max_samples: Some(4), ..settings.clone() };
        let direct_lx = [0, 1, 2].map(|l: usize| {
            let estimates = simulate(&octants[l].black(), &few, &mut ());
            estimates.point_intervals(0).iter().map(|interval| interval.value).collect()
        });
        Self { octants, courses, direct_lx }
    }

    /// Checkpoints that all meshes have.
    pub(super) fn checkpoints(&self) -> usize {
        self.courses.iter().map(|course| course.snapshots.len()).min().unwrap_or(0)
    }

    /// One value a replicate at the last checkpoint of a mesh.
    pub(super) fn on_mesh(&self, level: usize, part: Part, place: usize) -> Vec<f64> {
        self.values(level, self.courses[level].snapshots.len() - 1, part, place)
    }

    /// One value a replicate on the sphere, from the two finest meshes.
    pub(super) fn on_sphere(&self, part: Part, place: usize) -> Vec<f64> {
        self.pair_limit(1, self.checkpoints() - 1, part, place)
    }

    /// The same at a checkpoint.
    pub(super) fn on_sphere_at(&self, checkpoint: usize, part: Part, place: usize) -> Vec<f64> {
        self.pair_limit(1, checkpoint, part, place)
    }

    /// One value a replicate: how far the limit moved when the third mesh came.
    pub(super) fn moved(&self, part: Part, place: usize) -> Vec<f64> {
        let last = self.checkpoints() - 1;
        let [before, after] = [0, 1].map(|level| self.pair_limit(level, last, part, place));
        differences(&after, &before)
    }

    /// What may be left of the mesh in the limit, in lx: the third mesh moves it by the terms of
    /// fourth order and above, which the next would divide by 256. By 64, in case there is a third
    /// order.
    pub(super) fn left_lx(&self, part: Part, place: usize) -> f64 {
        let Interval { value, half_width } = mean_interval(&self.moved(part, place));
        (value.abs() + half_width.unwrap_or(f64::INFINITY)) / (FINER * FINER * FINER)
    }

    /// The order in 1/n: the logarithm of how many times smaller the second step between meshes is
    /// than the first, of the mean over all places; its half-width by the propagation of errors.
    pub(super) fn order(&self, part: Part) -> Interval {
        let places = self.octants[0].places.len();
        let step = |level: usize| {
            let of_place = |place| {
                let [coarse, fine] = [level, level + 1].map(|l| self.on_mesh(l, part, place));
                differences(&fine, &coarse)
            };
            let all: Vec<Vec<f64>> = (0..places).map(of_place).collect();
            let mean = |r: usize| all.iter().map(|one| one[r]).sum::<f64>() / places as f64;
            mean_interval(&(0..all[0].len()).map(mean).collect::<Vec<f64>>())
        };
        let (first, second) = (step(0), step(1));
        let shares = [first, second].map(|step| step.relative_half_width().unwrap_or(f64::NAN));
        Interval {
            value: libm::log(first.value / second.value) / libm::log(FINER),
            half_width: Some(libm::hypot(shares[0], shares[1]) / libm::log(FINER)),
        }
    }

    fn pair_limit(&self, coarse: usize, checkpoint: usize, part: Part, place: usize) -> Vec<f64> {
        let [coarse, fine] =
            [coarse, coarse + 1].map(|level| self.values(level, checkpoint, part, place));
        let steps = differences(&fine, &coarse);
        let rest = FINER * FINER - 1.0;
        fine.iter().zip(steps).map(|(fine, step)| fine + step / rest).collect()
    }

    fn values(&self, level: usize, checkpoint: usize, part: Part, place: usize) -> Vec<f64> {
        let rows = &self.courses[level].snapshots[checkpoint].estimates.sensors[0].replicate_lx;
        let direct_lx = self.direct_lx[level][place];
        let of_part = |total_lx: f64| match part {
            Part::Direct => direct_lx,
            Part::Indirect => total_lx - direct_lx,
            Part::Total => total_lx,
        };
        rows.iter().map(|row| of_part(row[place])).collect()
    }
}

fn differences(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
