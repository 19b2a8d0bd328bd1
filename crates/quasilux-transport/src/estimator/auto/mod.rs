//! The estimator `auto`: what pilots select, watched and relieved by bidirectional paths.
//!
//! Three estimators work side by side. The *selected* one is that of `bidirectional`: paths alone,
//! on a frozen map or beside connected photons, guided or not, as a survey and pilots find best for
//! the whole run. The *probe* traces a few bidirectional paths for every sensor point
//! ([`crate::path::subpath_weights`]): no survey, no pilot and no guide enters them, and none of
//! their contributions exceeds that of the same way in plain path tracing, or that of a plain
//! photon which is connected to the sensor (a connection that is chosen among several counts the
//! sum of theirs). The *relief* traces bidirectional paths in full for the sensor points that it
//! takes over:
//!
//! - where the probe finds more light than the selected estimator, by more than chance allows: that
//!   one misses light. Its interval is withdrawn at once.
//! - where the witness does ([`crate::estimator::witness`]).
//! - where the probe promises the wanted error for fewer rays than are left to the selected
//!   estimator, or for twice as many where that is known to hide tails ([`takeover`]).
//! - where light may hide behind openings that only they look for ([`unseen`]), if photons are
//!   connected to the sensors: what their survey did not see either they may lack. Of paths the
//!   relief leaves the value alone as long as it finds nothing.
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
use crate::estimator::block::{BlockFrame, PathRole};
use crate::estimator::path_estimator::PathEstimator;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::decisions::Decisions;
use crate::stats::estimates::Estimates;
use crate::stats::interval::Interval;
use crate::stats::schedule::MIN_SAMPLES;
use crate::stats::tolerance::Standing;
use crate::stats::watch::Watch;
use quasilux_scene::Scene;
use std::ops::Range;
use takeover::{Judged, PointState, SelectedKind, Side};
use unseen::{Tests, Unseen};

/// Standard errors in a half-width, about.
const CONFIDENT: f64 = 2.0;
/// Part of the rays of the run that the probe may take; the witness takes as many.
const SHARE_OF_PROBE: f64 = 0.05;
/// Paths of the probe at least where a run may end, of all sensor points together: with fewer it
/// tells nothing of light that a short run misses.
const MIN_OF_PROBE: u64 = 1 << 14;
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
    /// Of the points that it takes over, and of those where it looks for openings.
    relief: PathEstimator<'a, S>,
    /// The points that it has taken over.
    taken_over: Vec<bool>,
}

impl<S: Spectrum> Bidirectional<'_, S> {
    fn put(&self, out: &mut Writer) {
        self.relief.put(out);
        put_beside_relief(&self.probe, &self.taken_over, out);
    }

    /// Traces the probe up to so many samples; nobody stops it half-way, but where workers fail.
    fn trace_probe(&mut self, samples: u64, watch: &mut Watch<'_>) {
        let _ = watch.aside(|watch| self.probe.advance(samples, watch));
    }
}

/// What comes after the relief in states: how far the probe is, whose paths are traced again, and
/// the points that are taken over.
fn put_beside_relief<S: Spectrum>(
    probe: &PathEstimator<'_, S>,
    taken_over: &[bool],
    out: &mut Writer,
) {
    out.value(&probe.samples());
    out.value(taken_over);
}

