//! The grid itself: cells, contour lines with their labels, and numbers in the cells.

use super::cells::GridPicture;
use super::colour_map::ink_on;
use super::contour::{Field, Line};
use super::extremes::{Extreme, Mark, extremes};
use super::label::{self, LabelPlace};
use super::layout::{Layout, capital_px};
use super::overlay;
use super::plan::{Box, Labels};
use super::scale::{Level, ValueScale};
use crate::canvas::mix;
use crate::drawing::{Drawing, Frame};
use crate::number::{brief, decimal_exponent, to_place};
use crate::style::{Anchor, Colour, Dash, GREY, Stroke, TextStyle, WHITE};
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
/// Clear space around a number to other texts.
const NUMBER_CLEAR_PX: f64 = 2.0;
/// Colour of the line of what is required.
const TARGET: Colour = [0xc4, 0x00, 0x1e];
/// Colour of cells without a value.
const NO_VALUE: Colour = [200, 200, 200];

/// Draws a grid.
pub(crate) fn draw(
    drawing: &mut Drawing,
    layout: &Layout,
    grid: &GridPicture<'_>,
    scale: &ValueScale,
) {
    let frame = layout.grid();
    let plot = Plot {
        counts: grid.counts.map(|n| n as usize),
        frame,
        corner: DVec2::from(frame.corner_px),
        size: DVec2::from(frame.size_px),
        values: grid.cells.iter().map(|cell| cell.value).collect(),
        scale,
    };
    plot.draw_cells(drawing);
    overlay::draw(drawing, layout, grid);
    let around = |frame: Frame| {
        let [[left, top], [width, height]] = [frame.corner_px, frame.size_px];
        Frame { corner_px: [left - 0.5, top - 0.5], size_px: [width + 1.0, height + 1.0] }
    };
    drawing.outline(around(frame), Stroke::solid(GREY, 1.0));
    if layout.plot() != frame {
        drawing.outline(around(layout.plot()), Stroke::solid([0xd4; 3], 1.0));
    }
    let mut texts = Texts { boxes: Labels::new(frame), places: Vec::new() };
    let marks = plot.place_extremes(&mut texts.boxes);
    plot.draw_contours(drawing, grid, &mut texts);
    plot.draw_numbers(drawing, &texts);
    marks.iter().for_each(|mark| mark.draw(drawing));
}

/// The texts that others keep clear of.
struct Texts {
    /// Marks of extremes, on the sheet.
    boxes: Labels,
    /// Numbers of contour lines, from the plot's corner.
    places: Vec<LabelPlace>,
}

impl Texts {
    /// Whether a disk around a place, from the plot's corner, is free.
    fn is_free(&self, corner: DVec2, centre: DVec2, radius_px: f64) -> bool {
        let meets =
            |label: &LabelPlace| label.centre.distance(centre) <= label.radius_px + radius_px;
        !self.places.iter().any(meets)
            && !self.boxes.taken().iter().any(|b| b.meets_disk(corner + centre, radius_px))
    }
}

/// How the lines of one level are drawn.
struct LineInk {
    /// From below.
    strokes: Vec<Stroke>,
    text: Colour,
    label: String,
}

impl LineInk {
    fn plain(level: &Level, colour: Colour) -> Self {
        let ink = ink_on(colour);
        Self { strokes: vec![Stroke::solid(ink, LINE_PX)], text: ink, label: level.label.clone() }
    }

    /// The line of what is required: dashed, in a colour of its own, set off from all others.
    fn target(label: String) -> Self {
        let dashes = Stroke { colour: TARGET, width_px: 2.4, dash: Dash::Dashed };
        Self { strokes: vec![Stroke::solid(WHITE, 4.2), dashes], text: TARGET, label }
    }
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

    /// Places the marks of the smallest and the largest value before all other texts.
    fn place_extremes(&self, boxes: &mut Labels) -> Vec<Mark> {
        let found = extremes(&self.values, |value| brief(value, 3));
        let mark = |extreme: &Extreme| {
            let [i, j] = [extreme.cell % self.counts[0], extreme.cell / self.counts[0]];
            let centre = self.pixels(DVec2::new(i as f64 + 0.5, j as f64 + 0.5));
            let colour = self.colour_of(self.values[extreme.cell]);
            Mark::place(boxes, self.corner + centre, colour, &extreme.text)
        };
        found.iter().map(mark).collect()
    }

