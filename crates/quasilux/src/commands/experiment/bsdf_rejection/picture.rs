//! Errors of all setups, logarithmic both ways.

use super::Setup;
use super::walk::Method;
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
        let text = format!("{}, {}", setup.method.name(), setup.flights.sequence.name());
        vec![LegendEntry { text, stroke: Some(stroke(setup)) }]
    };
    let panel = Panel {
        title: "a box of one glossy table".to_owned(),
        x: Axis::around("number of photons N", Scale::Log(2), values(0)),
        y: Axis::around("RMS error / mean illuminance", Scale::Log(10), values(1)),
        lines: setups.iter().map(line).collect(),
    };
    figure(&Figure {
        title: "Directions of measured surfaces".to_owned(),
        panels: vec![panel],
        columns: 1,
        legend: setups.iter().map(entry).collect(),
    })
}

/// Colours are methods, dashes are points; of the two curves of random points, which fall together, the lower one is
/// wider.
fn stroke(setup: &Setup) -> Stroke {
    let (colour, random_px) = match setup.method {
        Method::InverseTransform => (PALETTE[0], 2.0),
        Method::Rejection => (PALETTE[4], 5.0),
    };
    match setup.flights.sequence {
        Sequence::Random => Stroke { colour, width_px: random_px, dash: Dash::Dashed },
        _ => Stroke::solid(colour, 2.5),
    }
}
