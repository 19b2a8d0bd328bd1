//! Many photons at once: ranges of indices of all replicates, shared between threads.

use crate::context::{Context, Stream};
use crate::cutoff;
use crate::photon::counts::PhotonCounts;
use crate::photon::order::{WAVES_PER_FIELD, Waves, Way};
use crate::photon::receiver::{PhotonReceiver, ReceiverCounts};
use crate::photon::trace::{Lead, Source, trace_photon};
use crate::photon::wave::{PhotonWave, Wave};
use crate::spectrum::Spectrum;
use crate::stats::estimates::FluxBalance;
use crate::stats::observer::Snapshot;
use crate::stats::watch::Watch;
use quasilux_sampling::{PointSet, Sampler};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// Most waves between two words to the observer. There are no fields that are begun then.
const WAVES_PER_ROUND: u64 = WAVES_PER_FIELD;

/// Which photons are traced: the same indices of each replicate.
pub(crate) struct PhotonBatch<'w> {
    pub(crate) stream: Stream,
    pub(crate) replicates: Range<u32>,
    pub(crate) indices: Range<u64>,
    pub(crate) way: Way,
    pub(crate) lead: Lead<'w>,
}

impl<'s> PhotonBatch<'s> {
    /// Photons that come before all paths, and that no estimate counts.
    pub(crate) fn for_plan(source: Source<'s>, indices: Range<u64>) -> Self {
        Self {
            stream: Stream::PlanPhotons,
            replicates: 0..1,
            indices,
            way: Way::CoherentWaves,
            lead: Lead::by_chance(source, None),
        }
    }
}

/// Traces photons; `receiver` makes what sees those of one replicate. `None` when the observer
/// stopped it.
pub(crate) fn trace_photons<S: Spectrum, R: PhotonReceiver<S>>(
    context: &Context<'_, S>,
    batch: &PhotonBatch<'_>,
    receiver: impl Fn(u32) -> R + Sync,
    watch: &mut Watch<'_>,
) -> Option<PhotonCounts> {
    trace_photons_in_view(context, batch, receiver, |_| None, watch)
}

/// The same where `look` tells what the sensors show, when so many of the photons were emitted and
/// none of them flies.
pub(crate) fn trace_photons_in_view<S: Spectrum, R: PhotonReceiver<S>>(
    context: &Context<'_, S>,
    batch: &PhotonBatch<'_>,
    receiver: impl Fn(u32) -> R + Sync,
    look: impl Fn(u64) -> Option<Snapshot>,
    watch: &mut Watch<'_>,
) -> Option<PhotonCounts> {
    let PhotonBatch { stream, replicates, indices, way, lead } = batch;
    let lead = *lead;
    let points: Vec<PointSet> = replicates.clone().map(|r| context.points(r, *stream)).collect();
    let Some(leading) = points.first() else { return Some(PhotonCounts::default()) };
    let close_in = match way {
        Way::OneByOne | Way::Waves => 0,
        Way::CoherentWaves => context.lights.leading_dimensions(),
    };
    let waves_each = Waves::new(leading, indices.clone(), close_in);
    let waves = waves_each.len() * points.len() as u64;
    // One space for each thread of this pool.
    let spaces: Vec<Mutex<PhotonWave<'_, S>>> =
        (0..rayon::current_num_threads()).map(|_| Mutex::new(PhotonWave::new())).collect();
    let trace = |number: u64| {
        let row = (number / waves_each.len()) as u32;
        let points = &points[row as usize];
        let indices = waves_each.indices(number % waves_each.len());
        let mut receiver = receiver(replicates.start + row);
        let mut counts = PhotonCounts::default();
        if *way == Way::OneByOne {
            for index in indices {
                let sampler = Sampler::new(points, index);
                trace_photon(context, lead, sampler, &mut receiver, &mut counts);
            }
        } else {
            let thread = rayon::current_thread_index().unwrap_or(0);
            let mut space = spaces[thread].lock().unwrap_or_else(PoisonError::into_inner);
            let wave = Wave { points, indices, lead };
            space.trace(context, wave, &mut receiver, &mut counts);
        }
        let ReceiverCounts { rays, invalid } = receiver.finish();
        counts.connections = rays;
        counts.rays += rays;
        counts.invalid += invalid;
        counts
    };
    let mut counts = PhotonCounts::default();
    let mut done = 0;
    while done < waves {
        let end = (done + WAVES_PER_ROUND).min(waves);
        let round =
            done..end - end % waves_each.len() + waves_each.gap_before(end % waves_each.len());
        done = round.end;
        let of_round =
            round.into_par_iter().map(trace).reduce(PhotonCounts::default, |mut a, b| {
                a += b;
                a
            });
        let (photons, rays) = (of_round.emitted, of_round.rays);
        counts += of_round;
        watch.show(|| look(counts.emitted));
        if !watch.tick(photons, 0, rays) {
            return None;
        }
    }
    Some(counts)
}

impl PhotonCounts {
    /// Where the flux of the lights went, by the shares of the photons.
    pub(crate) fn balance(&self, emitted_lm: f64) -> FluxBalance {
        let of = |quanta: i64| emitted_lm * self.share(quanta);
        FluxBalance {
            emitted_lm,
            absorbed_lm: of(self.absorbed),
            lost_lm: of(self.lost),
            cut_lm: of(self.cut),
        }
    }

    /// What a reader of the results must know of them.
    pub(crate) fn warning(&self) -> Option<String> {
        cutoff::warning(self.endless + self.trapped, "photons", "values")
    }
}
