//! Light tracing estimator: sensors count photons that pass through grids or land on elements of an
//! illumination map.
//!
//! A grid is a virtual receiver: it counts the photons that pass through each cell from its front
//! side and disturbs nothing. A sensor point on a diffuse surface reads the map element it lies on;
//! one in the air, or on another surface, is a virtual square of about that size.

mod pilot;
mod receivers;

pub(crate) use pilot::plan;
pub(crate) use receivers::Receivers;

use crate::codec::{Reader, StateError, Stored, Writer, digest};
use crate::context::{Context, Stream};
use crate::control::observer::Snapshot;
use crate::control::watch::{BlockCounts, Watch};
use crate::control::workers::BlockSize;
use crate::estimator::Estimator;
use crate::estimator::block::BlockFrame;
use crate::importance::{Plan, WeightWindows};
use crate::photon::batch::{PhotonBatch, trace_photons_with_snapshots};
use crate::photon::counts::PhotonCounts;
use crate::photon::map::QUANTA_PER_PHOTON;
use crate::photon::order::PhotonOrder;
use crate::photon::receiver::{PhotonReceiver, SeenPhoton};
use crate::photon::trace::{PhotonSetup, Source};
use crate::sensors::{by_sensor, snapshot};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::decisions::Decisions;
use crate::stats::estimates::{Dimensions, Estimates, SensorEstimates, TermEstimates};
use crate::stats::point_status::Evidence;
use crate::stats::tally::checked_quanta;
use crate::world::Interaction;
use crate::world::flight::Flight;
use quasilux_scene::Scene;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Indices per replicate of the first checkpoint.
const FIRST_SAMPLES: u64 = 1 << 8;

/// Photons counted by all sensors, in all replicates.
pub(crate) struct PhotonEstimator<'a, S> {
    context: &'a Context<'a, S>,
    scene: &'a Scene,
    receivers: Receivers,
    /// Result of the survey, which guides the photons.
    plan: Plan,
    /// One row of counters a replicate.
    counters: Vec<Counters>,
    samples: u64,
    /// Without pilots.
    photons: PhotonCounts,
}

/// Photons counted in one replicate, in quanta: all, and those of 0, 1, .. bounces as far as terms
/// are listed; those straight from a light always are.
struct Counters {
    all: Vec<AtomicU64>,
    by_bounces: Vec<Vec<AtomicU64>>,
    quanta_per_photon: f64,
}

struct SensorReceiver<'a> {
    receivers: &'a Receivers,
    counters: &'a Counters,
    /// Contributions that the counters refused.
    invalid: u64,
}

impl<'a, S: Spectrum> PhotonEstimator<'a, S> {
    pub(crate) fn new(context: &'a Context<'a, S>, scene: &'a Scene, settings: &Settings) -> Self {
        let receivers = Receivers::new(&context.world, scene, settings);
        let replicates = settings.effective_replicates();
        let plan = plan(context, scene, &receivers, settings);
        let lightest = plan.windows.as_ref().map_or(1.0, WeightWindows::lightest);
        let (quanta, terms) = (QUANTA_PER_PHOTON / lightest, settings.list_terms.max(1));
        let counters = || Counters::new(receivers.counters, terms, quanta);
        let counters = (0..replicates).map(|_| counters()).collect();
        let photons = PhotonCounts::default();
        Self { context, scene, receivers, plan, counters, samples: 0, photons }
    }

    /// Traces and counts the photons `indices` of all replicates.
    pub(crate) fn count(
        &self,
        order: PhotonOrder,
        indices: Range<u64>,
        watch: &mut Watch<'_>,
    ) -> Option<PhotonCounts> {
        let (receivers, counters) = (&self.receivers, &self.counters);
        let receiver =
            |r: u32| SensorReceiver { receivers, counters: &counters[r as usize], invalid: 0 };
        let (replicates, windows) = (0..counters.len() as u32, self.plan.windows.as_ref());
        let batch = PhotonBatch {
            stream: Stream::Photons,
            replicates,
            indices,
            order,
            setup: PhotonSetup::by_chance(Source::Lights, windows),
        };
        let before = self.samples * counters.len() as u64;
        let look = |emitted: u64| Some(self.snapshot(before + emitted));
        trace_photons_with_snapshots(self.context, &batch, receiver, look, watch)
    }

