//! The pixels of cameras: the mean luminance over each.
//!
//! `L_pixel` is the integral of `L(x, w(p))` over the places p of the pixel, a unit square of the
//! picture (box filter). Its paths start at the pinhole, through the place that their first two
//! coordinates give, and find light as those of sensors do: by the default as bidirectional paths
//! ([`PixelTracer`]), by other estimators as plain paths beside photon density of light that no
//! path finds.
//!
//! No sums are kept for a picture: a few blocks of pixels are traced in all replicates, then
//! summarised, and 32 bytes a pixel stay. `pictures/camera_run.rs` says how many paths a pixel
//! gets.

use crate::context::Context;
use crate::control::watch::Watch;
use crate::estimator::bidirectional::{PictureLight, PixelSink, PixelTracer, PixelUnit, Sink};
use crate::path::contribution::PathContribution;
use crate::path::path_batch::WorkCounts;
use crate::path::pixel_rays::PixelRays;
use crate::path::start::{Measurement, PathMaps, Start};
use crate::path::wave::{PathWave, WAVE};
use crate::photon::caustics::CausticMap;
use crate::pictures::pass::{KnownBlock, Pass, square_of};
use crate::pictures::pixel_sums::{BlockSums, PictureSums, PixelSums, TileSink};
use crate::pictures::raster::{PixelBlock, Raster};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::picture::{CameraEstimates, Pixel};
use crate::stats::tally::Quantum;
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
pub(crate) const INDICES: u64 = 2;
/// Where the picture of one camera is made.
pub(super) struct PictureIntegrator<'a, S> {
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

/// Light that serves the pixels that are traced together.
enum Light<'d, S> {
    /// Light that plain paths do not find.
    Caustics(Option<&'d CausticMap<S>>),
    /// Light subpaths of some indices, of each replicate.
    Subpaths(&'d PixelTracer<'d, S>, Vec<PictureLight<S>>),
}

/// A picture, and how many contributions are not in it.
pub(super) struct PassResult {
    pub(super) figures: CameraEstimates,
    pub(super) invalid: u64,
    pub(super) blocks: Vec<KnownBlock>,
}

/// Work at a pass.
pub(super) struct Step {
    pub(super) paths: u64,
    pub(super) rays: u64,
    /// Paths of a pixel in a replicate so far, on average over the picture.
    pub(super) done: f64,
    /// Paths of a pixel in a replicate that are probably to come, on average over the picture.
    pub(super) left: f64,
}

/// A block while it is traced.
struct Tile {
    /// Among those of the picture.
    number: usize,
    /// Paths of each pixel in each replicate.
    samples: u64,
    /// Paths of each pixel in each replicate that are probably to come.
    expected: f64,
    /// Whether it is known well enough.
    is_known: bool,
    /// The part of the picture that it is.
    share: f64,
    /// Numbers of its pixels in the picture.
    places: Vec<usize>,
    /// How often light vertices are joined to what it sees.
    per_sure_m2: f64,
    found: BlockSums,
}

/// How far a pass is.
struct Course<'t> {
    tick: &'t mut dyn FnMut(Step) -> bool,
    goes_on: bool,
    /// As in [`Step`].
    done: f64,
    left: f64,
}

impl Course<'_> {
    /// Notes work at this many paths of each pixel of some blocks.
    fn step(&mut self, cost: &WorkCounts, tiles: &mut [&mut Tile], paths: f64) {
        for tile in tiles {
            self.done += tile.share * paths;
            self.expect_less(tile, paths);
        }
        let (done, left) = (self.done, self.left);
        self.goes_on = (self.tick)(Step { paths: cost.paths, rays: cost.rays, done, left });
    }

    /// Expects this many paths less of each pixel of a block, none if fewer were expected.
    fn expect_less(&mut self, tile: &mut Tile, paths: f64) {
        let less = paths.min(tile.expected);
        tile.expected -= less;
        self.left -= tile.share * less;
    }
}

