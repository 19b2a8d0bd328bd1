//! Pictures, from their first pass to their last.
//!
//! A picture comes after the sensors, in passes with more and more paths a pixel, each from scratch
//! (`run/pixels.rs`). It is done when it is known well enough
//! ([`CameraEstimates::relative_half_width`]), or when it has the wanted number of paths; only
//! complete passes are looked at. The number of paths of a pass follows from the half-widths of the
//! one before, that of the first from a sample of the picture's blocks, so most of the work is in
//! the last. When the observer stops a pass, the one before is the picture; before the first there
//! is none.

use crate::context::Context;
use crate::cutoff;
use crate::path::sections::WorkCounts;
use crate::run::pixels::{Darkroom, Exposure};
use crate::run::raster::Part;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::estimates::Estimates;
use crate::stats::observer::PictureProgress;
use crate::stats::picture::CameraEstimates;
use crate::stats::watch::Watch;
use quasilux_scene::{Camera, Scene};

/// Wanted of a picture where nobody says anything else.
const REL_TOL: f64 = 0.05;
/// Paths of each pixel in each replicate at most, where only a tolerance is wanted.
const MAX_SAMPLES: u64 = 1 << 12;
/// Before so many of them no picture is called done: what few of them find says little of the rest;
/// of plain paths, and of bidirectional ones.
const MIN_SAMPLES: u64 = 4;
const MIN_SAMPLES_OF_BIDIRECTIONAL: u64 = 2;
/// Light of photons is told above this part of the tolerance.
const BLURRED: f64 = 0.1;
/// A picture of fewer blocks has no sample.
const MIN_BLOCKS: usize = 64;
/// Paths of a first pass at most, so that there soon is a picture.
const MAX_FIRST: u64 = 4;
/// From one pass to the next the number of paths grows by this factor at most.
const GROWTH: u64 = 16;
/// Half-widths shrink at least like N to this power.
const SLOPE: f64 = -0.5;
/// A pass is to be enough with some room to spare, since half-widths vary.
const MARGIN: f64 = 1.1;
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
        let wish = Wish::new(camera, settings);
        let replicates = settings.effective_replicates() as usize;
        let mut taken = Exposure::nothing(wish.rel_tol, replicates);
        if let Some(darkroom) = Darkroom::new(context, settings, number as u32, camera, watch) {
            let mut sitting = Sitting { number, wish, darkroom };
            taken = sitting.take(taken, &mut work, watch);
            taken.invalid += sitting.darkroom.invalid_photons();
        }
        let Exposure { figures, invalid } = taken;
        estimates.warnings.extend(wish.complaint(camera, &figures));
        estimates.warnings.extend(wish.blur(camera, &figures));
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
    estimates.warnings.extend(cutoff::warning(work.endless, "paths of pictures", "luminances"));
}

/// What is wanted of a picture.
#[derive(Clone, Copy, Debug)]
struct Wish {
    rel_tol: Option<f64>,
    /// Paths of each pixel in each replicate, at most.
    most: u64,
    /// Before so many it is not done.
    min_samples: u64,
    /// Whether only all of them make a picture.
    all_or_nothing: bool,
}

impl Wish {
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

    /// Paths of the first pass.
    fn first(&self) -> u64 {
        if self.all_or_nothing { self.most } else { 1 }
    }

    /// Paths of the pass that follows a complete one; `None` where that is the last.
    fn next(&self, figures: &CameraEstimates) -> Option<u64> {
        if self.is_done(figures) || figures.samples >= self.most {
            return None;
        }
        let most = figures.samples.saturating_mul(GROWTH).min(self.most);
        let fewest = (2 * figures.samples).max(self.min_samples).min(most);
        Some(self.expected(figures).unwrap_or(most).clamp(fewest, most))
    }

    /// Paths that should do, if nothing limits them.
    fn expected(&self, figures: &CameraEstimates) -> Option<u64> {
        let excess = figures.relative_half_width()? / self.rel_tol?;
        Some(
            even((MARGIN * figures.samples as f64 * libm::pow(excess, 1.0 / -SLOPE)).ceil() as u64),
        )
    }

