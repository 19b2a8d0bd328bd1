//! What a designer asks of a luminaire: its greatest intensity, how wide it shines, where its flux
//! goes.
//!
//! Everything is stated in the luminaire frame (C, gamma), whatever web of angles the file was
//! measured in. Types C and A have their poles at nadir and zenith: their figures are exact for the
//! bilinear table, for intensities along a plane are piecewise linear and zonal fluxes have a
//! closed form. Type B has other poles: the greatest intensity and the total flux are exact for it
//! too; planes are sampled each 0.1 degrees, zonal fluxes integrated numerically (see
//! [`ZonalFlux`]).
//!
//! Read on at [`PlaneCurve`] for the curves of the polar diagram, [`Spread`] for beam and field
//! angles, [`FluxCode`] for the CIE flux code.

mod flux_code;
mod plane;
mod spread;
mod zones;

use crate::{PhotometricType, Photometry, Symmetry, Web, WebAngles};
pub use flux_code::FluxCode;
use glam::DVec3;
pub use plane::{Plane, PlaneCurve, PlanePoint};
pub use spread::Spread;
use std::f64::consts::{FRAC_PI_2, PI};
pub use zones::ZonalFlux;

/// Zones of equal width between nadir and zenith.
const ZONES: usize = 18;

/// The web whose angles are C and gamma.
const WEB_C: Web = Web::new(PhotometricType::C);

/// A direction in the luminaire frame, as photometry names it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LuminaireAngles {
    /// Around the vertical axis, from +x (0) towards +y (90 degrees), in [0, 2 pi).
    pub c_rad: f64,
    /// From nadir (-z, 0) to zenith (+z, pi).
    pub gamma_rad: f64,
}

/// The greatest intensity of a luminaire.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaximumIntensity {
    /// In candela.
    pub intensity_cd: f64,
    /// Where it is; of several places one in which the table's polar angle is smallest.
    pub angles: LuminaireAngles,
}

/// One of the two principal planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneAnalysis {
    /// Which one.
    pub plane: Plane,
    /// The greatest intensity in the plane, in candela.
    pub maximum_cd: f64,
    /// The intensity at gamma = 0, in candela.
    pub centre_cd: f64,
    /// Half-peak divergence (CIE S 017, "angular extent of all radius vectors longer than 50 % of
    /// the maximum"), the beam angle of ANSI/IES LS-1; `None` in a dark plane.
    pub beam: Option<Spread>,
    /// The beam angle of CIE S 017, 17-27-077: 50 % of the *centre beam* intensity, the centre
    /// being gamma = 0; `None` where that is dark. It differs from `beam` where the maximum is
    /// elsewhere.
    pub centre_beam: Option<Spread>,
    /// One-tenth-peak divergence, the field angle of ANSI/IES LS-1: 10 % of the maximum.
    pub field: Option<Spread>,
}

/// The figures of a luminaire.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// Luminous flux, integrated exactly from the table.
    pub flux_lm: f64,
    /// The part of it below the horizon.
    pub downward_flux_lm: f64,
    /// The greatest intensity; `None` where there is no light at all.
    pub maximum: Option<MaximumIntensity>,
    /// The planes C0-C180 and C90-C270.
    pub planes: [PlaneAnalysis; 2],
    /// Integrated flux over that of the lamps with the ballast factor, which cancels: lamps and
    /// luminaire are compared on the same ballast. `None` for absolute photometry.
    pub light_output_ratio: Option<f64>,
    /// Integrated flux over the electrical power, in lm/W; `None` where the file gives no power.
    pub efficacy_lm_w: Option<f64>,
    /// The CIE flux code.
    pub flux_code: FluxCode,
    /// Flux in zones of 10 degrees of gamma, from nadir to zenith.
    pub zones_lm: [f64; ZONES],
    /// How many half-planes the file gives.
    pub measured_planes: usize,
}

