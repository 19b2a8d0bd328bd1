//! The words and the colour scale around every false-colour picture.

use super::colour_map::{self, CAUTION_INK};
use super::layout::{self, Layout, capital_px};
use super::words::Words;
use crate::drawing::{Drawing, Frame};
use crate::style::{Anchor, Colour, Dash, GREY, INK, Stroke, TextStyle, WHITE};
use crate::text::width_px;
use crate::ticks::Tick;

/// Colour of what is wanted.
pub(crate) const TARGET_INK: Colour = [0xc4, 0x00, 0x1e];

/// Digits of a target in texts.
pub(crate) const TARGET_DIGITS: i32 = 4;

/// The labels of a colour scale; places on it are shares of its length.
pub(crate) struct Legend<'a> {
    pub(crate) unit: &'a str,
    /// Lines across the scale.
    pub(crate) marks: Vec<f64>,
    /// Ticks below it with their numbers, ascending.
    pub(crate) ticks: Vec<Tick>,
    /// What is wanted.
    pub(crate) target: Option<LegendTarget>,
}

/// What is wanted, named above the colour scale.
pub(crate) struct LegendTarget {
    /// Its place on the scale, where the scale has it.
    pub(crate) share: Option<f64>,
    /// Its name.
    pub(crate) text: String,
}

/// A sheet for a picture, with the title and the figures under it.
pub(crate) fn titled(layout: &Layout, title: &str) -> Drawing {
    let mut drawing = Drawing::new(title, layout.size.map(|n| n as f64));
    let (left, words) = (layout.content_left(), &layout.words);
    let right = left + layout.content_width();
    let style = TextStyle::new(words.title_px, INK, Anchor::Start);
    for (k, line) in words.title.iter().enumerate() {
        let base = layout.title_base() + k as f64 * words.title_line_px();
        drawing.text([left, base], style, line);
    }
    let style = TextStyle::new(layout::SUMMARY_PX, GREY, Anchor::End);
    for (k, line) in words.project.iter().enumerate() {
        let base = layout.title_base() + k as f64 * Words::project_line_px();
        drawing.text([right, base], style, line);
    }
    let style = TextStyle::new(layout::SUMMARY_PX, INK, Anchor::Start);
    for (k, line) in words.facts.iter().enumerate() {
        drawing.text([left, layout.summary_base(k)], style, line);
    }
    drawing
}

/// Draws the colour scale.
pub(crate) fn draw_legend(drawing: &mut Drawing, layout: &Layout, legend: &Legend<'_>) {
    let frame = layout.legend();
    let ([left, top], [width, height]) = (frame.corner_px, frame.size_px);
    let columns = layout.legend_size[0];
    let colour = |column: usize| colour_map::colour((column as f64 + 0.5) / width);
    drawing.cells(frame, columns, (0..columns).map(colour).collect());
    let place = |share: f64| (left + share * width).floor() + 0.5;
    for &share in &legend.marks {
        let stroke = Stroke::solid(colour_map::ink_on(colour_map::colour(share)), 1.0);
        drawing.line(&[[place(share), top], [place(share), top + height]], stroke);
    }
    if let Some(target) = &legend.target {
        draw_target(drawing, frame, target);
    }
    let style = TextStyle::new(layout::SMALL_PX, GREY, Anchor::Middle);
    let below = top + height;
    let mut free_from = f64::NEG_INFINITY;
    for Tick { share, label } in &legend.ticks {
        let (column, number) = (place(*share), label.as_deref().unwrap_or_default());
        drawing.line(&[[column, below + 1.0], [column, below + 5.0]], Stroke::solid(GREY, 1.0));
        let half_px = 0.5 * width_px(number, layout::SMALL_PX);
        if column - half_px > free_from {
            drawing.text([column, below + 19.5], style, number);
            free_from = column + half_px + 8.0;
        }
    }
    let style = TextStyle::new(layout::SUMMARY_PX, INK, Anchor::Start);
    let base = top + 0.5 * (height + capital_px(layout::SUMMARY_PX));
    drawing.text([left + width + 10.0, base], style, legend.unit);
}

/// Draws a sample of the target's line with its name above the scale, and its place on it.
fn draw_target(drawing: &mut Drawing, scale: Frame, target: &LegendTarget) {
    let ([left, top], [width, height]) = (scale.corner_px, scale.size_px);
    let base = top - 7.0;
    let middle = base - 0.5 * capital_px(layout::SMALL_PX);
    target_line(drawing, &[[left, middle], [left + 34.0, middle]]);
    let style = TextStyle::new(layout::SMALL_PX, TARGET_INK, Anchor::Start);
    drawing.text([left + 42.0, base], style, &target.text);
    if let Some(share) = target.share {
        let x = (left + share * width).floor() + 0.5;
        drawing.line(&[[x, top - 3.0], [x, top + height + 3.0]], Stroke::solid(WHITE, 5.0));
        drawing.line(&[[x, top - 3.0], [x, top + height + 3.0]], Stroke::solid(TARGET_INK, 2.4));
    }
}

/// A line of what is wanted: dashed, in a colour of its own, set off from all others.
pub(crate) fn target_line(drawing: &mut Drawing, points_px: &[[f64; 2]]) {
    drawing.line(points_px, Stroke::solid(WHITE, 4.6));
    let dashes = Stroke { colour: TARGET_INK, width_px: 2.6, dash: Dash::Dashed };
    drawing.line(points_px, dashes);
}

/// Draws how the numbers were made, and what restricts them.
pub(crate) fn draw_footer(drawing: &mut Drawing, layout: &Layout) {
    let words = &layout.words;
    let method = words.method.iter().map(|line| (line, GREY));
    let lines = method.chain(words.caution.iter().map(|line| (line, CAUTION_INK)));
    for (k, (line, colour)) in lines.enumerate() {
        let style = TextStyle::new(layout::SMALL_PX, colour, Anchor::Start);
        drawing.text([layout.content_left(), layout.footer_base(k)], style, line);
    }
}
