//! Many photons at once: ranges of indices of all replicates, shared between threads.

use crate::estimates::FluxBalance;
use crate::photon::{MOST_EVENTS, PhotonCounts, PhotonReceiver, trace_photon};
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::watch::Watch;
use quasilux_sampling::SampleCursor;
use rayon::prelude::*;
use std::ops::Range;

/// Photons of one piece of work.
const BLOCK: u64 = 1024;
/// Pieces of work between two words to the observer.
const BLOCKS_PER_ROUND: u64 = 64;

/// Traces the photons `indices` of each of the `replicates`; `receiver` makes what sees those of
/// one replicate. `None` when the observer stopped it.
pub(crate) fn trace_photons<S: Spectrum, R: PhotonReceiver<S>>(
    stage: &Stage<'_, S>,
    stream: Stream,
    replicates: Range<u32>,
    indices: Range<u64>,
    receiver: impl Fn(u32) -> R + Sync,
    watch: &mut Watch<'_>,
) -> Option<PhotonCounts> {
    let blocks_each = (indices.end - indices.start).div_ceil(BLOCK);
    let blocks = blocks_each * u64::from(replicates.end - replicates.start);
    let mut counts = PhotonCounts::default();
    let mut done = 0;
    while done < blocks {
        let round = done..(done + BLOCKS_PER_ROUND).min(blocks);
        done = round.end;
        let of_round: PhotonCounts = round
            .into_par_iter()
            .map(|block| {
                let replicate = replicates.start + (block / blocks_each) as u32;
                let first = indices.start + block % blocks_each * BLOCK;
                let block = first..(first + BLOCK).min(indices.end);
                trace_block(stage, stream, replicate, block, receiver(replicate))
            })
            .reduce(PhotonCounts::default, |mut a, b| {
                a += b;
                a
            });
        let (photons, rays) = (of_round.emitted, of_round.rays);
        counts += of_round;
        if !watch.tick(photons, 0, rays, done as f64 / blocks as f64) {
            return None;
        }
    }
    Some(counts)
}

fn trace_block<S: Spectrum>(
    stage: &Stage<'_, S>,
    stream: Stream,
    replicate: u32,
    indices: Range<u64>,
    mut receiver: impl PhotonReceiver<S>,
) -> PhotonCounts {
    let points = stage.points(replicate, stream);
    let mut counts = PhotonCounts::default();
    for index in indices {
        let mut cursor = SampleCursor::new(&points, index);
        trace_photon(stage, &mut cursor, &mut receiver, &mut counts);
    }
    counts
}

impl PhotonCounts {
    /// Where the flux of the lights went, by the shares of the photons.
    pub(crate) fn balance(&self, emitted_lm: f64) -> FluxBalance {
        let of = |photons: u64| emitted_lm * (photons as f64 / self.emitted.max(1) as f64);
        FluxBalance {
            emitted_lm,
            absorbed_lm: of(self.absorbed),
            lost_lm: of(self.lost),
            cut_lm: of(self.cut + self.endless),
        }
    }

    /// What a reader of the results must know of them.
    pub(crate) fn warnings(&self) -> Vec<String> {
        let photons = self.endless;
        if photons == 0 {
            return Vec::new();
        }
        vec![format!(
            "{photons} photons were cut after {MOST_EVENTS} bounces: light is trapped here, and \
             values are too low"
        )]
    }
}
