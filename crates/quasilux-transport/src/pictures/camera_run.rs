//! Pictures, from their first pass to their last.
//!
//! A picture comes after the sensors, in passes, each from scratch (`pictures/integrator.rs`). It
//! is done when it is known well enough ([`CameraEstimates::relative_half_width`]), or when it has
//! the wanted number of paths; only complete passes are looked at. The first has one path a pixel
//! in each replicate and tells where more are needed (`pictures/pass.rs`), so most of the work is
//! in the last. When the observer stops a pass, the one before is the picture; before the first
//! there is none.

use crate::context::Context;
use crate::control::observer::PictureProgress;
use crate::control::watch::Watch;
use crate::path::path_batch::WorkCounts;
use crate::pictures::integrator::{PassResult, PictureIntegrator, Step};
use crate::pictures::pass::Pass;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::caveat::Caveat;
use crate::stats::estimates::Estimates;
use crate::stats::picture::CameraEstimates;
use quasilux_scene::{Camera, Scene};

/// Relative half-width that a picture is to reach by default.
const REL_TOL: f64 = 0.05;
/// Paths of each pixel in each replicate at most, where only a tolerance is wanted.
const MAX_SAMPLES: u64 = 1 << 12;
/// Before this many of them no picture is called done: what few of them find says little of the
/// rest; of plain paths, and of bidirectional ones.
const MIN_SAMPLES: u64 = 4;
const MIN_SAMPLES_OF_BIDIRECTIONAL: u64 = 2;
/// Light of photons is told above this part of the tolerance.
const BLURRED: f64 = 0.1;
/// Where half-widths are this many times the tolerance, one pass does not know what another needs.
const FAR: f64 = 8.0;
/// Where the number that is needed is unknown, the number of paths grows by this factor from pass
/// to pass.
const GROWTH: u64 = 16;
/// Photons for each path of a pixel that look for light which paths cannot find.
const CAUSTIC_PHOTONS: u64 = 1 << 12;

/// Takes the pictures of all cameras and adds them to what the sensors know.
pub(crate) fn add_pictures<S: Spectrum>(
    context: &Context<'_, S>,
    scene: &Scene,
    settings: &Settings,
    estimates: &mut Estimates,
    watch: &mut Watch<'_>,
) {
    let mut work = WorkCounts::default();
    for (number, camera) in scene.cameras.iter().enumerate() {
        let goal = PictureGoal::new(camera, settings);
        let replicates = settings.effective_replicates() as usize;
        let mut taken = PassResult::nothing(goal.rel_tol, replicates);
        let at = PictureProgress { camera: number, rel_tol: goal.rel_tol, ..Default::default() };
        // Where time is over, no camera begins.
        let begins = watch.tick_picture(0, 0, at, None);
        let integrator = || PictureIntegrator::new(context, settings, number as u32, camera, watch);
        if let Some(integrator) = begins.then(integrator).flatten() {
            let mut camera_run = CameraRun { number, goal, integrator, traced: 0.0 };
            taken = camera_run.take(taken, &mut work, watch);
            taken.invalid += camera_run.integrator.invalid_photons();
        }
        let PassResult { figures, invalid, .. } = taken;
        estimates.caveats.extend(goal.shortfall(camera, &figures));
        estimates.caveats.extend(goal.blur(camera, &figures));
        estimates.invalid_contributions += invalid;
        estimates.cameras.push(figures);
    }
    if scene.sensors.is_empty() {
        estimates.samples = estimates.cameras.iter().map(|c| c.samples).max().unwrap_or(0);
        estimates.tolerance_reached = true;
    }
    estimates.sensors_reached = estimates.tolerance_reached;
    estimates.tolerance_reached &= estimates.cameras.iter().all(|camera| camera.is_done);
    estimates.rays += work.rays;
    estimates.dimensions.path.merge(&work.dimensions);
    estimates.biased |= work.endless > 0;
    estimates.caveats.extend(Caveat::of_picture_paths(work.endless));
}

/// Tolerance of a picture, and limits of its paths.
#[derive(Clone, Copy, Debug)]
struct PictureGoal {
    rel_tol: Option<f64>,
    /// Paths of each pixel in each replicate, at most.
    most: u64,
    /// Before this many it is not done.
    min_samples: u64,
    /// Whether only all of them make a picture.
    all_or_nothing: bool,
}

impl PictureGoal {
    fn new(camera: &Camera, settings: &Settings) -> Self {
        let min_samples = match settings.estimator.is_bounded() {
            true => MIN_SAMPLES_OF_BIDIRECTIONAL,
            false => MIN_SAMPLES,
        };
        let limited = |rel_tol, most| Self { rel_tol, most, min_samples, all_or_nothing: false };
        // Part of a set whose number of points is fixed would leave part of its lights out.
        if let Some(points) = settings.sequence.points() {
            return Self { all_or_nothing: true, ..limited(None, points.max(1)) };
        }
        match (camera.rel_tol, camera.samples.or(settings.max_samples)) {
            (Some(_), _) => limited(camera.rel_tol, camera.samples.unwrap_or(MAX_SAMPLES)),
            (None, Some(most)) => limited(None, most),
            (None, None) => limited(Some(REL_TOL), MAX_SAMPLES),
        }
    }

