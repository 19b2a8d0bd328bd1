//! Flat panes: windows, glass partitions.

use super::{AngularNode, AngularTable};
use crate::Rgb;
use quasilux_bsdf::{Glazing, SheetShares};
use std::f64::consts::FRAC_PI_2;

/// Steps of the tables of a glazing, from the normal to the horizon.
const STEPS: u32 = 180;

/// A flat pane drawn as a single sheet: light goes straight through or is mirrored.
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
    /// Measured by angle, transmittance and reflectance of each side at most 1 together.
    Measured {
        /// Transmitted over incident flux, the same from both sides.
        transmittance: AngularTable,
        /// Reflected over incident flux, for light that comes from the front of the facet.
        front_reflectance: AngularTable,
        /// For light that comes from the back.
        back_reflectance: AngularTable,
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
            Self::Measured { transmittance, front_reflectance, back_reflectance } => {
                let reflected = |theta_rad| {
                    front_reflectance.at_angle(theta_rad).max(back_reflectance.at_angle(theta_rad))
                };
                let sum = |node: &AngularNode| node.share + reflected(node.theta_rad);
                Rgb::grey(transmittance.nodes().iter().map(sum).fold(1.0, f64::min))
            }
        }
    }

    /// A pane of which angles were measured, both sides alike.
    #[must_use]
    pub fn measured(transmittance: AngularTable, reflectance: AngularTable) -> Self {
        let front_reflectance = reflectance.clone();
        Self::Measured { transmittance, front_reflectance, back_reflectance: reflectance }
    }

    /// The pane of a glazing, in tables of steps of half a degree, with the front of the glazing on
    /// the front of the facets. Between the nodes the straight lines are off by less than 0.0002 up
    /// to 85 degrees, and by less than 0.004 beyond.
    #[must_use]
    pub fn of_glazing(glazing: &Glazing) -> Self {
        let theta_rad = |step: u32| f64::from(step) / f64::from(STEPS) * FRAC_PI_2;
        let shares: Vec<SheetShares> =
            (0..=STEPS).map(|step| glazing.visible(libm::cos(theta_rad(step)))).collect();
        let table = |share: fn(&SheetShares) -> f64| {
            let node = |(step, shares)| AngularNode {
                theta_rad: theta_rad(step),
                share: share(shares).clamp(0.0, 1.0),
            };
            AngularTable::from_steps((0..).zip(&shares).map(node).collect())
        };
        Self::Measured {
            transmittance: table(|it| it.transmittance),
            front_reflectance: table(|it| it.front_reflectance),
            back_reflectance: table(|it| it.back_reflectance),
        }
    }

    /// Transmittance of a clear pane of this index at normal incidence: `2 eta / (eta^2 + 1)`, from
    /// `(1 - r) / (1 + r)` with `r = ((eta - 1) / (eta + 1))^2` at each boundary.
    #[must_use]
    pub fn clear_transmittance(eta: f64) -> f64 {
        2.0 * eta / (eta * eta + 1.0)
    }
}
