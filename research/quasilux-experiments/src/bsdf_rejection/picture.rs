//! Errors of all setups.

use super::Setup;
use super::walk::Method;
use crate::error_plot::{ErrorLine, error_plot};
use quasilux_drawing::{Dash, PALETTE, Stroke};
use quasilux_sampling::Sequence;

/// The plot as an SVG file.
pub(super) fn svg(setups: &[Setup]) -> String {
    let line = |setup: &Setup| ErrorLine {
        name: format!("{}, {}", setup.method.name(), setup.flights.sequence.name()),
        stroke: stroke(setup),
        points: setup.flights.points(),
    };
    let lines: Vec<ErrorLine> = setups.iter().map(line).collect();
    error_plot("Directions of measured surfaces", "a box of one glossy table", &lines)
}

/// Colours are methods, dashes are points; of the two curves of random points, which fall together,
/// the lower one is wider.
fn stroke(setup: &Setup) -> Stroke {
    let (colour, random_px) = match setup.method {
        Method::InverseTransform => (PALETTE[0], 2.0),
        Method::Rejection => (PALETTE[4], 5.0),
    };
    match setup.flights.sequence {
        Sequence::Independent => Stroke { colour, width_px: random_px, dash: Dash::Dashed },
        _ => Stroke::solid(colour, 2.5),
    }
}
