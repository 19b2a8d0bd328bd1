//! The rays of a group as a structure of arrays, eight to a vector.

use crate::RayQuery;
use crate::frame::Frame;
use crate::lanes::Lanes;
use crate::node::WIDTH;
use glam::DVec3;

/// Rays of a group.
pub(crate) const MAX_GROUP: usize = 128;

/// Vectors of rays.
pub(crate) const VECTORS: usize = MAX_GROUP / WIDTH;

/// A number of each ray.
pub(crate) type ByRay<T> = [[T; WIDTH]; VECTORS];

/// The rays of a group in the frame.
#[repr(C, align(32))]
pub(crate) struct Rays {
    pub(crate) origin: [ByRay<f32>; 3],
    pub(crate) direction: [ByRay<f32>; 3],
    /// Where each ray ends; minus infinity where there is none, or it wants no more.
    pub(crate) end: ByRay<f32>,
    /// Triangles that do not count.
    excluded: [ByRay<u32>; 2],
    excludes: bool,
    /// How many vectors have rays.
    pub(crate) vectors: usize,
    /// A bit for each ray of a vector.
    pub(crate) active: [u32; VECTORS],
    /// Whether all rays start at the same point.
    pub(crate) one_origin: bool,
}

impl Rays {
    pub(crate) fn new() -> Self {
        Self {
            origin: [[[0.0; WIDTH]; VECTORS]; 3],
            direction: [[[0.0; WIDTH]; VECTORS]; 3],
            end: [[0.0; WIDTH]; VECTORS],
            excluded: [[[0; WIDTH]; VECTORS]; 2],
            excludes: false,
            vectors: 0,
            active: [0; VECTORS],
            one_origin: false,
        }
    }

    /// Takes in the rays of a run.
    #[inline(always)]
    pub(crate) fn fill(&mut self, frame: &Frame, shots: &[RayQuery]) {
        debug_assert!(!shots.is_empty() && shots.len() <= MAX_GROUP);
        self.vectors = shots.len().div_ceil(WIDTH);
        self.excludes = false;
        self.one_origin = true;
        let first = shots[0].ray.origin;
        let origin = frame.point(first).as_vec3a().to_array();
        for (shots, k) in shots.chunks(WIDTH).zip(0..VECTORS) {
            self.active[k] = u32::MAX >> (32 - shots.len());
            for lane in 0..WIDTH {
                let shot = &shots[lane.min(shots.len() - 1)];
                let direction: DVec3 = shot.ray.direction;
                self.direction[0][k][lane] = direction.x as f32;
                self.direction[1][k][lane] = direction.y as f32;
                self.direction[2][k][lane] = direction.z as f32;
                let end = frame.end(0.0, shot.ray.t_max);
                let is_there = lane < shots.len() && end >= 0.0;
                self.end[k][lane] = if is_there { end } else { f32::NEG_INFINITY };
                self.excluded[0][k][lane] = shot.excluded[0];
                self.excluded[1][k][lane] = shot.excluded[1];
                self.excludes |= shot.excluded != [RayQuery::NONE; 2];
                self.one_origin &= shot.ray.origin == first;
            }
            for (by_ray, x) in self.origin.iter_mut().zip(origin) {
                by_ray[k] = [x; WIDTH];
            }
        }
        if !self.one_origin {
            self.fill_origins(frame, shots);
        }
    }

    #[inline(never)]
    fn fill_origins(&mut self, frame: &Frame, shots: &[RayQuery]) {
        for i in 0..self.vectors * WIDTH {
            let origin = frame.point(shots[i.min(shots.len() - 1)].ray.origin).as_vec3a();
            for (by_ray, x) in self.origin.iter_mut().zip(origin.to_array()) {
                by_ray[i / WIDTH][i % WIDTH] = x;
            }
        }
    }

    /// A bit for each ray of a vector that is there and for which the triangle counts.
    #[inline(always)]
    pub(crate) fn counted<L: Lanes>(&self, k: usize, triangle: u32) -> u32 {
        let counted = self.active[k];
        if !self.excludes {
            return counted;
        }
        let [one, other] = &self.excluded;
        counted & L::differ(&one[k], [triangle; 3]) & L::differ(&other[k], [triangle; 3])
    }

    #[inline(always)]
    pub(crate) fn direction<L: Lanes>(&self, k: usize) -> [L; 3] {
        let [x, y, z] = &self.direction;
        [L::load(&x[k]), L::load(&y[k]), L::load(&z[k])]
    }

    #[inline(always)]
    pub(crate) fn origin<L: Lanes>(&self, k: usize) -> [L; 3] {
        let [x, y, z] = &self.origin;
        [L::load(&x[k]), L::load(&y[k]), L::load(&z[k])]
    }

    /// Where the first ray starts, in all lanes.
    #[inline(always)]
    pub(crate) fn first_origin<L: Lanes>(&self) -> [L; 3] {
        let [x, y, z] = &self.origin;
        [L::splat(x[0][0]), L::splat(y[0][0]), L::splat(z[0][0])]
    }
}
