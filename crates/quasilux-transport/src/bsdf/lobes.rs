//! Discrete choice between the two lobes of a BSDF.

use glam::DVec3;
use quasilux_sampling::Sampler;

/// How often directions come from the sharp lobe.
///
/// Both lobes share one density, their mean by probability, so that the weight of a direction does
/// not depend on which lobe proposed it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lobes {
    sharp: f64,
}

impl Lobes {
    /// Chosen by the shares of light that go into each.
    pub(super) fn new(sharp: f64, broad: f64) -> Self {
        let sum = sharp + broad;
        Self { sharp: if sum > 0.0 { sharp / sum } else { 0.0 } }
    }

    /// A direction above the surface; `None` where the sharp lobe points below it.
    pub(super) fn sample(
        self,
        sampler: &mut Sampler<'_>,
        sharp: impl FnOnce([f64; 2]) -> DVec3,
        broad: impl FnOnce([f64; 2]) -> DVec3,
    ) -> Option<DVec3> {
        let is_sharp = sampler.choose_bool(self.sharp);
        let u = [sampler.remapped_1d(), sampler.next_1d()];
        let wi = if is_sharp { sharp(u) } else { broad(u) };
        (wi.z > 0.0).then_some(wi)
    }

    /// Density of [`Self::sample`] where those of both lobes are given, in the same measure.
    pub(super) fn pdf(self, sharp: f64, broad: f64) -> f64 {
        self.sharp * sharp + (1.0 - self.sharp) * broad
    }
}
