//! The pixels of cameras: the mean luminance over each.
//!
//! `L_pixel` is the integral of `L(x, w(p))` over the places p of the pixel, a unit square of the
//! picture (box filter). Its paths start at the pinhole, through the place that their first two
//! coordinates give, and go on like the paths of sensors; all of them are plain paths, whatever the
//! estimator does at sensors, so a picture has no bias of a map. Light that no path finds comes
//! from photon density.
//!
//! No sums are kept for a picture: a run of pixels is traced in all replicates, then summarised,
//! and 24 bytes a pixel stay. `run/pictures.rs` says how many paths a pixel gets.

use crate::context::{Context, Stream};
use crate::path::end::Rest;
use crate::path::sections::WorkCounts;
use crate::path::start::{Measurement, Start};
use crate::path::wave::{PathWave, WAVE};
use crate::photon::caustics::CausticMap;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::picture::{CameraEstimates, Pixel};
use crate::stats::tally::{Quantum, Sum};
use crate::stats::watch::Watch;
use quasilux_sampling::{PointSet, Sampler};
use quasilux_scene::{Camera, View};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// Paths between two words to the observer.
const ROUND: u64 = 1 << 17;
/// Strips of a round at least, so that all threads have work.
const MIN_STRIPS: u64 = 256;
/// Channels of a picture.
const RGB: usize = 3;

/// Where the picture of one camera is made.
pub(super) struct Darkroom<'a, S> {
    context: &'a Context<'a, S>,
    number: u32,
    view: View,
    width: usize,
    pixels: usize,
    replicates: u32,
    /// The quantile behind the half-widths of pixels, which takes long to find.
    t: Option<f64>,
    quantum: Quantum,
    /// Light that no path finds.
    caustics: Option<CausticMap<S>>,
}

/// A picture, and how many contributions are not in it.
pub(super) struct Exposure {
    pub(super) figures: CameraEstimates,
    pub(super) invalid: u64,
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

impl<'a, S: Spectrum> Darkroom<'a, S> {
    pub(super) fn new(
        context: &'a Context<'a, S>,
        settings: &Settings,
        number: u32,
        camera: &Camera,
    ) -> Self {
        let replicates = settings.effective_replicates();
        Self {
            context,
            number,
            view: camera.view(),
            width: camera.resolution[0] as usize,
            pixels: camera.pixels(),
            replicates,
            t: t_quantile_for(replicates as usize, 1.0 - settings.confidence),
            quantum: Quantum::for_reference(context.lights.reference_lx(&context.world)),
            caustics: CausticMap::new(context, settings, &[]),
        }
    }

    /// No picture.
    pub(super) fn unexposed(&self) -> Exposure {
        let figures = CameraEstimates {
            pixels: Arc::new([]),
            replicate_mean_cd_m2: vec![0.0; self.replicates as usize],
            samples: 0,
            rel_tol: None,
            is_done: false,
        };
        Exposure { figures, invalid: 0 }
    }

    /// Photons whose contributions are not in the pictures.
    pub(super) fn invalid_photons(&self) -> u64 {
        self.caustics.as_ref().map_or(0, CausticMap::invalid)
    }

    /// Has so many photons in all look for light that no path finds; `None` where the observer
    /// stopped them, if it may.
    pub(super) fn trace_caustics(
        &mut self,
        photons: u64,
        may_stop: bool,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> Option<()> {
        let Some(caustics) = &mut self.caustics else { return Some(()) };
        let mut nobody = ();
        let rays = match may_stop {
            true => caustics.grow(self.context, photons, watch),
            false => caustics.grow(self.context, photons, &mut Watch::new(&mut nobody)),
        };
        work.rays += rays?;
        Some(())
    }

    /// One pass with so many paths of each pixel in each replicate over the whole picture. `tick`
    /// is told of paths, rays and the share of the pass that is over, and says whether to go on;
    /// `None` where it does not.
    pub(super) fn expose(
        &self,
        samples: u64,
        work: &mut WorkCounts,
        mut tick: impl FnMut(u64, u64, f64) -> bool,
    ) -> Option<Exposure> {
        let count = self.pixels;
        let paths_a_pixel = samples.saturating_mul(u64::from(self.replicates));
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
                    self.trace(first..(first + strip).min(last), samples, wave)
                })
                .collect();
            let before = (work.paths, work.rays);
            for found in strips {
                pixels.extend(found.pixels);
                sums.iter_mut().zip(found.sums).for_each(|(sum, found)| sum.merge(found));
                *work += found.work;
            }
            let (paths, rays) = (work.paths - before.0, work.rays - before.1);
            if !tick(paths, rays, last as f64 / count as f64) && last < count {
                return None;
            }
        }
        let n = samples as f64 * count as f64;
        let mean = |sums: &PixelSums| self.mean(sums, n).luminance();
        let figures = CameraEstimates {
            pixels: pixels.into(),
            replicate_mean_cd_m2: sums.iter().map(mean).collect(),
            samples,
            rel_tol: None,
            is_done: false,
        };
        let invalid = sums.iter().flat_map(|sums| sums.channels).map(|sum| sum.invalid).sum();
        Some(Exposure { figures, invalid })
    }

    /// Traces all paths of some pixels and summarises each.
    fn trace(&self, pixels: Range<usize>, samples: u64, wave: &mut PathWave<S>) -> Strip {
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
        let paths = samples * points.len() as u64;
        for first in (0..paths).step_by(WAVE as usize) {
            let numbers = first..(first + WAVE).min(paths);
            let starts = numbers.clone().map(|path| {
                let (row, index) = ((path / samples) as usize, path % samples);
                let (pixel, replicate) = (row / replicates, row % replicates);
                self.start(pixels.start + pixel, replicate as u32, &points[row], index)
            });
            for (path, ended) in numbers.clone().zip(wave.trace(self.context, starts)) {
                let ended = ended.end();
                let light = ended.found.direct + ended.found.indirect;
                let sums = &mut sums[(path / samples) as usize];
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
        let pixels = sums.chunks_exact(replicates).map(|own| self.pixel(own, samples)).collect();
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
    fn pixel(&self, own: &[PixelSums], samples: u64) -> Pixel {
        let n = samples as f64;
        let means = own.iter().map(|sums| self.mean(sums, n));
        let share = 1.0 / own.len() as f64;
        let mean = means.clone().fold(S::black(), |sum, mean| sum + mean) * share;
        let is_dark = own.iter().all(PixelSums::is_zero);
        let was_looked_for = own.iter().any(|sums| sums.reflected > 0);
        let interval = Interval::of_mean(
            means.map(Spectrum::luminance),
            self.t.filter(|_| !(is_dark && was_looked_for)),
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