    /// Estimates after `photons` of all replicates together.
    fn snapshot(&self, photons: u64) -> Snapshot {
        let photon_lm = self.context.lights.flux_lm / photons as f64;
        let value_lx = |&(counter, area_m2): &(u32, f64)| {
            let photons = |own: &Counters| own.all(counter as usize) as f64 / own.quanta_per_photon;
            Some(self.counters.iter().map(photons).sum::<f64>() * photon_lm / area_m2)
        };
        snapshot(self.scene, self.receivers.targets.iter().map(value_lx))
    }

    /// All counters of all replicates.
    pub(crate) fn counters(&self) -> impl Iterator<Item = u64> {
        let all = self
            .counters
            .iter()
            .flat_map(|own| own.all.iter().chain(own.by_bounces.iter().flatten()));
        all.map(|counter| counter.load(Ordering::Relaxed))
    }
}

impl<S: Spectrum> PhotonEstimator<'_, S> {
    /// The figures of all targets as if of one sensor.
    fn figures(&self) -> SensorEstimates {
        let photon_lm = self.context.lights.flux_lm / self.samples as f64;
        // One row a replicate, from the quanta of each counter.
        let read = |quanta: &dyn Fn(&Counters, usize) -> u64| -> Vec<Vec<f64>> {
            let value_lx = |own: &Counters, counter: u32, area_m2: f64| {
                let photons = quanta(own, counter as usize) as f64 / own.quanta_per_photon;
                photons * photon_lm / area_m2
            };
            let targets = || self.receivers.targets.iter();
            let row = |own| targets().map(|&(at, area_m2)| value_lx(own, at, area_m2)).collect();
            self.counters.iter().map(row).collect()
        };
        let replicate_lx = read(&|own, counter| own.all(counter));
        let mut direct_lx = vec![0.0; self.receivers.targets.len()];
        for row in read(&|own, counter| own.term(0, counter)) {
            for (sum, value) in direct_lx.iter_mut().zip(row) {
                *sum += value / self.counters.len() as f64;
            }
        }
        let found = |rows: &[Vec<f64>]| -> Vec<bool> {
            (0..direct_lx.len()).map(|target| rows.iter().any(|row| row[target] != 0.0)).collect()
        };
        let listed = self.context.listed_terms as usize;
        let terms = (0..=listed).take_while(|_| listed > 0).map(|term| {
            let replicate_lx = read(&|own, counter| own.term(term, counter));
            let cut = self.context.max_bounces.is_some_and(|most| term > most as usize);
            let resolved = found(&replicate_lx).into_iter().map(|found| found || cut).collect();
            TermEstimates { replicate_lx, resolved }
        });
        let terms = terms.collect();
        let evidence = |found: bool| if found { Evidence::Sound } else { Evidence::Dark };
        let evidence = found(&replicate_lx).into_iter().map(evidence).collect();
        let targets = direct_lx.len();
        SensorEstimates {
            replicate_lx,
            direct_lx,
            evidence,
            samples: vec![self.samples; targets],
            average: None,
            terms,
            unseen: None,
        }
    }
}

