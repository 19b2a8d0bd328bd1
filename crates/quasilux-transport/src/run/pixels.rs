//! The pixels of cameras: the mean luminance over each.
//!
//! `L_pixel` is the integral of `L(x, w(p))` over the places p of the pixel, a unit square of the
//! picture (box filter). Its paths start at the pinhole, through the place that their first two
//! coordinates give, and go on like the paths of sensors, but for the light that diffuse surfaces
//! send to each other: virtual lights stand for most of it (`photon/virtual_lights.rs`). With the
//! estimator `path` all are plain paths. Neither has a bias. Light that no path finds comes from
//! photon density.
//!
//! No sums are kept for a picture: a block of pixels is looked over (`path/sketch.rs`), traced in
//! all replicates, then summarised, and 24 bytes a pixel stay. `run/pictures.rs` says how many
//! paths a pixel gets; those where something ends, a surface or a shadow, get more.

use crate::context::{Context, Stream};
use crate::path::contribution::PathContribution;
use crate::path::sections::WorkCounts;
use crate::path::sketch::{Block, Sketch, SketchWork};
use crate::path::start::{Measurement, Start};
use crate::path::wave::{PathWave, WAVE};
use crate::photon::caustics::CausticMap;
use crate::photon::counts::PhotonCounts;
use crate::photon::virtual_lights::{Surfaces, VirtualLights};
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::Spectrum;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::picture::{CameraEstimates, Pixel};
use crate::stats::tally::{Quantum, Sum};
use crate::stats::watch::Watch;
use quasilux_sampling::{PointSet, Sampler};
use quasilux_scene::{Camera, View};
use rayon::prelude::*;
use std::sync::Arc;

/// Photons that leave a set of virtual lights.
pub(super) const PHOTONS: u64 = 1 << 11;
/// Sets of them in each replicate at most, one for each path of a pixel: there is memory for no
/// more. Passes with more paths have none: an error of sets that paths share would stay.
pub(super) const MAX_SETS: u64 = 16;
/// Paths between two words to the observer.
const ROUND: u64 = 1 << 17;
/// Pixels along the edge of a block.
const BLOCK: usize = 16;
/// A sample is one block in so many of each row, further right by so many from row to row.
const SAMPLE_STEP: usize = 8;
const SAMPLE_SLOPE: usize = 3;
/// Blocks of a round at least, so that all threads have work.
const MIN_BLOCKS: u64 = 24;
/// A pixel whose corners disagree has so many times the paths of others.
const ODD: u64 = 4;
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
    /// Where virtual lights may lie, if there are any.
    surfaces: Option<Surfaces>,
}

/// A picture, and how many contributions are not in it.
pub(super) struct Exposure {
    pub(super) figures: CameraEstimates,
    pub(super) invalid: u64,
}

/// What a pass is over.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    All,
    /// Some blocks, to see what the others will need.
    Sample,
}

/// Working space of a thread.
#[derive(Default)]
struct BlockWork<S: 'static> {
    wave: PathWave<S>,
    sketch: SketchWork,
}

/// A block before its paths are traced.
struct BlockSitting<'s> {
    /// Paths of a pixel that has no more than others.
    samples: u64,
    /// Numbers of its pixels in the picture.
    places: Vec<usize>,
    /// Paths of each pixel in each replicate.
    paths: Vec<u64>,
    sketch: Option<&'s Sketch>,
}

/// One path of one pixel of a block.
struct PathNumber {
    pixel: usize,
    path: u64,
}

/// The virtual lights of some photons.
struct Traced<S> {
    lights: VirtualLights<S>,
    counts: PhotonCounts,
}

/// The pixels of a block, all its paths traced.
struct Developed {
    pixels: Vec<Pixel>,
    /// Of each replicate, all pixels together.
    sums: Vec<PixelSums>,
    work: WorkCounts,
}

