//! The hours of a year as a picture in false colours: a column a day, the clock upward.

use super::caption::Caption;
use super::cells::Cell;
use super::frame::{self, Legend};
use super::layout::{self, Layout};
use super::plot::NO_VALUE;
use super::scale::ValueScale;
use crate::drawing::Drawing;
use crate::style::{Anchor, Colour, GREY, Stroke, TextStyle};

/// Hours of a year to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct YearPicture<'a> {
    /// The words around the picture.
    pub caption: Caption<'a>,
    /// Unit of the values.
    pub unit: &'a str,
    /// Intervals of a day.
    pub a_day: usize,
    /// Values in the order of time, day by day; `None` where none is known.
    pub values: &'a [Option<f64>],
    /// The month of each day, from 1.
    pub months: &'a [u32],
}

/// Size of a day in pixels: its width and its height.
const DAY_PX: [usize; 2] = [3, 360];
/// Between two numbers of the clock, in h.
const CLOCK_STEP_H: usize = 6;
const TICK: Stroke = Stroke::solid(GREY, 1.0);
/// Darkness, told from little light.
const DARK: Colour = [24, 20, 32];

const MONTHS: [&str; 12] =
    ["Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"];

/// Draws the hours of a year.
///
/// # Panics
/// If the number of values is not that of days times intervals, or there are none.
#[must_use]
pub fn year(picture: &YearPicture<'_>) -> Drawing {
    let &YearPicture { caption, unit, a_day, values, months } = picture;
    let days = months.len();
    assert!(days > 0 && values.len() == days * a_day, "hours of other days");
    let lit: Vec<Cell> = values
        .iter()
        .filter(|value| value.is_some_and(|value| value > 0.0))
        .map(|value| Cell { value: *value, half_width: None })
        .collect();
    let scale = ValueScale::from_cells(&lit);
    let row_px = (DAY_PX[1] / a_day).max(1);
    let plot_size = [DAY_PX[0] * days, row_px * a_day];
    let kind = if scale.is_logarithmic() { ", logarithmic scale" } else { "" };
    let method = format!("{}{kind}", caption.method);
    let layout = Layout::with_axes_around(plot_size, &Caption { method: &method, ..caption });
    let mut drawing = frame::titled(&layout, caption.title);
    let colour = |value: Option<f64>| match value {
        None => NO_VALUE,
        Some(value) if value > 0.0 => scale.colour(value),
        Some(_) => DARK,
    };
    // Rows run downward from midnight at the top of the clock.
    let rows = (0..a_day).rev();
    let colours =
        rows.flat_map(|hour| (0..days).map(move |day| colour(values[day * a_day + hour])));
    drawing.cells(layout.plot(), days, colours.collect());
    draw_axes(&mut drawing, &layout, months);
    let legend = Legend { unit, marks: Vec::new(), ticks: scale.ticks.clone(), target: None };
    frame::draw_legend(&mut drawing, &layout, &legend);
    frame::draw_footer(&mut drawing, &layout);
    drawing
}

fn draw_axes(drawing: &mut Drawing, layout: &Layout, months: &[u32]) {
    let plot = layout.plot();
    let style = |anchor| TextStyle::new(layout::SMALL_PX, GREY, anchor);
    let days = months.len() as f64;
    let mut first = 0;
    for of_month in months.chunk_by(|a, b| a == b) {
        let last = first + of_month.len();
        let [x, bottom] = plot.at([first as f64 / days, 0.0]);
        drawing.line(&[[x + 0.5, bottom + 1.0], [x + 0.5, bottom + 6.0]], TICK);
        let [middle, _] = plot.at([0.5 * (first + last) as f64 / days, 0.0]);
        let name = (of_month[0] as usize).checked_sub(1).and_then(|month| MONTHS.get(month));
        if of_month.len() > 9 {
            drawing.text([middle, bottom + 20.5], style(Anchor::Middle), name.unwrap_or(&""));
        }
        first = last;
    }
    for hour in (0..=24).step_by(CLOCK_STEP_H) {
        let [left, y] = plot.at([0.0, f64::from(hour as u32) / 24.0]);
        let y = y.ceil() - 0.5;
        drawing.line(&[[left - 6.0, y], [left - 1.0, y]], TICK);
        let base = y + 0.5 * layout::capital_px(layout::SMALL_PX);
        drawing.text([left - 10.5, base], style(Anchor::End), &hour.to_string());
    }
    let [left, y] = plot.at([0.0, 0.5]);
    drawing.text([left - 36.5, y], style(Anchor::Middle).upward(), "clock (h)");
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn midnight_is_at_the_bottom_and_noon_has_its_colour() {
        let months: Vec<u32> = (0..365).map(|day| 1 + day / 31).collect();
        let value = |hour: usize| match hour {
            12 => Some(400.0),
            3 => None,
            0..6 => Some(0.0),
            _ => Some(100.0),
        };
        let values: Vec<Option<f64>> = (0..8760).map(|hour| value(hour % 24)).collect();
        let caption = Caption { title: "a year", ..Caption::default() };
        let picture =
            YearPicture { caption, unit: "lx", a_day: 24, values: &values, months: &months };
        let drawing = year(&picture);
        let png = drawing.to_png(1.0);
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let width = reader.next_frame(&mut pixels).unwrap().width as usize;
        let layout = Layout::with_axes_around([1095, 360], &Caption::default());
        let [left, top] = layout.plot_corner;
        let at = |x: usize, y: usize| {
            let index = 3 * ((top + y) * width + left + x);
            [pixels[index], pixels[index + 1], pixels[index + 2]]
        };
        assert_eq!(at(500, 355), DARK);
        assert_eq!(at(500, 360 - 15 * 3 - 7), NO_VALUE);
        assert_ne!(at(500, 360 - 15 * 12 - 7), at(500, 360 - 15 * 13 - 7));
    }
}
