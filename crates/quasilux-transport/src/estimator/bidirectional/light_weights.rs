//! Weights of the techniques that leave vertices of a light subpath to eye paths.
//!
//! An eye path favours its first vertices ([`favour`]), so its weight there depends on the number
//! that a vertex has in it: a light subpath, which does not know how far it is to the target, keeps
//! the sums for each number that there may be.

use super::leading::Led;
use super::plan::{FAVOURED, favour};
use super::subpath_weights::SubpathWeights;
use crate::bsdf::Bsdf;
use crate::spectrum::Spectrum;
use glam::DVec3;

/// Of a vertex of a light subpath: by how many of the vertices behind it, toward the light, an eye
/// path favours.
#[derive(Clone, Copy, Default)]
pub(super) struct LightWeights([SubpathWeights; FAVOURED + 1]);

impl From<SubpathWeights> for LightWeights {
    /// Where nothing is behind but a light.
    fn from(weights: SubpathWeights) -> Self {
        Self([weights; FAVOURED + 1])
    }
}

impl LightWeights {
    /// Of a vertex that has this number in an eye path: 0 is the target.
    pub(super) fn numbered(&self, number: usize) -> SubpathWeights {
        self.0[FAVOURED.saturating_sub(number)]
    }

    pub(super) fn map(self, change: impl Fn(SubpathWeights) -> SubpathWeights) -> Self {
        Self(self.0.map(change))
    }

    /// After it was scattered along `wi`, having come from `wo`, where some eye paths are led, in
    /// this many copies on average.
    pub(super) fn scattered<S: Spectrum>(
        &self,
        bsdf: &Bsdf<S>,
        [wo, wi]: [DVec3; 2],
        led: Led,
        copies: f64,
    ) -> Self {
        let pdf_sr = copies * bsdf.survival_pdf_sr(wo, wi, 1.0);
        let [other_sr, favoured_sr] =
            [1.0, favour(FAVOURED)].map(|favour| led.survival_pdf_sr(bsdf, wi, wo, favour));
        self.followed(|before, is_favoured| {
            let reverse_pdf_sr = if is_favoured { favoured_sr } else { other_sr };
            before.scattered(wi.z.abs(), pdf_sr, reverse_pdf_sr)
        })
    }

    /// After one of finitely many directions was taken: [`SubpathWeights::mirrored`].
    pub(super) fn mirrored(&self, cos: f64, scale: f64) -> Self {
        self.followed(|before, _| before.mirrored(cos, scale))
    }

    /// Of the next vertex, by what this one weighed, and whether eye paths favour this one.
    fn followed(&self, next: impl Fn(SubpathWeights, bool) -> SubpathWeights) -> Self {
        let of_number = |favoured: usize| match favoured {
            0 => next(self.0[0], false),
            _ => next(self.0[favoured - 1], true),
        };
        Self(std::array::from_fn(of_number))
    }
}
