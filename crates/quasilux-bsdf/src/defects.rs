//! Warnings of tables that break energy conservation or reciprocity.

use crate::analysis::Reciprocity;
use crate::measured::MeasuredBsdf;
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::{ParseError, Position};

/// Albedos above 1 by less are the rounding of a file.
const ENERGY_TOLERANCE: f64 = 1e-3;

/// Published tables make up to some 90 times the light that they get, in steep narrow peaks; with
/// more than this one of their numbers is no measurement, and the light of a room would be its.
const MAX_ENERGY: f64 = 1000.0;

/// Mean relative differences below need no word.
const RECIPROCITY_TOLERANCE: f64 = 0.01;

/// Says that what was measured from the front alone lets light through from there alone.
pub(super) fn warn_of_one_way(bsdf: &MeasuredBsdf, at: Position, warnings: &mut Warnings) {
    let passes = |side| bsdf.scattering(side, ScatteringMode::Transmission).is_some();
    if passes(Side::Front) && !passes(Side::Back) {
        let expected = "both sides (nothing passes from the back)";
        warnings.push(WarningKind::OneWayTransmission, at, "transmission of the front", expected);
    }
}

/// Says by how much tables break energy conservation and reciprocity.
///
/// # Errors
/// For tables that make more light than any mistake of a measurement.
pub(super) fn warn_of_defects(
    bsdf: &MeasuredBsdf,
    at: Position,
    warnings: &mut Warnings,
) -> Result<(), ParseError> {
    let analysis = bsdf.analysis();
    for energy in analysis.energy.iter().filter(|energy| energy.worst > 1.0 + ENERGY_TOLERANCE) {
        let theta_deg = libm::acos(energy.worst_wi.z.clamp(-1.0, 1.0)).to_degrees();
        let found = format!(
            "{:.1} % of the light scattered at {theta_deg:.1} degrees on the {}",
            100.0 * energy.worst,
            energy.side.name(),
        );
        if energy.worst > MAX_ENERGY {
            let expected =
                format!("no more than 100 %, or {:.0} % as a file may err", 100.0 * MAX_ENERGY);
            return Err(ParseError::new(at, found, expected));
        }
        let expected = "no more than 100 % (used as it is)";
        warnings.push(WarningKind::EnergyNotConserved, at, found, expected);
    }
    let is_off = |found: &&Reciprocity| found.mean > RECIPROCITY_TOLERANCE;
    for reciprocity in analysis.reciprocity.iter().filter(is_off) {
        let found = format!(
            "{} {} that differs from that of swapped directions by {:.1} % in the mean",
            reciprocity.mode.name(),
            reciprocity.side.name(),
            100.0 * reciprocity.mean,
        );
        let expected = "the same both ways round (used as it is)";
        warnings.push(WarningKind::NotReciprocal, at, found, expected);
    }
    Ok(())
}
