//! Light that serves all pixels: the subpaths of some indices, and photons that come from narrow
//! surfaces.

use super::{PixelTracer, Spectrum};
use crate::context::Stream;
use crate::estimator::bidirectional::light_subpath::{KeptFlight, LightSubpaths};
use crate::estimator::bidirectional::partner::partners;
use crate::path::path_batch::WorkCounts;
use quasilux_sampling::Sampler;
use std::ops::Range;

/// Light subpaths of an index. Pixels have few indices, so they need more in each than sensor
/// points: with 32 the half-width of the office was 1.3 times as large, at 0.8 of the time.
pub(super) const SUBPATHS: u64 = 128;
/// Photons of an index of which those count that come from narrow surfaces: by the number of the
/// pixels that they serve, so that they take a part of the time.
const MIN_PHOTONS: u64 = 1 << 11;
pub(crate) const MAX_PHOTONS: u64 = 1 << 13;
const PIXELS_A_PHOTON: usize = 16;

/// Photons of an index for a picture of this many pixels.
pub(super) fn photons(pixels: usize) -> u64 {
    let wanted = (pixels / PIXELS_A_PHOTON).next_power_of_two() as u64;
    wanted.clamp(MIN_PHOTONS, MAX_PHOTONS)
}

/// Of some indices in one replicate.
pub(crate) struct PictureLight<S> {
    pub(super) indices: Range<u64>,
    pub(super) subpaths: LightSubpaths<S>,
    /// Of each index, the flights that count where they cross the discs of pixels.
    pub(super) flights: Vec<Vec<KeptFlight<S>>>,
    pub(crate) work: WorkCounts,
}

impl<S> PictureLight<S> {
    /// The first subpath of an index, among those of all.
    pub(super) fn first_of(&self, index: u64) -> usize {
        ((index - self.indices.start) * SUBPATHS) as usize
    }
}

impl<S: Spectrum> PixelTracer<'_, S> {
    /// Traces the light of some indices.
    pub(crate) fn light(&self, replicate: u32, indices: Range<u64>) -> PictureLight<S> {
        let Self { engine, merges, .. } = self;
        let mut flights: Vec<Vec<KeptFlight<S>>> = indices.clone().map(|_| Vec::new()).collect();
        let points = engine.context.points(replicate, Stream::PictureSubpaths);
        let samplers = partners(&points, indices.clone(), SUBPATHS);
        let subpaths = LightSubpaths::trace(engine, samplers, |passing| {
            if *merges && !passing.is_computed_at_points() && !passing.is_hardly_found(engine) {
                flights[passing.number / SUBPATHS as usize].push(KeptFlight::new(passing));
            }
        });
        let (rays, endless) = (subpaths.rays, subpaths.endless);
        let mut work = WorkCounts { rays, endless, ..WorkCounts::default() };
        if *merges {
            let points = engine.context.points(replicate, Stream::PicturePhotons);
            let each = self.open.photons;
            let numbers = indices.start * each..indices.end * each;
            let samplers = numbers.map(|index| Sampler::new(&points, index));
            let photons = LightSubpaths::trace(engine, samplers, |passing| {
                if !passing.is_computed_at_points() && passing.is_hardly_found(engine) {
                    flights[passing.number / each as usize].push(KeptFlight::new(passing));
                }
            });
            work.rays += photons.rays;
            work.endless += photons.endless;
        }
        PictureLight { indices, subpaths, flights, work }
    }
}
