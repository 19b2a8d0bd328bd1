//! The entry `explain` of the result document: which coordinates carry the variance.
//!
//! Coordinates count from 0; a block without a `last` one has all that follow. Shares are of the
//! variance of one sample, `alone` without what hangs on other blocks too, `total` with it.

use quasilux_transport::Explanation;
use quasilux_transport::explain::{Block, Gain, SampleKind, Share};
use serde::Serialize;

#[derive(Serialize)]
pub(super) struct ExplanationEntry<'a> {
    samples_are: &'static str,
    targets: usize,
    samples: u64,
    rays: u64,
    mean_dimension: f64,
    dimension_counts: &'a [u64],
    relative_deviation: Option<f64>,
    interacting_blocks: Option<f64>,
    truncation_dimension: Option<u32>,
    blocks: Vec<BlockEntry>,
    gain: Option<GainEntry>,
}

#[derive(Serialize)]
struct BlockEntry {
    first: u32,
    last: Option<u32>,
    feeds: Vec<UseEntry>,
    reached: f64,
    alone: Option<ShareEntry>,
    total: Option<ShareEntry>,
    smoothness: Option<f64>,
}

#[derive(Serialize)]
struct UseEntry {
    what: String,
    share: f64,
}

#[derive(Serialize)]
struct ShareEntry {
    value: f64,
    standard_error: f64,
}

#[derive(Serialize)]
struct GainEntry {
    samples: u64,
    replicates: u32,
    factor: f64,
    standard_error: f64,
    exponent: f64,
}

impl<'a> ExplanationEntry<'a> {
    pub(super) fn new(explanation: &'a Explanation) -> Self {
        let deviation = explanation.relative_deviation;
        Self {
            samples_are: match explanation.walk {
                SampleKind::Photons => "photons",
                SampleKind::Paths => "paths",
                SampleKind::PathsOnMap => "paths that end on a map",
            },
            targets: explanation.targets,
            samples: explanation.samples,
            rays: explanation.rays,
            mean_dimension: explanation.dimensions.mean(),
            dimension_counts: explanation.dimensions.counts(),
            relative_deviation: deviation.is_finite().then_some(deviation),
            interacting_blocks: explanation.interacting_blocks,
            truncation_dimension: explanation.truncation_dimension,
            blocks: explanation.blocks.iter().map(BlockEntry::new).collect(),
            gain: explanation.gain.map(GainEntry::new),
        }
    }
}

impl BlockEntry {
    fn new(block: &Block) -> Self {
        let share = |share: Option<Share>| {
            share.map(|Share { value, standard_error }| ShareEntry { value, standard_error })
        };
        let uses = block.uses.iter();
        let uses = uses.map(|used| UseEntry { what: used.purpose.to_string(), share: used.share });
        Self {
            first: block.dimensions.start,
            last: (block.dimensions.end < u32::MAX).then(|| block.dimensions.end - 1),
            feeds: uses.collect(),
            reached: block.reached,
            alone: share(block.alone),
            total: share(block.total),
            smoothness: block.smoothness,
        }
    }
}

impl GainEntry {
    fn new(gain: Gain) -> Self {
        let Gain { samples, replicates, factor, standard_error, exponent } = gain;
        Self { samples, replicates, factor, standard_error, exponent }
    }
}
