//! Rows of a legend: lines and their meanings.

use crate::drawing::Drawing;
use crate::style::{Anchor, Stroke, TextStyle};
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

/// Draws entries in a row, from the base line at `left`.
pub(super) fn draw_row(drawing: &mut Drawing, [left, y]: [f64; 2], entries: &[LegendEntry]) {
    let style = TextStyle::plain(Anchor::Start);
    let mut x = left;
    for entry in entries {
        if let Some(stroke) = entry.stroke {
            drawing.line(&[[x, y - 4.0], [x + LINE_PX, y - 4.0]], stroke);
            x += LINE_PX + GAP_PX;
        }
        drawing.text([x, y], style, &entry.text);
        x += WIDER * width_px(&entry.text, style.size_px) + SPACE_PX;
    }
}
