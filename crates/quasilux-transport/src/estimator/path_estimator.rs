//! Path tracing estimator of all sensors (Kajiya 1986), alone or on illumination maps.

mod advance;
mod blocks;
mod progress;
mod resolved;
mod snapshot;
mod state;

use crate::codec::{Reader, StateError, Writer};
use crate::context::{Context, Stream};
use crate::control::watch::Watch;
use crate::estimator::Estimator;
use crate::estimator::block::BlockFrame;
use crate::estimator::exact::{ComputedLight, Exact, computed_light};
use crate::estimator::progress::TargetProgress;
use crate::path::end::{PathEnd, Prepared};
use crate::path::path_batch::{PathBatch, PathSums, Piece, WorkCounts, trace_batches};
use crate::path::wave::PathWave;
use crate::photon::caustics::CausticMap;
use crate::photon::counts::PhotonCounts;
use crate::sensors::{Target, by_sensor, targets};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::caveat::Caveat;
use crate::stats::decisions::Decisions;
use crate::stats::estimates::{Dimensions, Estimates, SensorEstimates, TermEstimates};
use crate::stats::scores::Scores;
use crate::stats::tally::{Quantum, Sum};
use quasilux_scene::Scene;
use resolved::samples_direct;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// The first checkpoint takes at most this many indices, and about this many paths and photons of
/// maps in all.
const FIRST_SAMPLES: u64 = 16;
const FIRST_PATHS: u64 = 1 << 22;

/// Paths from all sensor points, in all replicates.
pub(crate) struct PathEstimator<'a, S> {
    context: &'a Context<'a, S>,
    scene: &'a Scene,
    targets: Vec<Target>,
    computed: ComputedLight,
    /// Targets to which light that is sampled may come straight.
    samples_direct: Vec<bool>,
    shared: SharedLight<S>,
    replicates: u32,
    quantum: Quantum,
    /// Of target t in replicate r at `t * replicates + r`.
    sums: Vec<PathSums>,
    /// Of each target.
    scores: Vec<Scores>,
    /// In paths, in the order of `sums`.
    progress: TargetProgress,
    costs: CostsByKind,
}

/// Photons that serve all paths.
struct SharedLight<S> {
    end: PathEnd<S>,
    caustics: Option<CausticMap<S>>,
    /// Indices that they are traced for, where that is for blocks of another process.
    traced_for: u64,
    /// Illuminance in lx of each target before the maps last changed.
    last_lx: Vec<Option<f64>>,
}

/// Counts of traced paths and photons.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Costs {
    work: WorkCounts,
    photons: PhotonCounts,
}

/// Counts of traced paths and photons, by what they serve.
struct CostsByKind {
    /// Before the first sample.
    prepared: Costs,
    /// Of photons that serve all paths.
    shared: Costs,
    /// Of the paths, and of photons that come with each.
    paths: Costs,
}

impl CostsByKind {
    /// All that was traced.
    fn total(&self) -> Costs {
        let Self { prepared, shared, paths } = self;
        [shared, paths].into_iter().fold(prepared.clone(), |mut sum, costs| {
            sum.work += costs.work.clone();
            sum.photons += costs.photons.clone();
            sum
        })
    }
}

