//! Withdrawn points and lies by family.

use super::ESTIMATORS;
use super::count::Count;
use super::trial::Trial;
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{PALETTE, Stroke};

/// The plot as an SVG file.
pub(super) fn svg(trials: &[Trial]) -> String {
    let families = super::families::ALL.len() as f64;
    let panel = |title: &str, label: &str, value: fn(&Count) -> f64| Panel {
        title: title.to_owned(),
        x: Axis::new("family", Scale::Linear, [0.0, families - 1.0]),
        y: Axis::new(label, Scale::Linear, [0.0, 1.0]),
        lines: lines(trials, value),
    };
    let entry = |number: usize| LegendEntry {
        text: ESTIMATORS[number].name().to_owned(),
        stroke: Some(stroke(number)),
    };
    figure(&Figure {
        title: "Hard rooms: points without an interval, and intervals that hold".to_owned(),
        panels: vec![
            panel("withdrawn", "share of points", Count::withdrawn_share),
            panel("coverage", "share of intervals", Count::coverage),
        ],
        columns: 2,
        legend: vec![(0..ESTIMATORS.len()).map(entry).collect()],
    })
    .to_svg()
}

/// One line an estimator, through the families that it ran.
fn lines(trials: &[Trial], value: fn(&Count) -> f64) -> Vec<Line> {
    let line = |number: usize| {
        let names = super::families::ALL.iter().map(|family| family.name).enumerate();
        let point = |(at, name): (usize, &str)| {
            let share = value(&Count::new(trials, ESTIMATORS[number], Some(name)));
            share.is_finite().then_some([at as f64, share])
        };
        Line { points: names.filter_map(point).collect(), stroke: stroke(number) }
    };
    (0..ESTIMATORS.len()).map(line).collect()
}

fn stroke(number: usize) -> Stroke {
    Stroke::solid(PALETTE[number], 2.0)
}
