//! Warnings of what the angles of a DDR file leave open.

use super::header::{Header, SpecularSymmetry};
use crate::gaps;
use crate::gaps::Gap;
use crate::warning::WarningKind;
use crate::warning::Warnings;

/// Angles of a file are rounded by no more, in radians.
const ROUNDING_RAD: f64 = 1e-3;

/// Tells what is made up where angles are missing.
pub(super) fn warn(header: &Header, warnings: &mut Warnings) {
    let at = header.at;
    let exits_rad = match header.symmetry {
        SpecularSymmetry::Axis => 0.0,
        SpecularSymmetry::Plane => gaps::mirrored(&header.phi_rad),
        SpecularSymmetry::None => gaps::around(&without_closing(&header.phi_rad)),
    };
    if gaps::judge(exits_rad) == Gap::Open {
        let degrees = exits_rad.to_degrees();
        let found = format!("azimuths phi that leave a gap of {degrees:.0} degrees");
        let expected = match header.symmetry {
            SpecularSymmetry::Plane => {
                "0 to 180 with gaps of 90 degrees at most (f is linear \
                                        across it, or as at the nearest end)"
            }
            _ => "gaps of 90 degrees at most (f is linear across it)",
        };
        warnings.push(WarningKind::AzimuthGap, at, found, expected);
    }
    let incident_rad = gaps::around(&header.psi_rad[..header.planes()]);
    if header.planes() > 1 {
        gaps::warn_of_incidence(incident_rad, at, warnings);
    }
    let first_rad = header.theta_rad[0];
    if first_rad > ROUNDING_RAD {
        let found = format!("theta from {:.1} degrees on", first_rad.to_degrees());
        let expected = "angles from 0 on, the specular direction (f is as at the first one)";
        warnings.push(WarningKind::SpecularMissing, at, found, expected);
    }
    if let [only] = header.sigma_rad[..] {
        let found = format!("one incident polar angle, {:.1} degrees", only.to_degrees());
        let expected = "several (the lobe follows the specular direction and keeps its light)";
        warnings.push(WarningKind::OneIncidence, at, found, expected);
    }
}

/// A whole turn is none.
fn without_closing(phi_rad: &[f64]) -> Vec<f64> {
    let is_last = |phi: &&f64| **phi > std::f64::consts::TAU - ROUNDING_RAD && phi_rad.len() > 1;
    phi_rad.iter().filter(|phi| !is_last(phi)).copied().collect()
}
