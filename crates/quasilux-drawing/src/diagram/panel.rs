//! One line plot.

use super::Axis;
use crate::drawing::{Drawing, Frame};
use crate::style::{Anchor, INK, Stroke, TEXT_PX, TextStyle};

/// A plot with two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// What stands above it.
    pub title: String,
    /// The axis that runs to the right.
    pub x: Axis,
    /// The axis that runs up.
    pub y: Axis,
    /// The lines, the last on top.
    pub lines: Vec<Line>,
}

/// A line of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Points (x, y); what an axis cannot show breaks the line.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub stroke: Stroke,
}

const MAX_X_LABELS: usize = 7;
const MAX_Y_LABELS: usize = 6;
const SMALL_PX: f64 = 11.0;
const GRID: Stroke = Stroke::solid([0xe4; 3], 1.0);
const TICK: Stroke = Stroke::solid(INK, 1.0);

impl Panel {
    /// Room that title, ticks and labels take: left, top, right, bottom.
    pub(super) const MARGINS_PX: [f64; 4] = [58.0, 30.0, 14.0, 42.0];

    /// Draws the plot with its axes around `frame`.
    pub(super) fn draw(&self, drawing: &mut Drawing, frame: Frame) {
        self.draw_x_axis(drawing, frame);
        self.draw_y_axis(drawing, frame);
        drawing.clipped(frame, |drawing| {
            for line in &self.lines {
                self.draw_line(drawing, frame, line);
            }
        });
        drawing.outline(frame, TICK);
        let [x, y] = frame.at([0.0, 1.0]);
        drawing.text([x, y - 9.0], TextStyle::plain(Anchor::Start), &self.title);
    }

    fn draw_line(&self, drawing: &mut Drawing, frame: Frame, line: &Line) {
        let place = |[x, y]: &[f64; 2]| frame.at([self.x.share(*x), self.y.share(*y)]);
        let places: Vec<[f64; 2]> = line.points.iter().map(place).collect();
        drawing.line(&places, line.stroke);
    }

    fn draw_x_axis(&self, drawing: &mut Drawing, frame: Frame) {
        let small = TextStyle::new(SMALL_PX, INK, Anchor::Middle);
        for tick in self.x.ticks(MAX_X_LABELS) {
            let [x, bottom] = frame.at([tick.share, 0.0]);
            if let Some(label) = &tick.label {
                let top = frame.at([tick.share, 1.0]);
                drawing.line(&[[x, bottom], top], GRID);
                drawing.text([x, bottom + 17.0], small, label);
            }
            let length_px = if tick.label.is_some() { 4.0 } else { 2.5 };
            drawing.line(&[[x, bottom], [x, bottom + length_px]], TICK);
        }
        if !self.x.label.is_empty() {
            let [x, bottom] = frame.at([0.5, 0.0]);
            let place = [x, bottom + 22.0 + TEXT_PX];
            drawing.text(place, TextStyle::plain(Anchor::Middle), &self.x.label);
        }
    }

    fn draw_y_axis(&self, drawing: &mut Drawing, frame: Frame) {
        let small = TextStyle::new(SMALL_PX, INK, Anchor::End);
        for tick in self.y.ticks(MAX_Y_LABELS) {
            let [left, y] = frame.at([0.0, tick.share]);
            if let Some(label) = &tick.label {
                let right = frame.at([1.0, tick.share]);
                drawing.line(&[[left, y], right], GRID);
                drawing.text([left - 7.0, y + 4.0], small, label);
            }
            let length_px = if tick.label.is_some() { 4.0 } else { 2.5 };
            drawing.line(&[[left, y], [left - length_px, y]], TICK);
        }
        if !self.y.label.is_empty() {
            let [left, y] = frame.at([0.0, 0.5]);
            let style = TextStyle::plain(Anchor::Middle).upward();
            drawing.text([left - 44.0, y], style, &self.y.label);
        }
    }
}
