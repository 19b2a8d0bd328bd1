//! Errors against the number of samples and against time, the paper's single runs beside ours.

use super::Findings;
use super::curve::{Curve, Stop};
use super::paper::{Printed, TABLE};
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{Dash, PALETTE, Stroke};

/// Of the curves in their order: pseudo, Halton, Halton once, ours.
const STROKES: [Stroke; 4] = [
    Stroke { colour: PALETTE[1], width_px: 2.5, dash: Dash::Dashed },
    Stroke::solid(PALETTE[0], 2.5),
    Stroke { colour: PALETTE[5], width_px: 1.5, dash: Dash::Dotted },
    Stroke::solid(PALETTE[2], 2.5),
];
/// Of the paper's: pseudo, quasi.
const PRINTED: [Stroke; 2] = [
    Stroke { colour: PALETTE[1], width_px: 1.2, dash: Dash::DashDot },
    Stroke { colour: PALETTE[0], width_px: 1.2, dash: Dash::DashDot },
];
/// Smaller errors are luck, and end the axis.
const MIN: f64 = 1e-5;

/// The plot as an SVG file.
pub(super) fn svg(findings: &Findings) -> String {
    let curves = &findings.curves;
    let against = |x: fn(&Stop) -> f64| -> Vec<Line> {
        let line = |(curve, stroke): (&Curve, Stroke)| Line {
            points: curve.stops.iter().map(|stop| [x(stop), stop.error()]).collect(),
            stroke,
        };
        curves.iter().zip(STROKES).map(line).collect()
    };
    let by_count = against(|stop| stop.samples as f64);
    let mut by_time = against(|stop| stop.seconds);
    for (error, stroke) in [Printed::pseudo_error as fn(&Printed) -> f64, Printed::quasi_error]
        .into_iter()
        .zip(PRINTED)
    {
        let points = TABLE.iter().map(|line| [line.seconds, error(line)]).collect();
        by_time.push(Line { points, stroke });
    }
    let panel = |title: &str, label: &str, base: u32, lines: Vec<Line>| {
        let values = |axis: usize| {
            let points = lines.iter().flat_map(|line| &line.points);
            points.map(move |point| point[axis]).collect::<Vec<f64>>()
        };
        let errors = values(1).into_iter().map(|error| error.max(MIN));
        Panel {
            title: title.to_owned(),
            x: Axis::around(label, Scale::Log(base), values(0)),
            y: Axis::around("error / 1353.247 lx", Scale::Log(10), errors),
            lines,
        }
    };
    figure(&Figure {
        title: "The mirror octant: total illuminance at the place in the middle".to_owned(),
        panels: vec![
            panel("against the number of samples", "N", 2, by_count),
            panel("against time; the paper's of 2003", "seconds", 10, by_time),
        ],
        columns: 2,
        legend: legend(curves),
    })
    .to_svg()
}

fn legend(curves: &[Curve]) -> Vec<Vec<LegendEntry>> {
    let entry = |text: String, stroke| LegendEntry { text, stroke: Some(stroke) };
    let ours: Vec<LegendEntry> = curves
        .iter()
        .zip(STROKES)
        .map(|(curve, stroke)| entry(curve.name.to_owned(), stroke))
        .collect();
    let printed = ["the paper's pseudo, single runs", "the paper's quasi, single runs"];
    let printed = printed.into_iter().zip(PRINTED);
    let printed = printed.map(|(text, stroke)| entry(text.to_owned(), stroke)).collect();
    let (photons, rest) = ours.split_at(2);
    vec![photons.to_vec(), rest.to_vec(), printed]
}
