//! Line plots in rows and columns, with one legend for all.

use super::Panel;
use super::legend::{self, LegendEntry};
use crate::drawing::{Drawing, Frame};
use crate::style::{Anchor, INK, TextStyle};

/// A figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// What stands above it.
    pub title: String,
    /// The plots, row by row.
    pub panels: Vec<Panel>,
    /// How many plots stand side by side.
    pub columns: usize,
    /// Rows of the legend, each a list of lines with their meanings.
    pub legend: Vec<Vec<LegendEntry>>,
}

const PANEL_PX: [f64; 2] = [248.0, 176.0];
const TITLE_PX: f64 = 34.0;
const LEGEND_ROW_PX: f64 = 20.0;

/// Draws a figure.
#[must_use]
pub fn figure(figure: &Figure) -> Drawing {
    let [left, top, right, bottom] = Panel::MARGINS_PX;
    let columns = figure.columns.max(1);
    let rows = figure.panels.len().div_ceil(columns);
    let pitch = [PANEL_PX[0] + left + right, PANEL_PX[1] + top + bottom];
    let panels_end = TITLE_PX + rows as f64 * pitch[1];
    let legend_px = figure.legend.len() as f64 * LEGEND_ROW_PX + 22.0;
    let size_px = [columns as f64 * pitch[0], panels_end + legend_px];
    let mut drawing = Drawing::new(&figure.title, size_px);
    let style = TextStyle::new(15.0, INK, Anchor::Start);
    drawing.text([left, 24.0], style, &figure.title);
    for (i, panel) in figure.panels.iter().enumerate() {
        let (column, row) = ((i % columns) as f64, (i / columns) as f64);
        let corner_px = [column * pitch[0] + left, TITLE_PX + row * pitch[1] + top];
        panel.draw(&mut drawing, Frame { corner_px, size_px: PANEL_PX });
    }
    for (row, entries) in figure.legend.iter().enumerate() {
        let y = panels_end + 12.0 + (row as f64 + 0.5) * LEGEND_ROW_PX;
        legend::draw_row(&mut drawing, [left, y], entries);
    }
    drawing
}
