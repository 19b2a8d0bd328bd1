//! Light path classes in the sense of Heckbert's notation: how a photon came since its light, as
//! path tracing sees it.

use crate::bsdf::Bsdf;
use crate::lights::images::SpecularImages;
use crate::spectrum::Spectrum;

/// The way of a photon since its light, as those who gather see it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LightPathClass {
    /// By mirrors that show this image of its point-like light; at first the light itself.
    Shown(u32),
    /// From a luminous shape, straight or through panes: paths see it.
    Straight,
    /// From outside, straight or through panes: paths ask for it, or find it past these.
    Outside,
    /// From a light that nothing runs into, by specular surfaces alone, and in no image: paths
    /// cannot find it.
    Caustic,
    /// Any other: paths find it where it was scattered last, or run into its light.
    Found,
}

impl LightPathClass {
    /// The class after one more surface: `bsdf` on `facet`; `mirrored` where the photon stays on
    /// its side.
    pub(crate) fn after<S: Spectrum>(
        self,
        images: &SpecularImages,
        bsdf: &Bsdf<S>,
        facet: u32,
        mirrored: bool,
    ) -> Self {
        if self == Self::Found || !bsdf.is_specular() {
            return Self::Found;
        }
        match self {
            _ if !mirrored && bsdf.straight_transmittance(1.0).is_some() => self,
            Self::Shown(image) if mirrored => {
                images.shown_by(image, facet).map_or(Self::Caustic, Self::Shown)
            }
            Self::Outside => Self::Found,
            _ => Self::Caustic,
        }
    }
}
