//! Line plots in rows and columns, with one legend for all.

use super::Panel;
use super::drawing::{Drawing, Frame};
use super::style::{Anchor, Stroke, TextStyle, room_px};

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

/// What a line means.
#[derive(Clone, Debug, PartialEq)]
pub struct LegendEntry {
    /// The meaning; a heading where there is no line.
    pub text: String,
    /// How the line is drawn.
    pub stroke: Option<Stroke>,
}

const PANEL_PX: [f64; 2] = [248.0, 176.0];
const TITLE_PX: f64 = 34.0;
const LEGEND_ROW_PX: f64 = 20.0;
const LEGEND_LINE_PX: f64 = 30.0;

/// The figure as an SVG file.
#[must_use]
pub fn figure(figure: &Figure) -> String {
    let [left, top, right, bottom] = Panel::MARGINS_PX;
    let columns = figure.columns.max(1);
    let rows = figure.panels.len().div_ceil(columns);
    let pitch = [PANEL_PX[0] + left + right, PANEL_PX[1] + top + bottom];
    let panels_end = TITLE_PX + rows as f64 * pitch[1];
    let legend_px = figure.legend.len() as f64 * LEGEND_ROW_PX + 22.0;
    let mut drawing = Drawing::new([columns as f64 * pitch[0], panels_end + legend_px]);
    let style = TextStyle { size_px: 15.0, ..TextStyle::plain(Anchor::Start) };
    drawing.text([left, 24.0], style, &figure.title);
    for (i, panel) in figure.panels.iter().enumerate() {
        let (column, row) = ((i % columns) as f64, (i / columns) as f64);
        let corner_px = [column * pitch[0] + left, TITLE_PX + row * pitch[1] + top];
        panel.draw(&mut drawing, Frame { corner_px, size_px: PANEL_PX });
    }
    for (row, entries) in figure.legend.iter().enumerate() {
        let y = panels_end + 12.0 + (row as f64 + 0.5) * LEGEND_ROW_PX;
        draw_legend_row(&mut drawing, [left, y], entries);
    }
    drawing.finish(&figure.title)
}

fn draw_legend_row(drawing: &mut Drawing, [left, y]: [f64; 2], entries: &[LegendEntry]) {
    let style = TextStyle::plain(Anchor::Start);
    let mut x = left;
    for entry in entries {
        if let Some(stroke) = entry.stroke {
            drawing.line(&[[x, y - 4.0], [x + LEGEND_LINE_PX, y - 4.0]], stroke);
            x += LEGEND_LINE_PX + 6.0;
        }
        drawing.text([x, y], style, &entry.text);
        x += room_px(&entry.text, style.size_px) + 20.0;
    }
}
