//! The pixels of cameras: the mean luminance over each.
//!
//! `L_pixel` is the integral of `L(x, w(p))` over the places p of the pixel, a unit square of the
//! picture (box filter). Its paths start at the pinhole, through the place that their first two
//! coordinates give, and go on like the paths of sensors; all of them are plain paths, whatever the
//! estimator does at sensors, so a picture has no bias of a map. Light that no path finds comes
//! from photon density.
//!
//! A picture has a fixed number of paths a pixel, not a tolerance: [`PIXEL_SAMPLES`] in each
//! replicate, or as many as the run is limited to. It comes after the sensors, in passes of 1, 16,
//! 256, ... paths, each from scratch: when the observer stops one, the pass before is the picture,
//! at a price of 1/15 of the work at most.
//!
//! No sums are kept for a picture: a run of pixels is traced in all replicates, then summarised,
//! and 24 bytes a pixel stay.

use crate::context::{Context, Stream};
use crate::cutoff;
use crate::path::end::Rest;
use crate::path::sections::WorkCounts;
use crate::path::start::{Measurement, Start};
use crate::path::wave::{PathWave, WAVE};
use crate::photon::caustics::CausticMap;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::estimates::Estimates;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::picture::{CameraEstimates, Pixel};
use crate::stats::tally::{Quantum, Sum};
use crate::stats::watch::Watch;
use quasilux_sampling::{PointSet, Sampler};
use quasilux_scene::{Camera, Scene, View};
use rayon::prelude::*;
use std::ops::{Range, RangeInclusive};

/// Paths of each pixel in each replicate, where no limit says otherwise: 256 with 16 replicates.
const PIXEL_SAMPLES: u64 = 16;
/// From one pass to the next the number of paths grows by this factor.
const GROWTH: u64 = 16;
/// Photons for each path of a pixel that look for light which paths cannot find.
const CAUSTIC_PHOTONS: u64 = 1 << 12;
/// Paths between two words to the observer.
const ROUND: u64 = 1 << 17;
/// Strips of a round at least, so that all threads have work.
const MIN_STRIPS: u64 = 256;
/// Channels of a picture.
const RGB: usize = 3;

/// Takes the pictures of all cameras and adds them to what the sensors know.
pub(crate) fn add_pictures<S: Spectrum>(
    context: &Context<'_, S>,
    scene: &Scene,
    settings: &Settings,
    estimates: &mut Estimates,
    watch: &mut Watch<'_>,
) {
    let samples = settings.max_samples.unwrap_or(PIXEL_SAMPLES).max(1);
    let mut work = WorkCounts::default();
    let mut complete = true;
    for (number, camera) in (0..).zip(&scene.cameras) {
        let mut darkroom = Darkroom {
            context,
            number,
            view: camera.view(),
            width: camera.resolution[0] as usize,
            replicates: settings.effective_replicates(),
            samples: 0,
            miss_probability: 1.0 - settings.confidence,
            quantum: Quantum::for_reference(context.lights.reference_lx(&context.world)),
            caustics: CausticMap::new(context, settings, &[]),
        };
        // Part of a set whose number of points is fixed would leave part of its lights out.
        let first = if settings.sequence.points().is_some() { samples } else { 1 };
        let Exposure { figures, invalid } =
            darkroom.expose_until(first.min(samples)..=samples, camera, &mut work, watch);
        complete &= figures.samples == samples;
        estimates.invalid_contributions +=
            invalid + darkroom.caustics.as_ref().map_or(0, CausticMap::invalid);
        estimates.cameras.push(figures);
    }
    if !complete {
        estimates.warnings.push(format!(
            "pictures were stopped before they had {samples} paths a pixel and replicate"
        ));
    }
    if scene.sensors.is_empty() {
        estimates.samples = estimates.cameras.iter().map(|c| c.samples).max().unwrap_or(0);
        estimates.tolerance_reached = true;
    }
    estimates.tolerance_reached &= complete;
    estimates.rays += work.rays;
    estimates.dimensions.path.merge(&work.dimensions);
    estimates.biased |= work.endless > 0;
    estimates.warnings.extend(cutoff::warning(work.endless, "paths of pictures", "luminances"));
}

