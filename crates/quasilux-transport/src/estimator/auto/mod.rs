//! The estimator `auto`: what pilots select, watched and relieved by bidirectional paths.
//!
//! Three estimators work side by side. The *selected* one is that of `bidirectional`: paths alone,
//! on a frozen map or beside connected photons, guided or not, as a survey and pilots find best for
//! the whole run. The *probe* traces a few bidirectional paths for every sensor point
//! ([`crate::path::subpath_weights`]): no survey, no pilot and no guide enters them, and none of
//! their contributions exceeds that of the same way in plain path tracing, or that of a plain
//! photon which is connected to the sensor (a connection that is chosen among several counts the
//! sum of theirs). The *relief* traces bidirectional paths in full for
//! the sensor points that it takes over:
//!
//! - where the probe finds more light than the selected estimator, by more than chance allows: that
//!   one misses light. Its interval is withdrawn at once.
//! - where the probe promises the wanted error for about as many rays, or for a few times as many
//!   where the other way is known to hide tails ([`takeover`]).
//! - where light may hide behind openings that only they look for ([`unseen`]).
//!
//! A point that is taken over begins anew: no sample of the decision enters its value. There the
//! worst case is that of bidirectional paths, whatever pilots saw, and the rays before. Points that
//! are not taken over trust what was selected as far as probe, tails and witness can tell.
//!
//! The probe is a function of scene, settings and the number of samples; it is traced again where a
//! run goes on or parts are merged. Where some light is known by density alone (caustics), which
//! bidirectional paths would count twice, there is neither probe nor relief.

mod takeover;
mod unseen;

use crate::codec::{Reader, StateError, Writer};
use crate::context::Context;
use crate::estimator::Estimator;
use crate::estimator::path_estimator::PathEstimator;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::decisions::Decisions;
use crate::stats::estimates::Estimates;
use crate::stats::interval::Interval;
use crate::stats::schedule::MIN_SAMPLES;
use crate::stats::watch::Watch;
use quasilux_scene::Scene;
use std::ops::Range;
use takeover::{Judged, PointState, SelectedKind, Takeover};
use unseen::{Tests, Unseen};

/// Standard errors in a half-width, about.
const CONFIDENT: f64 = 2.0;
/// Part of the rays of the run that the probe may take.
const SHARE_OF_PROBE: f64 = 0.1;
/// Samples of the probe at least where a run may end: with fewer it tells nothing of light that a
/// short run misses.
const MIN_OF_PROBE: u64 = MIN_SAMPLES / 2;
/// Paths of the probe between two moments when it can be stopped.
const STEP_OF_PROBE: u64 = 1 << 16;

/// The selected estimator, the probe and the relief.
pub(crate) struct AutoEstimator<'a, S> {
    selected: PathEstimator<'a, S>,
    kind: SelectedKind,
    bidirectional: Option<Bidirectional<'a, S>>,
}

struct Bidirectional<'a, S> {
    probe: PathEstimator<'a, S>,
    relief: PathEstimator<'a, S>,
}

impl<S: Spectrum> Bidirectional<'_, S> {
    /// The state of the relief, and how far the probe is, whose paths are traced again.
    fn put(&self, out: &mut Writer) {
        self.relief.put(out);
        out.value(&self.probe.samples());
    }
}

/// Samples of the probe after the next step: twice as many, if they are not too many paths.
fn next_of_probe<S: Spectrum>(probe: &PathEstimator<'_, S>) -> u64 {
    let samples = probe.samples();
    let most = (STEP_OF_PROBE / probe.paths_of_an_index()).max(1);
    samples + samples.clamp(1, most)
}

/// Traces the probe up to so many samples; nobody stops it half-way.
fn trace_probe<S: Spectrum>(probe: &mut PathEstimator<'_, S>, samples: u64) {
    let mut nobody = ();
    let _ = probe.advance(samples, &mut Watch::new(&mut nobody));
}

/// Whether bidirectional paths find all light of a scene, and none of it twice.
pub(crate) fn is_possible<S: Spectrum>(context: &Context<'_, S>, settings: &Settings) -> bool {
    context.hides.is_none()
        && settings.max_bounces != Some(0)
        && settings.effective_replicates() > 1
}

