//! The transmission that a file leaves out.

use super::block::{Block, SideAndMode};
use crate::distribution::Distribution;
use crate::measured::MeasuredBsdf;
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::warning::WarningKind;
use crate::warning::Warnings;

/// Takes the transmission of a side that the file leaves out from the other side, by reciprocity.
pub(super) fn fill_transmission(
    bsdf: &mut MeasuredBsdf,
    blocks: &[Block<'_, '_>],
    warnings: &mut Warnings,
) {
    let given = |side: Side| {
        let passing = SideAndMode { side, mode: ScatteringMode::Transmission };
        blocks.iter().find(|block| block.light == passing)
    };
    for side in Side::ALL {
        let (None, Some(source)) = (given(side), given(side.other())) else {
            continue;
        };
        let found = format!("no Transmission {}", side.name());
        let known = bsdf.scattering(side.other(), ScatteringMode::Transmission);
        let adjoint = known.and_then(Distribution::adjoint);
        let (deviation, expected) = match &adjoint {
            Some(_) => {
                let expected = "both directions (taken from the other one by reciprocity)";
                (WarningKind::ByReciprocity, expected.to_owned())
            }
            None => {
                let expected =
                    "both directions (this table cannot be turned round: nothing passes)";
                (WarningKind::OneWayTransmission, expected.to_owned())
            }
        };
        warnings.push(deviation, source.element.at, found, expected);
        if let Some(adjoint) = adjoint {
            bsdf.set(side, ScatteringMode::Transmission, adjoint);
        }
    }
}
