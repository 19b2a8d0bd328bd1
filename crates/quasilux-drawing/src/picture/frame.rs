//! What stands around every false-colour picture: its title, the scale, and how it was made.

use super::canvas::Canvas;
use super::colour_map::{self, CAUTION_INK, Colour, INK, SOFT_INK};
use super::layout::{self, Layout};
use super::text::{self, Align, TextStyle};
use glam::DVec2;

/// The words around a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Caption<'a> {
    /// The heading.
    pub title: &'a str,
    /// Facts below it; lines are broken between them.
    pub facts: &'a [String],
    /// How the values were made, at the bottom.
    pub method: &'a str,
    /// What restricts their use, below that; empty for nothing.
    pub caution: &'a str,
}

/// The labels of a colour scale; places on it are shares of its length.
pub(crate) struct Legend<'a> {
    pub(crate) unit: &'a str,
    /// Lines across the scale.
    pub(crate) marks: Vec<f64>,
    /// Ticks below it with their numbers, ascending.
    pub(crate) ticks: Vec<(f64, String)>,
}

/// Draws the title and the figures under it.
pub(crate) fn draw_title(canvas: &mut Canvas, layout: &Layout, name: &str) {
    let left = layout.content_left();
    let title = text::fitted(name, layout::TITLE_PX, layout.content_width());
    let style = TextStyle::new(layout::TITLE_PX, INK, Align::Left);
    text::draw(canvas, &title, DVec2::new(left, layout.title_base()), style);
    for (k, line) in layout.summary_lines.iter().enumerate() {
        let at = DVec2::new(left, layout.summary_base(k));
        text::draw(canvas, line, at, TextStyle::new(layout::SUMMARY_PX, INK, Align::Left));
    }
}

/// Draws the colour scale.
pub(crate) fn draw_legend(canvas: &mut Canvas, layout: &Layout, legend: &Legend<'_>) {
    let ([x, y], [w, h]) = (layout.legend_corner, layout.legend_size);
    for column in 0..w {
        let colour = colour_map::colour((column as f64 + 0.5) / w as f64);
        canvas.fill([x + column, y], [1, h], colour);
    }
    let top = y as f64;
    let place = |share: f64| (x as f64 + share * w as f64).floor() + 0.5;
    for &share in &legend.marks {
        let ends = [DVec2::new(place(share), top), DVec2::new(place(share), top + h as f64)];
        canvas.stroke(&[ends], 1.0, colour_map::ink_on(colour_map::colour(share)));
    }
    let style = TextStyle::new(layout::SMALL_PX, SOFT_INK, Align::Centre);
    let below = top + h as f64;
    let mut free_from = f64::NEG_INFINITY;
    for (share, number) in &legend.ticks {
        let column = place(*share);
        let tick = [DVec2::new(column, below + 1.0), DVec2::new(column, below + 5.0)];
        canvas.stroke(&[tick], 1.0, SOFT_INK);
        let half_px = 0.5 * text::width_px(number, layout::SMALL_PX);
        if column - half_px > free_from {
            text::draw(canvas, number, DVec2::new(column, below + 19.5), style);
            free_from = column + half_px + 8.0;
        }
    }
    let unit = TextStyle::new(layout::SUMMARY_PX, INK, Align::Left);
    let base = top + 0.5 * (h as f64 + layout::SUMMARY_PX);
    text::draw(canvas, legend.unit, DVec2::new((x + w) as f64 + 10.0, base), unit);
}

/// Draws how the numbers were made, and what restricts them.
pub(crate) fn draw_footer(canvas: &mut Canvas, layout: &Layout, caption: &Caption<'_>) {
    let lines: [(&str, Colour); 2] = [(caption.method, SOFT_INK), (caption.caution, CAUTION_INK)];
    for (k, (line, colour)) in lines.into_iter().enumerate() {
        let line = text::fitted(line, layout::SMALL_PX, layout.content_width());
        let style = TextStyle::new(layout::SMALL_PX, colour, Align::Left);
        text::draw(canvas, &line, DVec2::new(layout.content_left(), layout.footer_base(k)), style);
    }
}
