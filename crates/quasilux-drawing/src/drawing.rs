//! The drawing that all diagrams and pictures build: a list of shapes, without a file format.
//!
//! [`Drawing::to_svg`] and [`Drawing::to_png`] write the same list, as text for print and the web,
//! and as pixels with the bundled fonts.

use crate::style::{Colour, Stroke, TextStyle, WHITE};
use glam::DVec2;

/// Shapes on a white sheet: the origin is at the top left, x runs right, y runs down, lengths are
/// pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    pub(crate) title: String,
    pub(crate) size_px: [f64; 2],
    pub(crate) shapes: Vec<Shape>,
}

/// One shape; coordinates are finite.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// A filled rectangle.
    Fill { frame: Frame, colour: Colour },
    /// Lines of one stroke, each through two or more points, closed where the last equals the
    /// first.
    Lines { lines: Vec<Vec<[f64; 2]>>, stroke: Stroke },
    /// Closed outlines, the last point equal to the first, filled where their winding number is not
    /// zero.
    Region { outlines: Vec<Vec<[f64; 2]>>, colour: Colour },
    /// A filled disk.
    Disk { centre_px: [f64; 2], radius_px: f64, colour: Colour },
    /// A line of text.
    Text { place_px: [f64; 2], style: TextStyle, text: String },
    /// Equal cells that fill a rectangle, row by row from the top left.
    Cells { frame: Frame, columns: usize, colours: Vec<Colour> },
    /// Shapes of which only what is inside the rectangle shows.
    Clipped { frame: Frame, shapes: Vec<Self> },
}

/// A rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The corner at the top left.
    pub corner_px: [f64; 2],
    /// Width and height.
    pub size_px: [f64; 2],
}

impl Frame {
    /// The place at these shares of the width from the left and of the height from the *bottom*.
    #[must_use]
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([left, top], [width, height]) = (self.corner_px, self.size_px);
        [left + x * width, top + (1.0 - y) * height]
    }

    /// The corners in turn, the first again at the end.
    fn outline(self) -> [[f64; 2]; 5] {
        [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0], [0.0, 1.0]].map(|share| self.at(share))
    }
}

impl Drawing {
    /// A white sheet; `title` is what a screen reader says.
    #[must_use]
    pub fn new(title: &str, size_px: [f64; 2]) -> Self {
        let mut drawing = Self { title: title.to_owned(), size_px, shapes: Vec::new() };
        drawing.fill(Frame { corner_px: [0.0, 0.0], size_px }, WHITE);
        drawing
    }

    /// A filled rectangle.
    pub fn fill(&mut self, frame: Frame, colour: Colour) {
        self.shapes.push(Shape::Fill { frame, colour });
    }

    /// The border of a rectangle.
    pub fn outline(&mut self, frame: Frame, stroke: Stroke) {
        self.line(&frame.outline(), stroke);
    }

    /// A line through points; where one is not finite the line is broken.
    pub fn line(&mut self, points_px: &[[f64; 2]], stroke: Stroke) {
        let is_finite = |point: &[f64; 2]| point.iter().all(|x| x.is_finite());
        let lines: Vec<Vec<[f64; 2]>> = points_px
            .split(|point| !is_finite(point))
            .filter(|run| run.len() > 1)
            .map(<[_]>::to_vec)
            .collect();
        if !lines.is_empty() {
            self.shapes.push(Shape::Lines { lines, stroke });
        }
    }

    /// Separate lines of one stroke; where they cross nothing is drawn twice.
    pub(crate) fn lines(&mut self, segments: &[[DVec2; 2]], stroke: Stroke) {
        let finite = segments.iter().filter(|ends| ends.iter().all(|end| end.is_finite()));
        let lines: Vec<Vec<[f64; 2]>> =
            finite.map(|ends| ends.map(|end| end.to_array()).to_vec()).collect();
        if !lines.is_empty() {
            self.shapes.push(Shape::Lines { lines, stroke });
        }
    }

    /// A filled region between closed outlines; what is not finite is left out.
    pub(crate) fn region(&mut self, outlines: &[Vec<DVec2>], colour: Colour) {
        let closed = |outline: &Vec<DVec2>| -> Option<Vec<[f64; 2]>> {
            let first = outline.first().filter(|_| outline.iter().all(|p| p.is_finite()))?;
            Some(outline.iter().chain([first]).map(|p| p.to_array()).collect())
        };
        let outlines: Vec<Vec<[f64; 2]>> = outlines.iter().filter_map(closed).collect();
        if !outlines.is_empty() {
            self.shapes.push(Shape::Region { outlines, colour });
        }
    }

    /// A filled disk; none where its place is not finite.
    pub fn disk(&mut self, centre_px: [f64; 2], radius_px: f64, colour: Colour) {
        if centre_px.iter().all(|x| x.is_finite()) {
            self.shapes.push(Shape::Disk { centre_px, radius_px, colour });
        }
    }

    /// A text on its base line; what stands in `^{..}` is raised.
    pub fn text(&mut self, place_px: [f64; 2], style: TextStyle, text: &str) {
        self.shapes.push(Shape::Text { place_px, style, text: text.to_owned() });
    }

    /// Equal cells in rows from the top left corner of a rectangle, as many a row as `columns`.
    pub fn cells(&mut self, frame: Frame, columns: usize, colours: Vec<Colour>) {
        self.shapes.push(Shape::Cells { frame, columns, colours });
    }

    /// Draws, and shows only what is inside the frame.
    pub fn clipped(&mut self, frame: Frame, draw: impl FnOnce(&mut Self)) {
        let outside = std::mem::take(&mut self.shapes);
        draw(self);
        let shapes = std::mem::replace(&mut self.shapes, outside);
        self.shapes.push(Shape::Clipped { frame, shapes });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_finite_is_not_drawn() {
        let mut drawing = Drawing::new("", [10.0, 10.0]);
        let before = drawing.clone();
        drawing.disk([f64::NAN, 1.0], 1.0, [0; 3]);
        drawing.line(&[[0.0, 0.0], [1.0, f64::INFINITY], [2.0, 2.0]], Stroke::solid([0; 3], 1.0));
        assert_eq!(drawing, before);
    }

    #[test]
    fn clipped_shapes_lie_in_their_clip() {
        let mut drawing = Drawing::new("", [10.0, 10.0]);
        let frame = Frame { corner_px: [2.0, 3.0], size_px: [4.0, 4.0] };
        drawing.clipped(frame, |drawing| drawing.fill(frame, [0; 3]));
        let expected =
            Shape::Clipped { frame, shapes: vec![Shape::Fill { frame, colour: [0; 3] }] };
        assert_eq!(drawing.shapes[1..], [expected]);
    }
}