impl<'a, S: Spectrum> PathEstimator<'a, S> {
    /// Paths as the settings say, alone or on a map; `None` when the observer stopped it before it
    /// was ready.
    pub(crate) fn new(
        context: &'a Context<'a, S>,
        scene: &'a Scene,
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Option<Self> {
        let targets = targets(scene);
        let replicates = settings.effective_replicates();
        let computed = computed_light(context, &targets, watch)?;
        let samples_direct = targets.iter().map(|target| samples_direct(context, target)).collect();
        let quantum = Quantum::for_reference(context.lights.reference_lx(&context.world));
        let Prepared { end, counts: photons } =
            PathEnd::prepare(context, settings, &targets, watch);
        let work = WorkCounts { rays: computed.rays, ..WorkCounts::default() };
        Some(Self {
            context,
            scene,
            computed,
            samples_direct,
            shared: SharedLight {
                end,
                caustics: CausticMap::new(context, settings, &targets),
                traced_for: 0,
                last_lx: vec![None; targets.len()],
            },
            replicates,
            quantum,
            sums: vec![PathSums::default(); targets.len() * replicates as usize],
            scores: vec![Scores::default(); targets.len()],
            progress: TargetProgress::new(targets.len()),
            targets,
            costs: CostsByKind {
                prepared: Costs { work, photons },
                shared: Costs::default(),
                paths: Costs::default(),
            },
        })
    }

    /// Traces the paths `piece`, of those that are left when the paths `indices` of all growing
    /// targets and replicates, in the order of [`Self::sums`], are put in one row.
    fn trace_piece(
        &self,
        piece: &Range<u64>,
        indices: &Range<u64>,
        wave: &mut PathWave<S>,
    ) -> Piece {
        let each = indices.end - indices.start;
        let numbers = piece.start / each..piece.end.div_ceil(each);
        let batches: Vec<PathBatch<'_, S>> = numbers
            .map(|number| {
                let first = indices.start + piece.start.saturating_sub(number * each);
                let end = indices.start + (piece.end - number * each).min(each);
                self.batch(number, first..end)
            })
            .collect();
        trace_batches(self.context, &batches, self.quantum, wave)
    }

    /// The paths `indices` of the pair `number` of a growing target and a replicate.
    fn batch(&self, number: u64, indices: Range<u64>) -> PathBatch<'_, S> {
        let target = self.progress.growing()[(number / u64::from(self.replicates)) as usize];
        let replicate = (number % u64::from(self.replicates)) as u32;
        PathBatch {
            number: number as usize,
            target: self.targets[target],
            points: self.context.points(replicate, Stream::Paths(target as u64)),
            map_end: self.shared.end.map_end(self.context, replicate),
            caustics: self.shared.caustics.as_ref().and_then(|caustics| caustics.map(replicate)),
            indices,
        }
    }
}

impl<S: Spectrum> PathEstimator<'_, S> {
    /// Where the pair `number` of a growing target and a replicate has its sums.
    fn place(&self, number: usize) -> usize {
        let replicates = self.replicates as usize;
        self.progress.growing()[number / replicates] * replicates + number % replicates
    }

    /// Does nothing more for each target that has ended alone; other paths and photons stay what
    /// they are.
    fn freeze_caustics(&mut self) {
        if let Some(caustics) = &mut self.shared.caustics {
            caustics.freeze_converged(self.progress.ends());
        }
    }

    /// Mean of a sum over the paths of a target in one replicate.
    fn mean(&self, target: usize, sum: Sum) -> f64 {
        self.quantum.value(sum) / self.progress.samples_of(target) as f64
    }

    /// The terms of the Neumann series that are listed, and the rest.
    fn terms(&self) -> Vec<TermEstimates> {
        let (listed, replicates) = (self.context.listed_terms as usize, self.replicates as usize);
        if listed == 0 {
            return Vec::new();
        }
        let sum = |sums: &PathSums, term: usize| sums.terms.get(term).copied().unwrap_or_default();
        let caustic_lx = |r: usize, target: usize, term: usize| {
            let caustics = self.shared.caustics.as_ref();
            caustics.map_or(0.0, |caustics| caustics.term_lx(r, target, term))
        };
        let row = |term: usize, r: usize| -> Vec<f64> {
            let own = self.sums.iter().skip(r).step_by(replicates);
            own.zip(&self.computed.of_targets)
                .enumerate()
                .map(|(target, (sums, exact))| {
                    let exact_lx = Some(exact.terms_lx[term]).filter(|lx| lx.is_finite());
                    exact_lx.unwrap_or(0.0)
                        + self.mean(target, sum(sums, term))
                        + caustic_lx(r, target, term)
                })
                .collect()
        };
        let resolved = |term: usize| -> Vec<bool> {
            let cut = self.context.max_bounces.is_some_and(|most| term > most as usize);
            let targets = self.sums.chunks_exact(replicates).zip(&self.samples_direct);
            targets
                .map(|(own, samples_direct)| {
                    let found = own.iter().any(|sums| !sum(sums, term).is_zero());
                    let may_be = if term == 0 {
                        *samples_direct
                    } else {
                        own.iter().any(|sums| sums.reflected > 0)
                    };
                    found || cut || !may_be
                })
                .collect()
        };
        (0..=listed)
            .map(|term| TermEstimates {
                replicate_lx: (0..replicates).map(|r| row(term, r)).collect(),
                resolved: resolved(term),
            })
            .collect()
    }

    /// Illuminances at all targets in one replicate.
    fn replicate_lx(&self, replicate: usize) -> Vec<f64> {
        let own = self.sums.iter().skip(replicate).step_by(self.replicates as usize);
        let value_lx = |(target, (sums, exact)): (usize, (&PathSums, &Exact))| {
            let sampled_lx = self.mean(target, sums.direct) + self.mean(target, sums.indirect);
            let caustics = self.shared.caustics.as_ref();
            let caustic_lx = caustics.map_or(0.0, |map| map.target_lx(replicate, target));
            exact.sum_lx() + sampled_lx + caustic_lx
        };
        own.zip(&self.computed.of_targets).enumerate().map(value_lx).collect()
    }

    /// Direct illuminances at all targets, mean over the replicates.
    fn direct_lx(&self) -> Vec<f64> {
        let replicates = self.replicates as usize;
        let own = self.sums.chunks_exact(replicates).zip(&self.computed.of_targets).enumerate();
        own.map(|(target, (own, Exact { direct_lx, .. }))| {
            let sampled_lx = own.iter().map(|sums| self.mean(target, sums.direct));
            direct_lx + sampled_lx.sum::<f64>() / replicates as f64
        })
        .collect()
    }

    /// Number of refused contributions, photons included.
    fn invalid_contributions(&self, of_photons: u64) -> u64 {
        self.computed.invalid
            + of_photons
            + self.shared.caustics.as_ref().map_or(0, CausticMap::invalid)
            + self.sums.iter().map(PathSums::invalid).sum::<u64>()
    }
}

