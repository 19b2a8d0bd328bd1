//! Which coordinates carry the variance: why quasi-random points help in a scene, or do not.
//!
//! A pilot traces pseudo-random paths or photons whose coordinates no estimate uses, and finds out
//! which coordinates feed which decision, as the code that draws them says ([`crate::purpose`]).
//! Neighbouring coordinates that feed the same decision make a block. The pilot is then repeated
//! with one block exchanged at a time, which gives the block's share of the variance (`shares`),
//! and with one block moved a little, which tells jumps from slopes. Shares are of the
//! variance of one path or photon: what is even in few coordinates, and smooth, quasi-random points
//! integrate fast (Caflisch, Morokoff and Owen 1997). What they are worth here is measured, too:
//! independent replicates of the sequence of the run against the variance of the pilot.
//!
//! Values are kept by index and summed in their order, so that threads change no bit.

mod blocks;
mod gain;
mod paths;
mod photons;
mod shares;

use crate::context::{Context, Stream};
use crate::photon::counts::PhotonCounts;
use crate::purpose::{Ledger, Purpose, PurposeRecorder};
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::{Spectrum, is_grey};
use gain::gain;
use paths::PathSource;
use photons::PhotonSource;
use quasilux_sampling::{DimensionHistogram, PointSet, Randomization, Sequence, stream_key};
use quasilux_scene::{Rgb, Scene};
use rayon::prelude::*;
use shares::Spread;
use std::ops::Range;

/// Numbers of the replicates that only a pilot uses; estimates count from 0 and never get there.
const PILOT: u32 = u32::MAX;
const EXCHANGE: u32 = u32::MAX - 1;
const FIRST_OF_GAIN: u32 = u32::MAX - 1000;

/// Photons that one thread traces before it takes others.
const PHOTONS_A_PIECE: u64 = 1 << 8;
/// Steps by which blocks are moved, to see how fast the difference falls.
const STEPS: [f64; 2] = [1.0 / 16.0, 1.0 / 64.0];
/// Shares of less are not looked at for jumps.
const MIN_SHARE: f64 = 0.01;

/// Where the variance of an estimate comes from, by coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// Kind of the samples.
    pub walk: SampleKind,
    /// Sensor points whose paths were looked at, or sensors whose average photons were.
    pub targets: usize,
    /// Pilot samples, of each target where they are paths.
    pub samples: u64,
    /// Rays that all samples took; those of the estimate are not in it, nor what must be there
    /// before the first.
    pub rays: u64,
    /// How many coordinates the samples used.
    pub dimensions: DimensionHistogram,
    /// Standard deviation of what one sample finds over the mean, root mean square over the
    /// targets; 0 where nothing varies.
    pub relative_deviation: f64,
    /// Coordinates by what they feed, in their order.
    pub blocks: Vec<Block>,
    /// Sum of all total shares: how many blocks act together on average, 1 where effects just add
    /// (the mean dimension of Liu and Owen 2006, by blocks). `None` where nothing varies.
    pub interacting_blocks: Option<f64>,
    /// Number of first coordinates that carry 99 % of the variance, to whole blocks (the effective
    /// dimension in the truncation sense); `None` where it takes those past the last block.
    pub truncation_dimension: Option<u32>,
    /// Gain by the sequence of the run; `None` where nothing is randomised or nothing varies.
    pub gain: Option<Gain>,
}

/// Kind of samples that a pilot traces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleKind {
    /// Photons from the lights that sensors count.
    Photons,
    /// Paths from the sensors.
    Paths,
    /// Paths from the sensors that end on an illumination map, given the map.
    PathsOnMap,
}

impl SampleKind {
    /// How many samples of their own this many targets have for each index: photons serve all,
    /// paths one each.
    fn samples_an_index(self, targets: usize) -> usize {
        match self {
            Self::Photons => 1,
            Self::Paths | Self::PathsOnMap => targets,
        }
    }
}

