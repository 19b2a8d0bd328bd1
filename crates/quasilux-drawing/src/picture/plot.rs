//! The grid itself: cells, contour lines with their labels, and numbers in the cells.

use super::cells::{Cell, GridPicture};
use super::colour_map::ink_on;
use super::contour::{Field, Line};
use super::extremes::{Bordered, Extreme, Mark, extremes};
use super::frame::{TARGET_DIGITS, TARGET_INK, target_line};
use super::label::{self, LabelPlace};
use super::layout::{Layout, capital_px};
use super::numbers::Numbers;
use super::overlay;
use super::plan::Labels;
use super::scale::{Level, ValueScale};
use super::steady::steady;
use crate::canvas::mix;
use crate::drawing::{Drawing, Frame};
use crate::number::{among_others, brief, shared_place};
use crate::style::{Anchor, Colour, GREY, Stroke, TextStyle, WHITE};
use crate::text::width_px;
use glam::DVec2;

/// Font size of contour labels.
const LABEL_PX: f64 = 13.6;
/// Half the height that a label takes on its line, with clear space.
const LABEL_HALF_PX: f64 = 7.5;
/// Most clear space between a number and the border around it that marks an extreme.
const MARK_CLEAR_PX: DVec2 = DVec2::new(9.0, 9.0);
/// Width of contour lines in pixels.
const LINE_PX: f64 = 1.7;
/// Colour of cells without a value.
pub(super) const NO_VALUE: Colour = [200, 200, 200];

/// Draws a grid.
pub(crate) fn draw(
    drawing: &mut Drawing,
    layout: &Layout,
    grid: &GridPicture<'_>,
    scale: &ValueScale,
) {
    let frame = layout.grid();
    let (counts, size) = (grid.counts.map(|n| n as usize), DVec2::from(frame.size_px));
    let cell_px = size / DVec2::new(counts[0] as f64, counts[1] as f64);
    let values: Vec<Option<f64>> = grid.cells.iter().map(|cell| cell.value).collect();
    let plot = Plot {
        counts,
        frame,
        corner: DVec2::from(frame.corner_px),
        size,
        cell_px,
        numbers: Numbers::fitting(&values, cell_px),
        values,
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
    let mut texts = Texts { boxes: Labels::new(layout.plot()), places: Vec::new() };
    let marks = plot.place_extremes(&mut texts.boxes);
    plot.draw_contours(drawing, grid, &mut texts);
    plot.draw_numbers(drawing, &texts, &marks);
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
    /// Whether a place of a label is clear of marks and other labels.
    fn are_clear_of(&self, corner: DVec2, place: &LabelPlace) -> bool {
        let meets = |other: &LabelPlace| {
            other.centre.distance(place.centre) <= other.radius_px + place.radius_px
        };
        let is_marked =
            |at: DVec2| self.boxes.taken().iter().any(|b| b.meets_disk(corner + at, LABEL_HALF_PX));
        !self.places.iter().any(meets) && !place.disks(LABEL_HALF_PX).any(is_marked)
    }
}

/// How the lines of one level are drawn.
struct LineInk {
    text: Colour,
    halo: Colour,
    label: String,
    is_target: bool,
}

impl LineInk {
    fn plain(level: &Level, colour: Colour) -> Self {
        let label = level.label.clone();
        Self { text: ink_on(colour), halo: colour, label, is_target: false }
    }

    fn target(label: String) -> Self {
        Self { text: TARGET_INK, halo: WHITE, label, is_target: true }
    }

    fn draw(&self, drawing: &mut Drawing, points: &[[f64; 2]]) {
        if self.is_target {
            target_line(drawing, points);
        } else {
            drawing.line(points, Stroke::solid(self.text, LINE_PX));
        }
    }
}

struct Plot<'a> {
    counts: [usize; 2],
    frame: Frame,
    corner: DVec2,
    size: DVec2,
    cell_px: DVec2,
    values: Vec<Option<f64>>,
    /// Where they fit.
    numbers: Option<Numbers>,
    scale: &'a ValueScale,
}

