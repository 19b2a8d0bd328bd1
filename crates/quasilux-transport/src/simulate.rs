//! From a scene to estimates: the loop over checkpoints.

use crate::check::{caveats, is_biased};
use crate::counting::Counting;
use crate::estimates::Estimates;
use crate::gathering::Gathering;
use crate::interval::Interval;
use crate::observer::{Control, Observer};
use crate::pixels::add_pictures;
use crate::schedule::Schedule;
use crate::settings::{Estimator, Settings};
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::watch::Watch;
use quasilux_scene::{Rgb, Scene};

/// Paths or photons, all replicates together, that a point where nothing is found gets before a
/// run may end without it.
const LEAST_TRIES: f64 = (1 << 14) as f64;

/// Simulates light in a scene until every sensor point reaches the wanted tolerance, a limit comes
/// first, or the observer stops it; at least up to the first checkpoint. Then takes the pictures of the
/// cameras, with a fixed number of paths a pixel.
///
/// The result is a function of scene and settings, whatever the number of threads; an observer
/// that stops a run only picks which checkpoint is the last. Work is shared by the threads of the
/// rayon pool that the call is made in. [`crate::check`] says beforehand whether the settings make
/// sense for the scene.
#[must_use]
pub fn simulate(scene: &Scene, settings: &Settings, observer: &mut dyn Observer) -> Estimates {
    if is_grey(scene) {
        run::<f64>(scene, settings, observer)
    } else {
        run::<Rgb>(scene, settings, observer)
    }
}

/// Whether one channel is enough.
pub(crate) fn is_grey(scene: &Scene) -> bool {
    scene.materials.iter().all(|material| material.bsdf.is_grey())
}

/// An estimator at work: one variant of [`Estimator`] or several close ones.
pub(crate) trait Estimation {
    /// Adds the indices up to `samples` to all replicates; `false` when the observer stopped it
    /// half-way, which leaves it unusable.
    #[must_use]
    fn advance(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool;

    /// What is known now. Settings, intervals and warnings are filled in by the caller.
    fn estimates(&self) -> Estimates;

    /// Indices per replicate of the first checkpoint: enough to plan by, little work.
    fn first_checkpoint(&self) -> u64;
}

fn run<S: Spectrum>(scene: &Scene, settings: &Settings, observer: &mut dyn Observer) -> Estimates {
    let stage = Stage::<S>::new(scene, settings);
    let mut watch = Watch::new(observer);
    let mut estimation: Box<dyn Estimation + '_> = match settings.estimator {
        Estimator::Photon => Box::new(Counting::new(&stage, scene, settings)),
        Estimator::Path | Estimator::Bidirectional | Estimator::BidirectionalMap => {
            Box::new(Gathering::new(&stage, scene, settings, &mut watch))
        }
    };
    let first = estimation.first_checkpoint();
    // Without sensors there is nothing to wait for.
    let limit = if scene.sensors.is_empty() { Some(1) } else { settings.max_samples };
    let mut schedule = Schedule::new(1.0 - settings.confidence, first, limit);
    let mut last = None;
    loop {
        let samples = schedule.next_checkpoint();
        watch.expect(samples, schedule.expected_end());
        if !estimation.advance(samples, &mut watch) {
            break;
        }
        let mut estimates = estimation.estimates();
        estimates.confidence = settings.confidence;
        estimates.miss_probability = schedule.miss_probability();
        estimates.biased |= is_biased(scene, settings);
        estimates.warnings.extend(caveats(scene, settings));
        estimates.warnings.extend(stage.warning.clone());
        if let (Some(ways), true) = (&stage.hides, settings.estimator != Estimator::Photon) {
            estimates.biased = true;
            estimates.warnings.push(format!(
                "light that goes straight to a diffuse surface or a sensor {ways} comes from photon \
                 density: it is blurred over about the length of a map element, and missing on rough surfaces"
            ));
        }
        let convergence = Convergence::of(&estimates);
        estimates.unresolved_points = convergence.unresolved;
        estimates.warnings.extend(warnings_of_values(&estimates));
        let excess = convergence.excess(&estimates, settings);
        estimates.tolerance_reached =
            excess.is_some_and(|excess| excess <= 1.0) && convergence.unresolved == 0;
        // Part of a set whose number of points is fixed would leave part of its lights out.
        let may_end = settings.sequence.points().is_none();
        let over = schedule.complete(excess.filter(|_| may_end));
        let control = watch.checkpoint(&estimates, convergence.largest);
        last = Some(estimates);
        if over || control == Control::Stop {
            break;
        }
    }
    drop(estimation);
    let mut estimates = last.expect("a run is never stopped before its first checkpoint");
    add_pictures(&stage, scene, settings, &mut estimates, &mut watch);
    estimates
}

/// How near a run is to its tolerance.
struct Convergence {
    /// The largest half-width over value among the points that have one; `None` without any.
    largest: Option<f64>,
    /// Points where nothing was found yet.
    unresolved: u64,
}

impl Convergence {
    fn of(estimates: &Estimates) -> Self {
        let mut convergence = Self { largest: None, unresolved: 0 };
        for (sensor, figures) in estimates.sensors.iter().enumerate() {
            let unresolved = figures.resolved.iter().filter(|resolved| !**resolved).count();
            convergence.unresolved += unresolved as u64;
            let intervals = estimates.point_intervals(sensor);
            let widths = intervals.iter().filter_map(Interval::relative_half_width);
            convergence.largest =
                widths.chain(convergence.largest).reduce(|a, b| if a > b { a } else { b });
        }
        convergence
    }

    /// Half-width over tolerance; `None` where there is no tolerance or no half-width. Points where
    /// nothing was found hold a run up until they had a fair chance, not for ever.
    fn excess(&self, estimates: &Estimates, settings: &Settings) -> Option<f64> {
        if settings.rel_tol <= 0.0 || settings.effective_replicates() < 2 {
            return None;
        }
        let resolved = self.largest.unwrap_or(0.0) / settings.rel_tol;
        let tried = estimates.samples as f64 * f64::from(settings.effective_replicates());
        let hold_up = (LEAST_TRIES / tried).sqrt();
        Some(if self.unresolved > 0 && hold_up > 1.0 { resolved.max(hold_up) } else { resolved })
    }
}

/// What a reader must know of the values of this checkpoint.
fn warnings_of_values(estimates: &Estimates) -> Vec<String> {
    let mut warnings = Vec::new();
    if estimates.invalid_contributions > 0 {
        warnings.push(format!(
            "{} contributions were not finite, negative or too large, and are not in the results",
            estimates.invalid_contributions
        ));
    }
    if estimates.unresolved_points > 0 {
        warnings.push(format!(
            "at {} sensor points no light was found where it was looked for: they may be dark or \
             light may be hard to find, and their values have no interval",
            estimates.unresolved_points
        ));
    }
    warnings
}
