//! Rows of a legend: lines and their meanings.

use crate::drawing::Drawing;
use crate::style::{Anchor, Stroke, TEXT_PX, TextStyle};
use crate::text::width_px;

/// What a line means.
#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
    /// The meaning; a heading where there is no line.
    pub text: String,
    /// How the line is drawn.
    pub stroke: Option<Stroke>,
}

const LINE_PX: f64 = 30.0;
const GAP_PX: f64 = 6.0;
/// Between two entries.
const SPACE_PX: f64 = 14.0;
/// The fonts of a viewer may be this much wider than the bundled ones.
pub(super) const WIDER: f64 = 1.12;

/// From the base line of one row to that of the next.
const ROW_PX: f64 = 18.0;

/// Draws entries in a row, from the base line at `left`.
pub(super) fn draw_row(drawing: &mut Drawing, [left, y]: [f64; 2], entries: &[LegendEntry]) {
    let style = TextStyle::plain(Anchor::Start);
    let mut x = left;
    for entry in entries {
        let text_x = x + line_px(entry);
        if let Some(stroke) = entry.stroke {
            drawing.line(&[[x, y - 4.0], [x + LINE_PX, y - 4.0]], stroke);
        }
        drawing.text([text_x, y], style, &entry.text);
        x += entry_px(entry) + SPACE_PX;
    }
}

/// Entries in rows, as many as a width asks for.
pub(super) struct Rows<'a>(Vec<&'a [LegendEntry]>);

impl<'a> Rows<'a> {
    /// The rows of a width; an entry that is wider has one for itself.
    pub(super) fn within(width_px: f64, entries: &'a [LegendEntry]) -> Self {
        let mut rows = Vec::new();
        let (mut first, mut x) = (0, 0.0);
        for (index, entry) in entries.iter().enumerate() {
            if index > first && x + entry_px(entry) > width_px {
                rows.push(&entries[first..index]);
                (first, x) = (index, 0.0);
            }
            x += entry_px(entry) + SPACE_PX;
        }
        rows.push(&entries[first..]);
        Self(rows)
    }

    /// The height that they take beyond that of one row.
    pub(super) fn more_px(&self) -> f64 {
        ROW_PX * (self.0.len() - 1) as f64
    }

    /// Draws them, the last one on the base line at `left`.
    pub(super) fn draw(&self, drawing: &mut Drawing, [left, y]: [f64; 2]) {
        for (number, row) in self.0.iter().enumerate() {
            let above = self.more_px() - ROW_PX * number as f64;
            draw_row(drawing, [left, y - above], row);
        }
    }
}

/// The width of an entry's line, and of the gap behind it.
fn line_px(entry: &LegendEntry) -> f64 {
    if entry.stroke.is_some() { LINE_PX + GAP_PX } else { 0.0 }
}

fn entry_px(entry: &LegendEntry) -> f64 {
    line_px(entry) + WIDER * width_px(&entry.text, TEXT_PX)
}
