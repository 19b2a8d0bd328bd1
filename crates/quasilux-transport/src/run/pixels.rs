//! The pixels of cameras: the mean luminance over each.
//!
//! `L_pixel` is the integral of `L(x, w(p))` over the places p of the pixel, a unit square of the
//! picture (box filter). Its paths start at the pinhole, through the place that their first two
//! coordinates give, and find light as those of sensors do: by the default as bidirectional paths
//! ([`PixelTracer`]), by other estimators as plain paths beside photon density of light that no
//! path finds.
//!
//! No sums are kept for a picture: a few blocks of pixels are traced in all replicates, then
//! summarised, and 32 bytes a pixel stay. `run/pictures.rs` says how many paths a pixel gets.

use crate::context::Context;
use crate::estimator::bidirectional::{PictureLight, PixelSink, PixelTracer, PixelUnit, Sink};
use crate::path::contribution::PathContribution;
use crate::path::pixel_rays::PixelRays;
use crate::path::sections::WorkCounts;
use crate::path::start::{Measurement, Start};
use crate::path::wave::{PathWave, WAVE};
use crate::photon::caustics::CausticMap;
use crate::run::raster::{Part, PixelBlock, Raster};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::picture::{CameraEstimates, Pixel};
use crate::stats::tally::{Quantum, Sum};
use crate::stats::watch::Watch;
use quasilux_scene::Camera;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::Arc;

/// Blocks that are traced together at least, and for each thread, so that all have work; and those
/// that the same light serves before it is traced again.
const TOGETHER: usize = 24;
const OF_A_THREAD: usize = 2;
const REGION: usize = 240;
/// Indices between two words to the observer: half a second of a processor with two cores.
pub(super) const INDICES: u64 = 2;
/// Channels of a picture.
const RGB: usize = 3;

/// Where the picture of one camera is made.
pub(super) struct Darkroom<'a, S> {
    context: &'a Context<'a, S>,
    rays: PixelRays,
    raster: Raster,
    replicates: u32,
    /// The quantile behind the half-widths of pixels, which takes long to find.
    t: Option<f64>,
    quantum: Quantum,
    tracer: Tracer<'a, S>,
}

/// How light is followed.
enum Tracer<'a, S> {
    /// By plain paths, and what they do not find.
    Paths(Option<Box<CausticMap<S>>>),
    Bidirectional(Box<PixelTracer<'a, S>>),
}

/// What serves the pixels that are traced together.
enum Light<'d, S> {
    /// Light that plain paths do not find.
    Caustics(Option<&'d CausticMap<S>>),
    /// That of some indices, of each replicate.
    Subpaths(&'d PixelTracer<'d, S>, Vec<PictureLight<S>>),
}

/// A picture, and how many contributions are not in it.
pub(super) struct Exposure {
    pub(super) figures: CameraEstimates,
    pub(super) invalid: u64,
}

/// A block while it is traced.
struct Tray {
    /// Numbers of its pixels in the picture.
    places: Vec<usize>,
    /// How often light vertices are joined to what it sees.
    per_sure_m2: f64,
    found: BlockSums,
}

/// What the paths of a block found.
struct BlockSums {
    /// Of pixel p in replicate r at `p * replicates + r`.
    sums: Vec<PixelSums>,
    /// Of each pixel, the smallest disc that photons count on, in m^2; `None` where nothing is
    /// seen.
    least_disc_m2: Vec<Option<f64>>,
}

/// What the paths of one pixel in one replicate found, on average.
#[derive(Clone, Copy, Default)]
struct PixelSums {
    channels: [Sum; RGB],
    /// The part of their luminance that photons brought.
    merged: Sum,
    /// Paths that came to a surface that reflects.
    reflected: u64,
}

/// Takes what paths of one replicate find.
struct Developer<'t> {
    found: &'t mut BlockSums,
    replicate: u32,
    replicates: u32,
    /// What one path of a pixel counts.
    share: f64,
    quantum: Quantum,
}

impl Developer<'_> {
    /// Of a pixel of the block.
    fn sums(&mut self, pixel: usize) -> &mut PixelSums {
        &mut self.found.sums[pixel * self.replicates as usize + self.replicate as usize]
    }
}

