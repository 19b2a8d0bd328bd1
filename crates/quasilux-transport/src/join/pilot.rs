//! How many photons are joined for each path, by what a pilot measures.
//!
//! Paths with variance V and joined photons with variance U a photon, all of one sample, and costs c
//! and d in rays: n photons a path make the error `(V + U / n) (c + n d)`, squared and times the cost; it
//! is least for `n^2 = U c / (V d)`. Where a survey would have photons steered, they are tried steered and
//! left alone. The best is compared with paths that go alone. Variances are relative to the value, mean over
//! the sensor points. What paths hardly ever find does not show in their spread: what they are short of
//! counts as an error of theirs. Paths alone stand for those that end on a corrected map, which are about as good
//! or better: the map is made only where it is used.

use super::{Joined, Joining};
use crate::gathering::Exact;
use crate::path_end::Rest;
use crate::path_wave::PathWave;
use crate::photon::PhotonCounts;
use crate::sections::{Piece, Section, trace_sections};
use crate::settings::{Estimator, Settings, Switch};
use crate::spectrum::Spectrum;
use crate::stage::{Stage, Stream};
use crate::steering::{self, Plan};
use crate::tally::Quantum;
use crate::targets::Target;
use crate::watch::Watch;
use rayon::prelude::*;
use std::ops::Range;

/// Numbers of the replicates that only this pilot uses.
const REPLICATES: Range<u32> = 1 << 24..(1 << 24) + 8;
/// Paths from each target.
const SAMPLES: u64 = 16;
/// Photons for each.
const PHOTONS: u64 = 8;
/// Targets that are looked at, spread over all.
const TARGETS: usize = 64;
/// Most photons for a path.
const MOST_PHOTONS: f64 = 64.0;
/// The same for photons that are only counted.
const COARSE_PHOTONS: u64 = 64;
const MOST_COARSE_PHOTONS: f64 = 1024.0;
/// In a longer run, the error of the paths falls to about this part of what photons leave by then: they ask for
/// fewer coordinates. Measured on the office and the cube, where it makes the error least for the rays.
const LATER: f64 = 0.125;
/// Photons are not counted by cell where sensors times cells are more than this: they would take 8 bytes each.
const MOST_VIEWS: usize = 1 << 24;
/// A shortfall of so many times the variance of means may be by chance.
const BY_CHANCE: f64 = 4.0;
/// A ray that joins costs this part of a ray on a path: it only asks whether anything is in the way, and
/// its neighbours end where it does.
const JOINING_RAY: f64 = 0.25;

/// What was decided, and what it took.
pub(crate) struct Decision {
    /// `None` where paths go alone.
    pub(crate) joined: Option<Joined>,
    pub(crate) rays: u64,
}

/// Values of some targets by replicate, in lx, and rays.
struct Trial {
    /// Of target t in replicate r at `t * REPLICATES.len() + r`.
    lx: Vec<f64>,
    rays: f64,
}

/// Surveys the scene, tries both where the settings leave a choice, and decides.
pub(crate) fn decide<S: Spectrum>(
    stage: &Stage<'_, S>,
    settings: &Settings,
    targets: &[Target],
    exact: &[Exact],
    quantum: Quantum,
    watch: &mut Watch<'_>,
) -> Decision {
    let is_possible = settings.estimator == Estimator::Bidirectional
        && settings.joining != Switch::Off
        && settings.max_bounces != Some(0)
        && !targets.is_empty();
    if !is_possible {
        return Decision { joined: None, rays: 0 };
    }
    let sample = Sample::new(targets, exact);
    let alone = Trial::of_paths(stage, &sample.targets, None, quantum);
    let mut rays = alone.rays as u64;
    let mut ways = Vec::new();
    for Plan { windows, forecast, rays: of_survey } in plans(stage, targets, settings.steering) {
        rays += of_survey;
        let Some(forecast) = forecast else { continue };
        let expected_lx = exact.iter().enumerate();
        let expected_lx: Vec<f64> = expected_lx
            .map(|(target, exact)| exact.sum_lx() + forecast.indirect_lx(target))
            .collect();
        let asked_lx = sample.of(&expected_lx);
        let is_coarse = targets.len() * forecast.places.len() <= MOST_VIEWS;
        let joining = Joining {
            landings: forecast.landings,
            places: forecast.places,
            windows,
            photons: PHOTONS,
            coarse_photons: if is_coarse { COARSE_PHOTONS } else { 0 },
        };
        let (tried, kept) = (sample.targets.clone(), (0, quantum));
        let mut pilot = Joined::new(stage, joining, tried, asked_lx, REPLICATES, kept);
        // Before the first checkpoint the observer stops nothing, so there are always counts.
        let counts = pilot.grow(stage, SAMPLES, watch).unwrap_or_default();
        let [joined, coarse] = Trial::of_joined(&pilot, sample.targets.len(), &counts);
        // Photons that are counted serve all targets, not those alone that are looked at.
        let coarse = Trial { rays: coarse.rays / sample.step as f64, ..coarse };
        let beside = Trial::of_paths(stage, &sample.targets, Some(&pilot.joining), quantum);
        rays += pilot.rays + beside.rays as u64;
        rays += counts.iter().map(|counts| counts.rays).sum::<u64>();
        ways.push(Way { joining: pilot.joining, expected_lx, joined, coarse, beside });
    }
    let means_lx = sample.means_lx(&ways, &alone);
    let noise =
        alone.variance(&means_lx) + ways.iter().map(|way| way.variance(&means_lx)).sum::<f64>();
    let noise = noise / REPLICATES.len() as f64;
    let best = ways
        .into_iter()
        .map(|way| (way.best(&sample.exact_lx, &means_lx, noise), way))
        .min_by(|(a, _), (b, _)| a.error.total_cmp(&b.error));
    let found_alone_lx = |target: usize| sample.exact_lx[target] + alone.moments(target).mean;
    let of_alone = alone.variance(&means_lx) + shortfall(&means_lx, found_alone_lx, noise);
    let pays = |best: &Best| best.error < of_alone * alone.rays;
    let best = best.filter(|(best, _)| settings.joining == Switch::On || pays(best));
    let joined = best.map(|(Best { photons, coarse_photons, .. }, way)| {
        let joining = Joining { photons, coarse_photons, ..way.joining };
        let replicates = 0..settings.effective_replicates();
        let kept = (stage.listed_terms, quantum);
        Joined::new(stage, joining, targets.to_vec(), way.expected_lx, replicates, kept)
    });
    rays += joined.as_ref().map_or(0, |joined| joined.rays);
    Decision { joined, rays }
}

