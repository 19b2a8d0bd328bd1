//! A flat pane drawn as a single sheet: light goes straight through or is mirrored.
//!
//! A clear pane has two boundaries of reflectance r each, and light goes to and fro between them. For
//! each polarisation the series gives `R = 2 r / (1 + r)` reflected and `T = (1 - r) / (1 + r)` let
//! through (Stokes 1862, without absorption); unpolarised light has the mean of both. A stated
//! transmittance scales T at all angles; a measured pane has tables by angle instead. Both sides are
//! alike, and as the index is the same before and behind, radiance is not scaled.

use super::BsdfSample;
use super::fresnel::Boundary;
use crate::spectrum::Spectrum;
use glam::DVec3;
use quasilux_sampling::SampleCursor;
use quasilux_scene::bsdf::{self as scene, AngularTable};

/// A flat pane of no thickness.
#[derive(Clone, Debug)]
pub(crate) enum Pane<S> {
    /// Fresnel's boundaries, with T scaled by `tint`.
    Glass { eta: f64, tint: S },
    /// Tables by angle.
    Measured { transmittance: AngularTable, reflectance: AngularTable },
}

impl<S: Spectrum> Pane<S> {
    pub(super) fn new(pane: &scene::Pane) -> Self {
        match pane {
            scene::Pane::Clear { eta } => Self::Glass { eta: *eta, tint: S::white() },
            scene::Pane::Tinted { eta, transmittance } => {
                let tint =
                    S::from_rgb(*transmittance) * (1.0 / scene::Pane::clear_transmittance(*eta));
                Self::Glass { eta: *eta, tint }
            }
            scene::Pane::Measured { transmittance, reflectance } => Self::Measured {
                transmittance: transmittance.clone(),
                reflectance: reflectance.clone(),
            },
        }
    }

    /// The share of light that goes straight through, at an angle of cosine `cos` to the normal.
    pub(crate) fn pane_transmittance(&self, cos: f64) -> S {
        match self {
            Self::Glass { eta, tint } => *tint * (1.0 - clear_reflectance(cos, *eta)),
            Self::Measured { transmittance, .. } => S::white() * transmittance.at(cos),
        }
    }

    /// The share that is mirrored.
    pub(crate) fn pane_reflectance(&self, cos: f64) -> S {
        S::white()
            * match self {
                Self::Glass { eta, .. } => clear_reflectance(cos, *eta),
                Self::Measured { reflectance, .. } => reflectance.at(cos),
            }
    }

    pub(super) fn albedo(&self, wo: DVec3) -> S {
        self.pane_reflectance(wo.z) + self.pane_transmittance(wo.z)
    }

    pub(super) fn sample(&self, wo: DVec3, cursor: &mut SampleCursor<'_>) -> Option<BsdfSample<S>> {
        let (mirrored, straight) = (self.pane_reflectance(wo.z), self.pane_transmittance(wo.z));
        let sum = mirrored.luminance() + straight.luminance();
        if sum <= 0.0 {
            return None;
        }
        let p_mirrored = mirrored.luminance() / sum;
        let (wi, share, p) = if cursor.choose_bool(p_mirrored) {
            (DVec3::new(-wo.x, -wo.y, wo.z), mirrored, p_mirrored)
        } else {
            (-wo, straight, 1.0 - p_mirrored)
        };
        Some(BsdfSample { wi, weight: share * (1.0 / p), pdf_sr: None })
    }
}

/// Unpolarised light that a clear pane mirrors, all inner reflections included.
fn clear_reflectance(cos: f64, eta: f64) -> f64 {
    let boundary = Boundary::new(cos, eta);
    boundary.across / (1.0 + boundary.across) + boundary.within / (1.0 + boundary.within)
}
