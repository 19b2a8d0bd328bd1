//! Where everything lies in a picture. All lengths in pixels.

use super::caption::Caption;
use super::window::Window;
use super::words::Words;
pub(crate) use super::words::{SMALL_PX, SUMMARY_PX};
use crate::drawing::Frame;
use crate::font::CAPITAL_EM;
use glam::DVec2;

/// Longer side of the plot.
const PLOT_LONG: f64 = 900.0;
/// The longer side of the grid is at least this, up to a size of the plot.
const MIN_GRID_LONG: f64 = 560.0;
const MAX_PLOT_LONG: f64 = 1400.0;
/// The shorter side is at least this, also where true proportion would make it invisible.
const PLOT_SHORT_LEAST: f64 = 24.0;
/// Everything is at least this wide, so that the figures fit.
const CONTENT_LEAST: usize = 520;
const LEFT: usize = 72;
const RIGHT: usize = 64;
const TOP: usize = 30;
const TITLE: usize = 20;
const SUMMARY_LINE: usize = 22;
const BELOW_PLOT: usize = 62;
const BELOW_PICTURE: usize = 22;
const LEGEND_HEIGHT: usize = 20;
const BELOW_LEGEND: usize = 36;
const FOOTER_LINE: usize = 18;
const BOTTOM: usize = 14;

/// Corners are top left; a size is width and height.
pub(crate) struct Layout {
    pub(crate) size: [usize; 2],
    pub(crate) plot_corner: [usize; 2],
    pub(crate) plot_size: [usize; 2],
    /// What the grid takes of the plot: shares of its width and height from the lower left corner.
    grid_shares: [DVec2; 2],
    pub(crate) legend_corner: [usize; 2],
    pub(crate) legend_size: [usize; 2],
    pub(crate) words: Words,
    content_width: usize,
}

impl Layout {
    /// The layout for a grid that its plot is filled with.
    #[cfg(test)]
    pub(crate) fn new(edges_m: [f64; 2], facts: &[String]) -> Self {
        Self::with_axes(edges_m, PLOT_LONG, &Caption { facts, ..Caption::default() })
    }

    /// The layout for a rectangle with these edges.
    fn with_axes([u_m, v_m]: [f64; 2], long_px: f64, caption: &Caption<'_>) -> Self {
        let px_per_m = long_px / u_m.max(v_m);
        let plot_size =
            [u_m, v_m].map(|edge_m| (edge_m * px_per_m).round().max(PLOT_SHORT_LEAST) as usize);
        Self::around(plot_size, BELOW_PLOT, caption)
    }

    /// The layout of a plot that shows a window around its grid; larger where the grid takes little
    /// of it.
    pub(crate) fn of_window(window: &Window, grid_m: DVec2, caption: &Caption<'_>) -> Self {
        let size_m = window.size_m();
        let grid_shares = [-window.low_m, grid_m - window.low_m].map(|place| place / size_m);
        let long_px = MIN_GRID_LONG * size_m.max_element() / grid_m.max_element();
        let long_px = long_px.clamp(PLOT_LONG, MAX_PLOT_LONG);
        Self { grid_shares, ..Self::with_axes(size_m.to_array(), long_px, caption) }
    }

    /// The layout around a picture of this size without axes.
    pub(crate) fn without_axes(plot_size: [usize; 2], caption: &Caption<'_>) -> Self {
        let mut layout = Self::around(plot_size, BELOW_PICTURE, caption);
        layout.plot_corner[0] = LEFT;
        layout
    }

    /// The layout around a picture of this size with axes.
    pub(crate) fn with_axes_around(plot_size: [usize; 2], caption: &Caption<'_>) -> Self {
        Self::around(plot_size, BELOW_PLOT, caption)
    }

    fn around(plot_size: [usize; 2], below_plot: usize, caption: &Caption<'_>) -> Self {
        let content_width = plot_size[0].max(CONTENT_LEAST);
        let words = Words::new(caption, content_width as f64);
        let more_px = words.head_more_px() as usize;
        let plot_top = TOP + TITLE + more_px + 18 + SUMMARY_LINE * words.facts.len() + 10;
        let plot_corner = [LEFT + (content_width - plot_size[0]) / 2, plot_top];
        let legend_top = plot_top + plot_size[1] + below_plot;
        Self {
            size: [
                LEFT + content_width + RIGHT,
                legend_top
                    + LEGEND_HEIGHT
                    + BELOW_LEGEND
                    + FOOTER_LINE * words.footer_lines()
                    + BOTTOM,
            ],
            plot_corner,
            plot_size,
            grid_shares: [DVec2::ZERO, DVec2::ONE],
            legend_corner: [LEFT, legend_top],
            legend_size: [content_width, LEGEND_HEIGHT],
            words,
            content_width,
        }
    }

    /// The rectangle of the plot.
    pub(crate) fn plot(&self) -> Frame {
        frame(self.plot_corner, self.plot_size)
    }

    /// The rectangle of the grid in the plot.
    pub(crate) fn grid(&self) -> Frame {
        let [low, high] = self.grid_shares.map(|share| share.to_array());
        let [[left, bottom], [right, top]] = [low, high].map(|share| self.plot().at(share));
        Frame { corner_px: [left, top], size_px: [right - left, bottom - top] }
    }

    /// The rectangle of the colour scale.
    pub(crate) fn legend(&self) -> Frame {
        frame(self.legend_corner, self.legend_size)
    }

    pub(crate) fn content_left(&self) -> f64 {
        LEFT as f64
    }

    pub(crate) fn content_width(&self) -> f64 {
        self.content_width as f64
    }

    /// Base line of the title. All base lines lie on pixel centres, so that horizontal strokes are
    /// sharp.
    pub(crate) fn title_base(&self) -> f64 {
        (TOP + TITLE) as f64 + 0.5
    }

    pub(crate) fn summary_base(&self, line: usize) -> f64 {
        self.title_base() + self.words.head_more_px() + (29 + SUMMARY_LINE * line) as f64
    }

    pub(crate) fn footer_base(&self, line: usize) -> f64 {
        let legend_bottom = self.legend_corner[1] + self.legend_size[1];
        (legend_bottom + BELOW_LEGEND + FOOTER_LINE * (line + 1)) as f64 - 2.5
    }
}

fn frame(corner: [usize; 2], size: [usize; 2]) -> Frame {
    Frame { corner_px: corner.map(|x| x as f64), size_px: size.map(|x| x as f64) }
}

/// Height of a capital at a font size.
pub(crate) fn capital_px(size_px: f64) -> f64 {
    CAPITAL_EM * size_px
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn true_proportion() {
        assert_eq!(Layout::new([6.0, 5.0], &[]).plot_size, [900, 750]);
        assert_eq!(Layout::new([0.05, 0.06], &[]).plot_size, [750, 900]);
        assert_eq!(Layout::new([50.0, 2.0], &[]).plot_size, [900, 36]);
    }
}