    /// That light is blurred which only photons found, where that is more than a tenth of what may
    /// be off.
    fn blur(&self, camera: &Camera, figures: &CameraEstimates) -> Option<String> {
        let radius_m = figures.disc_radius_m?;
        let means = &figures.replicate_mean_cd_m2;
        let mean_cd_m2 = means.iter().sum::<f64>() / means.len() as f64;
        let share = figures.merged_mean_cd_m2 / mean_cd_m2;
        let told = BLURRED * self.rel_tol.unwrap_or(REL_TOL);
        (share > told).then(|| {
            format!(
                "{:.1} % of the light in the picture of camera \"{}\" comes from photons, over \
                 mirrors or through glass: it is blurred over {radius_m:.2} m",
                100.0 * share,
                camera.name
            )
        })
    }

    /// What a reader must know of a picture that is not what was wanted.
    fn complaint(&self, camera: &Camera, figures: &CameraEstimates) -> Option<String> {
        let name = &camera.name;
        let samples = figures.samples;
        let known = match figures.relative_half_width() {
            Some(known) => format!("it is known to {:.2} %", 100.0 * known),
            None => "little is known of it".to_owned(),
        };
        match self.rel_tol {
            _ if figures.is_done => None,
            _ if samples == 0 => Some(format!(
                "camera \"{name}\" has no picture: the run was stopped before it had a path for \
                 each pixel"
            )),
            Some(rel_tol) => Some(format!(
                "the picture of camera \"{name}\" ends with {samples} paths a pixel and replicate: \
                 {known}, not to {} %",
                100.0 * rel_tol
            )),
            None => Some(format!(
                "the picture of camera \"{name}\" was stopped at {samples} of {} paths a pixel and \
                 replicate",
                self.most
            )),
        }
    }
}

/// The number or the next one that has no more than two binary digits other than 0: points of nets
/// are balanced in such numbers.
fn even(number: u64) -> u64 {
    let step = (number.max(1).ilog2()).saturating_sub(1);
    number.div_ceil(1 << step) << step
}

/// A picture while it is taken.
struct Sitting<'a, S> {
    number: usize,
    wish: Wish,
    darkroom: Darkroom<'a, S>,
}

impl<S: Spectrum> Sitting<'_, S> {
    /// Pass after pass up to what is wanted, or until the observer stops one.
    fn take(
        &mut self,
        mut taken: Exposure,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> Exposure {
        let mut next = Some(self.first(&taken.figures, work, watch));
        while let Some(samples) = next {
            let Some(exposure) = self.pass(samples, &taken.figures, work, watch) else { break };
            taken = exposure;
            taken.figures.is_done = self.wish.is_done(&taken.figures);
            next = self.wish.next(&taken.figures);
            taken.figures.rel_tol = self.wish.rel_tol;
        }
        taken
    }

    /// Paths of the first pass: those that a sample of the picture says are enough, if few are.
    fn first(&self, before: &CameraEstimates, work: &mut WorkCounts, watch: &mut Watch<'_>) -> u64 {
        let Self { wish, darkroom, .. } = self;
        let first = wish.first();
        if wish.rel_tol.is_none() || darkroom.block_count() < MIN_BLOCKS {
            return first;
        }
        let at = self.progress(first, before);
        let sample = darkroom.expose(first, Part::Sample, work, |paths, rays, _| {
            watch.tick_picture(paths, rays, at, 0.0)
        });
        let expected = sample.and_then(|sample| wish.expected(&sample.figures));
        expected
            .map_or(first, |expected| expected.max(wish.min_samples).min(MAX_FIRST).min(wish.most))
    }

    fn progress(&self, samples: u64, before: &CameraEstimates) -> PictureProgress {
        PictureProgress {
            camera: self.number,
            samples,
            complete_samples: before.samples,
            relative_half_width: before.relative_half_width(),
            rel_tol: self.wish.rel_tol,
        }
    }

    /// One pass after another one; `None` where the observer stopped it.
    fn pass(
        &mut self,
        samples: u64,
        before: &CameraEstimates,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> Option<Exposure> {
        let at = self.progress(samples, before);
        // Earlier passes have taken as many again as a share of the last.
        let expected = self.wish.expected(before).unwrap_or(self.wish.most);
        let all = expected.clamp(samples, self.wish.most.max(samples)) as f64;
        watch.begin_pass(at);
        self.darkroom.trace_caustics(samples * CAUSTIC_PHOTONS, work, watch)?;
        self.darkroom.expose(samples, Part::All, work, |paths, rays, share| {
            watch.tick_picture(paths, rays, at, samples as f64 * share / all)
        })
    }
}
