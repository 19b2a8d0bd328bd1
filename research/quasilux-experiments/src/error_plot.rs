//! Errors over the number of photons, logarithmic both ways.

use quasilux_drawing::Stroke;
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};

/// The errors of one setup.
pub(super) struct ErrorLine {
    /// In the legend.
    pub(super) name: String,
    pub(super) stroke: Stroke,
    /// (N, root mean square error over the mean).
    pub(super) points: Vec<[f64; 2]>,
}

/// The plot as an SVG file, the last line on top.
pub(super) fn error_plot(title: &str, subtitle: &str, lines: &[ErrorLine]) -> String {
    let values = |k: usize| lines.iter().flat_map(move |l| l.points.iter().map(move |p| p[k]));
    let line = |line: &ErrorLine| Line { points: line.points.clone(), stroke: line.stroke };
    let entry =
        |line: &ErrorLine| vec![LegendEntry { text: line.name.clone(), stroke: Some(line.stroke) }];
    let panel = Panel {
        title: subtitle.to_owned(),
        x: Axis::around("number of photons N", Scale::Log(2), values(0)),
        y: Axis::around("RMS error / mean illuminance", Scale::Log(10), values(1)),
        lines: lines.iter().map(line).collect(),
    };
    figure(&Figure {
        title: title.to_owned(),
        panels: vec![panel],
        columns: 1,
        legend: lines.iter().map(entry).collect(),
    })
    .to_svg()
}
