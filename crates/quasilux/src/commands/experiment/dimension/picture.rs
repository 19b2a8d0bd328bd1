//! Errors of all setups, logarithmic both ways.

use super::Setup;
use super::walk::Features;
use quasilux_measure::svg::{
    Axis, Dash, Figure, LegendEntry, Line, PALETTE, Panel, Scale, Stroke, figure,
};
use quasilux_sampling::Sequence;

/// The plot as an SVG file.
pub(super) fn svg(setups: &[Setup]) -> String {
    let points = |setup: &Setup| setup.flights.points();
    let values = |k: usize| setups.iter().flat_map(points).map(move |point| point[k]);
    let line = |setup: &Setup| Line { points: points(setup), stroke: stroke(setup) };
    let entry = |setup: &Setup| {
        let text = format!("{}, {}", setup.flights.sequence.name(), setup.name);
        vec![LegendEntry { text, stroke: Some(stroke(setup)) }]
    };
    let panel = Panel {
        title: "four luminaires in a diffuse cube".to_owned(),
        x: Axis::around("number of photons N", Scale::Log(2), values(0)),
        y: Axis::around("RMS error / mean illuminance", Scale::Log(10), values(1)),
        lines: setups.iter().map(line).collect(),
    };
    figure(&Figure {
        title: "What coordinates cost".to_owned(),
        panels: vec![panel],
        columns: 1,
        legend: setups.iter().map(entry).collect(),
    })
}

/// Colours are features, dashes are points.
fn stroke(setup: &Setup) -> Stroke {
    let place = Features::ALL.iter().position(|(_, features)| *features == setup.features);
    let colour = PALETTE[place.unwrap_or(0) % PALETTE.len()];
    match setup.flights.sequence {
        Sequence::Random => Stroke { dash: Dash::Dashed, ..Stroke::solid(colour, 1.5) },
        _ => Stroke::solid(colour, 2.5),
    }
}