impl<'a, S: Spectrum> AutoEstimator<'a, S> {
    pub(crate) fn new(
        context: &'a Context<'a, S>,
        scene: &'a Scene,
        settings: &Settings,
        watch: &mut Watch<'_>,
    ) -> Self {
        let bidirectional = || Bidirectional {
            probe: PathEstimator::bidirectional(context, scene, settings),
            relief: PathEstimator::bidirectional(context, scene, settings).without_targets(),
        };
        let is_possible = is_possible(context, settings) && !scene.sensors.is_empty();
        let selected = PathEstimator::new(context, scene, settings, watch);
        let kind = SelectedKind::new(&selected.decisions());
        Self { bidirectional: is_possible.then(bidirectional), selected, kind }
    }

    /// Traces the probe that belongs to the rays of the others so far, and more where light may
    /// hide behind openings; `false` when the observer stopped it.
    fn probe(&mut self, watch: &mut Watch<'_>) -> bool {
        while self.wants_probe() {
            let Some(Bidirectional { probe, .. }) = &mut self.bidirectional else { break };
            let before = probe.sampling_rays();
            trace_probe(probe, next_of_probe(probe));
            let rays = probe.sampling_rays() - before;
            if !watch.tick(0, 0, rays) || !watch.keep(|out| self.put(out)) {
                return false;
            }
        }
        true
    }

    /// Whether the probe is to have twice the samples.
    fn wants_probe(&self) -> bool {
        let Some(Bidirectional { probe, relief }) = &self.bidirectional else { return false };
        let rays = self.selected.all_rays() + relief.sampling_rays();
        let next = next_of_probe(probe) as f64;
        let rays_of_next = probe.sampling_rays() as f64 * next / probe.samples().max(1) as f64;
        let is_look = self.selected.samples() >= MIN_SAMPLES;
        rays_of_next <= SHARE_OF_PROBE * rays as f64
            || is_look && probe.samples() < MIN_OF_PROBE
            || self.selected.samples() >= MIN_SAMPLES
                && self.unseen(&self.relieved(&self.selected.estimates())).wants_more
    }

    /// Where light may hide behind openings, beside these estimates.
    fn unseen(&self, estimates: &Estimates) -> Unseen {
        let Some(Bidirectional { probe, relief }) = &self.bidirectional else {
            return Unseen::nothing(0);
        };
        if self.selected.samples() < MIN_SAMPLES {
            return Unseen::nothing(self.selected.are_over().len());
        }
        let errors = estimates.sensors.iter().flat_map(|sensor| {
            (0..sensor.resolved.len()).map(|point| {
                let rows = sensor.replicate_lx.iter();
                Interval::of_mean(rows.map(|row| row[point]), Some(CONFIDENT))
            })
        });
        let tests = errors.enumerate().map(|(target, interval)| {
            let mut scores = probe.scores_of(target).clone();
            scores.merge(relief.scores_of(target));
            let paths = [probe, relief].map(|of| of.paths_of(target)).iter().sum();
            let half_width = interval.half_width.unwrap_or(0.0) / probe.reference_lx();
            Tests { scores, paths, half_width }
        });
        Unseen::new(&tests.collect::<Vec<Tests>>())
    }

    /// The values of the selected estimator, and of the relief where that has taken over.
    fn relieved(&self, selected: &Estimates) -> Estimates {
        let mut estimates = selected.clone();
        if let Some(Bidirectional { relief, .. }) = &self.bidirectional {
            let of_relief = relief.estimates();
            let mut is_relieved = relief.samples_of_all().into_iter().map(|samples| samples > 0);
            for (sensor, relieved) in estimates.sensors.iter_mut().zip(&of_relief.sensors) {
                let points = sensor.resolved.len();
                let taken: Vec<bool> = is_relieved.by_ref().take(points).collect();
                sensor.replace(&taken, relieved);
            }
            estimates.rays += of_relief.rays;
            estimates.invalid_contributions += of_relief.invalid_contributions;
            estimates.biased |= of_relief.biased;
            estimates.dimensions.path.merge(&of_relief.dimensions.path);
            estimates.warnings.extend(of_relief.warnings);
        }
        estimates
    }