impl<S: Spectrum> Sink<S> for Developer<'_> {
    fn add(&mut self, pixel: usize, _bounces: u32, light: S) {
        let (share, quantum) = (self.share, self.quantum);
        self.sums(pixel).add(light * share, quantum);
    }

    fn add_merged(&mut self, pixel: usize, bounces: u32, light: S) {
        self.add(pixel, bounces, light);
        let (share, quantum) = (self.share, self.quantum);
        self.sums(pixel).merged.add(light.luminance() * share, quantum);
    }
}

impl<S: Spectrum> PixelSink<S> for Developer<'_> {
    fn arrive(&mut self, pixel: usize, disc_m2: f64) {
        self.sums(pixel).reflected += 1;
        let least_m2 = &mut self.found.least_disc_m2[pixel];
        *least_m2 = Some(least_m2.map_or(disc_m2, |least_m2| least_m2.min(disc_m2)));
    }
}

impl Exposure {
    /// No picture.
    pub(super) fn nothing(rel_tol: Option<f64>, replicates: usize) -> Self {
        let figures = CameraEstimates {
            pixels: Arc::new([]),
            replicate_mean_cd_m2: vec![0.0; replicates],
            unseen_mean_cd_m2: None,
            merged_mean_cd_m2: 0.0,
            disc_radius_m: None,
            samples: 0,
            rel_tol,
            is_done: false,
        };
        Self { figures, invalid: 0 }
    }
}

impl<'a, S: Spectrum> Darkroom<'a, S> {
    /// `None` when the observer stopped it.
    pub(super) fn new(
        context: &'a Context<'a, S>,
        settings: &Settings,
        number: u32,
        camera: &Camera,
        watch: &mut Watch<'_>,
    ) -> Option<Self> {
        let replicates = settings.effective_replicates();
        let tracer = match settings.estimator.is_bounded() {
            true => {
                Tracer::Bidirectional(Box::new(PixelTracer::new(context, camera.pixels(), watch)?))
            }
            false => Tracer::Paths(CausticMap::new(context, settings, &[]).map(Box::new)),
        };
        let raster = Raster { size: camera.resolution.map(|edge| edge as usize) };
        Some(Self {
            context,
            rays: PixelRays { camera: number, view: camera.view(), width: raster.size[0] },
            raster,
            replicates,
            t: t_quantile_for(replicates as usize, 1.0 - settings.confidence),
            quantum: Quantum::for_reference(context.lights.reference_lx(&context.world)),
            tracer,
        })
    }

    /// Photons whose contributions are not in the pictures.
    pub(super) fn invalid_photons(&self) -> u64 {
        match &self.tracer {
            Tracer::Paths(Some(caustics)) => caustics.invalid(),
            Tracer::Paths(None) | Tracer::Bidirectional(_) => 0,
        }
    }