/// Where the picture of one camera is made.
struct Darkroom<'a, S> {
    context: &'a Context<'a, S>,
    number: u32,
    view: View,
    width: usize,
    replicates: u32,
    /// Paths of each pixel in each replicate.
    samples: u64,
    miss_probability: f64,
    quantum: Quantum,
    /// Light that no path finds.
    caustics: Option<CausticMap<S>>,
}

/// A picture, and how many contributions are not in it.
struct Exposure {
    figures: CameraEstimates,
    invalid: u64,
}

/// Some pixels in a row of the picture's memory.
struct Strip {
    pixels: Vec<Pixel>,
    /// Of each replicate, all pixels together.
    sums: Vec<PixelSums>,
    work: WorkCounts,
}

/// What the paths of one pixel in one replicate found.
#[derive(Clone, Copy, Default)]
struct PixelSums {
    channels: [Sum; RGB],
    /// Paths that came to a surface that reflects.
    reflected: u64,
}

impl<S: Spectrum> Darkroom<'_, S> {
    /// Has as many photons look for light that no path finds as belong to this pass. Whether to go
    /// on; it is always so where the pass may not be stopped.
    fn trace_caustics(
        &mut self,
        may_stop: bool,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> bool {
        let Some(caustics) = &mut self.caustics else { return true };
        let photons = self.samples.saturating_mul(CAUSTIC_PHOTONS);
        let mut nobody = ();
        let rays = match may_stop {
            true => caustics.grow(self.context, photons, watch),
            false => caustics.grow(self.context, photons, &mut Watch::new(&mut nobody)),
        };
        work.rays += rays.unwrap_or_default();
        rays.is_some()
    }

    /// Passes with more and more paths until the last of `paths`, or until the observer stops them:
    /// the last complete one. The first is never stopped.
    fn expose_until(
        &mut self,
        paths: RangeInclusive<u64>,
        camera: &Camera,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> Exposure {
        let mut picture = None;
        let mut next = Some(*paths.start());
        while let Some(pass) = next {
            self.samples = pass;
            let may_stop = picture.is_some();
            if !self.trace_caustics(may_stop, work, watch) {
                break;
            }
            let Some(taken) = self.expose(camera, may_stop, work, watch) else { break };
            picture = Some(taken);
            let last = *paths.end();
            next = (pass < last).then(|| pass.saturating_mul(GROWTH).min(last));
        }
        picture.expect("the first pass is never stopped")
    }

    /// One pass over the whole picture; `None` when the observer stopped it, if it may.
    fn expose(
        &self,
        camera: &Camera,
        may_stop: bool,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> Option<Exposure> {
        let count = camera.pixels();
        let paths_a_pixel = self.samples.saturating_mul(u64::from(self.replicates));
        let strip = (WAVE / paths_a_pixel).max(1) as usize;
        let round = strip * (ROUND / paths_a_pixel / strip as u64).max(MIN_STRIPS) as usize;
        let mut pixels = Vec::with_capacity(count);
        let mut sums = vec![PixelSums::default(); self.replicates as usize];
        while pixels.len() < count {
            let last = (pixels.len() + round).min(count);
            let strips: Vec<Strip> = (pixels.len()..last)
                .into_par_iter()
                .step_by(strip)
                .map_init(PathWave::default, |wave, first| {
                    self.trace(first..(first + strip).min(last), wave)
                })
                .collect();
            let before = (work.paths, work.rays);
            for found in strips {
                pixels.extend(found.pixels);
                sums.iter_mut().zip(found.sums).for_each(|(sum, found)| sum.merge(found));
                *work += found.work;
            }
            let (paths, rays) = (work.paths - before.0, work.rays - before.1);
            let goes_on = watch.tick_picture(paths, rays, last as f64 / count as f64);
            if may_stop && !goes_on {
                return None;
            }
        }
        let n = self.samples as f64 * count as f64;
        let mean = |sums: &PixelSums| self.mean(sums, n).luminance();
        let figures = CameraEstimates {
            pixels: pixels.into(),
            replicate_mean_cd_m2: sums.iter().map(mean).collect(),
            samples: self.samples,
        };
        let invalid = sums.iter().flat_map(|sums| sums.channels).map(|sum| sum.invalid).sum();
        Some(Exposure { figures, invalid })
    }

    /// Traces all paths of some pixels and summarises each.
    fn trace(&self, pixels: Range<usize>, wave: &mut PathWave<S>) -> Strip {
        let replicates = self.replicates as usize;
        let points: Vec<PointSet> = pixels
            .clone()
            .flat_map(|pixel| (0..self.replicates).map(move |replicate| (pixel, replicate)))
            .map(|(pixel, replicate)| {
                let stream = Stream::Pixel { camera: self.number, pixel: pixel as u32 };
                self.context.points(replicate, stream)
            })
            .collect();
        let mut sums = vec![PixelSums::default(); points.len()];
        let mut work = WorkCounts::default();
        let paths = self.samples * points.len() as u64;
        for first in (0..paths).step_by(WAVE as usize) {
            let numbers = first..(first + WAVE).min(paths);
            let starts = numbers.clone().map(|path| {
                let (row, index) = ((path / self.samples) as usize, path % self.samples);
                let (pixel, replicate) = (row / replicates, row % replicates);
                self.start(pixels.start + pixel, replicate as u32, &points[row], index)
            });
            for (path, ended) in numbers.clone().zip(wave.trace(self.context, starts)) {
                let ended = ended.end();
                let light = ended.found.direct + ended.found.indirect;
                let sums = &mut sums[(path / self.samples) as usize];
                for (c, channel) in sums.channels.iter_mut().enumerate().take(S::CHANNELS) {
                    channel.add(light.channel(c), self.quantum);
                }
                sums.reflected += u64::from(ended.found.reflected);
                work.add(&ended);
            }
        }
        work.rays += wave.take_rays();
        let mut of_replicates = vec![PixelSums::default(); replicates];
        for own in sums.chunks_exact(replicates) {
            of_replicates.iter_mut().zip(own).for_each(|(sum, own)| sum.merge(*own));
        }
        let pixels = sums.chunks_exact(replicates).map(|own| self.pixel(own)).collect();
        Strip { pixels, sums: of_replicates, work }
    }

    /// A path through the place of a pixel that its first two coordinates give.
    fn start<'p>(
        &'p self,
        pixel: usize,
        replicate: u32,
        points: &'p PointSet,
        index: u64,
    ) -> Start<'p, S> {
        let mut sampler = Sampler::new(points, index);
        let [u, v] = sampler.next_2d();
        let (x, y) = ((pixel % self.width) as f64, (pixel / self.width) as f64);
        let direction = self.view.direction([x + u, y + v]);
        Start {
            caustics: self.caustics.as_ref().and_then(|caustics| caustics.map(replicate)),
            partition: None,
            from: self.context.world.ray_origin_of_sensor(self.view.position, direction),
            measurement: Measurement::Luminance { direction },
            rest: &Rest::Path,
            light_subpath: None,
            sampler,
        }
    }

    /// What the replicates say together.
    fn pixel(&self, own: &[PixelSums]) -> Pixel {
        let n = self.samples as f64;
        let means = own.iter().map(|sums| self.mean(sums, n));
        let share = 1.0 / own.len() as f64;
        let mean = means.clone().fold(S::black(), |sum, mean| sum + mean) * share;
        let is_dark = own.iter().all(PixelSums::is_zero);
        let was_looked_for = own.iter().any(|sums| sums.reflected > 0);
        let t = t_quantile_for(own.len(), self.miss_probability);
        let interval = Interval::of_mean(
            means.map(Spectrum::luminance),
            t.filter(|_| !(is_dark && was_looked_for)),
        );
        Pixel {
            rgb_cd_m2: std::array::from_fn(|c| mean.channel(c) as f32),
            luminance_cd_m2: interval.value as f32,
            half_width_cd_m2: interval.half_width.map(|half_width| half_width as f32),
        }
    }

    fn mean(&self, sums: &PixelSums, n: f64) -> S {
        S::from_channels(|channel| self.quantum.value(sums.channels[channel]) / n)
    }
}

impl PixelSums {
    fn is_zero(&self) -> bool {
        self.channels.iter().all(Sum::is_zero)
    }

    fn merge(&mut self, other: Self) {
        self.channels.iter_mut().zip(other.channels).for_each(|(sum, other)| *sum += other);
        self.reflected += other.reflected;
    }
}
