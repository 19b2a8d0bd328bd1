//! The four curves, logarithmic both ways.

use super::{Curve, REPLICATES};
use crate::emission::Method;
use crate::error_plot::{ErrorLine, error_plot};
use quasilux_drawing::{Dash, PALETTE, Stroke};
use quasilux_sampling::Sequence;

/// Slopes of the guides, with their names.
const GUIDES: [(f64, &str, Dash); 2] =
    [(-0.5, "N^{\u{2212}1/2}", Dash::Solid), (-1.0, "N^{\u{2212}1}", Dash::Dotted)];

/// The plot as an SVG file.
pub(super) fn svg(curves: &[Curve]) -> String {
    let line = |curve: &Curve| ErrorLine {
        name: format!("{}, {}", curve.setup.method.name(), curve.setup.sequence.name()),
        stroke: stroke(curve),
        points: curve.points().collect(),
    };
    let lines: Vec<ErrorLine> = guides(&curves[0]).chain(curves.iter().map(line)).collect();
    let subtitle = format!("floor under a batwing, {REPLICATES} randomisations");
    error_plot("Directions of a batwing luminaire", &subtitle, &lines)
}

/// From the error at the smallest N.
fn guides(curve: &Curve) -> impl Iterator<Item = ErrorLine> {
    let [first, top] = curve.errors[0].point();
    let [last, _] = curve.last().point();
    GUIDES.into_iter().map(move |(slope, name, dash)| ErrorLine {
        name: name.to_owned(),
        stroke: Stroke { dash, ..Stroke::solid([0xc4; 3], 1.0) },
        points: vec![[first, top], [last, top * libm::pow(last / first, slope)]],
    })
}

/// Colours are methods, dashes are points; of the two curves of random points, which fall
/// together, the lower one is wider.
fn stroke(curve: &Curve) -> Stroke {
    let (colour, random_px) = match curve.setup.method {
        Method::InverseTransform => (PALETTE[0], 2.0),
        Method::Rejection => (PALETTE[4], 5.0),
    };
    match curve.setup.sequence {
        Sequence::Independent => Stroke { colour, width_px: random_px, dash: Dash::Dashed },
        _ => Stroke::solid(colour, 2.5),
    }
}