impl Plot<'_> {
    /// Pixels, from the plot's corner, of a place in cells.
    fn pixels(&self, cells: DVec2) -> DVec2 {
        let counts = DVec2::new(self.counts[0] as f64, self.counts[1] as f64);
        let share = cells / counts;
        DVec2::new(share.x, 1.0 - share.y) * self.size
    }

    /// The middle of a cell, from the plot's corner.
    fn centre(&self, cell: usize) -> DVec2 {
        let [i, j] = [cell % self.counts[0], cell / self.counts[0]];
        self.pixels(DVec2::new(i as f64 + 0.5, j as f64 + 0.5))
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
        let place = shared_place(self.values.iter().copied().flatten());
        let found = extremes(&self.values, |value| among_others(value, place));
        let mark = |extreme: &Extreme| {
            let centre = self.corner + self.centre(extreme.cell);
            let colour = self.colour_of(self.values[extreme.cell]);
            let Some(numbers) = &self.numbers else {
                return Mark::ring(boxes, centre, colour, extreme);
            };
            let number = numbers.covered(extreme.cell, centre);
            let border = number.grown(MARK_CLEAR_PX).within(self.cell_px - Mark::BORDER_PX);
            Mark::border(boxes, Bordered { number, border }, colour, extreme)
        };
        found.iter().map(mark).collect()
    }

    fn draw_contours(&self, drawing: &mut Drawing, grid: &GridPicture<'_>, texts: &mut Texts) {
        let values = steady(self.counts, grid.cells);
        let pieces = (self.cell_px.max_element() / 6.0).round().clamp(1.0, 12.0) as usize;
        let field = Field::of_cells(self.counts, &values).refined(pieces);
        if let Some(target) = grid.target {
            let label = brief(target, TARGET_DIGITS);
            let lines = self.certain(field.contours(target), target, grid.cells);
            self.draw_level(drawing, lines, &LineInk::target(label), texts);
        }
        for level in &self.scale.levels {
            if grid.target != Some(level.value) {
                let ink = LineInk::plain(level, self.scale.colour(level.value));
                let lines = self.certain(field.contours(level.value), level.value, grid.cells);
                self.draw_level(drawing, lines, &ink, texts);
            }
        }
    }

    /// The lines of a level without rings in which no cell is known to differ from it.
    fn certain(&self, lines: Vec<Line>, level: f64, cells: &[Cell]) -> Vec<Line> {
        let columns = self.counts[0];
        let differs = |cell: &Cell| {
            let half_width = cell.half_width.unwrap_or(0.0);
            cell.value.is_some_and(|value| (value - level).abs() > half_width)
        };
        let known: Vec<DVec2> = (0..cells.len())
            .filter(|&cell| differs(&cells[cell]))
            .map(|cell| DVec2::new((cell % columns) as f64 + 0.5, (cell / columns) as f64 + 0.5))
            .collect();
        let is_certain = |line: &Line| {
            line.first() != line.last() || known.iter().any(|place| is_inside(line, *place))
        };
        lines.into_iter().filter(is_certain).collect()
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
            let is_clear = |place: &LabelPlace| texts.are_clear_of(self.corner, place);
            let hides_none = |place: &LabelPlace| is_clear(place) && !self.hides_a_number(place);
            let place = label::place(&line, length_px, self.size, hides_none)
                .or_else(|| label::place(&line, length_px, self.size, is_clear));
            for part in label::parts(&line, place) {
                let points: Vec<[f64; 2]> =
                    part.iter().map(|p| (*p + self.corner).to_array()).collect();
                ink.draw(drawing, &points);
            }
            if let Some(place) = place {
                self.draw_label(drawing, ink, place);
                texts.places.push(place);
            }
        }
    }

    fn draw_label(&self, drawing: &mut Drawing, ink: &LineInk, place: LabelPlace) {
        let style = TextStyle {
            direction: place.direction.to_array(),
            halo: Some(ink.halo),
            ..TextStyle::new(LABEL_PX, ink.text, Anchor::Middle)
        };
        let down = DVec2::new(-place.direction.y, place.direction.x);
        let base = self.corner + place.centre + down * (0.5 * capital_px(LABEL_PX));
        drawing.text(base.to_array(), style, &ink.label);
    }

    /// Whether a label covers the number of a cell.
    fn hides_a_number(&self, place: &LabelPlace) -> bool {
        let Some(numbers) = &self.numbers else {
            return false;
        };
        place.disks(LABEL_HALF_PX).any(|at| {
            let [i, j] = (DVec2::new(at.x, self.size.y - at.y) / self.cell_px).to_array();
            let near = |x: f64, count: usize| {
                let x = x.max(0.0) as usize;
                x.saturating_sub(1)..(x + 2).min(count)
            };
            near(j, self.counts[1]).any(|j| {
                near(i, self.counts[0]).any(|i| {
                    let cell = j * self.counts[0] + i;
                    numbers.covered(cell, self.centre(cell)).meets_disk(at, LABEL_HALF_PX)
                })
            })
        })
    }

    fn draw_numbers(&self, drawing: &mut Drawing, texts: &Texts, marks: &[Mark]) {
        let Some(numbers) = &self.numbers else {
            return;
        };
        let places = texts.places.iter();
        let disks = places.flat_map(|place| place.disks(LABEL_HALF_PX).map(|at| self.corner + at));
        let disks: Vec<DVec2> = disks.collect();
        let px = numbers.size_px;
        for (cell, number) in numbers.texts.iter().enumerate() {
            let centre = self.corner + self.centre(cell);
            let own = numbers.covered(cell, centre);
            if disks.iter().any(|at| own.meets_disk(*at, LABEL_HALF_PX))
                || marks.iter().any(|mark| mark.covers(&own))
            {
                continue;
            }
            let colour = self.colour_of(self.values[cell]);
            // A little fainter than the contour lines, which are read first.
            let ink = mix(colour, ink_on(colour), 0.85);
            let style = TextStyle { halo: Some(colour), ..TextStyle::new(px, ink, Anchor::Middle) };
            // Lines end at a number.
            drawing.fill(own.frame(), colour);
            let below = DVec2::Y * (0.5 * capital_px(px));
            let base = (centre + below).round() + DVec2::splat(0.5);
            drawing.text(base.to_array(), style, number);
        }
    }
}