/// Neighbouring coordinates that mostly feed the same decision.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its coordinates, counted from 0; the last block has all that follow.
    pub dimensions: Range<u32>,
    /// Decisions that they feed, by falling share.
    pub uses: Vec<Use>,
    /// Share of the samples that get to its first coordinate.
    pub reached: f64,
    /// Share of the variance that it carries alone; `None` where nothing varies.
    pub alone: Option<Share>,
    /// Share of the variance that depends on it, alone or with others.
    pub total: Option<Share>,
    /// The power of a small step with which the squared difference falls: 2 where values are smooth
    /// in the block, 1 where they jump. `None` where it carries too little to tell.
    pub smoothness: Option<f64>,
}

/// A decision that a block feeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Use {
    /// Purpose of the decision.
    pub purpose: Purpose,
    /// Share of the block's coordinates that were drawn for it.
    pub share: f64,
}

/// A share of the variance, estimated.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// The estimate.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

/// Error under the sequence of the run beside that of pseudo-random points, both of means over the
/// same number of samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gain {
    /// Samples in a mean.
    pub samples: u64,
    /// Independent randomisations.
    pub replicates: u32,
    /// Pseudo-random error over that of the sequence.
    pub factor: f64,
    /// Standard error of the factor, about.
    pub standard_error: f64,
    /// The error falls like the samples to the power of minus this, from a sixteenth of them on;
    /// 0.5 for pseudo-random points.
    pub exponent: f64,
}

/// Looks into the variance of one sample, without the run.
///
/// Deterministic for any number of threads. It costs some hundred thousand samples of each kind, up
/// to a million.
#[must_use]
pub fn explain(scene: &Scene, settings: &Settings) -> Explanation {
    if is_grey(scene) { on_stage::<f64>(scene, settings) } else { on_stage::<Rgb>(scene, settings) }
}

fn on_stage<S: Spectrum>(scene: &Scene, settings: &Settings) -> Explanation {
    let ledger = Ledger::default();
    let mut context = Context::<S>::new(scene, settings);
    context.purposes = PurposeRecorder::recording(&ledger);
    match settings.estimator {
        EstimatorKind::Photon => {
            look_into(&PhotonSource::new(&context, scene, settings), &ledger, settings)
        }
        EstimatorKind::Auto
        | EstimatorKind::Path
        | EstimatorKind::Bidirectional
        | EstimatorKind::BidirectionalMap => {
            look_into(&PathSource::new(&context, scene, settings), &ledger, settings)
        }
    }
}

/// Values that samples found.
struct Pilot {
    /// Of each target, by index.
    values: Vec<Vec<f64>>,
    rays: u64,
    dimensions: DimensionHistogram,
}

impl Pilot {
    /// Of photons, each of which gives something to every target.
    fn of_photons(
        photons: u64,
        targets: usize,
        give_lx: impl Fn(u64, &mut PhotonCounts) -> Vec<f64> + Sync,
    ) -> Self {
        let piece = |number: u64| {
            let mut counts = PhotonCounts::default();
            let first = number * PHOTONS_A_PIECE;
            let photons = first..(first + PHOTONS_A_PIECE).min(photons);
            let given: Vec<Vec<f64>> = photons.map(|index| give_lx(index, &mut counts)).collect();
            (given, counts)
        };
        let pieces = (0..photons.div_ceil(PHOTONS_A_PIECE)).into_par_iter().map(piece);
        let mut all = PhotonCounts::default();
        let mut values = vec![Vec::new(); targets];
        for (given, counts) in pieces.collect::<Vec<_>>() {
            all += counts;
            for lx in given {
                // The run counts and reports NaN.
                let lx = lx.into_iter().map(|lx| if lx.is_finite() { lx } else { 0.0 });
                values.iter_mut().zip(lx).for_each(|(of_target, lx)| of_target.push(lx));
            }
        }
        Self { values, rays: all.rays, dimensions: all.dimensions }
    }
}

/// Points of a stream.
type Points<'p> = dyn Fn(Stream) -> PointSet + Sync + 'p;

