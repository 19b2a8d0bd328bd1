//! The estimator of all sensors by bidirectional paths: sums over units of work, and the estimates
//! that follow from them.

use super::caps::{Caps, SamplesOfIndex, index_totals};
use super::engine::Engine;
use super::flux_tally::FluxTally;
use super::join_rate::plan_joins;
use super::plan::SUBPATHS;
use super::sums::TargetSums;
use super::surveyed::survey;
use super::unit::UnitSums;
use crate::codec::{Reader, StateError, Sums, Writer, add_count, digest};
use crate::context::Context;
use crate::control::watch::Watch;
use crate::estimator::Estimator;
use crate::estimator::block::BlockFrame;
use crate::estimator::exact::{ComputedLight, Exact, computed_light};
use crate::estimator::progress::TargetProgress;
use crate::path::path_batch::WorkCounts;
use crate::sensors::{by_sensor, targets};
use crate::settings::{IntervalKind, Settings, Switch};
use crate::spectrum::Spectrum;
use crate::stats::caveat::Caveat;
use crate::stats::decisions::Decisions;
use crate::stats::estimates::{Dimensions, Estimates, SensorEstimates, TermEstimates};
use crate::stats::point_status::Evidence;
use crate::stats::tally::{Quantum, Sum};
use crate::stats::unseen::UnseenLight;
use quasilux_scene::Scene;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Bidirectional paths from all sensor points, in all replicates.
pub(crate) struct BidirectionalEstimator<'a, S> {
    pub(super) engine: Engine<'a, 'a, S>,
    pub(super) scene: &'a Scene,
    caps: Caps,
    /// Whether certified intervals were asked for, and what they know of indices.
    is_certified: bool,
    samples_of_index: Option<SamplesOfIndex>,
    computed: ComputedLight,
    pub(super) replicates: u32,
    pub(super) quantum: Quantum,
    /// Of target t in replicate r at `t * replicates + r`.
    pub(super) sums: Vec<TargetSums>,
    /// In units of work.
    pub(super) progress: TargetProgress,
    pub(super) costs: Costs,
    /// Rays of surveys and pilots.
    pilot_rays: u64,
}

/// Counts of traced paths and photons, and their flux.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Costs {
    pub(super) paths: WorkCounts,
    pub(super) photons: u64,
    pub(super) flux: FluxTally,
}

impl Costs {
    /// Adds those of a unit.
    pub(super) fn add(&mut self, unit: &UnitSums) {
        self.paths += unit.work.clone();
        self.photons += unit.photons;
        self.flux += &unit.flux;
    }
}

impl Sums for Costs {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        self.paths.checked_add(&other.paths)?;
        self.flux.checked_add(&other.flux)?;
        add_count(&mut self.photons, other.photons)
    }
}