impl PassResult {
    /// Whether blocks had to end before they were known well enough.
    pub(super) fn is_limited(&self) -> bool {
        self.blocks.iter().any(|block| !block.is_enough)
    }

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
        Self { figures, invalid: 0, blocks: Vec::new() }
    }
}

impl<'a, S: Spectrum> PictureIntegrator<'a, S> {
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

    /// Has this many photons in all look for light that no path finds; `None` where the observer
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

    /// Paths of a pixel that a pass probably takes, on average.
    pub(super) fn expected(&self, pass: &Pass) -> f64 {
        let blocks = self.raster.blocks();
        let of_block = |(it, block): (usize, &PixelBlock)| {
            block.pixels() as f64 * pass.expected(it) / self.raster.pixels() as f64
        };
        blocks.iter().enumerate().map(of_block).sum()
    }

    /// One pass over the picture. `tick` is told how far it is, and says whether to go on; `None`
    /// where there was more to do.
    pub(super) fn render_pass(
        &self,
        pass: &Pass,
        work: &mut WorkCounts,
        mut tick: impl FnMut(Step) -> bool,
    ) -> Option<PassResult> {
        let blocks = self.raster.blocks();
        let mut course =
            Course { tick: &mut tick, goes_on: true, done: 0.0, left: self.expected(pass) };
        let mut pixels = vec![Pixel::default(); self.raster.pixels()];
        let mut sums = PictureSums::new(self.replicates);
        let mut known = Vec::with_capacity(blocks.len());
        for (region, first) in blocks.chunks(REGION).zip((0..).step_by(REGION)) {
            let tile = |(it, block): (usize, &PixelBlock)| self.tile(first + it, *block, pass);
            let mut tiles: Vec<Tile> = region.par_iter().enumerate().map(tile).collect();
            self.render_region(pass, &mut tiles, work, &mut course)?;
            for tile in &tiles {
                for (place, pixel) in tile.places.iter().zip(self.pixels(tile)) {
                    pixels[*place] = pixel;
                }
                sums.add::<S>(&tile.found, tile.samples, self.quantum);
                known.push(KnownBlock {
                    pixels: tile.places.len(),
                    samples: tile.samples,
                    is_enough: tile.is_known,
                    square: 0.0,
                });
            }
        }
        Some(self.result(pixels, sums, known))
    }

    /// Traces blocks that the same light serves, each until it is known well enough; `None` where
    /// they were stopped.
    fn render_region(
        &self,
        pass: &Pass,
        tiles: &mut [Tile],
        work: &mut WorkCounts,
        course: &mut Course<'_>,
    ) -> Option<()> {
        let together = TOGETHER.max(OF_A_THREAD * rayon::current_num_threads());
        let mut open: Vec<&mut Tile> = tiles.iter_mut().collect();
        let mut samples = 0;
        while !open.is_empty() {
            let next = (samples + INDICES).min(pass.most);
            let indices = pass.first + samples..pass.first + next;
            let light = self.light(indices.clone(), work);
            for tiles in open.chunks_mut(together) {
                if !course.goes_on {
                    return None;
                }
                let cost = self.trace(tiles, &light, indices.clone());
                course.step(&cost, tiles, (next - samples) as f64);
                *work += cost;
            }
            samples = next;
            if pass.is_look(samples) {
                open.par_iter_mut().for_each(|tile| {
                    tile.is_known = pass.is_known(tile.number, &self.pixels(tile));
                });
            }
            open.retain_mut(|tile| {
                let goes_on = !tile.is_known && samples < pass.most;
                if !goes_on {
                    course.expect_less(tile, f64::INFINITY);
                }
                goes_on
            });
        }
        Some(())
    }