/// Samples whose values can be had with any coordinates.
trait SampleSource: Sync {
    fn kind(&self) -> SampleKind;
    /// How many samples make a pilot.
    fn samples(&self) -> u64;
    /// Values in lx that deviations of each target are relative to, where that is not the mean of
    /// its values.
    fn whole_lx(&self) -> Option<&[f64]> {
        None
    }
    /// Traces the first samples.
    fn trace(&self, samples: u64, points: &Points<'_>) -> Pilot;
}

fn look_into(walk: &dyn SampleSource, ledger: &Ledger, settings: &Settings) -> Explanation {
    let mut exchange = Exchange { walk, seed: settings.seed, rays: 0 };
    ledger.set_open(true);
    let pilot = exchange.trace(&|stream| exchange_points(settings.seed, PILOT, stream));
    ledger.set_open(false);
    let other = exchange.trace(&|stream| exchange_points(settings.seed, EXCHANGE, stream));
    let spread = Spread::new([&pilot.values, &other.values], walk.whole_lx());
    let samples = walk.samples();
    let an_index = walk.kind().samples_an_index(pilot.values.len());
    let mut blocks = blocks::from_uses(&ledger.take(), samples * an_index as u64);
    let mut truncation_dimension = None;
    if spread.varies() {
        blocks.iter_mut().for_each(|block| exchange.measure(block, &spread));
        truncation_dimension = exchange.truncation_dimension(&blocks, &spread);
    }
    let totals: Option<Vec<f64>> =
        blocks.iter().map(|block| block.total.map(|share| share.value)).collect();
    let mut rays = exchange.rays;
    let gain = gain(walk, settings, &spread, &mut rays);
    Explanation {
        walk: walk.kind(),
        targets: pilot.values.len(),
        samples,
        rays,
        dimensions: pilot.dimensions,
        relative_deviation: spread.relative_deviation(),
        interacting_blocks: totals.filter(|_| spread.varies()).map(|totals| totals.iter().sum()),
        truncation_dimension,
        blocks,
        gain,
    }
}

/// Independent points of a stream, the pilot's or those exchanged for them.
fn exchange_points(seed: u64, replicate: u32, stream: Stream) -> PointSet {
    let key = stream_key(seed, replicate, stream.id());
    PointSet::new(Sequence::Independent, Randomization::None, key)
}

/// Traces the samples of the pilot again with some of their coordinates exchanged or moved.
struct Exchange<'w> {
    walk: &'w dyn SampleSource,
    seed: u64,
    /// Traced so far.
    rays: u64,
}

impl Exchange<'_> {
    fn trace(&mut self, points: &Points<'_>) -> Pilot {
        let pilot = self.walk.trace(self.walk.samples(), points);
        self.rays += pilot.rays;
        pilot
    }

    /// Values with fresh coordinates in some dimensions.
    fn exchanged(&mut self, dimensions: Range<u32>) -> Vec<Vec<f64>> {
        let seed = self.seed;
        let points = |stream: Stream| {
            let fresh = stream_key(seed, EXCHANGE, stream.id());
            exchange_points(seed, PILOT, stream).exchanged(dimensions.clone(), fresh)
        };
        self.trace(&points).values
    }

    /// The shares of a block in the variance, and how smooth values are in it.
    fn measure(&mut self, block: &mut Block, spread: &Spread) {
        let exchanged = self.exchanged(block.dimensions.clone());
        block.alone = spread.alone(&exchanged);
        block.total = spread.total(&exchanged);
        if carries(block.total, MIN_SHARE) {
            let squares = STEPS.map(|by| {
                let (seed, dimensions) = (self.seed, &block.dimensions);
                let points = |stream: Stream| {
                    exchange_points(seed, PILOT, stream).moved(dimensions.clone(), by)
                };
                let moved = self.trace(&points).values;
                spread.total(&moved).map_or(0.0, |share| share.value)
            });
            block.smoothness = shares::power(squares, STEPS);
        }
    }

    /// The first dimension of a block from which on all together carry at most a hundredth of the
    /// variance.
    fn truncation_dimension(&mut self, blocks: &[Block], spread: &Spread) -> Option<u32> {
        let mut firsts = blocks.iter().skip(1).map(|block| block.dimensions.start);
        firsts.find(|&first| !carries(spread.total(&self.exchanged(first..u32::MAX)), 0.01))
    }
}

/// Whether a share is known and larger than `least`.
fn carries(share: Option<Share>, least: f64) -> bool {
    share.is_some_and(|share| share.value > least)
}

#[cfg(test)]
mod tests;
