//! Coverage against the width of the intervals: where it is one, 95 % should be covered.

use super::SEQUENCES;
use super::count::{Count, Figure, Moment};
use super::report::ALL;
use quasilux_drawing::diagram::{Axis, Figure as Drawing, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{Dash, PALETTE, Stroke};
use quasilux_sampling::Sequence;

const GUIDE: Stroke = Stroke::solid([0xc4; 3], 1.0);
/// Widths that are drawn, in units of the reported ones.
const WIDTHS: [f64; 2] = [0.4, 1.6];
const STEPS: u32 = 60;
/// What is drawn of all scenes together.
const FIGURES: [Figure; 3] = [Figure::Point(0), Figure::Average, Figure::Minimum];

/// The plot as an SVG file.
pub(super) fn svg(counts: &[Count]) -> String {
    let panels = Moment::ALL.map(|moment| Panel {
        title: format!("all scenes, {}", moment.name()),
        x: Axis::new("width of the interval / reported width", Scale::Linear, WIDTHS),
        y: Axis::new("coverage", Scale::Linear, [0.5, 1.0]),
        lines: guides().into_iter().chain(lines(counts, moment)).collect(),
    });
    figure(&Drawing {
        title: "How often intervals cover the truth".to_owned(),
        panels: panels.into(),
        columns: 2,
        legend: legend(),
    })
    .to_svg()
}

fn guides() -> Vec<Line> {
    let [low, high] = WIDTHS;
    let line = |points: [[f64; 2]; 2]| Line { points: points.to_vec(), stroke: GUIDE };
    vec![line([[low, 0.95], [high, 0.95]]), line([[1.0, 0.5], [1.0, 1.0]])]
}

fn lines(counts: &[Count], moment: Moment) -> Vec<Line> {
    let [low, high] = WIDTHS;
    let width = |step: u32| low + (high - low) * f64::from(step) / f64::from(STEPS);
    let own = counts.iter().filter(|count| {
        count.scene == ALL && count.moment == moment && FIGURES.contains(&count.figure)
    });
    own.map(|count| Line {
        points: (0..=STEPS).map(|step| [width(step), count.coverage(width(step))]).collect(),
        stroke: stroke(count.figure, count.sequence),
    })
    .collect()
}

/// Colours are figures, dashes are points.
fn stroke(figure: Figure, sequence: Sequence) -> Stroke {
    let number = FIGURES.iter().position(|other| *other == figure).unwrap_or(0);
    let colour = PALETTE[2 * number];
    match sequence {
        Sequence::Independent => Stroke { colour, width_px: 1.5, dash: Dash::Dashed },
        _ => Stroke::solid(colour, 2.0),
    }
}

fn legend() -> Vec<Vec<LegendEntry>> {
    let row = |(name, figure): (&str, Figure)| {
        let entry = |(sequence, _): &(Sequence, _)| LegendEntry {
            text: format!("{name}, {}", sequence.name()),
            stroke: Some(stroke(figure, *sequence)),
        };
        SEQUENCES.iter().map(entry).collect()
    };
    ["one point", "average", "minimum"].into_iter().zip(FIGURES).map(row).collect()
}
