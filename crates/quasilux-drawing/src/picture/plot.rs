//! The grid itself: cells, contour lines with their labels, and numbers in the cells.

use super::canvas::Canvas;
use super::cells::GridPicture;
use super::colour_map::{Colour, SOFT_INK, ink_on, mix};
use super::contour::{Field, Line};
use super::label::{self, LabelPlace};
use super::layout::Layout;
use super::scale::ValueScale;
use super::text::{self, Align, TextStyle};
use crate::number::{decimal_exponent, to_place};
use glam::DVec2;

/// Height of the capitals of contour labels in pixels.
const LABEL_PX: f64 = 10.0;
/// Heights tried for the numbers in the cells, the largest that fits is taken.
const NUMBER_PX: [f64; 4] = [12.0, 10.0, 9.0, 8.0];
/// Clear space around a number in its cell in pixels.
const NUMBER_MARGIN_PX: f64 = 6.5;
/// Width of contour lines in pixels.
const LINE_PX: f64 = 1.7;
/// Colour of cells without a value.
const NO_VALUE: Colour = [200, 200, 200];

/// Draws a grid.
pub(crate) fn draw(
    canvas: &mut Canvas,
    layout: &Layout,
    grid: &GridPicture<'_>,
    scale: &ValueScale,
) {
    let plot = Plot {
        counts: grid.counts.map(|n| n as usize),
        corner: DVec2::new(layout.plot_corner[0] as f64, layout.plot_corner[1] as f64),
        size: DVec2::new(layout.plot_size[0] as f64, layout.plot_size[1] as f64),
        values: grid.cells.iter().map(|cell| cell.value).collect(),
        scale,
    };
    plot.draw_cells(canvas, layout);
    let labels = plot.draw_contours(canvas);
    plot.draw_numbers(canvas, &labels);
    plot.draw_frame(canvas);
}

struct Plot<'a> {
    counts: [usize; 2],
    corner: DVec2,
    size: DVec2,
    values: Vec<Option<f64>>,
    scale: &'a ValueScale,
}

impl Plot<'_> {
    /// Pixels, from the plot's corner, of a place in cells.
    fn pixels(&self, cells: DVec2) -> DVec2 {
        let counts = DVec2::new(self.counts[0] as f64, self.counts[1] as f64);
        let share = cells / counts;
        DVec2::new(share.x, 1.0 - share.y) * self.size
    }

    fn cell_px(&self) -> DVec2 {
        self.size / DVec2::new(self.counts[0] as f64, self.counts[1] as f64)
    }

    fn colour_of(&self, value: Option<f64>) -> Colour {
        value.map_or(NO_VALUE, |value| self.scale.colour(value))
    }

    fn draw_cells(&self, canvas: &mut Canvas, layout: &Layout) {
        let ([x0, y0], [w, h]) = (layout.plot_corner, layout.plot_size);
        let [columns, rows] = self.counts;
        for y in 0..h {
            let j = rows - 1 - y * rows / h;
            for x in 0..w {
                let i = x * columns / w;
                canvas.set(x0 + x, y0 + y, self.colour_of(self.values[j * columns + i]));
            }
        }
    }

    fn draw_contours(&self, canvas: &mut Canvas) -> Vec<LabelPlace> {
        let values: Vec<f64> = self.values.iter().map(|value| value.unwrap_or(f64::NAN)).collect();
        let pieces = (self.cell_px().max_element() / 6.0).round().clamp(1.0, 12.0) as usize;
        let field = Field::of_cells(self.counts, &values).refined(pieces);
        let mut labels: Vec<LabelPlace> = Vec::new();
        for &level in &self.scale.levels.values {
            let ink = ink_on(self.scale.colour(level));
            let number = self.scale.levels.label(level);
            let length_px = text::width_px(&number, LABEL_PX) + 10.0;
            for line in field.contours(level) {
                let line: Line = line.into_iter().map(|p| self.pixels(p)).collect();
                let place = label::place(&line, length_px, self.size, &labels);
                let mut segments = label::pieces(&line, place);
                segments.iter_mut().flatten().for_each(|p| *p += self.corner);
                canvas.stroke(&segments, LINE_PX, ink);
                if let Some(place) = place {
                    self.draw_label(canvas, &number, ink, place);
                    labels.push(place);
                }
            }
        }
        labels
    }

    fn draw_label(&self, canvas: &mut Canvas, number: &str, ink: Colour, place: LabelPlace) {
        let mut style = TextStyle::new(LABEL_PX, ink, Align::Centre);
        style.direction = place.direction;
        let down = DVec2::new(-place.direction.y, place.direction.x);
        let base = self.corner + place.centre + down * (0.5 * LABEL_PX);
        text::draw(canvas, number, base, style);
    }

    fn draw_numbers(&self, canvas: &mut Canvas, labels: &[LabelPlace]) {
        let largest = self.values.iter().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
        let place = decimal_exponent(largest).map_or(0, |e| e - 2).min(0);
        let numbers: Vec<String> = self
            .values
            .iter()
            .map(|value| value.map_or_else(|| "-".into(), |value| to_place(value, place)))
            .collect();
        let room = self.cell_px() - 2.0 * NUMBER_MARGIN_PX;
        let fits =
            |px: &f64| *px <= room.y && numbers.iter().all(|n| text::width_px(n, *px) <= room.x);
        let Some(&px) = NUMBER_PX.iter().find(|px| fits(px)) else {
            return;
        };
        for (cell, number) in numbers.iter().enumerate() {
            let [i, j] = [cell % self.counts[0], cell / self.counts[0]];
            let centre = self.pixels(DVec2::new(i as f64 + 0.5, j as f64 + 0.5));
            let half_diagonal = 0.5 * text::width_px(number, px).max(px);
            let hidden = labels
                .iter()
                .any(|l| l.centre.distance(centre) < l.radius_px + 0.8 * half_diagonal);
            if hidden {
                continue;
            }
            let colour = self.colour_of(self.values[cell]);
            // A little fainter than the contour lines, which are read first.
            let ink = mix(colour, ink_on(colour), 0.85);
            let style = TextStyle::new(px, ink, Align::Centre);
            let base = (self.corner + centre + DVec2::Y * (0.5 * px)).round() + DVec2::splat(0.5);
            text::draw_on(canvas, number, base, style, colour);
        }
    }

    fn draw_frame(&self, canvas: &mut Canvas) {
        let low = self.corner - 0.5;
        let high = self.corner + self.size + 0.5;
        let corners = [low, DVec2::new(high.x, low.y), high, DVec2::new(low.x, high.y)];
        let sides: Vec<_> = (0..4).map(|k| [corners[k], corners[(k + 1) % 4]]).collect();
        canvas.stroke(&sides, 1.0, SOFT_INK);
    }
}
