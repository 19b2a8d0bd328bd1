//! Pictures: false colours with a scale for grids and cameras, and what a camera sees, alone or side by side.
//!
//! The false-colour picture of a grid has flat cells in true proportion, contour lines at round
//! illuminances, the number of each cell where it fits, axes in metres and a legend in lux.
//! Cells show what was computed, one value each; only the contour lines interpolate (bilinear between
//! cell centres, on straight on to the border).

mod axis;
mod camera;
mod canvas;
mod colour_map;
mod contour;
mod frame;
mod glyphs;
mod label;
mod layout;
mod luminance_scale;
mod plot;
mod scale;
mod series;
mod text;
mod tone_map;

pub use camera::camera_false_colour_png;
pub use series::{SeriesPicture, series_png};
pub use tone_map::tone_mapped_png;

use crate::number::figure_text;
use crate::{Figure, Report, SensorReport};
use axis::Axis;
use canvas::Canvas;
use colour_map::Colour;
use frame::Legend;
use glam::DVec2;
use layout::Layout;
use scale::LuxScale;
use std::ops::RangeInclusive;
use text::{Align, TextStyle};

/// Colour of titles.
const INK: Colour = [24, 24, 24];
/// Colour of axes and remarks.
const SOFT_INK: Colour = [96, 96, 96];
/// Colour of what a reader must not miss.
const CAUTION_INK: Colour = [168, 52, 0];

/// The picture of a grid as a PNG file; `None` for a sensor that is not a grid.
///
/// The first edge of the rectangle runs to the right, the second one upward.
#[must_use]
pub fn false_colour_png(sensor: &SensorReport, report: &Report) -> Option<Vec<u8>> {
    let grid = sensor.grid?;
    let scale = LuxScale::of(sensor);
    let layout = Layout::of(grid.u.length(), grid.v.length(), &summary(sensor));
    let mut canvas = Canvas::new(layout.size[0], layout.size[1]);
    frame::draw_title(&mut canvas, &layout, &sensor.name);
    plot::draw(&mut canvas, &layout, sensor, &scale);
    draw_axes(&mut canvas, &layout, &grid);
    frame::draw_legend(&mut canvas, &layout, &legend(&scale));
    frame::draw_footer(&mut canvas, &layout, report, samples(sensor));
    Some(canvas.to_png())
}

/// The fewest and the most indices a replicate behind a point: points that are done get no more.
fn samples(sensor: &SensorReport) -> RangeInclusive<u64> {
    let samples = || sensor.points.iter().map(|point| point.samples);
    samples().min().unwrap_or(0)..=samples().max().unwrap_or(0)
}

/// The scale as a legend, with the levels of the contour lines.
fn legend(scale: &LuxScale) -> Legend {
    let share = |lx: &f64| scale.share(*lx);
    let ticks = scale.ticks.values.iter();
    Legend {
        unit: "lx",
        marks: scale.levels.values.iter().map(share).collect(),
        ticks: ticks.map(|lx| (share(lx), scale.ticks.label(*lx))).collect(),
    }
}

/// The figures under the title, each as one piece of text.
fn summary(sensor: &SensorReport) -> Vec<String> {
    let piece = |name: &str, figure: Figure, unit: &str| {
        format!("{name} {}{unit}", figure_text(figure).joined())
    };
    let summary = &sensor.summary;
    vec![
        piece("average", summary.average_lx, " lx"),
        piece("minimum", summary.minimum_lx, " lx"),
        piece("maximum", summary.maximum_lx, " lx"),
        piece("uniformity", summary.uniformity, ""),
    ]
}