impl LuminaireAngles {
    /// The angles of a direction of any length; accurate at nadir and zenith.
    pub fn from_direction(direction: DVec3) -> Self {
        let WebAngles { horizontal_rad, vertical_rad } = WEB_C.angles(direction);
        Self { c_rad: horizontal_rad, gamma_rad: vertical_rad }
    }

    /// The unit direction.
    pub fn direction(self) -> DVec3 {
        WEB_C.direction(WebAngles { horizontal_rad: self.c_rad, vertical_rad: self.gamma_rad })
    }
}

impl Analysis {
    /// The figures of a luminaire.
    pub fn new(photometry: &Photometry) -> Self {
        let zones = ZonalFlux::new(photometry);
        let facts = photometry.facts();
        let flux_lm = photometry.flux_lm();
        let light_output_ratio = facts.lamps_flux_lm().map(|lamps_lm| flux_lm / lamps_lm);
        let is_powered = facts.input_watts > 0.0 && facts.input_watts.is_finite();
        let border = |zone: usize| PI * zone as f64 / ZONES as f64;
        Self {
            flux_lm,
            downward_flux_lm: zones.below_lm(FRAC_PI_2),
            maximum: maximum(photometry),
            planes: Plane::PRINCIPAL.map(|plane| PlaneAnalysis::new(photometry, plane)),
            light_output_ratio,
            efficacy_lm_w: is_powered.then(|| flux_lm / facts.input_watts),
            flux_code: FluxCode::new(&zones, light_output_ratio),
            zones_lm: std::array::from_fn(|zone| zones.between_lm(border(zone), border(zone + 1))),
            measured_planes: measured_planes(photometry),
        }
    }
}

impl PlaneAnalysis {
    fn new(photometry: &Photometry, plane: Plane) -> Self {
        let curve = PlaneCurve::new(photometry, plane);
        let maximum_cd = curve.maximum_cd();
        let centre_cd = photometry.intensity_cd(DVec3::NEG_Z);
        Self {
            plane,
            maximum_cd,
            centre_cd,
            beam: curve.spread(0.5 * maximum_cd),
            centre_beam: curve.spread(0.5 * centre_cd),
            field: curve.spread(0.1 * maximum_cd),
        }
    }
}

/// A bilinear function has its maximum at a node.
fn maximum(photometry: &Photometry) -> Option<MaximumIntensity> {
    let peak = photometry.table().maximum();
    (peak.value > 0.0).then(|| MaximumIntensity {
        intensity_cd: peak.value,
        angles: LuminaireAngles::from_direction(
            photometry.web().luminaire_from_table(peak.angles.direction()),
        ),
    })
}

/// The planes before symmetry unfolded them; mirror images of types A and B count.
fn measured_planes(photometry: &Photometry) -> usize {
    let unfolded = photometry.table().phi_rad().count();
    match photometry.table().symmetry() {
        Symmetry::Rotational => 1,
        Symmetry::Quadrant => (unfolded - 1) / 4 + 1,
        Symmetry::Bilateral => (unfolded - 1) / 2 + 1,
        Symmetry::None | Symmetry::Sector => unfolded,
        Symmetry::Open => unfolded - 1,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn angles_and_directions_are_inverse() {
        for (c_deg, gamma_deg) in [(0.0, 30.0), (90.0, 90.0), (200.0, 150.0), (359.0, 1e-9)] {
            let radians = |degrees: f64| degrees / 180.0 * PI;
            let angles = LuminaireAngles { c_rad: radians(c_deg), gamma_rad: radians(gamma_deg) };
            let back = LuminaireAngles::from_direction(angles.direction());
            assert!((back.c_rad - angles.c_rad).abs() < 1e-14, "{c_deg} {gamma_deg}");
            assert!((back.gamma_rad - angles.gamma_rad).abs() < 1e-15, "{c_deg} {gamma_deg}");
        }
        let south = LuminaireAngles::from_direction(DVec3::NEG_Z);
        assert_eq!((south.c_rad, south.gamma_rad), (0.0, 0.0));
        assert!(LuminaireAngles::from_direction(DVec3::new(1.0, -1e-300, 0.0)).c_rad < TAU);
    }
}
