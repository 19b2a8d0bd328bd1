//! Rays from the pinhole of a camera through its pixels, where paths of pixels start.

use crate::context::{Context, Stream};
use crate::spectrum::Spectrum;
use crate::world::{RayOrigin, World};
use glam::DVec3;
use quasilux_sampling::{PointSet, Sampler};
use quasilux_scene::View;
use std::ops::Range;

/// Rays through the pixels of one camera.
pub(crate) struct PixelRays {
    /// Number of the camera.
    pub(crate) camera: u32,
    pub(crate) view: View,
    /// Pixels in a row of the picture.
    pub(crate) width: usize,
}

/// A ray through a place of a pixel.
pub(crate) struct PixelRay<'p> {
    /// Number of its pixel among those that were asked for.
    pub(crate) section: usize,
    pub(crate) index: u64,
    /// Past the coordinates of the place.
    pub(crate) sampler: Sampler<'p>,
    pub(crate) from: RayOrigin,
    /// Unit vector.
    pub(crate) direction: DVec3,
}

impl PixelRays {
    /// The points of pixels, by their numbers in the picture, in a replicate.
    pub(crate) fn points<S: Spectrum>(
        &self,
        context: &Context<'_, S>,
        replicate: u32,
        pixels: &[usize],
    ) -> Vec<PointSet> {
        let stream = |pixel: usize| Stream::Pixel { camera: self.camera, pixel: pixel as u32 };
        pixels.iter().map(|pixel| context.points(replicate, stream(*pixel))).collect()
    }

    /// All rays of pixels with these indices, pixel by pixel, through the places that their first
    /// two coordinates give; `points` are those of the pixels.
    pub(crate) fn through<'p, S: Spectrum>(
        &self,
        world: &World<S>,
        pixels: &[usize],
        points: &'p [PointSet],
        indices: Range<u64>,
    ) -> Vec<PixelRay<'p>> {
        let ray = |section: usize, index: u64| {
            let mut sampler = Sampler::new(&points[section], index);
            let [u, v] = sampler.next_2d();
            let pixel = pixels[section];
            let (x, y) = ((pixel % self.width) as f64, (pixel / self.width) as f64);
            let direction = self.view.direction([x + u, y + v]);
            let from = world.ray_origin_of_sensor(self.view.position, direction);
            PixelRay { section, index, sampler, from, direction }
        };
        let of_pixel = |section: usize| indices.clone().map(move |index| ray(section, index));
        (0..pixels.len()).flat_map(of_pixel).collect()
    }
}
