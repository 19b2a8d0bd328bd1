//! Numbers in metres along the frame of a view.

use super::ink;
use super::view::View;
use crate::drawing::Drawing;
use crate::style::{Anchor, GREY, INK, Stroke, TextStyle};
use crate::text::width_px;
use crate::ticks::Ticks;

const TICK: Stroke = Stroke::solid(GREY, 1.0);
/// Font size of the heading above a view.
pub(crate) const HEADING_PX: f64 = 14.0;
const NUMBER_PX: f64 = 12.0;
/// About this far from one number to the next.
const STEP_PX: f64 = 50.0;

/// Draws the frame, the numbers along its lower and left edges, and the heading above it.
pub(crate) fn draw(drawing: &mut Drawing, view: &View, heading: &str, names: [&str; 2]) {
    let frame = view.frame;
    drawing.outline(frame, ink::BORDER);
    let [[left, top], [width, height]] = [frame.corner_px, frame.size_px];
    let style = |anchor| TextStyle::new(NUMBER_PX, GREY, anchor);
    let projection = view.projection;
    let centre = projection.anchor_m;
    let numbers = |middle_m: f64, length_px: f64| {
        let half_m = 0.5 * length_px / projection.px_per_m;
        let most = (length_px / STEP_PX).max(3.0) as usize;
        let ticks = Ticks::within(middle_m - half_m, middle_m + half_m, most, 0.0);
        ticks.marks(|value| 0.5 + 0.5 * (value - middle_m) / half_m)
    };
    for tick in numbers(centre.dot(projection.right), width) {
        let [x, bottom] = frame.at([tick.share, 0.0]);
        drawing.line(&[[x, bottom], [x, bottom + 5.0]], TICK);
        drawing.text(
            [x, bottom + 18.0],
            style(Anchor::Middle),
            tick.label.as_deref().unwrap_or(""),
        );
    }
    let mut widest: f64 = 0.0;
    for tick in numbers(centre.dot(projection.up), height) {
        let [left, y] = frame.at([0.0, tick.share]);
        let label = tick.label.as_deref().unwrap_or("");
        drawing.line(&[[left - 5.0, y], [left, y]], TICK);
        drawing.text([left - 8.0, y + 4.2], style(Anchor::End), label);
        widest = widest.max(width_px(label, NUMBER_PX));
    }
    let [across, along] = names.map(|name| format!("{name} (m)"));
    drawing.text([left + 0.5 * width, top + height + 34.0], style(Anchor::Middle), &across);
    let base = [left - 16.0 - widest, top + 0.5 * height];
    drawing.text(base, style(Anchor::Middle).upward(), &along);
    drawing.text([left, top - 8.0], TextStyle::new(HEADING_PX, INK, Anchor::Start), heading);
}