    /// Has so many photons in all look for light that no path finds; `None` where the observer
    /// stopped them.
    pub(super) fn trace_caustics(
        &mut self,
        photons: u64,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> Option<()> {
        if let Tracer::Paths(Some(caustics)) = &mut self.tracer {
            work.rays += caustics.grow(self.context, photons, watch)?;
        }
        Some(())
    }

    /// One pass with so many paths of each pixel in each replicate over the whole picture, or over
    /// a part. `tick` is told of paths, rays and the share of the pass that is over, and says
    /// whether to go on; `None` where it does not.
    pub(super) fn expose(
        &self,
        samples: u64,
        part: Part,
        work: &mut WorkCounts,
        mut tick: impl FnMut(u64, u64, f64) -> bool,
    ) -> Option<Exposure> {
        let blocks = self.raster.blocks(part);
        let mut pixels = vec![Pixel::default(); self.raster.pixels()];
        let mut sums = vec![PixelSums::default(); self.replicates as usize];
        let together = TOGETHER.max(OF_A_THREAD * rayon::current_num_threads());
        let mut done = 0.0;
        for region in blocks.chunks(REGION) {
            let mut trays: Vec<Tray> = region.par_iter().map(|it| self.tray(*it)).collect();
            let mut indices = 0..INDICES.min(samples);
            while !indices.is_empty() {
                let light = self.light(indices.clone(), work);
                for trays in trays.chunks_mut(together) {
                    done += (indices.end - indices.start) as f64 * trays.len() as f64;
                    let cost = self.trace(trays, &light, indices.clone(), samples);
                    let (paths, rays) = (cost.paths, cost.rays);
                    *work += cost;
                    let all = samples as f64 * blocks.len() as f64;
                    if !tick(paths, rays, done / all) && done < all {
                        return None;
                    }
                }
                indices = indices.end..(indices.end + INDICES).min(samples);
            }
            for Tray { places, found, .. } in trays {
                let own = found.sums.chunks_exact(self.replicates as usize);
                for (own, (place, disc_m2)) in own.zip(places.iter().zip(found.least_disc_m2)) {
                    sums.iter_mut().zip(own).for_each(|(sum, own)| sum.merge(*own));
                    pixels[*place] = self.pixel(own, samples, disc_m2.unwrap_or(0.0));
                }
            }
        }
        if let Part::Sample = part {
            let places = blocks.iter().flat_map(|&block| self.raster.places(block));
            pixels = places.map(|place| pixels[place]).collect();
        }
        let invalid = sums.iter().flat_map(|sums| sums.channels).map(|sum| sum.invalid).sum();
        Some(Exposure { figures: self.figures(pixels, &sums, samples), invalid })
    }

    /// What is known of a picture; the sums are those of all its pixels in each replicate.
    fn figures(&self, pixels: Vec<Pixel>, sums: &[PixelSums], samples: u64) -> CameraEstimates {
        let n = pixels.len() as f64;
        let merged = sums.iter().map(|sums| self.quantum.value(sums.merged));
        CameraEstimates {
            unseen_mean_cd_m2: self.unseen_of_mean(&pixels, samples),
            merged_mean_cd_m2: merged.sum::<f64>() / (n * sums.len() as f64),
            disc_radius_m: match &self.tracer {
                Tracer::Paths(_) => None,
                Tracer::Bidirectional(tracer) => tracer.disc_radius_m(),
            },
            pixels: pixels.into(),
            replicate_mean_cd_m2: sums.iter().map(|it| self.mean(it).luminance() / n).collect(),
            samples,
            rel_tol: None,
            is_done: false,
        }
    }

    /// How many blocks a picture has.
    pub(super) fn block_count(&self) -> usize {
        self.raster.blocks(Part::All).len()
    }

    fn tray(&self, block: PixelBlock) -> Tray {
        let places: Vec<usize> = self.raster.places(block).collect();
        let per_sure_m2 = match &self.tracer {
            Tracer::Paths(_) => 0.0,
            Tracer::Bidirectional(tracer) => {
                let view = &self.rays.view;
                let directions = block.quarters().map(|place| view.direction(place));
                tracer.per_sure_m2(view.position, &directions)
            }
        };
        let count = places.len();
        let found = BlockSums {
            sums: vec![PixelSums::default(); count * self.replicates as usize],
            least_disc_m2: vec![None; count],
        };
        Tray { places, per_sure_m2, found }
    }

    /// What serves all pixels with these indices.
    fn light(&self, indices: Range<u64>, work: &mut WorkCounts) -> Light<'_, S> {
        let tracer = match &self.tracer {
            Tracer::Paths(caustics) => return Light::Caustics(caustics.as_deref()),
            Tracer::Bidirectional(tracer) => tracer,
        };
        let replicates = (0..self.replicates).into_par_iter();
        let light = replicates.map(|replicate| tracer.light(replicate, indices.clone()));
        let light: Vec<PictureLight<S>> = light.collect();
        light.iter().for_each(|light| *work += light.work.clone());
        Light::Subpaths(tracer, light)
    }

    /// Traces paths of the pixels of some blocks in all replicates: these of so many.
    fn trace(
        &self,
        trays: &mut [Tray],
        light: &Light<'_, S>,
        indices: Range<u64>,
        samples: u64,
    ) -> WorkCounts {
        let of_tray = |wave: &mut PathWave<S>, tray: &mut Tray| {
            let mut work = WorkCounts::default();
            let Tray { places, per_sure_m2, found } = tray;
            for replicate in 0..self.replicates {
                let sink = &mut Developer {
                    found,
                    replicate,
                    replicates: self.replicates,
                    share: 1.0 / samples as f64,
                    quantum: self.quantum,
                };
                work += match light {
                    Light::Subpaths(tracer, light) => {
                        let unit = PixelUnit {
                            rays: &self.rays,
                            pixels: places,
                            replicate,
                            per_sure_m2: *per_sure_m2,
                            light: &light[replicate as usize],
                        };
                        tracer.trace(&unit, sink)
                    }
                    Light::Caustics(caustics) => {
                        self.trace_paths(places, *caustics, indices.clone(), sink, wave)
                    }
                };
            }
            work
        };
        let works = trays.par_iter_mut().map_init(PathWave::default, of_tray);
        let works: Vec<WorkCounts> = works.collect();
        works.into_iter().fold(WorkCounts::default(), |mut sum, own| {
            sum += own;
            sum
        })
    }