    fn draw_contours(&self, drawing: &mut Drawing, grid: &GridPicture<'_>, texts: &mut Texts) {
        let values: Vec<f64> = self.values.iter().map(|value| value.unwrap_or(f64::NAN)).collect();
        let pieces = (self.cell_px().max_element() / 6.0).round().clamp(1.0, 12.0) as usize;
        let field = Field::of_cells(self.counts, &values).refined(pieces);
        if let Some(target) = grid.target {
            let label = format!("{} {} required", brief(target, 4), grid.unit);
            let lines = field.contours(target);
            self.draw_level(drawing, lines, &LineInk::target(label), texts);
        }
        for level in &self.scale.levels {
            if grid.target != Some(level.value) {
                let ink = LineInk::plain(level, self.scale.colour(level.value));
                self.draw_level(drawing, field.contours(level.value), &ink, texts);
            }
        }
    }

    /// Draws the lines of one level, with numbers where there is room.
    fn draw_level(
        &self,
        drawing: &mut Drawing,
        lines: Vec<Line>,
        ink: &LineInk,
        texts: &mut Texts,
    ) {
        let length_px = width_px(&ink.label, LABEL_PX) + 10.0;
        for line in lines {
            let line: Line = line.into_iter().map(|p| self.pixels(p)).collect();
            let is_free = |centre, radius| texts.is_free(self.corner, centre, radius);
            let place = label::place(&line, length_px, self.size, is_free);
            for part in label::parts(&line, place) {
                let points: Vec<[f64; 2]> =
                    part.iter().map(|p| (*p + self.corner).to_array()).collect();
                ink.strokes.iter().for_each(|stroke| drawing.line(&points, *stroke));
            }
            if let Some(place) = place {
                self.draw_label(drawing, &ink.label, ink.text, place);
                texts.places.push(place);
            }
        }
    }

    fn draw_label(&self, drawing: &mut Drawing, number: &str, ink: Colour, place: LabelPlace) {
        let direction = place.direction.to_array();
        let halo = (ink == TARGET).then_some(WHITE);
        let style = TextStyle { direction, halo, ..TextStyle::new(LABEL_PX, ink, Anchor::Middle) };
        let down = DVec2::new(-place.direction.y, place.direction.x);
        let base = self.corner + place.centre + down * (0.5 * capital_px(LABEL_PX));
        drawing.text(base.to_array(), style, number);
    }

    fn draw_numbers(&self, drawing: &mut Drawing, texts: &Texts) {
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
            let own = DVec2::new(width_px(number, px), capital_px(px));
            let own = Box::around(self.corner + centre, 0.5 * own + NUMBER_CLEAR_PX);
            let is_crossed = texts
                .places
                .iter()
                .any(|place| own.meets_disk(self.corner + place.centre, place.radius_px));
            if is_crossed || texts.boxes.taken().iter().any(|other| other.overlaps(&own)) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape;
    use crate::example::{Grid, batwing};

    /// The texts in the cells of a picture: boxes of the upright ones, disks of those along lines.
    fn covered(drawing: &Drawing) -> [Vec<Box>; 2] {
        let mut found = [Vec::new(), Vec::new()];
        for shape in &drawing.shapes {
            let Shape::Text { place_px, style, text } = shape else {
                continue;
            };
            let is_value = style.halo.is_some() && style.halo != Some(WHITE);
            let is_along = style.size_px == LABEL_PX && style.anchor == Anchor::Middle;
            if !is_value && !is_along {
                continue;
            }
            let width = width_px(text, style.size_px);
            let right = DVec2::from(style.direction);
            let up = DVec2::new(right.y, -right.x);
            let capital = capital_px(style.size_px);
            let centre = DVec2::from(*place_px) + up * (0.5 * capital);
            let half = 0.5 * (right.abs() * width + up.abs() * capital);
            found[usize::from(is_along)].push(Box::around(centre, half));
        }
        found
    }

    /// Numbers of contour lines and the texts of extremes keep clear of each other and of the values
    /// in the cells.
    #[test]
    fn labels_and_values_do_not_overlap() {
        let fields: [fn(f64, f64) -> f64; 3] =
            [batwing, |x, y| 300.0 + 200.0 * x + 50.0 * y, |x, y| libm::exp(9.0 * x) + y];
        for (k, lx) in fields.into_iter().enumerate() {
            let grid = Grid::new([5.0, 4.0], [20, 16], 0.001, lx);
            let picture = GridPicture { target: Some(420.0), ..grid.picture("workplane") };
            let [values, labels] = covered(&crate::picture::grid(&picture));
            assert!(
                values.len() > 100 && labels.len() > 4,
                "{k}: {} {}",
                values.len(),
                labels.len()
            );
            for (number, label) in labels.iter().enumerate() {
                assert!(!values.iter().any(|value| value.overlaps(label)), "{k}: {label:?}");
                assert!(!labels[..number].iter().any(|l| l.overlaps(label)), "{k}: {label:?}");
            }
        }
    }
}