fn draw_axes(canvas: &mut Canvas, layout: &Layout, grid: &quasilux_scene::Grid) {
    let ([x, y], [w, h]) = (layout.plot_corner, layout.plot_size);
    let bottom = (y + h) as f64;
    let most = |length_px: usize| (length_px / 70).max(2);
    let along = Axis::of(grid.origin, grid.u, "u", most(w));
    let across = Axis::of(grid.origin, grid.v, "v", most(h));
    let mut style = TextStyle::new(layout::SMALL_PX, SOFT_INK, Align::Centre);
    for (share, number) in &along.ticks {
        let column = (x as f64 + share * w as f64).floor() + 0.5;
        let ends = [DVec2::new(column, bottom + 1.0), DVec2::new(column, bottom + 6.0)];
        canvas.stroke(&[ends], 1.0, SOFT_INK);
        text::draw(canvas, number, DVec2::new(column, bottom + 20.5), style);
    }
    let middle = DVec2::new(x as f64 + 0.5 * w as f64, bottom + 38.5);
    text::draw(canvas, &along.title, middle, style);
    style.align = Align::Right;
    let mut widest: f64 = 0.0;
    for (share, number) in &across.ticks {
        let row = (bottom - share * h as f64).ceil() - 0.5;
        let left = x as f64;
        canvas.stroke(&[[DVec2::new(left - 6.0, row), DVec2::new(left - 1.0, row)]], 1.0, SOFT_INK);
        let base = DVec2::new(left - 10.5, row + 0.5 * layout::SMALL_PX);
        text::draw(canvas, number, base, style);
        widest = widest.max(text::width_px(number, layout::SMALL_PX));
    }
    style.align = Align::Centre;
    style.direction = DVec2::NEG_Y;
    let at = DVec2::new(x as f64 - 18.5 - widest, bottom - 0.5 * h as f64);
    text::draw(canvas, &across.title, at, style);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::{batwing, grid, office, report_of};

    /// Decodes a picture: width, height and pixels.
    fn decoded(png: &[u8]) -> ([u32; 2], Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("a frame");
        ([info.width, info.height], pixels)
    }

    #[test]
    fn the_picture_has_the_expected_size_and_proportion() {
        let report = office();
        let png = false_colour_png(&report.sensors[0], &report).expect("a grid");
        let (size, pixels) = decoded(&png);
        let layout = Layout::of(5.0, 4.0, &summary(&report.sensors[0]));
        assert_eq!(layout.plot_size, [900, 720]);
        assert_eq!(size.map(|n| n as usize), layout.size);
        assert_eq!(pixels.len(), 3 * layout.size[0] * layout.size[1]);
    }

    #[test]
    fn a_cell_has_its_colour_and_v_runs_upward() {
        let report = report_of("s", grid([2.0, 2.0], [2, 2]), 0.0, |x, y| {
            if x > 0.5 && y > 0.5 { 400.0 } else { 100.0 }
        });
        let sensor = &report.sensors[0];
        let (size, pixels) = decoded(&false_colour_png(sensor, &report).expect("a grid"));
        let layout = Layout::of(2.0, 2.0, &summary(sensor));
        let scale = LuxScale::of(sensor);
        let at = |x: usize, y: usize| {
            let [left, top] = layout.plot_corner;
            let index = 3 * ((top + y) * size[0] as usize + left + x);
            [pixels[index], pixels[index + 1], pixels[index + 2]]
        };
        assert_eq!(at(880, 20), scale.colour(400.0));
        for (x, y) in [(20, 20), (20, 880), (880, 880)] {
            assert_eq!(at(x, y), scale.colour(100.0));
        }
    }

    #[test]
    fn points_have_no_picture() {
        let report = office();
        assert!(false_colour_png(&report.sensors[1], &report).is_none());
    }

    #[test]
    fn the_same_report_gives_the_same_bytes() {
        let [first, second] = [office(), office()];
        assert_eq!(
            false_colour_png(&first.sensors[0], &first),
            false_colour_png(&second.sensors[0], &second)
        );
    }

    #[test]
    fn odd_grids_do_not_break() {
        let grids = [
            ([1.0, 1.0], [1, 1]),
            ([50.0, 2.0], [50, 2]),
            ([2.0, 50.0], [2, 50]),
            ([1e4, 1e-3], [7, 1]),
            ([3.0, 2.0], [1, 30]),
            ([4.0, 3.0], [100, 80]),
        ];
        type Lux<'a> = &'a dyn Fn(f64, f64) -> f64;
        let fields: [(&str, f64, Lux); 8] = [
            ("", 0.0, &|_, _| 500.0),
            ("noisy", 0.5, &|_, _| 500.0),
            ("batwing", 0.01, &batwing),
            ("negative", 0.0, &|x, y| x - y),
            ("dark", 0.0, &|_, _| 0.0),
            ("holes", 0.0, &|x, _| if x < 0.5 { f64::NAN } else { x }),
            ("infinite", 0.0, &|_, _| f64::INFINITY),
            (&"long name ".repeat(40), 0.01, &|x, y| 1e9 * (x + y * y)),
        ];
        for (g, (edges_m, counts)) in grids.into_iter().enumerate() {
            // Every other pair: each grid meets half of the fields, each field half of the grids.
            for (name, noise, lx) in fields.iter().skip(g % 2).step_by(2) {
                let report = report_of(name, grid(edges_m, counts), *noise, lx);
                let png = false_colour_png(&report.sensors[0], &report).expect("a grid");
                let ([width, height], _) = decoded(&png);
                assert!((500..1200).contains(&width) && (200..1300).contains(&height));
            }
        }
    }
}
