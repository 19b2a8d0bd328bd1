//! Points of the unit square, with the cells of a grid.

use crate::drawing::{Drawing, Frame};
use crate::style::{Anchor, GREY, INK, PALETTE, Stroke, TEXT_PX, TextStyle};

/// Points of the unit square to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter<'a> {
    /// What stands above the square.
    pub title: &'a str,
    /// What stands below the title, smaller; empty for nothing.
    pub subtitle: &'a str,
    /// Names of the two axes.
    pub labels: [&'a str; 2],
    /// The points; x runs to the right, y up.
    pub points: &'a [[f64; 2]],
    /// The number of cells along each side; 1 draws none.
    pub cells: u32,
}

const SIDE_PX: f64 = 480.0;
const LEFT_PX: f64 = 56.0;
const TOP_PX: f64 = 64.0;
const RIGHT_PX: f64 = 24.0;
const BOTTOM_PX: f64 = 56.0;
/// More lines than this along a side are a grey surface.
const MAX_LINES: u32 = 128;

/// Draws the points.
#[must_use]
pub fn scatter(scatter: &Scatter<'_>) -> Drawing {
    scatters(std::slice::from_ref(scatter))
}

/// Draws several squares of points side by side.
#[must_use]
pub fn scatters(scatters: &[Scatter<'_>]) -> Drawing {
    let width_px = LEFT_PX + SIDE_PX + RIGHT_PX;
    let all_px = width_px * scatters.len() as f64;
    let titles = scatters.iter().map(|s| format!("{}, {}", s.title, s.subtitle));
    let title = titles.collect::<Vec<_>>().join("; ");
    let mut drawing = Drawing::new(&title, [all_px, TOP_PX + SIDE_PX + BOTTOM_PX]);
    for (place, scatter) in scatters.iter().enumerate() {
        let corner_px = [LEFT_PX + width_px * place as f64, TOP_PX];
        let frame = Frame { corner_px, size_px: [SIDE_PX, SIDE_PX] };
        draw_text(&mut drawing, frame, scatter);
        draw_cells(&mut drawing, frame, scatter.cells);
        drawing.outline(frame, Stroke::solid(INK, 1.2));
        let radius_px = radius_px(scatter.points.len());
        for point in scatter.points {
            drawing.disk(frame.at(*point), radius_px, PALETTE[0]);
        }
    }
    drawing
}

/// Few points can be large; of many each covers a tenth of its share of the square.
fn radius_px(points: usize) -> f64 {
    (0.18 * SIDE_PX / (points.max(1) as f64).sqrt()).clamp(0.6, 4.2)
}

fn draw_cells(drawing: &mut Drawing, frame: Frame, cells: u32) {
    for i in 1..cells.min(MAX_LINES) {
        let share = f64::from(i) / f64::from(cells);
        let stroke = Stroke::solid([0xbb; 3], 0.8);
        drawing.line(&[frame.at([share, 0.0]), frame.at([share, 1.0])], stroke);
        drawing.line(&[frame.at([0.0, share]), frame.at([1.0, share])], stroke);
    }
}

fn draw_text(drawing: &mut Drawing, frame: Frame, scatter: &Scatter<'_>) {
    let [left, top] = frame.at([0.0, 1.0]);
    let title = TextStyle::new(16.0, INK, Anchor::Start);
    drawing.text([left, top - 34.0], title, scatter.title);
    let subtitle = TextStyle { colour: GREY, ..TextStyle::plain(Anchor::Start) };
    drawing.text([left, top - 14.0], subtitle, scatter.subtitle);
    let middle = TextStyle::plain(Anchor::Middle);
    for (share, label) in [(0.0, "0"), (0.5, "0.5"), (1.0, "1")] {
        let ([x, bottom], [left, y]) = (frame.at([share, 0.0]), frame.at([0.0, share]));
        drawing.line(&[[x, bottom], [x, bottom + 5.0]], Stroke::solid(INK, 1.0));
        drawing.line(&[[left, y], [left - 5.0, y]], Stroke::solid(INK, 1.0));
        drawing.text([x, bottom + 19.0], middle, label);
        drawing.text([left - 9.0, y + 4.0], TextStyle::plain(Anchor::End), label);
    }
    let [x, bottom] = frame.at([0.5, 0.0]);
    drawing.text([x, bottom + 26.0 + TEXT_PX], middle, scatter.labels[0]);
    let [left, y] = frame.at([0.0, 0.5]);
    drawing.text([left - 36.0, y], middle.upward(), scatter.labels[1]);
}