    /// Plain paths of pixels in the replicate of a sink.
    fn trace_paths(
        &self,
        places: &[usize],
        caustics: Option<&CausticMap<S>>,
        indices: Range<u64>,
        sink: &mut Developer<'_>,
        wave: &mut PathWave<S>,
    ) -> WorkCounts {
        let Self { context, rays, .. } = self;
        let points = rays.points(context, sink.replicate, places);
        let mut work = WorkCounts::default();
        let all = rays.through(&context.world, places, &points, indices);
        for together in all.chunks(WAVE as usize) {
            let starts = together.iter().map(|ray| Start {
                caustics: caustics.and_then(|caustics| caustics.map(sink.replicate)),
                from: ray.from,
                measurement: Measurement::Luminance { direction: ray.direction },
                map_end: None,
                daylight: None,
                sampler: ray.sampler.clone(),
            });
            for (ray, mut path) in together.iter().zip(wave.trace(context, starts)) {
                let ended = path.end();
                let PathContribution { direct, indirect, reflected, .. } = &ended.found;
                sink.add(ray.section, 0, *direct + *indirect);
                if *reflected {
                    PixelSink::<S>::arrive(sink, ray.section, f64::INFINITY);
                }
                work.add(&ended);
            }
        }
        work.rays += wave.take_rays();
        work
    }

    /// What the replicates say together.
    fn pixel(&self, own: &[PixelSums], samples: u64, disc_m2: f64) -> Pixel {
        let means = own.iter().map(|sums| self.mean(sums));
        let share = 1.0 / own.len() as f64;
        let mean = means.clone().fold(S::black(), |sum, mean| sum + mean) * share;
        let is_dark = own.iter().all(PixelSums::is_zero);
        let was_looked_for = own.iter().any(|sums| sums.reflected > 0);
        let interval = Interval::of_mean(
            means.map(Spectrum::luminance),
            self.t.filter(|_| !(is_dark && was_looked_for)),
        );
        let paths = samples as f64 * own.len() as f64;
        let unseen_cd_m2 = match &self.tracer {
            Tracer::Paths(_) => None,
            Tracer::Bidirectional(tracer) => Some(tracer.unseen_cd_m2(paths, disc_m2) as f32),
        };
        Pixel {
            rgb_cd_m2: std::array::from_fn(|c| mean.channel(c) as f32),
            luminance_cd_m2: interval.value as f32,
            half_width_cd_m2: interval.half_width.map(|half_width| half_width as f32),
            unseen_cd_m2,
        }
    }

    /// The bound of the picture's mean: a path of one of m pixels adds an m-th.
    fn unseen_of_mean(&self, pixels: &[Pixel], samples: u64) -> Option<f64> {
        let Tracer::Bidirectional(tracer) = &self.tracer else { return None };
        let m = pixels.len() as f64;
        let of_pixels = pixels.iter().filter_map(|pixel| pixel.unseen_cd_m2).map(f64::from);
        let paths = samples as f64 * f64::from(self.replicates) * m;
        Some(tracer.unseen_cd_m2(paths, 0.0).min(of_pixels.sum::<f64>() / m))
    }

    fn mean(&self, sums: &PixelSums) -> S {
        S::from_channels(|channel| self.quantum.value(sums.channels[channel]))
    }
}

impl PixelSums {
    fn add<S: Spectrum>(&mut self, light: S, quantum: Quantum) {
        for (c, channel) in self.channels.iter_mut().enumerate().take(S::CHANNELS) {
            channel.add(light.channel(c), quantum);
        }
    }

    fn is_zero(&self) -> bool {
        self.channels.iter().all(Sum::is_zero)
    }

    fn merge(&mut self, other: Self) {
        self.channels.iter_mut().zip(other.channels).for_each(|(sum, other)| *sum += other);
        self.merged += other.merged;
        self.reflected += other.reflected;
    }
}
