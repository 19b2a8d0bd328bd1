//! Errors of all setups.

use super::Setup;
use super::walk::Features;
use crate::error_plot::{ErrorLine, error_plot};
use quasilux_drawing::{Dash, PALETTE, Stroke};
use quasilux_sampling::Sequence;

/// The plot as an SVG file.
pub(super) fn svg(setups: &[Setup]) -> String {
    let line = |setup: &Setup| ErrorLine {
        name: format!("{}, {}", setup.flights.sequence.name(), setup.name),
        stroke: stroke(setup),
        points: setup.flights.points(),
    };
    let lines: Vec<ErrorLine> = setups.iter().map(line).collect();
    error_plot("What coordinates cost", "four luminaires in a diffuse cube", &lines)
}

/// Colours are features, dashes are points.
fn stroke(setup: &Setup) -> Stroke {
    let place = Features::ALL.iter().position(|(_, features)| *features == setup.features);
    let colour = PALETTE[place.unwrap_or(0) % PALETTE.len()];
    match setup.flights.sequence {
        Sequence::Independent => Stroke { dash: Dash::Dashed, ..Stroke::solid(colour, 1.5) },
        _ => Stroke::solid(colour, 2.5),
    }
}