impl<S: Spectrum> Estimator for PathEstimator<'_, S> {
    fn advance(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool {
        watch.expect_work(self.work_up_to(samples));
        self.serve(samples, watch) && self.gather(samples, watch)
    }

    fn estimates(&self) -> Estimates {
        let Costs { work, photons } = self.costs.total();
        let replicates = self.replicates as usize;
        let replicate_lx: Vec<Vec<f64>> = (0..replicates).map(|r| self.replicate_lx(r)).collect();
        let evidence = self.evidence(&replicate_lx);
        let targets = 0..self.targets.len();
        let all = SensorEstimates {
            replicate_lx,
            direct_lx: self.direct_lx(),
            evidence,
            samples: targets.map(|target| self.progress.samples_of(target)).collect(),
            average: None,
            terms: self.terms(),
            unseen: None,
        };
        let of_paths = Caveat::of_paths(work.endless);
        let caveats = photons.caveat().into_iter().chain(of_paths).collect();
        Estimates {
            sensors: by_sensor(self.scene, all),
            samples: self.progress.samples,
            rays: work.rays + photons.rays,
            flux: photons.balance(self.context.lights.flux_lm),
            biased: work.endless + photons.trapped > 0,
            caveats,
            dimensions: Dimensions {
                photon: photons.dimensions,
                photons: photons.begun,
                photon_events: photons.events,
                path: work.dimensions,
            },
            invalid_contributions: self.invalid_contributions(photons.invalid),
            ..Estimates::default()
        }
    }

    fn decisions(&self) -> Decisions {
        self.decided()
    }

    fn put(&self, out: &mut Writer) {
        self.put_all(out);
    }

    fn merge_from(&mut self, coming: u64, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.take_in_all(coming, from)
    }

    fn trace_part(&mut self, part: Range<u64>, samples: u64, watch: &mut Watch<'_>) -> bool {
        self.progress.begin_at(part.start);
        self.serve(samples, watch) && self.gather(part.end, watch)
    }

    fn put_shared(&self, out: &mut Writer) {
        self.put_shared(out);
    }

    fn put_part(&self, out: &mut Writer) {
        self.put_own(out);
    }

    fn merge_shared(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.merge_shared(from)
    }

    fn merge_part(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.take_in_own(from)
    }

    fn trace_block(
        &mut self,
        frame: &BlockFrame,
        block: Range<u64>,
    ) -> Result<Vec<u8>, StateError> {
        self.trace_block(frame, block)
    }

    fn complete_at(&mut self, samples: u64) {
        self.progress.complete(samples);
    }

    fn freeze_converged(&mut self, done: &[bool]) -> bool {
        self.progress.freeze(done);
        self.freeze_caustics();
        true
    }

    fn first_checkpoint(&self) -> u64 {
        let photons = self.shared.end.photons_of_an_index(self.replicates);
        let affordable = FIRST_PATHS / photons.saturating_add(self.sums.len() as u64).max(1);
        let powers = (affordable + 1).next_power_of_two() / 2;
        powers.clamp(1, FIRST_SAMPLES)
    }
}