impl<'a, S: Spectrum> BidirectionalEstimator<'a, S> {
    /// `None` when the observer stopped it before it was ready.
    pub(crate) fn new(
        context: &'a Context<'a, S>,
        scene: &'a Scene,
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Option<Self> {
        let targets = targets(scene);
        let computed = computed_light(context, &targets, watch)?;
        let mut engine = Engine::new(context, &targets, watch)?;
        let is_certified = settings.interval == IntervalKind::Certified;
        let may_copy = settings.importance != Switch::Off && context.max_bounces != Some(0);
        let mut pilot_rays = 0;
        if may_copy && !is_certified {
            pilot_rays += survey(&mut engine, &targets, watch)?;
        }
        pilot_rays += plan_joins(&mut engine, watch)?;
        let caps = Caps::new(&engine, watch)?;
        for (receiver, most_lx) in
            engine.receivers.iter_mut().zip(caps.of_samples_lx(&context.world))
        {
            receiver.most_lx = most_lx;
        }
        let replicates = settings.effective_replicates();
        let empty = TargetSums::new(context.listed_terms);
        Some(Self {
            is_certified,
            samples_of_index: is_certified
                .then(|| SamplesOfIndex::new(&engine, settings.sequence))
                .flatten(),
            caps,
            engine,
            scene,
            computed,
            replicates,
            quantum: Quantum::for_reference(context.lights.reference_lx(&context.world)),
            sums: vec![empty; targets.len() * replicates as usize],
            progress: TargetProgress::new(targets.len()),
            costs: Costs::default(),
            pilot_rays,
        })
    }

    fn mean(&self, target: usize, sum: Sum) -> f64 {
        self.quantum.value(sum) / self.progress.samples_of(target).max(1) as f64
    }

    /// The illuminance at a target after this many indices of all replicates together; `None`
    /// without any.
    pub(super) fn all_lx(&self, target: usize, indices: u64) -> Option<f64> {
        let replicates = self.replicates as usize;
        let own = &self.sums[target * replicates..][..replicates];
        let of_sums =
            |sums: &TargetSums| self.quantum.value(sums.direct) + self.quantum.value(sums.indirect);
        let sampled: f64 = own.iter().map(of_sums).sum();
        (indices > 0).then(|| self.computed.of_targets[target].sum_lx() + sampled / indices as f64)
    }

    /// The mean over the replicates of what `sum` takes of each target.
    fn mean_of(&self, sum: impl Fn(&TargetSums) -> Sum) -> Vec<f64> {
        let own = self.sums.chunks_exact(self.replicates as usize).enumerate();
        own.map(|(target, own)| {
            let all_lx: f64 = own.iter().map(|sums| self.mean(target, sum(sums))).sum();
            all_lx / own.len() as f64
        })
        .collect()
    }

    /// One row a replicate: what `sum` takes of each target, beside what was computed.
    fn rows(
        &self,
        exact_lx: impl Fn(&Exact) -> f64,
        sum: impl Fn(&TargetSums) -> [Sum; 2],
    ) -> Vec<Vec<f64>> {
        let replicates = self.replicates as usize;
        let row = |replicate: usize| {
            let exact = &self.computed.of_targets;
            let own = self.sums.iter().skip(replicate).step_by(replicates).zip(exact);
            let value_lx = |(target, (sums, exact)): (usize, (&TargetSums, &Exact))| {
                let [a, b] = sum(sums).map(|sum| self.mean(target, sum));
                exact_lx(exact) + a + b
            };
            own.enumerate().map(value_lx).collect()
        };
        (0..replicates).map(row).collect()
    }

    /// The terms of the Neumann series that are listed, and the rest.
    fn terms(&self) -> Vec<TermEstimates> {
        let listed = self.context().listed_terms as usize;
        if listed == 0 {
            return Vec::new();
        }
        let term = |term: usize| TermEstimates {
            replicate_lx: self.rows(
                |exact| Some(exact.terms_lx[term]).filter(|lx| lx.is_finite()).unwrap_or(0.0),
                |sums| [sums.terms[term], Sum::default()],
            ),
            resolved: vec![true; self.progress.targets()],
        };
        (0..=listed).map(term).collect()
    }

    /// Eye paths of a target in all replicates.
    fn trials(&self, target: usize) -> f64 {
        self.progress.samples_of(target) as f64 * f64::from(self.replicates)
    }

    /// Bounds, at all points, on light that no sample met.
    fn unseen(&self) -> UnseenLight {
        let trials = |target| self.trials(target);
        let exact_lx = || self.computed.of_targets.iter().map(Exact::sum_lx).collect();
        let samples = self.samples_of_index.as_ref();
        UnseenLight {
            average_lx: 0.0,
            point_lx: self.caps.unseen_lx(trials),
            merged_lx: self.mean_of(|sums| sums.merged),
            disc_radius_m: self.engine.receivers.iter().map(|it| it.radius_m).collect(),
            totals: self
                .is_certified
                .then(|| index_totals(&self.engine, samples, exact_lx(), trials)),
        }
    }

    fn context(&self) -> &'a Context<'a, S> {
        self.engine.context
    }
}

impl<S: Spectrum> Estimator for BidirectionalEstimator<'_, S> {
    fn advance(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool {
        self.trace_up_to(samples, watch)
    }

    fn estimates(&self) -> Estimates {
        let progress = &self.progress;
        let (targets, exact) = (progress.targets(), &self.computed.of_targets);
        let direct_lx = self.mean_of(|sums| sums.direct);
        let exact_lx = exact.iter().map(|exact| exact.direct_lx);
        let all = SensorEstimates {
            replicate_lx: self.rows(Exact::sum_lx, |sums| [sums.direct, sums.indirect]),
            direct_lx: direct_lx.into_iter().zip(exact_lx).map(|(a, b)| a + b).collect(),
            evidence: vec![Evidence::Sound; targets],
            samples: (0..targets).map(|target| progress.samples_of(target)).collect(),
            average: None,
            terms: self.terms(),
            unseen: Some(self.unseen()),
        };
        let mut sensors = by_sensor(self.scene, all);
        let mut first = 0;
        for sensor in &mut sensors {
            let Some(unseen) = &mut sensor.unseen else { continue };
            let own = first..first + unseen.point_lx.len();
            first = own.end;
            let trials = own.map(|target| self.trials(target));
            let least_trials = trials.fold(f64::INFINITY, f64::min);
            unseen.average_lx = self.caps.unseen_of_average_lx(&unseen.point_lx, least_trials);
        }
        let (engine, Costs { paths, photons, flux }) = (&self.engine, &self.costs);
        Estimates {
            sensors,
            samples: progress.samples,
            rays: paths.rays + self.computed.rays + self.pilot_rays,
            flux: flux.balance(&engine.context.lights, *photons, engine.flux_quantum),
            biased: paths.endless > 0,
            caveats: Caveat::of_paths(paths.endless).into_iter().collect(),
            dimensions: Dimensions {
                photons: *photons,
                path: paths.dimensions.clone(),
                ..Dimensions::default()
            },
            invalid_contributions: self.computed.invalid
                + self.sums.iter().map(TargetSums::invalid).sum::<u64>(),
            ..Estimates::default()
        }
    }

    fn decisions(&self) -> Decisions {
        let Engine { receivers, emitters_found_by, sky_found_by, copies, openings, .. } =
            &self.engine;
        Decisions {
            connected_photons: Some(SUBPATHS),
            digest: digest(|out| {
                out.value(&self.quantum);
                let exact = self.computed.of_targets.iter();
                out.value(&exact.map(Exact::sum_lx).collect::<Vec<f64>>());
                out.value(&SUBPATHS);
                copies.put(out);
                openings.put(out);
                out.value(&[*emitters_found_by, *sky_found_by]);
                let of_receivers = receivers.iter().map(|it| {
                    [it.area_m2, it.per_sure_m2, it.view.through, it.view.surfaces_behind]
                });
                out.value(&of_receivers.collect::<Vec<[f64; 4]>>());
            }),
            ..Decisions::default()
        }
    }

    fn put(&self, out: &mut Writer) {
        self.put_all(out);
    }

    fn merge_from(&mut self, coming: u64, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.take_in_all(coming, from)
    }

    fn trace_part(&mut self, part: Range<u64>, _samples: u64, watch: &mut Watch<'_>) -> bool {
        self.progress.begin_at(part.start);
        self.trace_up_to(part.end, watch)
    }

    fn put_shared(&self, _out: &mut Writer) {}

    fn merge_shared(&mut self, _from: &mut Reader<'_>) -> Result<(), StateError> {
        Ok(())
    }

    fn put_part(&self, out: &mut Writer) {
        self.put_own(out);
    }

    fn merge_part(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.take_in_own(from)
    }

    fn trace_block(
        &mut self,
        frame: &BlockFrame,
        block: Range<u64>,
    ) -> Result<Vec<u8>, StateError> {
        self.trace_units_of(frame, block)
    }

    fn complete_at(&mut self, samples: u64) {
        self.progress.complete(samples);
    }

    fn freeze_converged(&mut self, done: &[bool]) -> bool {
        self.progress.freeze(done);
        true
    }

    fn first_checkpoint(&self) -> u64 {
        // Where there are many targets all that a time limit leaves.
        1
    }
}