impl<S: Spectrum> Estimator for PhotonEstimator<'_, S> {
    fn advance(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool {
        let indices = self.samples..samples;
        let counters: usize = self.counters.iter().map(|own| own.all.len()).sum();
        let size = BlockSize { paths: self.counters.len() as u64, sums: counters as u64 };
        if let Some(blocks) = watch.blocks(|| BlockFrame::CountedPhotons, indices, size) {
            let is_done = watch.distribute(&blocks, &mut |from| {
                let mut photons = PhotonCounts::default();
                photons.merge_from(from)?;
                self.counters.as_mut_slice().merge_from(from)?;
                let (begun, rays) = (photons.begun, photons.rays);
                self.photons += photons;
                Ok(BlockCounts { photons: begun, paths: 0, rays })
            });
            self.samples = samples;
            return is_done;
        }
        for piece in watch.pieces(self.samples..samples, self.counters.len() as u64) {
            let end = piece.end;
            let Some(counts) = self.count(PhotonOrder::CoherentWaves, piece, watch) else {
                return false;
            };
            self.photons += counts;
            self.samples = end;
            if !watch.keep(|out| self.put(out)) {
                return false;
            }
        }
        true
    }

    fn estimates(&self) -> Estimates {
        Estimates {
            sensors: by_sensor(self.scene, self.figures()),
            samples: self.samples,
            rays: self.plan.rays + self.photons.rays,
            flux: self.photons.balance(self.context.lights.flux_lm),
            dimensions: Dimensions {
                photon: self.photons.dimensions.clone(),
                photons: self.photons.begun,
                photon_events: self.photons.events,
                ..Dimensions::default()
            },
            biased: self.photons.endless > 0,
            invalid_contributions: self.photons.invalid,
            caveats: self.photons.caveat().into_iter().collect(),
            ..Estimates::default()
        }
    }

    fn decisions(&self) -> Decisions {
        let windows = &self.plan.windows;
        Decisions {
            uses_importance: windows.is_some(),
            digest: digest(|out| {
                windows.iter().for_each(|windows| windows.put(out));
                out.value(&self.plan.rays);
                self.receivers.targets.iter().for_each(|(counter, area_m2)| {
                    out.value(counter);
                    out.value(area_m2);
                });
            }),
            ..Decisions::default()
        }
    }

    fn put(&self, out: &mut Writer) {
        out.value(&self.samples);
        self.put_part(out);
    }

    fn merge_from(&mut self, coming: u64, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.samples = from.value()?;
        self.merge_part(from)?;
        let is_fine = self.samples <= coming;
        if is_fine { Ok(()) } else { Err(StateError::Unfit("the number of samples")) }
    }

    fn trace_part(&mut self, part: Range<u64>, _samples: u64, watch: &mut Watch<'_>) -> bool {
        self.samples = part.start;
        self.advance(part.end, watch)
    }

    /// Each photon serves itself.
    fn put_shared(&self, _out: &mut Writer) {}

    fn merge_shared(&mut self, _from: &mut Reader<'_>) -> Result<(), StateError> {
        Ok(())
    }

    fn put_part(&self, out: &mut Writer) {
        self.photons.put(out);
        self.counters.as_slice().put(out);
    }

    fn merge_part(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.photons.merge_from(from)?;
        self.counters.as_mut_slice().merge_from(from)
    }

    fn trace_block(
        &mut self,
        frame: &BlockFrame,
        block: Range<u64>,
    ) -> Result<Vec<u8>, StateError> {
        let BlockFrame::CountedPhotons = frame else {
            return Err(StateError::Unfit("the kind of a block"));
        };
        self.counters.iter_mut().for_each(Counters::clear);
        self.photons = PhotonCounts::default();
        let mut nobody = ();
        if !self.trace_part(block, 0, &mut Watch::new(&mut nobody)) {
            return Err(StateError::Unfit("the range of a block"));
        }
        let mut out = Writer::default();
        self.put_part(&mut out);
        Ok(out.finish())
    }

    fn complete_at(&mut self, samples: u64) {
        self.samples = samples;
    }

    fn first_checkpoint(&self) -> u64 {
        FIRST_SAMPLES
    }
}

