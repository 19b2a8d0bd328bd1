//! How many photons are joined for each path, by what a pilot measures.
//!
//! Paths with variance V and joined photons with variance U a photon, all of one sample, and costs c
//! and d in rays: n photons a path make the error `(V + U / n) (c + n d)`, squared and times the cost; it
//! is least for `n^2 = U c / (V d)`. It is compared with what paths cost that go alone. Variances are
//! relative to the value, mean over the sensor points. They are taken around the mean of paths and
//! photons together also where paths go alone: what paths hardly ever find would not show in their spread.

use super::{Joined, Joining};
use crate::gathering::Exact;
use crate::path_end::Rest;
use crate::path_wave::PathWave;
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
    let Plan { windows, forecast, mut rays } = steering::foresee(stage, targets, settings.steering);
    let Some(forecast) = forecast else { return Decision { joined: None, rays } };
    let expected_lx: Vec<f64> =
        (0..targets.len()).map(|target| forecast.target_lx(target)).collect();
    let step = targets.len().div_ceil(TARGETS).max(1);
    let asked: Vec<Target> = targets.iter().step_by(step).copied().collect();
    let asked_lx = expected_lx.iter().step_by(step).copied().collect();
    let joining = Joining { landings: forecast.landings, windows, photons: PHOTONS };
    let mut pilot = Joined::new(joining, asked.clone(), asked_lx, REPLICATES, (0, quantum));
    // Before the first checkpoint the observer stops nothing, so there are always counts.
    let counts = pilot.grow(stage, SAMPLES, watch).unwrap_or_default();
    let joined = Trial {
        lx: (0..asked.len())
            .flat_map(|target| (0..REPLICATES.len()).map(move |r| (r, target)))
            .map(|(r, target)| pilot.lx(r, target))
            .collect(),
        rays: (counts.rays - counts.joins) as f64 + JOINING_RAY * counts.joins as f64,
    };
    let beside = Trial::of_paths(stage, &asked, Some(&pilot.joining), quantum);
    let alone = Trial::of_paths(stage, &asked, None, quantum);
    rays += counts.rays + (beside.rays + alone.rays) as u64;
    let exact_lx: Vec<f64> = exact.iter().step_by(step).map(Exact::sum_lx).collect();
    let best = Best::of(&joined, &beside, &alone, &exact_lx);
    let joins = settings.joining == Switch::On || best.pays;
    let photons = joins.then_some(best.photons);
    let joined = photons.map(|photons| {
        let joining = Joining { photons, ..pilot.joining };
        let replicates = 0..settings.effective_replicates();
        let kept = (stage.listed_terms, quantum);
        Joined::new(joining, targets.to_vec(), expected_lx, replicates, kept)
    });
    Decision { joined, rays }
}

/// How photons are joined best.
struct Best {
    /// For each path.
    photons: u64,
    /// Whether paths alone are worse.
    pays: bool,
}

impl Best {
    fn of(joined: &Trial, beside: &Trial, alone: &Trial, exact_lx: &[f64]) -> Self {
        let replicates = REPLICATES.len() as f64;
        let (mut of_joined, mut of_beside, mut of_alone, mut seen) = (0.0, 0.0, 0.0, 0.0);
        for (target, exact_lx) in exact_lx.iter().enumerate() {
            let (joined, beside) = (joined.moments(target), beside.moments(target));
            let alone = alone.moments(target);
            let mean = exact_lx + joined.mean + beside.mean;
            if mean <= 0.0 {
                continue;
            }
            let error = (joined.variance + beside.variance) / replicates;
            let off = alone.mean + exact_lx - mean;
            of_joined += joined.variance / (mean * mean);
            of_beside += beside.variance / (mean * mean);
            of_alone += (alone.variance + (off * off - error).max(0.0)) / (mean * mean);
            seen += 1.0;
        }
        // Where nothing was found, photons are as good a chance as any.
        let ratio = of_joined * beside.rays / (of_beside * joined.rays);
        let best = if ratio.is_finite() { PHOTONS as f64 * ratio.sqrt() } else { PHOTONS as f64 };
        let photons = libm::exp2(libm::round(libm::log2(best.clamp(1.0, MOST_PHOTONS))));
        let more = photons / PHOTONS as f64;
        let together = (of_beside + of_joined / more) * (beside.rays + joined.rays * more);
        let pays = seen == 0.0 || together < of_alone * alone.rays;
        Self { photons: photons as u64, pays }
    }
}

/// Of what the replicates found at one target.
struct Moments {
    mean: f64,
    variance: f64,
}

impl Trial {
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
