//! What stands around every false-colour picture: its title, the scale, and how it was made.

use super::canvas::Canvas;
use super::colour_map::{self, Colour};
use super::layout::{self, Layout};
use super::text::{self, Align, TextStyle};
use super::{CAUTION_INK, INK, SOFT_INK};
use crate::Report;
use crate::number::{brief, count};
use glam::DVec2;
use std::ops::RangeInclusive;

/// The labels of a colour scale; places on it are shares of its length.
pub(crate) struct Legend {
    pub(crate) unit: &'static str,
    /// Lines across the scale.
    pub(crate) marks: Vec<f64>,
    /// Ticks below it with their numbers, ascending.
    pub(crate) ticks: Vec<(f64, String)>,
}

/// Draws the title and the figures under it.
pub(crate) fn draw_title(canvas: &mut Canvas, layout: &Layout, name: &str) {
    let left = layout.content_left();
    let title = text::fitted(name, layout::TITLE_PX, layout.content_width());
    let mut style = TextStyle::new(layout::TITLE_PX, INK, Align::Left);
    style.stroke_px = 2.4;
    text::draw(canvas, &title, DVec2::new(left, layout.title_base()), style);
    for (k, line) in layout.summary_lines.iter().enumerate() {
        let at = DVec2::new(left, layout.summary_base(k));
        text::draw(canvas, line, at, TextStyle::new(layout::SUMMARY_PX, INK, Align::Left));
    }
}

/// Draws the colour scale.
pub(crate) fn draw_legend(canvas: &mut Canvas, layout: &Layout, legend: &Legend) {
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

/// How the numbers were made, from so many indices a replicate: they never go without.
pub(crate) fn draw_footer(
    canvas: &mut Canvas,
    layout: &Layout,
    report: &Report,
    samples: RangeInclusive<u64>,
) {
    let run = &report.run;
    let made = format!(
        "quasilux {}: {}, {}, {}, {} x {} samples, {} % intervals",
        run.version,
        run.settings.estimator.name(),
        run.settings.sequence.name(),
        run.settings.randomization.name(),
        run.replicates,
        span(&samples),
        brief(100.0 * run.confidence, 4),
    );
    let caution = if report.biased {
        "values may be biased beyond their intervals"
    } else if run.settings.rel_tol > 0.0 && !run.tolerance_reached {
        "stopped before the wanted tolerance was reached"
    } else {
        ""
    };
    let lines: [(&str, Colour); 2] = [(&made, SOFT_INK), (caution, CAUTION_INK)];
    for (k, (line, colour)) in lines.into_iter().enumerate() {
        let line = text::fitted(line, layout::SMALL_PX, layout.content_width());
        let style = TextStyle::new(layout::SMALL_PX, colour, Align::Left);
        text::draw(canvas, &line, DVec2::new(layout.content_left(), layout.footer_base(k)), style);
    }
}

/// From the fewest to the most, or the one number that both are.
fn span(samples: &RangeInclusive<u64>) -> String {
    let [fewest, most] = [samples.start(), samples.end()].map(|n| count(*n));
    if fewest == most { most } else { format!("{fewest} to {most}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_told_from_the_fewest_to_the_most() {
        assert_eq!(span(&(512..=512)), "512");
        assert_eq!(span(&(128..=2048)), "128 to 2 048");
    }
}