    /// How each sensor point stands that the relief has not taken over.
    fn takeovers(&self, selected: &Estimates) -> Vec<Takeover> {
        let Some(Bidirectional { probe, relief }) = &self.bidirectional else {
            return Vec::new();
        };
        let states = PointState::of_all(&self.selected.are_over(), &relief.begun());
        let judged = Judged {
            selected: &selected.sensors,
            probe: &probe.estimates().sensors,
            rays: [self.selected.sampling_rays(), probe.sampling_rays()],
            kind: self.kind,
            photons_hide_tails: self.selected.photons_hide_tails(),
        };
        takeover::all(&judged, &states)
    }
}

impl<S: Spectrum> Estimator for AutoEstimator<'_, S> {
    fn advance(&mut self, samples: u64, watch: &mut Watch<'_>) -> bool {
        if let Some(bidirectional) = &self.bidirectional {
            watch.surround(|_| (), |after| bidirectional.put(after));
        }
        if !self.selected.advance(samples, watch) {
            return false;
        }
        if let Some(Bidirectional { relief, probe }) = &mut self.bidirectional {
            let selected = &self.selected;
            watch.surround(|before| selected.put(before), |after| after.value(&probe.samples()));
            if !relief.advance(samples, watch) {
                return false;
            }
        }
        watch.surround(|_| (), |_| ());
        self.probe(watch)
    }

    fn decisions(&self) -> Decisions {
        self.selected.decisions()
    }

    fn put(&self, out: &mut Writer) {
        self.selected.put(out);
        self.bidirectional.iter().for_each(|own| own.put(out));
    }

    fn merge_from(&mut self, coming: u64, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.selected.merge_from(coming, from)?;
        let Some(Bidirectional { probe, relief }) = &mut self.bidirectional else { return Ok(()) };
        relief.merge_from(coming, from)?;
        let probed: u64 = from.value()?;
        if probed > self.selected.samples().max(unseen::MAX_TESTS) {
            return Err(StateError::Unfit("the samples of the probe"));
        }
        trace_probe(probe, probed);
        Ok(())
    }

    fn trace_part(&mut self, part: Range<u64>, samples: u64, watch: &mut Watch<'_>) -> bool {
        self.selected.trace_part(part, samples, watch)
    }

    fn put_shared(&self, out: &mut Writer) {
        Estimator::put_shared(&self.selected, out);
    }

    fn merge_shared(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        Estimator::merge_shared(&mut self.selected, from)
    }

    fn put_part(&self, out: &mut Writer) {
        self.selected.put_part(out);
    }

    fn merge_part(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.selected.merge_part(from)
    }

    fn complete_at(&mut self, samples: u64) {
        self.selected.complete_at(samples);
        let mut nobody = ();
        let _ = self.probe(&mut Watch::new(&mut nobody));
    }

    fn estimates(&self) -> Estimates {
        let selected = self.selected.estimates();
        let Some(Bidirectional { probe, relief }) = &self.bidirectional else { return selected };
        let mut estimates = self.relieved(&selected);
        let takeovers = self.takeovers(&selected);
        let mut contradicted = takeovers.iter().map(|takeover| *takeover == Takeover::MissesLight);
        let mut unseen = self.unseen(&estimates).points.into_iter();
        for sensor in &mut estimates.sensors {
            let points = sensor.resolved.len();
            sensor.withdraw(contradicted.by_ref().take(points).collect());
            sensor.withdraw_unseen(unseen.by_ref().take(points));
        }
        estimates.rays += probe.all_rays();
        estimates.relieved_points = relief.begun().iter().filter(|begun| **begun).count() as u64;
        estimates
    }

    fn freeze_converged(&mut self, done: &[bool]) -> bool {
        if let Some(Bidirectional { relief, .. }) = &mut self.bidirectional {
            relief.freeze_converged(done);
        }
        self.selected.freeze_converged(done)
    }

    fn adapt(&mut self) -> bool {
        let selected = self.selected.estimates();
        let takeovers = self.takeovers(&selected);
        let unseen = self.unseen(&self.relieved(&selected)).points;
        let Some(Bidirectional { relief, .. }) = &mut self.bidirectional else { return false };
        let begun = relief.begun();
        let due = takeovers.into_iter().zip(unseen);
        let taken: Vec<bool> = due.map(|(takeover, unseen)| takeover.is_due() || unseen).collect();
        relief.begin(&taken);
        self.selected.freeze_converged(&relief.begun());
        relief.begun() != begun && self.selected.are_over().into_iter().all(|over| over)
    }

    fn first_checkpoint(&self) -> u64 {
        self.selected.first_checkpoint()
    }
}
