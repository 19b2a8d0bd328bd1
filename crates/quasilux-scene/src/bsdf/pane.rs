//! Flat panes: windows, glass partitions.

use super::{AngularNode, AngularTable};
use crate::Rgb;

/// A flat pane drawn as a single sheet, both sides alike: light goes straight through or is
/// mirrored.
#[derive(Clone, Debug, PartialEq)]
pub enum Pane {
    /// Clear: both boundaries reflect, and light goes to and fro between them.
    Clear {
        /// Refractive index; not 1.
        eta: f64,
    },
    /// As clear, but that at all angles less is let through.
    Tinted {
        /// Refractive index; not 1.
        eta: f64,
        /// Transmitted over incident flux at normal incidence, each channel from 0 to that of a
        /// clear pane.
        transmittance: Rgb,
    },
    /// Measured by angle, both at most 1 together.
    Measured {
        /// Transmitted over incident flux.
        transmittance: AngularTable,
        /// Reflected over incident flux.
        reflectance: AngularTable,
    },
}

impl Pane {
    /// As [`super::Bsdf::most_kept`].
    pub(super) fn most_kept(&self) -> Rgb {
        match self {
            Self::Clear { .. } => Rgb::WHITE,
            Self::Tinted { eta, transmittance } => {
                *transmittance * (1.0 / Self::clear_transmittance(*eta))
            }
            Self::Measured { transmittance, reflectance } => {
                let sum = |node: &AngularNode| node.share + reflectance.at_angle(node.theta_rad);
                Rgb::grey(transmittance.nodes().iter().map(sum).fold(1.0, f64::min))
            }
        }
    }

    /// What a clear pane of this index lets through at normal incidence: `2 eta / (eta^2 + 1)`,
    /// from `(1 - r) / (1 + r)` with `r = ((eta - 1) / (eta + 1))^2` at each boundary.
    #[must_use]
    pub fn clear_transmittance(eta: f64) -> f64 {
        2.0 * eta / (eta * eta + 1.0)
    }
}
