//! Coverage of each kind of interval, room by room.

use super::Count;
use super::kinds::Kind;
use super::pool::Pool;
use super::runs::FIXED;
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{Dash, PALETTE, Stroke};

const GUIDE: Stroke = Stroke::solid([0xc4; 3], 1.0);

/// The plot as an SVG file: coverage against half-width, a line through the rooms of each kind.
pub(super) fn svg(counts: &[Count], pools: &[Pool]) -> String {
    let rooms = [1.0, pools.len().max(2) as f64];
    let names: Vec<&str> = pools.iter().map(|pool| pool.room).collect();
    let axis = || Axis::new(&format!("room: {}", names.join(", ")), Scale::Linear, rooms);
    let widths: Vec<f64> = counts.iter().filter_map(|count| count.half_width).collect();
    let low = widths.iter().copied().fold(f64::INFINITY, f64::min);
    let high = widths.iter().copied().fold(0.0, f64::max);
    let guide = Line { points: vec![[rooms[0], 0.95], [rooms[1], 0.95]], stroke: GUIDE };
    let coverage = Panel {
        title: "coverage of 95 % intervals".to_owned(),
        x: axis(),
        y: Axis::new("coverage", Scale::Linear, [0.7, 1.0]),
        lines: std::iter::once(guide).chain(lines(counts, |it| Some(it.coverage()))).collect(),
    };
    let widths = Panel {
        title: "median half-width".to_owned(),
        x: axis(),
        y: Axis::new("half-width / truth", Scale::Log(10), [0.8 * low, 1.25 * high]),
        lines: lines(counts, |it| it.half_width),
    };
    figure(&Figure {
        title: "Kinds of intervals from 4096 indices".to_owned(),
        panels: vec![coverage, widths],
        columns: 2,
        legend: Kind::ALL.chunks(3).map(|kinds| kinds.iter().map(entry).collect()).collect(),
    })
    .to_svg()
}

fn lines(counts: &[Count], value: impl Fn(&Count) -> Option<f64>) -> Vec<Line> {
    let line = |kind: Kind| {
        let own = counts.iter().filter(|it| it.moment == FIXED && it.kind == kind.name());
        let points = own.zip(1_u32..).filter_map(|(it, room)| Some([room.into(), value(it)?]));
        Line { points: points.collect(), stroke: stroke(kind) }
    };
    Kind::ALL.map(line).into()
}

fn stroke(kind: Kind) -> Stroke {
    let number = Kind::ALL.iter().position(|other| *other == kind).unwrap_or(0);
    let dash = if number < 3 { Dash::Solid } else { Dash::Dashed };
    Stroke { colour: PALETTE[number % PALETTE.len()], width_px: 1.75, dash }
}

fn entry(kind: &Kind) -> LegendEntry {
    LegendEntry { text: kind.name().to_owned(), stroke: Some(stroke(*kind)) }
}