/// Photons as the survey says; where it says that they should be steered, also left alone.
fn plans<S: Spectrum>(stage: &Stage<'_, S>, targets: &[Target], steering: Switch) -> Vec<Plan> {
    let plan = steering::foresee(stage, targets, steering);
    let is_open = steering == Switch::Auto && plan.windows.is_some();
    let plain = is_open.then(|| steering::foresee(stage, targets, Switch::Off));
    std::iter::once(plan).chain(plain).collect()
}

/// The targets that are looked at.
struct Sample {
    /// Every so many of all.
    step: usize,
    targets: Vec<Target>,
    exact_lx: Vec<f64>,
}

/// How much a trial is short of the means, squared and relative, mean over the targets: as far as it cannot
/// be by chance, where means have this variance.
fn shortfall(means_lx: &[f64], found_lx: impl Fn(usize) -> f64, noise: f64) -> f64 {
    let seen = means_lx.iter().enumerate().filter(|(_, mean_lx)| **mean_lx > 0.0);
    let (sum, count) = seen.fold((0.0, 0.0), |(sum, count), (target, mean_lx)| {
        let missing = 1.0 - found_lx(target) / mean_lx;
        (sum + missing * missing, count + 1.0)
    });
    if count > 0.0 { (sum / count - BY_CHANCE * noise).max(0.0) } else { 0.0 }
}

/// A way to join photons, tried.
struct Way {
    joining: Joining,
    expected_lx: Vec<f64>,
    joined: Trial,
    coarse: Trial,
    beside: Trial,
}

/// How photons are joined best in one way.
struct Best {
    /// For each path.
    photons: u64,
    /// For each path, only counted.
    coarse_photons: u64,
    /// Squared relative error times rays.
    error: f64,
}

impl Sample {
    fn new(targets: &[Target], exact: &[Exact]) -> Self {
        let step = targets.len().div_ceil(TARGETS).max(1);
        let exact_lx = exact.iter().step_by(step).map(Exact::sum_lx).collect();
        Self { step, targets: targets.iter().step_by(step).copied().collect(), exact_lx }
    }

    fn of(&self, all: &[f64]) -> Vec<f64> {
        all.iter().step_by(self.step).copied().collect()
    }

    /// The illuminance at each, as far as known: the most that any way found, for what is seldom found is
    /// found too little by most.
    fn means_lx(&self, ways: &[Way], alone: &Trial) -> Vec<f64> {
        let mean_lx = |(target, exact_lx): (usize, &f64)| {
            let found = |way: &Way| way.found_lx(target);
            let most = ways.iter().map(found).fold(alone.moments(target).mean, f64::max);
            exact_lx + most
        };
        self.exact_lx.iter().enumerate().map(mean_lx).collect()
    }
}

impl Way {
    /// By photons and by paths beside them, at one target.
    fn found_lx(&self, target: usize) -> f64 {
        let all = [&self.joined, &self.coarse, &self.beside];
        all.into_iter().map(|trial| trial.moments(target).mean).sum()
    }

