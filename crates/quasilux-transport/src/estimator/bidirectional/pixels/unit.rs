//! A unit of the work: some pixels, in one replicate, with a few indices that follow each other.

use super::camera_paths::CameraPath;
use super::discs::Discs;
use super::light::{PictureLight, SUBPATHS};
use super::receivers::SeenPlace;
use super::{DVec3, PixelSink, PixelTracer, Spectrum};
use crate::estimator::bidirectional::eye_path::{EyePaths, Sink, Start};
use crate::estimator::bidirectional::joins::{JoinWork, Joiner};
use crate::estimator::bidirectional::plan::connected;
use crate::path::path_batch::WorkCounts;
use crate::path::pixel_rays::PixelRays;
use crate::path::wave::WAVE;
use crate::world::vertex::{Surface, Vertex};

/// Joins of a light subpath to what a path sees, on average.
const JOINED: f64 = 0.125;
/// The child of a path's coordinates that chooses its joins.
const JOINS: u32 = 1;
/// Paths whose shadow rays of joins are traced together.
const ASKED_TOGETHER: usize = 64;

/// Some pixels of a camera with some indices in one replicate.
pub(crate) struct PixelUnit<'u, S> {
    pub(crate) rays: &'u PixelRays,
    /// Numbers of the pixels in the picture.
    pub(crate) pixels: &'u [usize],
    pub(crate) replicate: u32,
    /// In m^2: a join is made for certain where cosines over squared distance are one over it.
    pub(crate) per_sure_m2: f64,
    /// Of its indices.
    pub(crate) light: &'u PictureLight<S>,
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
        found: &mut impl PixelSink<S>,
    ) -> WorkCounts {
        let context = self.engine.context;
        let mut work = WorkCounts::default();
        let PixelUnit { rays, pixels, replicate, light, .. } = unit;
        let points = rays.points(context, *replicate, pixels);
        let rays = rays.through(&context.world, pixels, &points, light.indices.clone());
        let starts = rays.into_iter().map(CameraPath::new).collect();
        let seen = CameraPath::trace_all(&self.engine, starts, found, &mut work);
        let places = self.places(unit.per_sure_m2, seen, &mut work);
        for SeenPlace { seen, receiver } in &places {
            found.arrive(seen.section, receiver.area_m2);
        }
        if self.merges {
            for (index, flights) in light.indices.clone().zip(&light.flights) {
                let own = places.iter().filter(|it| it.seen.index == index);
                Discs::new(&self.engine, own).cross_all(&self.engine, flights, found);
            }
        }
        work.rays += self.join(light, &places, found);
        work += self.gather(unit, &places, found);
        work
    }

    /// Joins light vertices to what is seen; the number of rays.
    fn join(
        &self,
        light: &PictureLight<S>,
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
            let vertex = Vertex::on(world, &first.at, surface, first.beta);
            let mut joiner = Joiner {
                receiver,
                way_out: self.engine.way_out_of_start(receiver, &vertex),
                vertex,
                max_bounces: left,
                next: seen.sampler.child(JOINS).next_1d(),
            };
            work.shadows.max_bounces = left;
            let first = light.first_of(seen.index);
            let numbers = light.subpaths.numbers_of(first..first + SUBPATHS as usize);
            let who = seen.section as u32;
            joiner.join(&self.engine, who, &light.subpaths, numbers, &mut work);
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
                let pixel = unit.pixels[seen.section];
                let own = connected(pixel, seen.index, SUBPATHS) as usize;
                Start {
                    section: seen.section,
                    receiver,
                    light: &unit.light.subpaths,
                    subpath: unit.light.first_of(seen.index) + own,
                    sampler: seen.sampler.clone(),
                    surface: Some(&seen.surface),
                }
            });
            paths.trace(&self.engine, starts, found);
        }
        paths.work
    }
}