/// Whether a ring goes around a place: a ray from there crosses it an odd number of times.
fn is_inside(ring: &Line, place: DVec2) -> bool {
    let crosses = |side: &&[DVec2]| {
        let [a, b] = [side[0] - place, side[1] - place];
        (a.y > 0.0) != (b.y > 0.0) && (a.x * b.y - b.x * a.y > 0.0) == (b.y > a.y)
    };
    ring.windows(2).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape;
    use crate::example::{Grid, batwing};
    use crate::picture::plan::Box;

    /// The texts over the cells of a picture.
    #[derive(Default)]
    struct DrawnTexts {
        values: Vec<Box>,
        /// Disks along each label, as high as its letters.
        labels: Vec<Vec<DVec2>>,
    }

    const LETTER_HALF_PX: f64 = 5.0;

    fn texts_over(drawing: &Drawing) -> DrawnTexts {
        let mut found = DrawnTexts::default();
        for shape in &drawing.shapes {
            let Shape::Text { place_px, style, text } = shape else {
                continue;
            };
            let is_label = style.size_px == LABEL_PX;
            let is_value = style.halo.is_some() && !is_label;
            let width = width_px(text, style.size_px);
            let right = DVec2::from(style.direction);
            let capital = capital_px(style.size_px);
            let centre = DVec2::from(*place_px) + DVec2::new(right.y, -right.x) * (0.5 * capital);
            if is_value {
                let half = 0.5 * DVec2::new(width, capital);
                found.values.push(Box::around(centre, half));
            } else if is_label {
                let steps = (-8..=8).map(|k| f64::from(k) / 8.0);
                let reach = 0.5 * width - LETTER_HALF_PX;
                found.labels.push(steps.map(|s| centre + right * (reach * s)).collect());
            }
        }
        found
    }

    /// Numbers of contour lines keep clear of each other and of the values in the cells.
    #[test]
    fn labels_and_values_do_not_overlap() {
        let fields: [fn(f64, f64) -> f64; 3] =
            [batwing, |x, y| 300.0 + 200.0 * x + 50.0 * y, |x, y| libm::exp(9.0 * x) + y];
        for (k, lx) in fields.into_iter().enumerate() {
            let grid = Grid::new([5.0, 4.0], [20, 16], 0.001, lx);
            let picture = GridPicture { target: Some(420.0), ..grid.picture("workplane") };
            let DrawnTexts { values, labels } = texts_over(&crate::picture::grid(&picture));
            // Few values give way to labels, and none to nothing.
            assert!(values.len() > 300, "{k}: {} values", values.len());
            let frame = Layout::new([5.0, 4.0], &grid.facts).grid();
            for cell in 0..320_u32 {
                let [i, j] = [cell % 20, cell / 20].map(f64::from);
                let centre = DVec2::from(frame.at([(i + 0.5) / 20.0, (j + 0.5) / 16.0]));
                let is_near = |at: &DVec2| at.distance(centre) < 30.0;
                let has_value = values.iter().any(|value| value.centre().distance(centre) < 2.0);
                assert!(has_value || labels.iter().flatten().any(is_near), "{k}: {i}, {j}");
            }
            assert!(labels.len() > 4, "{k}: {} labels", labels.len());
            for (number, label) in labels.iter().enumerate() {
                let meets =
                    |value: &Box| label.iter().any(|at| value.meets_disk(*at, LETTER_HALF_PX));
                assert!(!values.iter().any(meets), "{k}: {label:?}");
                let near =
                    |at: &DVec2| label.iter().any(|own| own.distance(*at) < 2.0 * LETTER_HALF_PX);
                assert!(!labels[..number].iter().flatten().any(near), "{k}: {label:?}");
            }
        }
    }

    /// Behind each number its cell is as it was before lines went through it.
    #[test]
    fn lines_end_at_numbers() {
        let grid = Grid::new([5.0, 4.0], [20, 16], 0.001, batwing);
        let picture = GridPicture { target: Some(420.0), ..grid.picture("workplane") };
        let shapes = crate::picture::grid(&picture).shapes;
        let scale = ValueScale::from_cells(&grid.cells);
        let values: Vec<&[Shape]> = shapes
            .windows(2)
            .filter(|pair| {
                matches!(&pair[1], Shape::Text { style, .. }
                    if style.halo.is_some() && style.size_px != LABEL_PX)
            })
            .collect();
        assert!(values.len() > 300);
        for pair in values {
            let [Shape::Fill { frame, colour }, Shape::Text { place_px, style, text }] = pair
            else {
                panic!("a number without a ground");
            };
            let value: f64 = text.parse().expect("a number");
            assert!(*colour == style.halo.expect("a halo"), "{value}");
            assert!(grid.cells.iter().any(|it| it.value.map(|x| scale.colour(x)) == Some(*colour)));
            let half = 0.5 * width_px(text, style.size_px);
            let [left, top] = [place_px[0] - half, place_px[1] - capital_px(style.size_px)];
            let [[x, y], [width, height]] = [frame.corner_px, frame.size_px];
            assert!(x < left && y < top && x + width > left + 2.0 * half, "{text}");
            assert!(y + height > place_px[1], "{text}");
        }
    }

    /// A ramp under noise has one line a level, and a cell that may as well lie below a level has
    /// no ring.
    #[test]
    fn noise_has_no_lines() {
        let mut grid =
            Grid::new([5.0, 4.0], [20, 16], 0.0, |x, _| 445.0 + 200.0 * (x - 0.5).max(0.0));
        for (k, cell) in grid.cells.iter_mut().enumerate() {
            let shift = [4.0, -3.0, 1.0, -5.0, 3.0, 0.0, -1.0][k * k % 7];
            *cell = Cell { value: cell.value.map(|lx| lx + shift), half_width: Some(10.0) };
        }
        grid.cells[165].value = Some(454.0);
        let drawing = crate::picture::grid(&grid.picture("workplane"));
        let scale = ValueScale::from_cells(&grid.cells);
        let contours = drawing.shapes.iter().filter_map(|shape| match shape {
            Shape::Lines { lines, stroke } if stroke.width_px == LINE_PX => Some(lines),
            _ => None,
        });
        // A label parts its line in two.
        let count = contours.count();
        assert!(count <= 2 * scale.levels.len(), "{count} of {} levels", scale.levels.len());
    }

    /// The line of a target runs between cells below and above it, over the whole grid, and the
    /// legend names it with the number of points that reach it.
    #[test]
    fn the_target_has_a_line_of_its_own_and_a_name() {
        let grid = Grid::new([5.0, 4.0], [20, 16], 0.001, |x, _| 100.0 + 400.0 * x);
        let picture = GridPicture { target: Some(300.0), ..grid.picture("workplane") };
        let drawing = crate::picture::grid(&picture);
        let dashed = drawing.shapes.iter().filter_map(|shape| match shape {
            Shape::Lines { lines, stroke } if stroke.colour == TARGET_INK => Some((lines, stroke)),
            _ => None,
        });
        let frame = Layout::new([5.0, 4.0], &grid.facts).grid();
        let [x, top] = frame.at([0.5, 1.0]);
        let bottom = frame.at([0.5, 0.0])[1];
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for (lines, stroke) in dashed {
            assert!(stroke.width_px > LINE_PX);
            let over = lines.iter().flatten().filter(|p| (top..=bottom).contains(&p[1]));
            for place in over {
                assert!((place[0] - x).abs() < 1.0, "{place:?}");
                (low, high) = (low.min(place[1]), high.max(place[1]));
            }
        }
        assert!(low < top + 1.0 && high > bottom - 1.0, "{low} {high}");
        let is_there = |drawing: &Drawing, text: &str| drawing.to_svg().contains(text);
        assert!(is_there(&drawing, "target 300 lx, reached at 160 of 320 points"));
        for (target, reached) in [(5.0, 320), (4000.0, 0)] {
            let drawing = crate::picture::grid(&GridPicture { target: Some(target), ..picture });
            let text = format!("target {target} lx, reached at {reached} of 320 points");
            assert!(is_there(&drawing, &text), "{text}");
        }
        let without = crate::picture::grid(&GridPicture { target: None, ..picture });
        assert!(!is_there(&without, "target"));
    }
}