/// Samples of the probe after the next step: twice as many, if they are not too many paths.
fn next_of_probe<S: Spectrum>(probe: &PathEstimator<'_, S>) -> u64 {
    let samples = probe.samples();
    let most = (STEP_OF_PROBE / probe.paths_of_an_index()).max(1);
    samples + samples.clamp(1, most)
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
        let bidirectional = || {
            let bidirectional = || PathEstimator::bidirectional(context, scene, settings);
            let relief = bidirectional().without_targets().with_role(PathRole::Relief);
            let probe = bidirectional().with_role(PathRole::Probe);
            let taken_over = vec![false; relief.begun().len()];
            Bidirectional { probe, relief, taken_over }
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
            let Some(own) = &mut self.bidirectional else { break };
            let before = own.probe.sampling_rays();
            own.trace_probe(next_of_probe(&own.probe), watch);
            let rays = own.probe.sampling_rays() - before;
            if watch.has_failed() || !watch.tick(0, 0, rays) || !watch.keep(|out| self.put(out)) {
                return false;
            }
        }
        true
    }

    /// Whether the probe is to have twice the samples.
    fn wants_probe(&self) -> bool {
        let Some(Bidirectional { probe, relief, .. }) = &self.bidirectional else { return false };
        let rays = self.selected.all_rays() + relief.sampling_rays();
        let next = next_of_probe(probe) as f64;
        let rays_of_next = probe.sampling_rays() as f64 * next / probe.samples().max(1) as f64;
        let is_look = self.selected.samples() >= MIN_SAMPLES;
        rays_of_next <= SHARE_OF_PROBE * rays as f64
            || is_look && probe.samples() * probe.paths_of_an_index() < MIN_OF_PROBE
            || is_look && self.unseen(&self.relieved(&self.selected.estimates())).wants_more
    }

    /// Where light may hide behind openings, beside these estimates.
    fn unseen(&self, estimates: &Estimates) -> Unseen {
        let Some(Bidirectional { probe, relief, .. }) = &self.bidirectional else {
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
        let replicates = estimates.sensors.first().map_or(0, |sensor| sensor.replicate_lx.len());
        Unseen::new(&tests.collect::<Vec<Tests>>(), MIN_SAMPLES * replicates as u64)
    }

    /// The values of the selected estimator, and of the relief where that has taken over.
    fn relieved(&self, selected: &Estimates) -> Estimates {
        let mut estimates = selected.clone();
        if let Some(Bidirectional { relief, taken_over, .. }) = &self.bidirectional {
            let of_relief = relief.estimates();
            let known = relief.samples_of_all().into_iter().zip(taken_over);
            let is_relieved = known.map(|(samples, taken_over)| *taken_over && samples > 0);
            replace(&mut estimates, &is_relieved.collect::<Vec<bool>>(), &of_relief);
            estimates.rays += of_relief.rays;
            estimates.invalid_contributions += of_relief.invalid_contributions;
            estimates.biased |= of_relief.biased;
            estimates.dimensions.path.merge(&of_relief.dimensions.path);
            estimates.warnings.extend(of_relief.warnings);
        }
        estimates
    }

    /// What these estimates of the selected estimator are beside `probe`; `None` before either
    /// has enough samples to judge by.
    fn judge<T>(&self, selected: &Estimates, judge: impl FnOnce(&Judged<'_>) -> T) -> Option<T> {
        let Bidirectional { probe, relief, taken_over } = self.bidirectional.as_ref()?;
        if self.selected.samples() < MIN_SAMPLES {
            return None;
        }
        let side = |of: &PathEstimator<'_, S>, sensors| {
            let indices: u64 = of.samples_of_all().iter().sum();
            Side { sensors, rays: of.sampling_rays() as f64 / indices.max(1) as f64 }
        };
        let mut probed = probe.estimates();
        let more = relief.samples_of_all().into_iter().zip(probe.samples_of_all());
        let knows_more: Vec<bool> = more.map(|(relief, probe)| relief > probe).collect();
        replace(&mut probed, &knows_more, &relief.estimates());
        Some(judge(&Judged {
            selected: side(&self.selected, &selected.sensors),
            probe: side(probe, &probed.sensors),
            kind: self.kind,
            photons_hide_tails: self.selected.photons_hide_tails(),
            states: PointState::of_all(&self.selected.are_over(), taken_over),
        }))
    }
}