    /// Of one sample with the photons that were tried.
    fn variance(&self, means_lx: &[f64]) -> f64 {
        [&self.joined, &self.coarse, &self.beside]
            .map(|trial| trial.variance(means_lx))
            .iter()
            .sum()
    }

    fn best(&self, exact_lx: &[f64], means_lx: &[f64], noise: f64) -> Best {
        let found_lx = |target: usize| exact_lx[target] + self.found_lx(target);
        let shortfall = shortfall(means_lx, found_lx, noise);
        let of_beside = self.beside.variance(means_lx);
        let part = |trial: &Trial, variance: f64, tried: u64, most: f64| {
            if trial.rays == 0.0 {
                return Part { photons: 0.0, error: 0.0, rays: 0.0 };
            }
            let ratio = variance * self.beside.rays / (of_beside * LATER * trial.rays);
            let best = if ratio.is_nan() { 1.0 } else { ratio.sqrt() } * tried as f64;
            let photons = libm::exp2(libm::round(libm::log2(best.clamp(1.0, most))));
            let more = photons / tried as f64;
            Part { photons, error: variance / more, rays: trial.rays * more }
        };
        // What is seldom found, joined photons would have found.
        let of_joined = self.joined.variance(means_lx) + shortfall;
        let joined = part(&self.joined, of_joined, PHOTONS, MOST_PHOTONS);
        let of_coarse = self.coarse.variance(means_lx);
        let coarse = part(&self.coarse, of_coarse, COARSE_PHOTONS, MOST_COARSE_PHOTONS);
        let error = of_beside + joined.error + coarse.error;
        Best {
            photons: joined.photons as u64,
            coarse_photons: coarse.photons as u64,
            error: error * (self.beside.rays + joined.rays + coarse.rays),
        }
    }
}

/// So many photons of one kind for a path, and what they bring and cost.
struct Part {
    photons: f64,
    error: f64,
    rays: f64,
}

/// Of what the replicates found at one target.
struct Moments {
    mean: f64,
    variance: f64,
}

impl Trial {
    /// What joined and counted photons found.
    fn of_joined(pilot: &Joined, targets: usize, counts: &[PhotonCounts; 2]) -> [Self; 2] {
        let pairs =
            || (0..targets).flat_map(|target| (0..REPLICATES.len()).map(move |r| (r, target)));
        let fine_lx = pairs().map(|(r, target)| pilot.fine_lx(r, target)).collect();
        let coarse_lx = pairs().map(|(r, target)| pilot.coarse_lx(r, target, None)).collect();
        let [fine, coarse] = counts;
        let joins = fine.joins as f64;
        let rays = fine.rays as f64 - joins + JOINING_RAY * joins;
        [Self { lx: fine_lx, rays }, Self { lx: coarse_lx, rays: coarse.rays as f64 }]
    }

    fn of_paths<S: Spectrum>(
        stage: &Stage<'_, S>,
        targets: &[Target],
        joining: Option<&Joining>,
        quantum: Quantum,
    ) -> Self {
        let each = REPLICATES.len();
        let trace = |wave: &mut PathWave<S>, number: usize| -> Piece {
            let target = number / each;
            let replicate = REPLICATES.start + (number % each) as u32;
            let section = Section {
                number,
                target: targets[target],
                points: stage.points(replicate, Stream::Paths(target as u64)),
                rest: Rest::Path,
                hidden: None,
                joining,
                indices: 0..SAMPLES,
            };
            trace_sections(stage, &[section], quantum, wave)
        };
        let numbers = (0..targets.len() * each).into_par_iter();
        let pieces: Vec<Piece> = numbers.map_init(PathWave::default, trace).collect();
        let value_lx = |piece: &Piece| -> f64 {
            let sums = &piece.sums[0];
            (quantum.value(sums.direct) + quantum.value(sums.indirect)) / SAMPLES as f64
        };
        let rays: u64 = pieces.iter().map(|piece| piece.work.rays).sum();
        Self { lx: pieces.iter().map(value_lx).collect(), rays: rays as f64 }
    }

    /// Relative variance, mean over the targets.
    fn variance(&self, means_lx: &[f64]) -> f64 {
        let seen = || means_lx.iter().enumerate().filter(|(_, mean_lx)| **mean_lx > 0.0);
        let relative =
            seen().map(|(target, mean_lx)| self.moments(target).variance / (mean_lx * mean_lx));
        relative.sum::<f64>() / seen().count().max(1) as f64
    }

    fn moments(&self, target: usize) -> Moments {
        let each = REPLICATES.len();
        let values = &self.lx[target * each..(target + 1) * each];
        let mean = values.iter().sum::<f64>() / each as f64;
        let squares = values.iter().map(|value| (value - mean) * (value - mean));
        Moments { mean, variance: squares.sum::<f64>() / (each - 1) as f64 }
    }
}