    /// Whether a complete pass is what was wanted.
    fn is_done(&self, figures: &CameraEstimates) -> bool {
        match self.rel_tol {
            None => figures.samples >= self.most,
            Some(rel_tol) => {
                let is_known = figures.relative_half_width().is_some_and(|known| known <= rel_tol);
                is_known && figures.samples >= self.min_samples.min(self.most)
            }
        }
    }

    /// The first pass.
    fn first(&self) -> Pass {
        Pass::of_all(if self.all_or_nothing { self.most } else { 1 })
    }

    /// The pass that follows a complete one; `None` where that is the last.
    fn next(&self, pass: &Pass, taken: &PassResult) -> Option<Pass> {
        let figures = &taken.figures;
        let is_last = self.rel_tol.is_some_and(|rel_tol| pass.is_up_to(rel_tol));
        if figures.is_done || (is_last && taken.is_limited()) || pass.least >= self.most {
            return None;
        }
        let Some((rel_tol, known)) = self.rel_tol.zip(figures.relative_half_width()) else {
            return Some(Pass::of_all(pass.least.saturating_mul(GROWTH).min(self.most)));
        };
        // Where much is left to do, a pass on the way there tells more of it.
        let is_far = known > FAR * rel_tol;
        let rel_tol = if is_far { (known * rel_tol).sqrt() } else { rel_tol };
        let least = (2 * pass.least).max(self.min_samples).min(self.most);
        let limits = pass.followed_by(least, self.most);
        Some(limits.up_to(rel_tol, figures.mean_cd_m2(), &taken.blocks))
    }

    /// Paths of a pixel in the passes after this one, which follows what is known; `None` where
    /// that is unknown.
    fn later(&self, pass: &Pass, before: &CameraEstimates) -> Option<f64> {
        let Some(rel_tol) = self.rel_tol else {
            let next = |least: &u64| (*least < self.most).then(|| least.saturating_mul(GROWTH));
            let later = std::iter::successors(Some(pass.least), next).skip(1);
            return Some(later.map(|least| least.min(self.most) as f64).sum());
        };
        if pass.is_up_to(rel_tol) {
            return Some(0.0);
        }
        let excess = before.relative_half_width()? / rel_tol;
        Some(before.samples as f64 * excess * excess)
    }

    /// That light is blurred which only photons found, where that is more than a tenth of what may
    /// be off.
    fn blur(&self, camera: &Camera, figures: &CameraEstimates) -> Option<Caveat> {
        let radius_m = figures.disc_radius_m?;
        let share = figures.merged_mean_cd_m2 / figures.mean_cd_m2();
        let told = BLURRED * self.rel_tol.unwrap_or(REL_TOL);
        let camera = camera.name.clone();
        (share > told).then_some(Caveat::PictureBlurred { camera, share, radius_m })
    }

    /// Warning that a picture is not what was wanted.
    fn shortfall(&self, camera: &Camera, figures: &CameraEstimates) -> Option<Caveat> {
        let camera = camera.name.clone();
        let samples = figures.samples;
        let relative_half_width = figures.relative_half_width();
        match self.rel_tol {
            _ if figures.is_done => None,
            _ if samples == 0 => Some(Caveat::NoPicture { camera }),
            Some(rel_tol) => Some(Caveat::PictureAboveTolerance {
                camera,
                samples,
                relative_half_width,
                rel_tol,
            }),
            None => Some(Caveat::PictureUnfinished { camera, samples, wanted_samples: self.most }),
        }
    }
}

/// A picture while it is taken.
struct CameraRun<'a, S> {
    number: usize,
    goal: PictureGoal,
    integrator: PictureIntegrator<'a, S>,
    /// Paths of a pixel in a replicate in the passes so far, on average.
    traced: f64,
}

impl<S: Spectrum> CameraRun<'_, S> {
    /// Pass after pass up to what is wanted, or until the observer stops one.
    fn take(
        &mut self,
        mut taken: PassResult,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> PassResult {
        let mut next = Some(self.goal.first());
        while let Some(pass) = next {
            let Some(result) = self.pass(&pass, &taken, work, watch) else { break };
            taken = result;
            taken.figures.is_done = self.goal.is_done(&taken.figures);
            taken.figures.rel_tol = self.goal.rel_tol;
            next = self.goal.next(&pass, &taken);
        }
        taken
    }

    /// One pass after another one; `None` where the observer stopped it.
    fn pass(
        &mut self,
        pass: &Pass,
        before: &PassResult,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> Option<PassResult> {
        let expected = self.integrator.expected(pass);
        let at = PictureProgress {
            camera: self.number,
            samples: expected.round() as u64,
            complete_samples: before.figures.samples,
            relative_half_width: before.figures.relative_half_width(),
            rel_tol: self.goal.rel_tol,
        };
        let later = self.goal.later(pass, &before.figures);
        watch.begin_pass(at);
        let photons = expected.ceil() as u64 * CAUSTIC_PHOTONS;
        self.integrator.trace_caustics(photons, work, watch)?;
        let traced = self.traced;
        self.integrator.render_pass(pass, work, |Step { paths, rays, done, left }| {
            self.traced = traced + done;
            let whole = later.map(|later| self.traced + left + later);
            watch.tick_picture(paths, rays, at, whole.map(|whole| self.traced / whole))
        })
    }
}