/// What the paths of one pixel in one replicate found, on average.
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
            surfaces: (settings.estimator != EstimatorKind::Path).then(|| Surfaces::new(context)),
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
    /// stopped them.
    pub(super) fn trace_caustics(
        &mut self,
        photons: u64,
        work: &mut WorkCounts,
        watch: &mut Watch<'_>,
    ) -> Option<()> {
        let Some(caustics) = &mut self.caustics else { return Some(()) };
        work.rays += caustics.grow(self.context, photons, watch)?;
        Some(())
    }

    /// Virtual lights by replicate, a set for each path of a pixel; none for plain paths.
    fn virtual_lights(&self, samples: u64, work: &mut WorkCounts) -> Vec<Vec<VirtualLights<S>>> {
        let Some(surfaces) = self.surfaces.filter(|_| samples <= MAX_SETS) else {
            return Vec::new();
        };
        let trace = |replicate: u32, set: u64| {
            let mut counts = PhotonCounts::default();
            let indices = set * PHOTONS..(set + 1) * PHOTONS;
            let lights =
                VirtualLights::trace(self.context, surfaces, replicate, indices, &mut counts);
            Traced { lights, counts }
        };
        let of_replicate = |replicate: u32| -> Vec<Traced<S>> {
            (0..samples).into_par_iter().map(|set| trace(replicate, set)).collect()
        };
        let traced = (0..self.replicates).map(of_replicate);
        let mut take = |Traced { lights, counts }: Traced<S>| {
            work.rays += counts.rays;
            work.endless += counts.endless;
            lights
        };
        traced.map(|of| of.into_iter().map(&mut take).collect()).collect()
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
        let lights = self.virtual_lights(samples, work);
        let blocks = self.blocks(part);
        let paths_a_block =
            samples.saturating_mul(u64::from(self.replicates) * (BLOCK * BLOCK) as u64);
        let round = (ROUND / paths_a_block).max(MIN_BLOCKS) as usize;
        let mut pixels = vec![Pixel::default(); self.pixels];
        let mut sums = vec![PixelSums::default(); self.replicates as usize];
        let mut done = 0;
        for round in blocks.chunks(round) {
            let taken: Vec<Developed> = round
                .par_iter()
                .map_init(BlockWork::default, |work, &block| {
                    self.trace(block, samples, &lights, work)
                })
                .collect();
            let before = (work.paths, work.rays);
            for (found, &block) in taken.into_iter().zip(round) {
                self.places(block).zip(found.pixels).for_each(|(place, own)| pixels[place] = own);
                sums.iter_mut().zip(found.sums).for_each(|(sum, found)| sum.merge(found));
                *work += found.work;
            }
            done += round.len();
            let (paths, rays) = (work.paths - before.0, work.rays - before.1);
            if !tick(paths, rays, done as f64 / blocks.len() as f64) && done < blocks.len() {
                return None;
            }
        }
        if let Part::Sample = part {
            let places = blocks.iter().flat_map(|&block| self.places(block));
            pixels = places.map(|place| pixels[place]).collect();
        }
        let n = pixels.len() as f64;
        let mean = |sums: &PixelSums| self.mean(sums).luminance() / n;
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

    /// How many blocks a picture has.
    pub(super) fn block_count(&self) -> usize {
        self.blocks(Part::All).len()
    }

    /// Whether virtual lights stand for the light that diffuse surfaces send.
    pub(super) fn has_virtual_lights(&self) -> bool {
        self.surfaces.is_some()
    }

    /// The blocks of the picture, row by row.
    fn blocks(&self, part: Part) -> Vec<Block> {
        let [width, height] = [self.width, self.pixels / self.width];
        let size = |first: usize, all: usize| (all - first).min(BLOCK) as u32;
        let firsts =
            (0..height).step_by(BLOCK).flat_map(|y| (0..width).step_by(BLOCK).map(move |x| [x, y]));
        let block = |[x, y]: [usize; 2]| Block {
            first: [x as u32, y as u32],
            size: [size(x, width), size(y, height)],
        };
        let is_in = |[x, y]: &[usize; 2]| match part {
            Part::All => true,
            Part::Sample => (x / BLOCK + SAMPLE_SLOPE * (y / BLOCK)).is_multiple_of(SAMPLE_STEP),
        };
        firsts.filter(is_in).map(block).collect()
    }

    /// Numbers of the pixels of a block.
    fn places(&self, block: Block) -> impl Iterator<Item = usize> {
        let Block { first: [x0, y0], size: [across, down] } = block;
        let width = self.width;
        let row = move |y: u32| (x0..x0 + across).map(move |x| y as usize * width + x as usize);
        (y0..y0 + down).flat_map(row)
    }

    /// Traces all paths of the pixels of a block and summarises each.
    fn trace(
        &self,
        block: Block,
        samples: u64,
        lights: &[Vec<VirtualLights<S>>],
        work: &mut BlockWork<S>,
    ) -> Developed {
        let sketch = (!lights.is_empty())
            .then(|| Sketch::new(self.context, &self.view, block, &mut work.sketch));
        let paths = |pixel: usize| match &sketch {
            Some(sketch) if !sketch.pixel(pixel).is_plain => samples.saturating_mul(ODD),
            _ => samples,
        };
        let places: Vec<usize> = self.places(block).collect();
        let sitting = BlockSitting {
            paths: (0..places.len()).map(paths).collect(),
            samples,
            places,
            sketch: sketch.as_ref(),
        };
        let mut counts = WorkCounts::default();
        counts.rays += sketch.as_ref().map_or(0, |sketch| sketch.rays);
        let replicates = self.replicates as usize;
        let mut sums = vec![PixelSums::default(); sitting.places.len() * replicates];
        for replicate in 0..replicates {
            let lights = lights.get(replicate).map_or(&[][..], Vec::as_slice);
            let own = self.trace_replicate(&sitting, replicate as u32, lights, work, &mut counts);
            let of_pixels = sums.iter_mut().skip(replicate).step_by(replicates);
            of_pixels.zip(own).for_each(|(sums, own)| *sums = own);
        }
        counts.rays += work.wave.take_rays();
        let mut of_replicates = vec![PixelSums::default(); replicates];
        for own in sums.chunks_exact(replicates) {
            of_replicates.iter_mut().zip(own).for_each(|(sum, own)| sum.merge(*own));
        }
        let pixels = sums.chunks_exact(replicates).map(|own| self.pixel(own)).collect();
        Developed { pixels, sums: of_replicates, work: counts }
    }

    /// The paths of the pixels of a block in one replicate.
    fn trace_replicate(
        &self,
        sitting: &BlockSitting<'_>,
        replicate: u32,
        lights: &[VirtualLights<S>],
        work: &mut BlockWork<S>,
        counts: &mut WorkCounts,
    ) -> Vec<PixelSums> {
        let BlockSitting { samples, places, paths, sketch } = sitting;
        let stream = |&pixel: &usize| Stream::Pixel { camera: self.number, pixel: pixel as u32 };
        let points: Vec<PointSet> =
            places.iter().map(|pixel| self.context.points(replicate, stream(pixel))).collect();
        let mut probed = Vec::with_capacity(lights.len());
        for (set, lights) in (0..).zip(lights) {
            let Some(sketch) = sketch else { break };
            // No path of the pixel has these coordinates.
            let u = Sampler::new(&points[0], set).child(1).next_1d();
            probed.push(sketch.probe(&self.context.world, lights, u, &mut work.sketch));
            counts.rays += work.sketch.rays();
        }
        let set = |pixel: usize, path: u64| (path / (paths[pixel] / samples)) as usize;
        let mut sums = vec![PixelSums::default(); places.len()];
        let mut numbers = (0..places.len())
            .flat_map(|pixel| (0..paths[pixel]).map(move |path| PathNumber { pixel, path }))
            .peekable();
        while numbers.peek().is_some() {
            let together: Vec<PathNumber> = numbers.by_ref().take(WAVE as usize).collect();
            let starts = together.iter().map(|&PathNumber { pixel, path }| Start {
                virtual_lights: probed.get(set(pixel, path)),
                pixel: sketch.map(|sketch| sketch.pixel(pixel)),
                ..self.start(places[pixel], replicate, &points[pixel], path)
            });
            for (number, mut ended) in together.iter().zip(work.wave.trace(self.context, starts)) {
                let ended = ended.end();
                sums[number.pixel].add(&ended.found, paths[number.pixel], self.quantum);
                counts.add(&ended);
            }
        }
        sums
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
            virtual_lights: None,
            pixel: None,
            from: self.context.world.ray_origin_of_sensor(self.view.position, direction),
            measurement: Measurement::Luminance { direction },
            map_end: None,
            daylight: None,
            sampler,
        }
    }

    /// What the replicates say together.
    fn pixel(&self, own: &[PixelSums]) -> Pixel {
        let means = own.iter().map(|sums| self.mean(sums));
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

    fn mean(&self, sums: &PixelSums) -> S {
        S::from_channels(|channel| self.quantum.value(sums.channels[channel]))
    }
}

impl PixelSums {
    /// Adds what one of so many paths found; what virtual lights are corrected by may be negative.
    fn add<S: Spectrum>(&mut self, found: &PathContribution<S>, paths: u64, quantum: Quantum) {
        let light = (found.direct + found.indirect) * (1.0 / paths as f64);
        for (c, channel) in self.channels.iter_mut().enumerate().take(S::CHANNELS) {
            channel.add_signed(light.channel(c), quantum);
        }
        self.reflected += u64::from(found.reflected);
    }

    fn is_zero(&self) -> bool {
        self.channels.iter().all(Sum::is_zero)
    }

    fn merge(&mut self, other: Self) {
        self.channels.iter_mut().zip(other.channels).for_each(|(sum, other)| *sum += other);
        self.reflected += other.reflected;
    }
}
