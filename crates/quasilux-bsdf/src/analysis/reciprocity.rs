//! How far swapped directions have the same value.

use crate::color::luminance;
use crate::distribution::Distribution;
use crate::hemisphere::upwards;
use crate::hemisphere::{Incident, lattice, spread};
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::tables::ScatteringTables;
use glam::DVec3;
use quasilux_sampling::warp::sample_disk;
use std::f64::consts::PI;

/// Pairs of patches, at most; of more a sample is looked at.
const MAX_PAIRS: usize = 1 << 22;

/// Incidences of tables without patches, at most, and exits for each.
const INCIDENCES: usize = 512;
const EXITS: usize = 256;

/// How far f(a, b) and f(b, a) differ.
///
/// Of matrices all pairs of patches count by their projected solid angles, and the figures are
/// exact where the two sides have the same ones. Of others up to 512 incidences count, each with
/// 256 exits: half of them spread evenly, half as the light goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Reciprocity {
    /// The side of `a`.
    pub side: Side,
    /// Whether `b` is on the same side.
    pub mode: ScatteringMode,
    /// The mean of |f(a, b) - f(b, a)| over the mean of the greater of both.
    pub mean: f64,
    /// The largest |f(a, b) - f(b, a)| over the greater of both, between 0 and 1.
    pub worst: f64,
    /// The pair where that is, in the frames of their sides.
    pub worst_pair: [DVec3; 2],
}

/// Reflection off both sides, transmission once.
pub(super) fn all(tables: &ScatteringTables) -> Vec<Reciprocity> {
    let (front, back) = (Side::Front, Side::Back);
    let pairs = [
        (front, ScatteringMode::Reflection),
        (back, ScatteringMode::Reflection),
        (front, ScatteringMode::Transmission),
    ];
    pairs.into_iter().filter_map(|(side, mode)| Reciprocity::new(tables, side, mode)).collect()
}

impl Reciprocity {
    /// Compares f of light that arrives on `side` and is scattered in `mode` with f of light that
    /// travels in reverse; `None` where one of the two is missing or both are dark.
    pub(super) fn new(tables: &ScatteringTables, side: Side, mode: ScatteringMode) -> Option<Self> {
        let back_side = if mode == ScatteringMode::Reflection { side } else { side.other() };
        let forth = tables.get(side, mode)?;
        let back = tables.get(back_side, mode)?;
        let mut sums = Sums::default();
        let mut look = |a, b, weight: f64| {
            let values = [forth.evaluate(a, b), back.evaluate(b, a)].map(luminance);
            sums.add([a, b], values, weight);
        };
        match exits_of_patches(forth, back) {
            Some(exits) => {
                for Incident { wi, part } in forth.parts() {
                    exits.iter().for_each(|exit| look(wi, exit.wi, part * exit.part));
                }
            }
            None => look_at_samples(forth, look),
        }
        let Sums { difference, sum, worst, pair } = sums;
        let mean = difference / sum;
        (sum > 0.0).then_some(Self { side, mode, mean, worst, worst_pair: pair })
    }
}

/// What is known of pairs that were looked at.
#[derive(Default)]
struct Sums {
    difference: f64,
    sum: f64,
    worst: f64,
    pair: [DVec3; 2],
}

impl Sums {
    fn add(&mut self, pair: [DVec3; 2], values: [f64; 2], weight: f64) {
        let greater = values[0].max(values[1]);
        let off = greater - values[0].min(values[1]);
        self.difference += weight * off;
        self.sum += weight * greater;
        if off > self.worst * greater {
            (self.worst, self.pair) = (off / greater, pair);
        }
    }
}

/// The patches that light leaves to, as those from which light in reverse comes; `None` where
/// there are no patches, or too many.
fn exits_of_patches(forth: &Distribution, back: &Distribution) -> Option<Vec<Incident>> {
    let (Distribution::Klems(forth), Distribution::Klems(back)) = (forth, back) else {
        return None;
    };
    let pairs = forth.incident_basis().patches().checked_mul(back.incident_basis().patches())?;
    (pairs <= MAX_PAIRS).then(|| back.parts())
}

/// Calls `look` with pairs and with what they count: the inverse of their density.
fn look_at_samples(forth: &Distribution, mut look: impl FnMut(DVec3, DVec3, f64)) {
    let mut incidences = forth.parts();
    if incidences.len() > INCIDENCES {
        let part = 1.0 / INCIDENCES as f64;
        incidences = spread(INCIDENCES).map(|wi| Incident { wi, part }).collect();
    }
    for (number, Incident { wi, part }) in incidences.into_iter().enumerate() {
        for index in 0..EXITS {
            let u = lattice(index / 2, EXITS / 2, number as f64 * 0.754_877_666_246_692_7);
            let even = upwards(sample_disk(u));
            let wo = match index % 2 {
                0 => even,
                _ => forth.sample(wi, u).map_or(even, |sample| sample.wo),
            };
            // Of both halves, with respect to projected solid angle.
            let along = if wo.z > 0.0 { forth.pdf_sr(wi, wo) / wo.z } else { 0.0 };
            look(wi, wo, part / (1.0 / PI + along));
        }
    }
}
