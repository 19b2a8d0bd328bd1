//! Batches of photons: a range of indices of all replicates, shared between threads.

use crate::context::{Context, Stream};
use crate::control::observer::Snapshot;
use crate::control::watch::Watch;
use crate::photon::counts::PhotonCounts;
use crate::photon::order::{PhotonOrder, WAVES_PER_FIELD, Waves};
use crate::photon::receiver::PhotonReceiver;
use crate::photon::trace::{PhotonSetup, Source, trace_photon};
use crate::photon::wave::{PhotonWave, Wave};
use crate::spectrum::Spectrum;
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
    pub(crate) order: PhotonOrder,
    pub(crate) setup: PhotonSetup<'w>,
}

impl<'s> PhotonBatch<'s> {
    /// Photons that come before all paths, and that no estimate counts.
    pub(crate) fn for_plan(source: Source<'s>, indices: Range<u64>) -> Self {
        Self {
            stream: Stream::PlanPhotons,
            replicates: 0..1,
            indices,
            order: PhotonOrder::CoherentWaves,
            setup: PhotonSetup::by_chance(source, None),
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
    trace_photons_with_snapshots(context, batch, receiver, |_| None, watch)
}

/// Traces photons as [`trace_photons`] does, where `look` gives the sensors' values between rounds,
/// by the number of emitted photons.
pub(crate) fn trace_photons_with_snapshots<S: Spectrum, R: PhotonReceiver<S>>(
    context: &Context<'_, S>,
    batch: &PhotonBatch<'_>,
    receiver: impl Fn(u32) -> R + Sync,
    look: impl Fn(u64) -> Option<Snapshot>,
    watch: &mut Watch<'_>,
) -> Option<PhotonCounts> {
    let PhotonBatch { stream, replicates, .. } = batch;
    let points: Vec<PointSet> = replicates.clone().map(|r| context.points(r, *stream)).collect();
    let Some(waves) = BatchWaves::new(context, batch, &points) else {
        return Some(PhotonCounts::default());
    };
    let mut counts = PhotonCounts::default();
    let mut done = 0;
    while done < waves.len() {
        let round = waves.round(done);
        done = round.end;
        let traced = round.into_par_iter().map(|number| waves.trace(number, &receiver));
        let of_round = traced.reduce(PhotonCounts::default, |mut a, b| {
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

/// The waves of a batch, those of one replicate after the other, and working space.
struct BatchWaves<'b, 'c, S> {
    context: &'b Context<'c, S>,
    batch: &'b PhotonBatch<'b>,
    /// By replicate.
    points: &'b [PointSet],
    /// Of one replicate.
    waves: Waves,
    /// One for each thread of this pool.
    spaces: Vec<Mutex<PhotonWave<'b, S>>>,
}

impl<'b, 'c, S: Spectrum> BatchWaves<'b, 'c, S> {
    /// `None` where there are no replicates.
    fn new(
        context: &'b Context<'c, S>,
        batch: &'b PhotonBatch<'b>,
        points: &'b [PointSet],
    ) -> Option<Self> {
        let coherent_dimensions = match batch.order {
            PhotonOrder::OneByOne | PhotonOrder::Waves => 0,
            PhotonOrder::CoherentWaves => context.lights.leading_dimensions(),
        };
        let waves = Waves::new(points.first()?, batch.indices.clone(), coherent_dimensions);
        let spaces =
            (0..rayon::current_num_threads()).map(|_| Mutex::new(PhotonWave::default())).collect();
        Some(Self { context, batch, points, waves, spaces })
    }

    fn len(&self) -> u64 {
        self.waves.len() * self.points.len() as u64
    }

    /// The waves from `first` to the next word to the observer.
    fn round(&self, first: u64) -> Range<u64> {
        let each = self.waves.len();
        let end = (first + WAVES_PER_ROUND).min(self.len());
        first..end - end % each + self.waves.gap_before(end % each)
    }

    fn trace<R: PhotonReceiver<S>>(
        &self,
        number: u64,
        receiver: &impl Fn(u32) -> R,
    ) -> PhotonCounts {
        let PhotonBatch { replicates, order, setup, .. } = self.batch;
        let row = (number / self.waves.len()) as u32;
        let points = &self.points[row as usize];
        let indices = self.waves.indices(number % self.waves.len());
        let mut receiver = receiver(replicates.start + row);
        let mut counts = PhotonCounts::default();
        if *order == PhotonOrder::OneByOne {
            for index in indices {
                let sampler = Sampler::new(points, index);
                trace_photon(self.context, *setup, sampler, &mut receiver, &mut counts);
            }
        } else {
            let thread = rayon::current_thread_index().unwrap_or(0);
            let mut space = self.spaces[thread].lock().unwrap_or_else(PoisonError::into_inner);
            let wave = Wave { points, indices, setup: *setup };
            space.trace(self.context, wave, &mut receiver, &mut counts);
        }
        counts.invalid += receiver.finish();
        counts
    }
}
