//! From a scene to estimates: the loop over checkpoints.

use crate::check::{caveats, is_biased};
use crate::counting::Counting;
use crate::estimates::Estimates;
use crate::gathering::Gathering;
use crate::interval::{Interval, t_quantile_for};
use crate::observer::{Control, Observer};
use crate::schedule::Schedule;
use crate::settings::{Estimator, Settings};
use crate::spectrum::Spectrum;
use crate::stage::Stage;
use crate::watch::Watch;
use quasilux_scene::{Rgb, Scene};

/// Simulates light in a scene until every sensor point reaches the wanted tolerance, a limit comes
/// first, or the observer stops it; at least up to the first checkpoint.
///
/// The result is a function of scene and settings, whatever the number of threads; an observer
/// that stops a run only picks which checkpoint is the last. Work is shared by the threads of the
/// rayon pool that the call is made in. [`crate::check`] says beforehand whether the settings make
/// sense for the scene.
#[must_use]
pub fn simulate(scene: &Scene, settings: &Settings, observer: &mut dyn Observer) -> Estimates {
    let grey = scene.materials.iter().all(|material| material.bsdf.reflectance().is_grey());
    if grey { run::<f64>(scene, settings, observer) } else { run::<Rgb>(scene, settings, observer) }
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

fn run<S: Spectrum>(
    scene: &Scene,
    settings: &Settings,
    observer: &mut dyn Observer,
) -> Estimates {
    let stage = Stage::<S>::new(scene, settings);
    let mut watch = Watch::new(observer);
    let mut estimation: Box<dyn Estimation + '_> = match settings.estimator {
        Estimator::Photon => Box::new(Counting::new(&stage, scene, settings)),
        Estimator::Path | Estimator::Bidirectional | Estimator::BidirectionalMap => {
            Box::new(Gathering::new(&stage, scene, settings, &mut watch))
        }
    };
    let first = estimation.first_checkpoint();
    let mut schedule = Schedule::new(1.0 - settings.confidence, first, settings.max_samples);
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
        estimates.biased = is_biased(scene, settings);
        estimates.warnings.extend(caveats(scene, settings));
        let largest = largest_relative_half_width(&estimates);
        let excess = excess(largest, settings);
        estimates.tolerance_reached = excess.is_some_and(|excess| excess <= 1.0);
        // Part of a set whose number of points is fixed would leave part of its lights out.
        let may_end = settings.sequence.points().is_none();
        let over = schedule.complete(excess.filter(|_| may_end));
        let control = watch.checkpoint(&estimates, largest);
        last = Some(estimates);
        if over || control == Control::Stop {
            break;
        }
    }
    last.expect("a run is never stopped before its first checkpoint")
}

/// The largest half-width over value among all sensor points; `None` without intervals.
fn largest_relative_half_width(estimates: &Estimates) -> Option<f64> {
    let mut largest: Option<f64> = None;
    for sensor in &estimates.sensors {
        let t = t_quantile_for(sensor.replicate_lx.len(), estimates.miss_probability)?;
        for point in 0..sensor.direct_lx.len() {
            let values = sensor.replicate_lx.iter().map(|row| row[point]);
            let relative = Interval::of_mean(values, Some(t)).relative_half_width()?;
            largest = Some(largest.map_or(relative, |other| other.max(relative)));
        }
    }
    largest
}

/// Half-width over tolerance; `None` where there is no tolerance or no half-width.
fn excess(largest: Option<f64>, settings: &Settings) -> Option<f64> {
    largest.filter(|_| settings.rel_tol > 0.0).map(|largest| largest / settings.rel_tol)
}
