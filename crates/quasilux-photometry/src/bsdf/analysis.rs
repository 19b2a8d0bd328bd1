//! What a measured surface reflects and transmits, and where its table breaks energy conservation or reciprocity.
//!
//! Tables are used as they are: these figures say by how much they are wrong.

use super::distribution::{luminance, upwards};
use super::{Distribution, MeasuredBsdf, Side, Way};
use glam::DVec3;
use quasilux_sampling::warp::sample_disk;

/// Directions of the look at reciprocity: squares of equal projected solid angle, so many a side.
const DIRECTIONS_A_SIDE: usize = 12;

/// They are turned by this, away from the edges that patches have at 45 degrees and the like.
const TURN_RAD: f64 = 0.1;

/// Figures of a measured surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BsdfAnalysis {
    /// For each side that light arrives on and that scatters.
    pub energy: Vec<EnergyBalance>,
    /// Reflection off each side, and transmission where both sides have one.
    pub reciprocity: Vec<Reciprocity>,
}

/// Where light of one side goes.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyBalance {
    /// The side that light arrives on.
    pub side: Side,
    /// Luminous reflectance and transmittance for light along the normal.
    pub normal: [f64; 2],
    /// The same for diffuse light: means over projected solid angle.
    pub diffuse: [f64; 2],
    /// The greatest sum of both over all stored incidences, of the strongest colour channel.
    pub worst: f64,
    /// The incidence where that is.
    pub worst_wi: DVec3,
}

/// How far f(a, b) and f(b, a) differ, over pairs of directions of equal projected solid angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Reciprocity {
    /// The side of `a`.
    pub side: Side,
    /// Whether `b` is on the same side.
    pub way: Way,
    /// The mean of |f(a, b) - f(b, a)| over the mean of the greater of both.
    pub mean: f64,
    /// The largest |f(a, b) - f(b, a)| over the greater of both, between 0 and 1.
    pub worst: f64,
    /// The pair where that is, in the frames of their sides.
    pub worst_pair: [DVec3; 2],
}

impl BsdfAnalysis {
    /// Figures of a surface.
    #[must_use]
    pub fn of(bsdf: &MeasuredBsdf) -> Self {
        let energy = Side::ALL.into_iter().filter_map(|side| EnergyBalance::of(bsdf, side));
        Self { energy: energy.collect(), reciprocity: reciprocities(bsdf) }
    }
}

impl EnergyBalance {
    /// The balance of one side; `None` where it scatters nothing.
    #[must_use]
    pub fn of(bsdf: &MeasuredBsdf, side: Side) -> Option<Self> {
        let ways = Way::ALL.map(|way| bsdf.scattering(side, way));
        let share = |way: usize, wi| ways[way].map_or([0.0; 3], |found| found.albedo(wi));
        let luminance = |wi| [0, 1].map(|way| luminance(share(way, wi)));
        let mut incidences: Vec<DVec3> = vec![DVec3::Z];
        incidences.extend(ways.into_iter().flatten().flat_map(Distribution::incidences));
        if incidences.len() == 1 {
            return None;
        }
        let total = |wi| {
            let (reflected, passed) = (share(0, wi), share(1, wi));
            (0..3).map(|channel| reflected[channel] + passed[channel]).fold(0.0, f64::max)
        };
        let mut worst = (total(DVec3::Z), DVec3::Z);
        for wi in incidences {
            let total = total(wi);
            if total > worst.0 {
                worst = (total, wi);
            }
        }
        let directions = directions();
        let mean = |way: usize| {
            let sum: f64 = directions.iter().map(|&wi| luminance(wi)[way]).sum();
            sum / directions.len() as f64
        };
        Some(Self {
            side,
            normal: luminance(DVec3::Z),
            diffuse: [mean(0), mean(1)],
            worst: worst.0,
            worst_wi: worst.1,
        })
    }
}

impl Reciprocity {
    /// Compares f of light that arrives on `side` and goes `way` with f of light the other way round; `None` where one
    /// of the two is missing or both are dark.
    #[must_use]
    pub fn of(bsdf: &MeasuredBsdf, side: Side, way: Way) -> Option<Self> {
        let back_side = if way == Way::Reflection { side } else { side.other() };
        let forth = bsdf.scattering(side, way)?;
        let back = bsdf.scattering(back_side, way)?;
        let directions = directions();
        let (mut difference, mut sum) = (0.0, 0.0);
        let mut worst = (0.0, [DVec3::Z; 2]);
        for (index, &a) in directions.iter().enumerate() {
            // Reflection: each pair once.
            let first = if way == Way::Reflection { index + 1 } else { 0 };
            for &b in &directions[first.min(directions.len())..] {
                let values = [forth.evaluate(a, b), back.evaluate(b, a)].map(luminance);
                let greater = values[0].max(values[1]);
                let off = greater - values[0].min(values[1]);
                difference += off;
                sum += greater;
                if off > worst.0 * greater {
                    worst = (off / greater, [a, b]);
                }
            }
        }
        let mean = difference / sum;
        (sum > 0.0).then_some(Self { side, way, mean, worst: worst.0, worst_pair: worst.1 })
    }
}

/// Reflection off both sides, transmission once.
fn reciprocities(bsdf: &MeasuredBsdf) -> Vec<Reciprocity> {
    let (front, back) = (Side::Front, Side::Back);
    let pairs = [(front, Way::Reflection), (back, Way::Reflection), (front, Way::Transmission)];
    pairs.into_iter().filter_map(|(side, way)| Reciprocity::of(bsdf, side, way)).collect()
}

/// Directions of equal projected solid angle.
fn directions() -> Vec<DVec3> {
    let middle = |i: usize| (i as f64 + 0.5) / DIRECTIONS_A_SIDE as f64;
    let pairs = (0..DIRECTIONS_A_SIDE).flat_map(|i| (0..DIRECTIONS_A_SIDE).map(move |j| (i, j)));
    let (sin, cos) = libm::sincos(TURN_RAD);
    let direction = |(i, j)| {
        let [x, y] = sample_disk([middle(i), middle(j)]);
        upwards([cos * x - sin * y, sin * x + cos * y])
    };
    pairs.map(direction).collect()
}
