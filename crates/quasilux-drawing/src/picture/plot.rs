//! The grid itself: cells, contour lines with their labels, and numbers in the cells.

use super::cells::GridPicture;
use super::colour_map::ink_on;
use super::contour::{Field, Line};
use super::label::{self, LabelPlace};
use super::layout::{Layout, capital_px};
use super::scale::ValueScale;
use crate::canvas::mix;
use crate::drawing::{Drawing, Frame};
use crate::number::{decimal_exponent, to_place};
use crate::style::{Anchor, Colour, GREY, Stroke, TextStyle};
use crate::text::width_px;
use glam::DVec2;

/// Font size of contour labels.
const LABEL_PX: f64 = 14.0;
/// Font sizes tried for the numbers in the cells, the largest that fits is taken.
const NUMBER_PX: [f64; 4] = [16.8, 14.0, 12.6, 11.2];
/// Clear space around a number in its cell in pixels.
const NUMBER_MARGIN_PX: f64 = 6.5;
/// Width of contour lines in pixels.
const LINE_PX: f64 = 1.7;
/// Colour of cells without a value.
const NO_VALUE: Colour = [200, 200, 200];

/// Draws a grid.
pub(crate) fn draw(
    drawing: &mut Drawing,
    layout: &Layout,
    grid: &GridPicture<'_>,
    scale: &ValueScale,
) {
    let frame = layout.plot();
    let plot = Plot {
        counts: grid.counts.map(|n| n as usize),
        frame,
        corner: DVec2::from(frame.corner_px),
        size: DVec2::from(frame.size_px),
        values: grid.cells.iter().map(|cell| cell.value).collect(),
        scale,
    };
    plot.draw_cells(drawing);
    let labels = plot.draw_contours(drawing);
    plot.draw_numbers(drawing, &labels);
    let [[left, top], [width, height]] = [frame.corner_px, frame.size_px];
    let border = Frame { corner_px: [left - 0.5, top - 0.5], size_px: [width + 1.0, height + 1.0] };
    drawing.outline(border, Stroke::solid(GREY, 1.0));
}

struct Plot<'a> {
    counts: [usize; 2],
    frame: Frame,
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

    fn draw_cells(&self, drawing: &mut Drawing) {
        let rows = self.values.chunks(self.counts[0]).rev();
        let colours = rows.flatten().map(|value| self.colour_of(*value)).collect();
        drawing.cells(self.frame, self.counts[0], colours);
    }

    fn draw_contours(&self, drawing: &mut Drawing) -> Vec<LabelPlace> {
        let values: Vec<f64> = self.values.iter().map(|value| value.unwrap_or(f64::NAN)).collect();
        let pieces = (self.cell_px().max_element() / 6.0).round().clamp(1.0, 12.0) as usize;
        let field = Field::of_cells(self.counts, &values).refined(pieces);
        let mut labels: Vec<LabelPlace> = Vec::new();
        for &level in &self.scale.levels.values {
            let ink = ink_on(self.scale.colour(level));
            let number = self.scale.levels.label(level);
            let length_px = width_px(&number, LABEL_PX) + 10.0;
            for line in field.contours(level) {
                let line: Line = line.into_iter().map(|p| self.pixels(p)).collect();
                let place = label::place(&line, length_px, self.size, &labels);
                for part in label::parts(&line, place) {
                    let points: Vec<[f64; 2]> =
                        part.iter().map(|p| (*p + self.corner).to_array()).collect();
                    drawing.line(&points, Stroke::solid(ink, LINE_PX));
                }
                if let Some(place) = place {
                    self.draw_label(drawing, &number, ink, place);
                    labels.push(place);
                }
            }
        }
        labels
    }

    fn draw_label(&self, drawing: &mut Drawing, number: &str, ink: Colour, place: LabelPlace) {
        let direction = place.direction.to_array();
        let style = TextStyle { direction, ..TextStyle::new(LABEL_PX, ink, Anchor::Middle) };
        let down = DVec2::new(-place.direction.y, place.direction.x);
        let base = self.corner + place.centre + down * (0.5 * capital_px(LABEL_PX));
        drawing.text(base.to_array(), style, number);
    }

    fn draw_numbers(&self, drawing: &mut Drawing, labels: &[LabelPlace]) {
        let largest = self.values.iter().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
        let place = decimal_exponent(largest).map_or(0, |e| e - 2).min(0);
        let numbers: Vec<String> = self
            .values
            .iter()
            .map(|value| value.map_or_else(|| "-".into(), |value| to_place(value, place)))
            .collect();
        let room = self.cell_px() - 2.0 * NUMBER_MARGIN_PX;
        let fits = |px: &f64| {
            capital_px(*px) <= room.y && numbers.iter().all(|n| width_px(n, *px) <= room.x)
        };
        let Some(&px) = NUMBER_PX.iter().find(|px| fits(px)) else {
            return;
        };
        for (cell, number) in numbers.iter().enumerate() {
            let [i, j] = [cell % self.counts[0], cell / self.counts[0]];
            let centre = self.pixels(DVec2::new(i as f64 + 0.5, j as f64 + 0.5));
            let half_diagonal = 0.5 * width_px(number, px).max(capital_px(px));
            let is_covered = labels
                .iter()
                .any(|l| l.centre.distance(centre) < l.radius_px + 0.8 * half_diagonal);
            if is_covered {
                continue;
            }
            let colour = self.colour_of(self.values[cell]);
            // A little fainter than the contour lines, which are read first.
            let ink = mix(colour, ink_on(colour), 0.85);
            let style = TextStyle { halo: Some(colour), ..TextStyle::new(px, ink, Anchor::Middle) };
            let below = DVec2::Y * (0.5 * capital_px(px));
            let base = (self.corner + centre + below).round() + DVec2::splat(0.5);
            drawing.text(base.to_array(), style, number);
        }
    }
}
