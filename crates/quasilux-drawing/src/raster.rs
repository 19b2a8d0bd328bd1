//! The PNG writer of drawings: each shape as pixels of a [`Canvas`], text with the bundled fonts.

use crate::canvas::Canvas;
use crate::drawing::{Drawing, Frame, Shape};
use crate::font::Segment;
use crate::style::{Colour, Stroke};
use crate::text::{self, HALO_PX};
use glam::DVec2;

impl Drawing {
    /// The drawing as a PNG file with `px_per_unit` pixels for each of its own: 1 for a screen, 2
    /// to 4 for print. The same drawing gives the same bytes on every machine.
    #[must_use]
    pub fn to_png(&self, px_per_unit: f64) -> Vec<u8> {
        self.canvas(px_per_unit).to_png()
    }

    pub(crate) fn canvas(&self, px_per_unit: f64) -> Canvas {
        let [width, height] = self.size_px.map(|length| (length * px_per_unit).ceil() as usize);
        let mut painter = Painter { canvas: Canvas::new(width, height), px_per_unit };
        self.shapes.iter().for_each(|shape| painter.shape(shape));
        painter.canvas
    }
}

struct Painter {
    canvas: Canvas,
    px_per_unit: f64,
}

impl Painter {
    fn place(&self, point_px: [f64; 2]) -> DVec2 {
        DVec2::from(point_px) * self.px_per_unit
    }

    fn shape(&mut self, shape: &Shape) {
        let scale = self.px_per_unit;
        match shape {
            Shape::Fill { frame, colour } => self.cells(*frame, 1, &[*colour]),
            Shape::Lines { lines, stroke } => {
                let pieces: Vec<Segment> = lines
                    .iter()
                    .flat_map(|line| {
                        let points: Vec<DVec2> = line.iter().map(|p| self.place(*p)).collect();
                        dashed(&points, *stroke, scale)
                    })
                    .collect();
                self.canvas.stroke(&pieces, stroke.width_px * scale, stroke.colour);
            }
            Shape::Region { outlines, colour } => {
                let pieces: Vec<Segment> = outlines
                    .iter()
                    .flat_map(|outline| outline.windows(2))
                    .map(|pair| [pair[0], pair[1]].map(|end| self.place(end)))
                    .collect();
                self.canvas.fill_outline(&pieces, *colour);
            }
            Shape::Disk { centre_px, radius_px, colour } => {
                let centre = self.place(*centre_px);
                self.canvas.stroke(&[[centre; 2]], 2.0 * radius_px * scale, *colour);
            }
            Shape::Text { place_px, style, text } => {
                let pieces = text::outline(text, self.place(*place_px), style, scale);
                if let Some(halo) = style.halo {
                    self.canvas.stroke(&pieces, HALO_PX * scale, halo);
                }
                self.canvas.fill_outline(&pieces, style.colour);
            }
            Shape::Cells { frame, columns, colours } => self.cells(*frame, *columns, colours),
            Shape::Clipped { frame, shapes } => {
                let [from, to] = self.corners(*frame);
                let before = self.canvas.clip(from, to);
                shapes.iter().for_each(|shape| self.shape(shape));
                self.canvas.restore(before);
            }
        }
    }

    /// The pixels of a rectangle: the first ones and those behind the last ones.
    fn corners(&self, frame: Frame) -> [[usize; 2]; 2] {
        [[0.0, 1.0], [1.0, 0.0]]
            .map(|share| frame.at(share).map(|x| (x * self.px_per_unit).round() as usize))
    }

    /// A pixel has the colour of the cell that its top left corner lies in.
    fn cells(&mut self, frame: Frame, columns: usize, colours: &[Colour]) {
        let [[x0, y0], [x1, y1]] = self.corners(frame);
        let rows = colours.len() / columns.max(1);
        for y in y0..y1 {
            let row = (y - y0) * rows / (y1 - y0);
            for x in x0..x1 {
                let column = (x - x0) * columns / (x1 - x0);
                self.canvas.set(x, y, colours[row * columns + column]);
            }
        }
    }
}

