//! A unit of the work: some pixels, in one replicate, with a few indices that follow each other.

use super::camera_paths::CameraPath;
use super::discs::Discs;
use super::light::{PictureLight, SUBPATHS};
use super::receivers::SeenPlace;
use super::{DVec3, PixelSink, PixelTracer, Spectrum, World};
use crate::context::Stream;
use crate::estimator::bidirectional::eye_path::{EyePaths, Sink, Start};
use crate::estimator::bidirectional::joins::{JoinWork, Joiner};
use crate::estimator::bidirectional::plan::connected;
use crate::path::sections::WorkCounts;
use crate::path::wave::WAVE;
use crate::world::vertex::{Surface, Vertex};
use quasilux_sampling::{PointSet, Sampler};
use quasilux_scene::View;

/// Joins of a light subpath to what a path sees, on average.
const JOINED: f64 = 0.125;
/// The child of a path's coordinates that chooses its joins.
const JOINS: u32 = 1;
/// Paths whose shadow rays of joins are traced together.
const ASKED_TOGETHER: usize = 64;

/// Some pixels of a camera with some indices in one replicate.
pub(crate) struct PixelUnit<'u, S> {
    /// Number of the camera.
    pub(crate) camera: u32,
    pub(crate) view: &'u View,
    /// Pixels in a row of the picture.
    pub(crate) width: usize,
    /// Numbers of the pixels in the picture.
    pub(crate) pixels: &'u [usize],
    pub(crate) replicate: u32,
    /// In m^2: a join is made for certain where cosines over squared distance are one over it.
    pub(crate) per_sure_m2: f64,
    /// Of its indices.
    pub(crate) light: &'u PictureLight<S>,
}

impl<S: Spectrum> PixelUnit<'_, S> {
    /// Paths through the places of the pixels that their first two coordinates give.
    fn camera_paths<'p>(&self, world: &World<S>, points: &'p [PointSet]) -> Vec<CameraPath<'p, S>> {
        let path = |(section, index): (usize, u64)| {
            let mut sampler = Sampler::new(&points[section], index);
            let [u, v] = sampler.next_2d();
            let pixel = self.pixels[section];
            let (x, y) = ((pixel % self.width) as f64, (pixel / self.width) as f64);
            let direction = self.view.direction([x + u, y + v]);
            let from = world.ray_origin_of_sensor(self.view.position, direction);
            CameraPath::new(section, index, sampler, from, direction)
        };
        let sections = 0..self.pixels.len();
        sections
            .flat_map(|it| self.light.indices.clone().map(move |index| (it, index)))
            .map(path)
            .collect()
    }
}

impl<S: Spectrum> PixelTracer<'_, S> {
    /// In m^2: how often light vertices are joined near what these directions see from a place; a
    /// function of the pixels alone.
    pub(crate) fn per_sure_m2(&self, from: DVec3, directions: &[DVec3]) -> f64 {
        let world = &self.engine.context.world;
        let rates: Vec<f64> = directions
            .iter()
            .filter_map(|direction| {
                let at = world.trace(world.ray_origin_of_sensor(from, *direction), *direction)?;
                self.pilots.rate(world.ray_origin(&at).position(), at.n, JOINED)
            })
            .collect();
        match rates.len() {
            0 => self.open.per_sure_m2,
            count => rates.iter().sum::<f64>() / count as f64,
        }
    }

    /// Traces all paths of a unit.
    pub(crate) fn trace(
        &self,
        unit: &PixelUnit<'_, S>,
        mut found: &mut dyn PixelSink<S>,
    ) -> WorkCounts {
        let context = self.engine.context;
        let mut work = WorkCounts::default();
        let stream = |pixel: usize| Stream::Pixel { camera: unit.camera, pixel: pixel as u32 };
        let points: Vec<PointSet> =
            unit.pixels.iter().map(|it| context.points(unit.replicate, stream(*it))).collect();
        let starts = unit.camera_paths(&context.world, &points);
        let seen = CameraPath::trace_all(&self.engine, starts, &mut found, &mut work);
        let places = self.places(unit.per_sure_m2, seen, &mut work);
        for SeenPlace { seen, receiver } in &places {
            found.arrive(seen.section, receiver.area_m2);
        }
        if self.merges {
            for (index, flights) in unit.light.indices.clone().zip(&unit.light.flights) {
                let own = places.iter().filter(|it| it.seen.index == index);
                Discs::new(&self.engine, own).cross_all(&self.engine, flights, &mut found);
            }
        }
        work.rays += self.join(unit, &places, &mut found);
        work += self.gather(unit, &places, &mut found);
        work
    }

    /// Joins light vertices to what is seen; the number of rays.
    fn join(
        &self,
        unit: &PixelUnit<'_, S>,
        places: &[SeenPlace<'_, S>],
        found: &mut dyn Sink<S>,
    ) -> u64 {
        let context = self.engine.context;
        let world = &context.world;
        let mut work = JoinWork::default();
        for (number, SeenPlace { seen, receiver }) in places.iter().enumerate() {
            let first = &seen.surface;
            let left = context.max_bounces.map_or(u32::MAX, |most| most - first.bounces - 1);
            let surface = &Surface::new(world, &first.at, first.direction);
            let mut joiner = Joiner {
                receiver,
                vertex: Vertex::on(world, &first.at, surface, first.beta),
                max_bounces: left,
                next: seen.sampler.child(JOINS).next_1d(),
            };
            work.shadows.max_bounces = left;
            let place = (seen.index - unit.light.indices.start) as usize * SUBPATHS as usize;
            let light = &unit.light.subpaths;
            let numbers = light.numbers_of(place..place + SUBPATHS as usize);
            joiner.join(&self.engine, seen.section as u32, light, numbers, &mut work);
            let asked = number + 1;
            if asked % ASKED_TOGETHER == 0 || asked == places.len() {
                work.shadows.answer(world, |who, light: S, bounces| {
                    found.add(who as usize, bounces, light);
                });
            }
        }
        work.shadows.rays
    }

    /// Traces the eye paths on from what is seen.
    fn gather(
        &self,
        unit: &PixelUnit<'_, S>,
        places: &[SeenPlace<'_, S>],
        found: &mut dyn Sink<S>,
    ) -> WorkCounts {
        let mut paths = EyePaths::default();
        for places in places.chunks(WAVE as usize) {
            let starts = places.iter().map(|SeenPlace { seen, receiver }| {
                let place = seen.index - unit.light.indices.start;
                let pixel = unit.pixels[seen.section];
                Start {
                    section: seen.section,
                    receiver,
                    light: &unit.light.subpaths,
                    subpath: (place * SUBPATHS + connected(pixel, seen.index, SUBPATHS)) as usize,
                    sampler: seen.sampler.clone(),
                    surface: Some(&seen.surface),
                }
            });
            paths.trace(&self.engine, starts, found);
        }
        paths.work
    }
}