    /// Estimates of a picture; computes the mean square errors of the blocks.
    fn result(
        &self,
        pixels: Vec<Pixel>,
        sums: PictureSums,
        mut blocks: Vec<KnownBlock>,
    ) -> PassResult {
        let n = pixels.len() as f64;
        let PictureSums { cd_m2, merged_cd_m2, invalid } = sums;
        let least = blocks.iter().map(|it| it.samples).min().unwrap_or(0);
        let paths: f64 = blocks.iter().map(|it| it.samples as f64 * it.pixels as f64).sum();
        let figures = CameraEstimates {
            unseen_mean_cd_m2: self.unseen_of_mean(&pixels, least),
            merged_mean_cd_m2: merged_cd_m2 / (n * f64::from(self.replicates)),
            disc_radius_m: match &self.tracer {
                Tracer::Paths(_) => None,
                Tracer::Bidirectional(tracer) => tracer.disc_radius_m(),
            },
            pixels: pixels.into(),
            replicate_mean_cd_m2: cd_m2.into_iter().map(|sum| sum / n).collect(),
            samples: (paths / n).round() as u64,
            rel_tol: None,
            is_done: false,
        };
        let mean_cd_m2 = figures.mean_cd_m2();
        for (known, block) in blocks.iter_mut().zip(self.raster.blocks()) {
            let own = self.raster.places(block).map(|place| &figures.pixels[place]);
            known.square = square_of(own, mean_cd_m2);
        }
        PassResult { figures, invalid, blocks }
    }

    fn tile(&self, number: usize, block: PixelBlock, pass: &Pass) -> Tile {
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
        Tile {
            number,
            samples: 0,
            expected: pass.expected(number),
            is_known: false,
            share: count as f64 / self.raster.pixels() as f64,
            places,
            per_sure_m2,
            found,
        }
    }

    /// Light that serves all pixels with these indices.
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

    /// Traces the paths of the pixels of some blocks with these indices, in all replicates.
    fn trace(
        &self,
        tiles: &mut [&mut Tile],
        light: &Light<'_, S>,
        indices: Range<u64>,
    ) -> WorkCounts {
        let of_tile = |wave: &mut PathWave<S>, tile: &mut &mut Tile| {
            let mut work = WorkCounts::default();
            let Tile { samples, places, per_sure_m2, found, .. } = &mut **tile;
            *samples += indices.end - indices.start;
            for replicate in 0..self.replicates {
                let sink = &mut TileSink {
                    found,
                    replicate,
                    replicates: self.replicates,
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
        let works = tiles.par_iter_mut().map_init(PathWave::default, of_tile);
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
        sink: &mut TileSink<'_>,
        wave: &mut PathWave<S>,
    ) -> WorkCounts {
        let Self { context, rays, .. } = self;
        let points = rays.points(context, sink.replicate, places);
        let mut work = WorkCounts::default();
        let all = rays.through(&context.world, places, &points, indices);
        for together in all.chunks(WAVE as usize) {
            let starts = together.iter().map(|ray| Start {
                from: ray.from,
                measurement: Measurement::Luminance { direction: ray.direction },
                maps: PathMaps {
                    end: None,
                    caustics: caustics.and_then(|caustics| caustics.map(sink.replicate)),
                },
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

    /// Estimates of the pixels of a block.
    fn pixels(&self, tile: &Tile) -> Vec<Pixel> {
        let BlockSums { sums, least_disc_m2 } = &tile.found;
        let own = sums.chunks_exact(self.replicates as usize).zip(least_disc_m2);
        own.map(|(own, disc_m2)| self.pixel(own, tile.samples, disc_m2.unwrap_or(0.0))).collect()
    }

    /// Estimate of a pixel from all replicates.
    fn pixel(&self, own: &[PixelSums], samples: u64, disc_m2: f64) -> Pixel {
        let means = own.iter().map(|sums| sums.mean::<S>(samples, self.quantum));
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

    /// The bound of the picture's mean, where no pixel has fewer paths: a path of one of m pixels
    /// adds an m-th.
    fn unseen_of_mean(&self, pixels: &[Pixel], samples: u64) -> Option<f64> {
        let Tracer::Bidirectional(tracer) = &self.tracer else { return None };
        let m = pixels.len() as f64;
        let of_pixels = pixels.iter().filter_map(|pixel| pixel.unseen_cd_m2).map(f64::from);
        let paths = samples as f64 * f64::from(self.replicates) * m;
        Some(tracer.unseen_cd_m2(paths, 0.0).min(of_pixels.sum::<f64>() / m))
    }
}
