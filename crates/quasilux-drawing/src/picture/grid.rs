//! The false-colour picture of a grid with its axes and legend.

use super::axis::Axis;
use super::canvas::Canvas;
use super::cells::GridPicture;
use super::colour_map::SOFT_INK;
use super::frame::{self, Legend};
use super::layout::{self, Layout};
use super::plot;
use super::scale::ValueScale;
use super::text::{self, Align, TextStyle};
use glam::{DVec2, DVec3};

/// The picture of a grid as a PNG file.
///
/// # Panics
/// If the number of cells is not the product of the counts.
#[must_use]
pub fn grid_png(grid: &GridPicture<'_>) -> Vec<u8> {
    let [columns, rows] = grid.counts.map(|n| n as usize);
    assert_eq!(grid.cells.len(), columns * rows, "cells of another grid");
    let scale = ValueScale::of(grid.cells);
    let layout = Layout::of(grid.edges_m(), grid.caption.facts);
    let mut canvas = Canvas::new(layout.size[0], layout.size[1]);
    frame::draw_title(&mut canvas, &layout, grid.caption.title);
    plot::draw(&mut canvas, &layout, grid, &scale);
    draw_axes(&mut canvas, &layout, grid);
    frame::draw_legend(&mut canvas, &layout, &legend(&scale, grid.unit));
    frame::draw_footer(&mut canvas, &layout, &grid.caption);
    canvas.to_png()
}

/// The scale as a legend, with the levels of the contour lines.
fn legend<'a>(scale: &ValueScale, unit: &'a str) -> Legend<'a> {
    let share = |value: &f64| scale.share(*value);
    let ticks = scale.ticks.values.iter();
    Legend {
        unit,
        marks: scale.levels.values.iter().map(share).collect(),
        ticks: ticks.map(|value| (share(value), scale.ticks.label(*value))).collect(),
    }
}

fn draw_axes(canvas: &mut Canvas, layout: &Layout, grid: &GridPicture<'_>) {
    let ([x, y], [w, h]) = (layout.plot_corner, layout.plot_size);
    let bottom = (y + h) as f64;
    let most = |length_px: usize| (length_px / 70).max(2);
    let origin = DVec3::from(grid.origin_m);
    let along = Axis::of(origin, DVec3::from(grid.u_m), "u", most(w));
    let across = Axis::of(origin, DVec3::from(grid.v_m), "v", most(h));
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
    use crate::example::{Grid, batwing};
    use crate::picture::Cell;

    /// Decodes a picture: width, height and pixels.
    fn decoded(png: &[u8]) -> ([u32; 2], Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("a frame");
        ([info.width, info.height], pixels)
    }

    #[test]
    fn the_picture_has_the_expected_size_and_proportion() {
        let grid = Grid::new([5.0, 4.0], [24, 20], 0.01, batwing);
        let (size, pixels) = decoded(&grid_png(&grid.picture("workplane")));
        let layout = Layout::of([5.0, 4.0], &grid.facts);
        assert_eq!(layout.plot_size, [900, 720]);
        assert_eq!(size.map(|n| n as usize), layout.size);
        assert_eq!(pixels.len(), 3 * layout.size[0] * layout.size[1]);
    }

    #[test]
    fn a_cell_has_its_colour_and_v_runs_upward() {
        let grid =
            Grid::new(
                [2.0, 2.0],
                [2, 2],
                0.0,
                |x, y| {
                    if x > 0.5 && y > 0.5 { 400.0 } else { 100.0 }
                },
            );
        let (size, pixels) = decoded(&grid_png(&grid.picture("s")));
        let layout = Layout::of([2.0, 2.0], &grid.facts);
        let scale = ValueScale::of(&grid.cells);
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
    fn the_same_grid_gives_the_same_bytes() {
        let [first, second] = [(); 2].map(|()| Grid::new([5.0, 4.0], [24, 20], 0.01, batwing));
        assert_eq!(grid_png(&first.picture("a")), grid_png(&second.picture("a")));
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
                let mut grid = Grid::new(edges_m, counts, *noise, lx);
                grid.cells.iter_mut().for_each(|cell| {
                    let finite = |x: &f64| x.is_finite();
                    *cell = Cell {
                        value: cell.value.filter(finite),
                        half_width: cell.half_width.filter(finite),
                    };
                });
                let ([width, height], _) = decoded(&grid_png(&grid.picture(name)));
                assert!((500..1200).contains(&width) && (200..1300).contains(&height));
            }
        }
    }
}