impl Counters {
    fn new(counters: usize, terms: u32, quanta_per_photon: f64) -> Self {
        let zeros = || (0..counters).map(|_| AtomicU64::new(0)).collect();
        let by_bounces = (0..terms).map(|_| zeros()).collect();
        Self { all: zeros(), by_bounces, quanta_per_photon }
    }

    fn clear(&mut self) {
        let counters = self.all.iter_mut().chain(self.by_bounces.iter_mut().flatten());
        counters.for_each(|counter| *counter.get_mut() = 0);
    }

    fn all(&self, counter: usize) -> u64 {
        self.all[counter].load(Ordering::Relaxed)
    }

    /// Photons of one number of bounces, in quanta; past the last that is counted, the rest.
    fn term(&self, bounces: usize, counter: usize) -> u64 {
        let counted = |counts: &Vec<AtomicU64>| counts[counter].load(Ordering::Relaxed);
        match self.by_bounces.get(bounces) {
            Some(counts) => counted(counts),
            None => self.all(counter) - self.by_bounces.iter().map(counted).sum::<u64>(),
        }
    }

    /// Adds to a counter; 1 where the contribution was refused.
    #[inline]
    fn count(&self, counter: usize, photons: f64, bounces: u32) -> u64 {
        let Some(quanta) = checked_quanta(photons, self.quanta_per_photon) else { return 1 };
        let quanta = quanta.cast_unsigned();
        self.all[counter].fetch_add(quanta, Ordering::Relaxed);
        if let Some(counts) = self.by_bounces.get(bounces as usize) {
            counts[counter].fetch_add(quanta, Ordering::Relaxed);
        }
        0
    }
}

impl Stored for Counters {
    fn put(&self, out: &mut Writer) {
        let counters = self.all.iter().chain(self.by_bounces.iter().flatten());
        out.value(&((self.all.len() * (1 + self.by_bounces.len())) as u64));
        counters.for_each(|counter| out.value(&counter.load(Ordering::Relaxed)));
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        from.expect_length(self.all.len() * (1 + self.by_bounces.len()))?;
        let counters = self.all.iter_mut().chain(self.by_bounces.iter_mut().flatten());
        counters.map(AtomicU64::get_mut).try_for_each(|counter| from.add_count(counter))?;
        let told_apart = |counter: usize| {
            let counts =
                self.by_bounces.iter().map(|counts| counts[counter].load(Ordering::Relaxed));
            counts.map(u128::from).sum::<u128>()
        };
        let is_fine = |counter: usize| told_apart(counter) <= u128::from(self.all(counter));
        if (0..self.all.len()).all(is_fine) { Ok(()) } else { Err(StateError::Unfit("a counter")) }
    }
}

impl<S: Spectrum> PhotonReceiver<S> for SensorReceiver<'_> {
    fn flight(&mut self, flight: &Flight, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, .. } = photon;
        for counter in self.receivers.passed(flight) {
            self.invalid += self.counters.count(counter, weight.luminance(), bounces);
        }
    }

    fn landing(&mut self, at: &Interaction, photon: &SeenPhoton<S>) {
        let &SeenPhoton { weight, bounces, .. } = photon;
        if let Some(counter) = self.receivers.landed_on(at) {
            self.invalid += self.counters.count(counter, weight.luminance(), bounces);
        }
    }

    fn finish(self) -> u64 {
        self.invalid
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invalid_photons_are_refused_and_counted() {
        let counters = Counters::new(1, 2, QUANTA_PER_PHOTON);
        for bad in [f64::NAN, f64::INFINITY, -1.0] {
            assert_eq!(counters.count(0, bad, 1), 1, "{bad}");
        }
        assert_eq!((counters.all(0), counters.term(1, 0)), (0, 0));
        assert_eq!(counters.count(0, 1.0, 1), 0);
        assert_eq!(counters.all(0), QUANTA_PER_PHOTON as u64);
    }
}
