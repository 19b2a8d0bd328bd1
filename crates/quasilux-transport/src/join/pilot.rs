//! How many photons are joined for each path, by what a pilot measures.
//!
//! A trial of each shows variances V of paths and U of a photon, at each sensor point and for one sample, and what
//! both cost in rays: n photons a path leave `V + U / n`. Of all powers of two for n the cheapest is taken
//! ([`Cost`]). Where a survey would have photons steered, they are tried steered and
//! left alone. The best is compared with paths that go alone. Variances are relative to the tolerance, or else to the
//! value. What paths hardly ever find does not show in their spread: what they are short of
//! counts as an error of theirs. Paths alone stand for those that end on a corrected map, which are about as good
//! or better: the map is made only where it is used.

use super::cost::Cost;
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
const MOST_PHOTONS: u64 = 64;
/// The same for photons that are only counted.
const COARSE_PHOTONS: u64 = 64;
const MOST_COARSE_PHOTONS: u64 = 1024;
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
        && settings.joins() != Some(false)
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
    let wanted = Wanted::new(settings, sample.means_lx(&ways, &alone));
    let noise = wanted.variances(&alone).iter().sum::<f64>()
        + ways.iter().flat_map(|way| way.variances(&wanted)).sum::<f64>();
    let noise = noise / (REPLICATES.len() * wanted.seen().count().max(1)) as f64;
    let best = ways
        .into_iter()
        .map(|way| (way.best(&sample.exact_lx, &wanted, noise), way))
        .min_by(|(a, _), (b, _)| a.cost.total_cmp(&b.cost));
    let found_alone_lx = |target: usize| sample.exact_lx[target] + alone.moments(target).mean;
    let missed = wanted.shortfall(found_alone_lx, noise);
    let of_alone: Vec<f64> = wanted.variances(&alone).iter().map(|v| v + missed).collect();
    let pays = |best: &Best| best.cost < wanted.cost.rays(&of_alone, alone.rays, 0.0);
    let best = best.filter(|(best, _)| settings.joins() == Some(true) || pays(best));
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

/// What is to be known, and how well.
struct Wanted {
    cost: Cost,
    /// The illuminance at each target, as far as known.
    means_lx: Vec<f64>,
    /// What an error is compared with there: the tolerance, or the value where there is none.
    scales_lx: Vec<f64>,
}

impl Wanted {
    fn new(settings: &Settings, means_lx: Vec<f64>) -> Self {
        let scale_lx = |mean_lx: &f64| match settings.has_tolerance() {
            true => settings.tolerance_lx(*mean_lx),
            false => *mean_lx,
        };
        let scales_lx = means_lx.iter().map(scale_lx).collect();
        Self { cost: Cost::of(settings), means_lx, scales_lx }
    }

    /// Targets where there is light.
    fn seen(&self) -> impl Iterator<Item = usize> {
        (0..self.means_lx.len()).filter(|target| self.means_lx[*target] > 0.0)
    }

    /// Of what a trial finds, over the scales squared; one for each target that is seen.
    fn variances(&self, trial: &Trial) -> Vec<f64> {
        let relative = |target: usize| {
            let scale_lx = self.scales_lx[target];
            trial.moments(target).variance / (scale_lx * scale_lx)
        };
        self.seen().map(relative).collect()
    }

    /// How much a trial is short of the means, over the scales and squared, mean over the targets: as far as it
    /// cannot be by chance, where means have this variance.
    fn shortfall(&self, found_lx: impl Fn(usize) -> f64, noise: f64) -> f64 {
        let (sum, count) = self.seen().fold((0.0, 0.0), |(sum, count), target| {
            let missing = (self.means_lx[target] - found_lx(target)) / self.scales_lx[target];
            (sum + missing * missing, count + 1.0)
        });
        if count > 0.0 { (sum / count - BY_CHANCE * noise).max(0.0) } else { 0.0 }
    }
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
    /// In units that all ways share.
    cost: f64,
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
    fn variances(&self, wanted: &Wanted) -> Vec<f64> {
        let [mut sums, joined, coarse] =
            [&self.beside, &self.joined, &self.coarse].map(|trial| wanted.variances(trial));
        sums.iter_mut().zip(joined.iter().zip(&coarse)).for_each(|(sum, (a, b))| *sum += a + b);
        sums
    }

    fn best(&self, exact_lx: &[f64], wanted: &Wanted, noise: f64) -> Best {
        let found_lx = |target: usize| exact_lx[target] + self.found_lx(target);
        // What is seldom found, joined photons would have found.
        let shortfall = wanted.shortfall(found_lx, noise);
        let beside = wanted.variances(&self.beside);
        let joined: Vec<f64> =
            wanted.variances(&self.joined).iter().map(|v| v + shortfall).collect();
        let coarse = wanted.variances(&self.coarse);
        let cost = |of_paths: f64, photons: u64, coarse_photons: u64| {
            let of_joined = photons as f64 / PHOTONS as f64;
            let of_coarse = coarse_photons as f64 / COARSE_PHOTONS as f64;
            let variances: Vec<f64> = beside
                .iter()
                .zip(joined.iter().zip(&coarse))
                .map(|(v, (joined, coarse))| v * of_paths + joined / of_joined + coarse / of_coarse)
                .collect();
            let rays = self.joined.rays * of_joined + self.coarse.rays * of_coarse;
            wanted.cost.rays(&variances, self.beside.rays, rays)
        };
        let is_coarse = self.coarse.rays > 0.0;
        let most_coarse = if is_coarse { MOST_COARSE_PHOTONS } else { 1 };
        let pairs = powers_up_to(MOST_PHOTONS)
            .flat_map(|photons| powers_up_to(most_coarse).map(move |coarse| (photons, coarse)));
        let later = |&(photons, coarse): &(u64, u64)| cost(LATER, photons, coarse);
        let best = pairs.min_by(|a, b| later(a).total_cmp(&later(b)));
        let (photons, coarse_photons) = best.unwrap_or((1, 1));
        let cost = cost(1.0, photons, coarse_photons);
        Best { photons, coarse_photons: if is_coarse { coarse_photons } else { 0 }, cost }
    }
}

/// 1, 2, 4 and so on.
fn powers_up_to(most: u64) -> impl Iterator<Item = u64> {
    std::iter::successors(Some(1), |power| Some(2 * power)).take_while(move |power| *power <= most)
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

    fn moments(&self, target: usize) -> Moments {
        let each = REPLICATES.len();
        let values = &self.lx[target * each..(target + 1) * each];
        let mean = values.iter().sum::<f64>() / each as f64;
        let squares = values.iter().map(|value| (value - mean) * (value - mean));
        Moments { mean, variance: squares.sum::<f64>() / (each - 1) as f64 }
    }
}