/// Dashes of one line: with more of them, whatever the canvas shows is a small part of the line.
const MAX_DASHES: f64 = 1e5;

/// The pieces of a line in pixels, without gaps where these are too many to draw; the canvas
/// lengthens each by the width of the line (its round ends).
fn dashed(points: &[DVec2], stroke: Stroke, scale: f64) -> Vec<Segment> {
    let lengths = stroke.dash.lengths();
    let segments = points.windows(2).map(|pair| [pair[0], pair[1]]).filter(|[a, b]| a != b);
    let whole: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
    let period = lengths.iter().sum::<f64>() * stroke.width_px * scale;
    if lengths.is_empty() || !whole.is_finite() || whole > MAX_DASHES * period {
        return segments.collect();
    }
    let drawn = |part: usize| {
        let more = if part.is_multiple_of(2) { -1.0 } else { 1.0 };
        (lengths[part] + more) * stroke.width_px * scale
    };
    // A dash or a gap, and what is left of it.
    let (mut part, mut rest) = (0, drawn(0));
    let mut pieces = Vec::new();
    for [from, to] in segments {
        let length = from.distance(to);
        let mut at = 0.0;
        loop {
            let ends_here = at + rest > length;
            let end = if ends_here { length } else { at + rest };
            if part % 2 == 0 {
                pieces.push([at, end].map(|s| from.lerp(to, s / length)));
            }
            rest -= end - at;
            at = end;
            if ends_here {
                break;
            }
            part = (part + 1) % lengths.len();
            rest = drawn(part);
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::Dash;

    #[test]
    fn dashes_cover_their_share_of_a_line() {
        for (dash, [share, period]) in [(Dash::Dashed, [5.0, 8.0]), (Dash::DashDot, [7.0, 11.0])] {
            // The line ends within the last gap.
            let length = 12.0 * 3.0 * period - 0.5;
            let points: Vec<DVec2> =
                (0..=100).map(|i| DVec2::X * f64::from(i) / 100.0 * length).collect();
            let stroke = Stroke { colour: [0; 3], width_px: 1.5, dash };
            let pieces = dashed(&points, stroke, 2.0);
            // Dashes that a point of the line cuts are several pieces without a gap.
            let begun = pieces.windows(2).filter(|pair| pair[0][1].distance(pair[1][0]) > 1e-9);
            let ends = 3.0 * (1 + begun.count()) as f64;
            let drawn: f64 = pieces.iter().map(|[a, b]| a.distance(*b)).sum();
            let expected = length * share / period;
            assert!(((drawn + ends) / expected - 1.0).abs() < 0.01, "{dash:?} {drawn}");
        }
    }

    #[test]
    fn lines_without_number_of_dashes_are_not_broken() {
        let stroke = Stroke { colour: [0; 3], width_px: 1.5, dash: Dash::Dotted };
        for end in [1e12, f64::INFINITY, f64::NAN] {
            let line = [DVec2::ZERO, DVec2::X * end];
            assert_eq!(dashed(&line, stroke, 1.0).len(), 1, "{end}");
        }
        assert!(dashed(&[DVec2::ZERO, DVec2::X * 100.0], stroke, 1.0).len() > 10);
    }

    #[test]
    fn what_is_clipped_stays_in_the_frame() {
        let mut drawing = Drawing::new("", [8.0, 8.0]);
        let all = Frame { corner_px: [0.0, 0.0], size_px: [8.0, 8.0] };
        let frame = Frame { corner_px: [2.0, 3.0], size_px: [4.0, 2.0] };
        drawing.clipped(frame, |drawing| {
            drawing.fill(all, [9; 3]);
            drawing.line(&[[0.0, 0.0], [8.0, 8.0]], Stroke::solid([1; 3], 3.0));
        });
        drawing.fill(Frame { corner_px: [7.0, 7.0], size_px: [1.0, 1.0] }, [7; 3]);
        let canvas = drawing.canvas(2.0);
        let coloured = (0..256).filter(|i| canvas.at(i % 16, i / 16) != [255; 3]);
        assert_eq!(coloured.count(), 4 * 8 + 4);
    }
}