/// Takes the figures of some points from other estimates.
fn replace(estimates: &mut Estimates, points: &[bool], other: &Estimates) {
    let mut points = points.iter().copied();
    for (sensor, other) in estimates.sensors.iter_mut().zip(&other.sensors) {
        let own: Vec<bool> = points.by_ref().take(sensor.resolved.len()).collect();
        sensor.replace(&own, other);
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
        if let Some(Bidirectional { relief, probe, taken_over }) = &mut self.bidirectional {
            let selected = &self.selected;
            let after = |after: &mut Writer| put_beside_relief(probe, taken_over, after);
            watch.surround(|before| selected.put(before), after);
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
        let Some(own) = &mut self.bidirectional else { return Ok(()) };
        own.relief.merge_from(coming, from)?;
        let probed: u64 = from.value()?;
        let taken_over: Vec<bool> = from.value()?;
        if probed > self.selected.samples().max(unseen::MAX_TESTS) {
            return Err(StateError::Unfit("the samples of the probe"));
        }
        let begun = own.relief.begun();
        let fits = taken_over.len() == begun.len()
            && taken_over.iter().zip(begun).all(|(taken_over, begun)| begun || !taken_over);
        if !fits {
            return Err(StateError::Unfit("the points that were taken over"));
        }
        own.taken_over = taken_over;
        let mut nobody = ();
        own.trace_probe(probed, &mut Watch::new(&mut nobody));
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

    fn trace_block(
        &mut self,
        frame: &BlockFrame,
        block: Range<u64>,
    ) -> Result<Vec<u8>, StateError> {
        let role = match frame {
            BlockFrame::Paths { role, .. } => *role,
            _ => PathRole::Selected,
        };
        match (role, &mut self.bidirectional) {
            (PathRole::Selected, _) => self.selected.trace_block(frame, block),
            (PathRole::Probe, Some(own)) => own.probe.trace_block(frame, block),
            (PathRole::Relief, Some(own)) => own.relief.trace_block(frame, block),
            (_, None) => Err(StateError::Unfit("the kind of a block")),
        }
    }

    fn complete_at(&mut self, samples: u64) {
        self.selected.complete_at(samples);
        let mut nobody = ();
        let _ = self.probe(&mut Watch::new(&mut nobody));
    }

    fn estimates(&self) -> Estimates {
        let selected = self.selected.estimates();
        let Some(Bidirectional { probe, taken_over, .. }) = &self.bidirectional else {
            return selected;
        };
        let mut estimates = self.relieved(&selected);
        let misses_light =
            self.judge(&selected, |judged| judged.misses_light()).unwrap_or_default();
        let mut contradicted = misses_light.into_iter().chain(std::iter::repeat(false));
        let mut unseen = self.unseen(&estimates).points.into_iter();
        for sensor in &mut estimates.sensors {
            let points = sensor.resolved.len();
            sensor.withdraw(contradicted.by_ref().take(points).collect());
            sensor.withdraw_unseen(unseen.by_ref().take(points));
        }
        estimates.rays += probe.all_rays();
        estimates.relieved_points = taken_over.iter().filter(|taken| **taken).count() as u64;
        estimates
    }

    fn freeze_converged(&mut self, done: &[bool]) -> bool {
        if let Some(Bidirectional { relief, .. }) = &mut self.bidirectional {
            relief.freeze_converged(done);
        }
        self.selected.freeze_converged(done)
    }

    fn adapt(&mut self, estimates: &Estimates, standing: &Standing) -> bool {
        let selected = self.selected.estimates();
        let judge = |judged: &Judged<'_>| judged.pays(&standing.excess);
        let Some(pays) = self.judge(&selected, judge) else { return false };
        let unseen = self.unseen(&self.relieved(&selected)).points;
        let Some(Bidirectional { relief, taken_over, .. }) = &mut self.bidirectional else {
            return false;
        };
        let before = taken_over.clone();
        // By the probe or by the witness.
        let contradicted = estimates.sensors.iter().flat_map(|sensor| &sensor.contradicted);
        let distrusts = self.kind != SelectedKind::Paths;
        let due = contradicted.zip(pays).zip(&unseen);
        for (taken, ((contradicted, pays), unseen)) in taken_over.iter_mut().zip(due) {
            *taken |= *contradicted || pays || (distrusts && *unseen);
        }
        let either = |(a, b): (&bool, &bool)| *a || *b;
        relief.begin(&taken_over.iter().zip(&unseen).map(either).collect::<Vec<bool>>());
        // Where the relief only looks, what was selected may be known well enough.
        let resolved = selected.sensors.iter().flat_map(|sensor| &sensor.resolved);
        let known = unseen.iter().zip(resolved).zip(&standing.narrow);
        let is_enough = known.map(|((unseen, resolved), narrow)| *unseen && *resolved && *narrow);
        let over: Vec<bool> = taken_over.iter().zip(is_enough).map(|(a, b)| *a || b).collect();
        self.selected.freeze_converged(&over);
        *taken_over != before && self.selected.are_over().into_iter().all(|over| over)
    }

    fn first_checkpoint(&self) -> u64 {
        self.selected.first_checkpoint()
    }
}
