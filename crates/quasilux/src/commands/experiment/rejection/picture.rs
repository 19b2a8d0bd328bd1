//! The four curves, logarithmic both ways.

use super::{Curve, REPLICATES};
use crate::commands::experiment::emission::Method;
use quasilux_measure::svg::{
    Axis, Dash, Figure, LegendEntry, Line, PALETTE, Panel, Scale, Stroke, figure,
};
use quasilux_sampling::Sequence;

const GUIDE: Stroke = Stroke::solid("#c4c4c4", 1.0);
/// Slopes of the guides.
const GUIDES: [f64; 2] = [-0.5, -1.0];

/// The plot as an SVG file.
pub(super) fn svg(curves: &[Curve]) -> String {
    let values =
        |axis: usize| curves.iter().flat_map(move |c| c.points.iter().map(move |p| p[axis]));
    let lines =
        curves.iter().map(|curve| Line { points: curve.points.clone(), stroke: stroke(curve) });
    let panel = Panel {
        title: format!("floor under a batwing, {REPLICATES} randomisations"),
        x: Axis::around("number of photons N", Scale::Log(2), values(0)),
        y: Axis::around("RMS error / mean illuminance", Scale::Log(10), values(1)),
        lines: guides(curves).into_iter().chain(lines).collect(),
    };
    figure(&Figure {
        title: "Directions of a batwing luminaire".to_owned(),
        panels: vec![panel],
        columns: 1,
        legend: legend(curves),
    })
}

/// From the largest error at the smallest N.
fn guides(curves: &[Curve]) -> Vec<Line> {
    let points = &curves[0].points;
    let (Some([first, top]), Some([last, _])) = (points.first(), points.last()) else {
        return Vec::new();
    };
    let guide = |slope: f64| {
        let end = top * libm::pow(last / first, slope);
        Line { points: vec![[*first, *top], [*last, end]], stroke: GUIDE }
    };
    GUIDES.into_iter().map(guide).collect()
}

/// Colours are methods, dashes are points; of the two curves of random points, which fall
/// together, the lower one is wider.
fn stroke(curve: &Curve) -> Stroke {
    let (colour, random_px) = match curve.setup.method {
        Method::InverseTransform => (PALETTE[0], 2.0),
        Method::Rejection => (PALETTE[4], 5.0),
    };
    match curve.setup.sequence {
        Sequence::Random => Stroke { colour, width_px: random_px, dash: Dash::Dashed },
        _ => Stroke::solid(colour, 2.5),
    }
}

fn legend(curves: &[Curve]) -> Vec<Vec<LegendEntry>> {
    let entry = |curve: &Curve| {
        let text = format!("{}, {}", curve.setup.method.name(), curve.setup.sequence.name());
        vec![LegendEntry { text, stroke: Some(stroke(curve)) }]
    };
    let guides = "guides: N^{\u{2212}1/2}, N^{\u{2212}1}".to_owned();
    let guides = vec![LegendEntry { text: guides, stroke: Some(GUIDE) }];
    curves.iter().map(entry).chain([guides]).collect()
}
