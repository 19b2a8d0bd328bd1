//! How subpaths leave a surface, eye paths and light subpaths alike: whether they survive, what
//! they carry, and where they go.

use crate::bsdf::BsdfSample;
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use crate::world::{Interaction, RayOrigin, World};
use glam::DVec3;
use quasilux_sampling::Sampler;

/// A subpath that goes on from a surface.
pub(super) struct Departure<S> {
    pub(super) from: RayOrigin,
    /// Unit vector.
    pub(super) direction: DVec3,
    /// Factor on what it carries.
    pub(super) factor: S,
}

impl<S: Spectrum> Departure<S> {
    /// Survives with the weight of its new direction as the probability, or 1 where that is more:
    /// what goes on then never carries more than before in its strongest channel, but where
    /// surfaces give more than they get. `None` where it ends, or its weight is NaN.
    pub(super) fn survive(
        world: &World<S>,
        at: &Interaction,
        frame: &Frame,
        next: &BsdfSample<S>,
        favour: f64,
        sampler: &mut Sampler<'_>,
    ) -> Option<Self> {
        let survival = (favour * next.weight.max_channel()).min(1.0);
        let survives = survival > 0.0 && sampler.choose_bool(survival);
        let is_above = next.wi.z > 0.0;
        survives.then(|| Self {
            from: if is_above { world.ray_origin(at) } else { world.ray_origin_behind(at) },
            direction: frame.to_world(next.wi),
            factor: next.weight * survival.recip(),
        })
    }
}
