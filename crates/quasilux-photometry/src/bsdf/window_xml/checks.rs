//! What follows from a file as a whole: the transmission that it leaves out, and the defects of its tables.

use super::block::Block;
use crate::Deviation;
use crate::bsdf::{BsdfAnalysis, Distribution, MeasuredBsdf, Side, Way};
use crate::report::{Position, Warnings};

/// Albedos above 1 by less are the rounding of a file.
const ENERGY_TOLERANCE: f64 = 1e-3;

/// Mean relative differences below need no word.
const RECIPROCITY_TOLERANCE: f64 = 0.01;

/// Takes the transmission of a side that the file leaves out from the other side, by reciprocity.
pub(super) fn fill_transmission(
    bsdf: &mut MeasuredBsdf,
    blocks: &[Block<'_, '_>],
    warnings: &mut Warnings,
) {
    let given = |side: Side| {
        let is_given =
            |block: &&Block<'_, '_>| (block.side, block.way) == (side, Way::Transmission);
        blocks.iter().find(is_given)
    };
    for side in Side::ALL {
        let (None, Some(source)) = (given(side), given(side.other())) else {
            continue;
        };
        let found = format!("no Transmission {}", side.name());
        let reversed = match bsdf.scattering(side.other(), Way::Transmission) {
            Some(Distribution::Klems(table)) => table.reversed().map(Distribution::Klems),
            Some(Distribution::TensorTree(tree)) => tree.reversed().map(Distribution::TensorTree),
            _ => None,
        };
        let (deviation, expected) = match &reversed {
            Some(Distribution::TensorTree(tree)) if tree.is_isotropic() => {
                let side = tree.resolution();
                let expected =
                    format!("both directions (resampled by reciprocity, {side} boxes a side)");
                (Deviation::ByReciprocity, expected)
            }
            Some(_) => {
                let expected = "both directions (taken from the other one by reciprocity)";
                (Deviation::ByReciprocity, expected.to_owned())
            }
            None => {
                let expected =
                    "both directions (this table cannot be turned round: nothing passes)";
                (Deviation::OneWayTransmission, expected.to_owned())
            }
        };
        warnings.push(deviation, source.element.at, found, expected);
        if let Some(reversed) = reversed {
            bsdf.set(side, Way::Transmission, reversed);
        }
    }
}

/// Says by how much tables break energy conservation and reciprocity.
pub(super) fn warn_of_defects(bsdf: &MeasuredBsdf, at: Position, warnings: &mut Warnings) {
    let analysis = BsdfAnalysis::of(bsdf);
    for energy in analysis.energy.iter().filter(|energy| energy.worst > 1.0 + ENERGY_TOLERANCE) {
        let theta_deg = libm::acos(energy.worst_wi.z.clamp(-1.0, 1.0)).to_degrees();
        let found = format!(
            "{:.1} % of the light scattered at {theta_deg:.1} degrees on the {}",
            100.0 * energy.worst,
            energy.side.name(),
        );
        let expected = "no more than 100 % (used as it is)";
        warnings.push(Deviation::EnergyNotConserved, at, found, expected);
    }
    let is_off = |found: &&crate::bsdf::Reciprocity| found.mean > RECIPROCITY_TOLERANCE;
    for reciprocity in analysis.reciprocity.iter().filter(is_off) {
        let found = format!(
            "{} {} that differs from that of exchanged directions by {:.1} % in the mean",
            reciprocity.way.name(),
            reciprocity.side.name(),
            100.0 * reciprocity.mean,
        );
        let expected = "the same both ways round (used as it is)";
        warnings.push(Deviation::NotReciprocal, at, found, expected);
    }
}
