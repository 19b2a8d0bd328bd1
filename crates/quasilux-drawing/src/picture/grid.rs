//! The false-colour picture of a grid with its axes and legend.

use super::axis::{Axis, Edge};
use super::caption::Caption;
use super::cells::GridPicture;
use super::frame::{self, Legend, LegendTarget, TARGET_DIGITS};
use super::layout::{self, Layout};
use super::plan::north;
use super::plot;
use super::scale::ValueScale;
use super::window::Window;
use crate::drawing::Drawing;
use crate::number::brief;
use crate::style::{Anchor, GREY, Stroke, TextStyle};
use crate::text::width_px;
use glam::{DVec2, DVec3};

/// The middle of the pointer to the north, from the upper right corner of the content.
const NORTH_PX: DVec2 = DVec2::new(34.0, 42.0);
const TICK: Stroke = Stroke::solid(GREY, 1.0);

/// Draws a grid in false colours.
///
/// # Panics
/// If the number of cells is not the product of the counts.
#[must_use]
pub fn grid(grid: &GridPicture<'_>) -> Drawing {
    let [columns, rows] = grid.counts.map(|n| n as usize);
    assert_eq!(grid.cells.len(), columns * rows, "cells of another grid");
    let shared = if grid.scale_cells.is_empty() { grid.cells } else { grid.scale_cells };
    let scale = ValueScale::from_cells(shared);
    let window = Window::new(grid);
    let kind = if scale.is_logarithmic() { ", logarithmic scale" } else { "" };
    let method = format!("{}{kind}", grid.caption.method);
    let caption = Caption { method: &method, ..grid.caption };
    let layout = Layout::of_window(&window, grid.edges_m().into(), &caption);
    let mut drawing = frame::titled(&layout, caption.title);
    plot::draw(&mut drawing, &layout, grid, &scale);
    draw_axes(&mut drawing, &layout, grid, &window);
    draw_north(&mut drawing, &layout, grid);
    let levels = scale.levels.iter();
    let legend = Legend {
        unit: grid.unit,
        marks: levels.map(|level| scale.share(level.value)).collect(),
        ticks: scale.ticks.clone(),
        target: grid.target.map(|target| legend_target(grid, &scale, target)),
    };
    frame::draw_legend(&mut drawing, &layout, &legend);
    frame::draw_footer(&mut drawing, &layout);
    drawing
}

/// The target's name, with the number of points that reach it.
fn legend_target(grid: &GridPicture<'_>, scale: &ValueScale, target: f64) -> LegendTarget {
    let reached = grid.cells.iter().filter(|cell| cell.value.is_some_and(|value| value >= target));
    let (reached, all) = (reached.count(), grid.cells.len());
    let text = format!(
        "target {} {}, reached at {reached} of {all} points",
        brief(target, TARGET_DIGITS),
        grid.unit
    );
    LegendTarget { share: scale.holds(target).then(|| scale.share(target)), text }
}

/// Draws a pointer to the north beside a level grid of a project that knows it.
fn draw_north(drawing: &mut Drawing, layout: &Layout, grid: &GridPicture<'_>) {
    let Some(north_deg) = grid.surroundings.north_deg.filter(|_| grid.is_level()) else {
        return;
    };
    let (sin, cos) = libm::sincos(north_deg.to_radians());
    let to = DVec3::new(-sin, cos, 0.0);
    let [u, v] = grid.directions();
    let on_sheet = DVec2::new(to.dot(u), -to.dot(v)).normalize_or(DVec2::NEG_Y);
    let right = layout.content_left() + layout.content_width();
    let at = DVec2::new(right, layout.plot_corner[1] as f64) + NORTH_PX;
    north(drawing, at, on_sheet, "N");
}

fn draw_axes(drawing: &mut Drawing, layout: &Layout, grid: &GridPicture<'_>, window: &Window) {
    let plot = layout.plot();
    let most = |length_px: usize| (length_px / 70).max(2);
    let origin = DVec3::from(grid.origin_m);
    let [u, v] = grid.directions();
    let edge = |direction, axis: usize, name| Edge {
        origin,
        direction,
        shown_m: [window.low_m[axis], window.high_m[axis]],
        name,
    };
    let along = Axis::along_edge(&edge(u, 0, "u"), most(layout.plot_size[0]));
    let across = Axis::along_edge(&edge(v, 1, "v"), most(layout.plot_size[1]));
    let style = |anchor| TextStyle::new(layout::SMALL_PX, GREY, anchor);
    for tick in &along.ticks {
        let [x, bottom] = plot.at([tick.share, 0.0]);
        let x = x.floor() + 0.5;
        drawing.line(&[[x, bottom + 1.0], [x, bottom + 6.0]], TICK);
        let number = tick.label.as_deref().unwrap_or_default();
        drawing.text([x, bottom + 20.5], style(Anchor::Middle), number);
    }
    let [x, bottom] = plot.at([0.5, 0.0]);
    drawing.text([x, bottom + 38.5], style(Anchor::Middle), &along.title);
    let mut widest: f64 = 0.0;
    for tick in &across.ticks {
        let [left, y] = plot.at([0.0, tick.share]);
        let y = y.ceil() - 0.5;
        drawing.line(&[[left - 6.0, y], [left - 1.0, y]], TICK);
        let number = tick.label.as_deref().unwrap_or_default();
        let base = y + 0.5 * layout::capital_px(layout::SMALL_PX);
        drawing.text([left - 10.5, base], style(Anchor::End), number);
        widest = widest.max(width_px(number, layout::SMALL_PX));
    }
    let [left, y] = plot.at([0.0, 0.5]);
    drawing.text([left - 18.5 - widest, y], style(Anchor::Middle).upward(), &across.title);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape;
    use crate::example::{Grid, batwing};
    use crate::picture::{Cell, Surroundings};

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
        let (size, pixels) = decoded(&super::grid(&grid.picture("workplane")).to_png(1.0));
        let layout = Layout::new([5.0, 4.0], &grid.facts);
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
        let (size, pixels) = decoded(&super::grid(&grid.picture("s")).to_png(1.0));
        let layout = Layout::new([2.0, 2.0], &grid.facts);
        let scale = ValueScale::from_cells(&grid.cells);
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

    /// North turns counter-clockwise from +y; a grid may run along other directions.
    #[test]
    fn maps_point_to_the_north() {
        let grid = Grid::new([5.0, 4.0], [10, 8], 0.01, batwing);
        let way = |north_deg, u_m, v_m| {
            let surroundings = Surroundings { north_deg, ..Surroundings::default() };
            let picture = GridPicture { u_m, v_m, surroundings, ..grid.picture("workplane") };
            let layout = Layout::new([5.0, 4.0], &grid.facts);
            let right = layout.content_left() + layout.content_width();
            let middle = DVec2::new(right, layout.plot_corner[1] as f64) + NORTH_PX;
            super::grid(&picture).shapes.into_iter().find_map(|shape| match shape {
                Shape::Text { place_px, text, .. } if text == "N" => {
                    Some((DVec2::from(place_px) - DVec2::Y * 5.0 - middle).normalize())
                }
                _ => None,
            })
        };
        let (x, y, z) = ([5.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0]);
        for (north_deg, to) in [(0.0, [0.0, -1.0]), (90.0, [-1.0, 0.0]), (-90.0, [1.0, 0.0])] {
            let found = way(Some(north_deg), x, y).expect("a pointer");
            assert!(found.distance(DVec2::from(to)) < 0.02, "{north_deg}: {found}");
        }
        let turned = way(Some(0.0), [0.0, 5.0, 0.0], [-4.0, 0.0, 0.0]).expect("a pointer");
        assert!(turned.distance(DVec2::X) < 0.02, "{turned}");
        assert_eq!(way(None, x, y), None);
        assert_eq!(way(Some(0.0), x, z), None);
    }

    #[test]
    fn the_same_grid_gives_the_same_bytes() {
        let [first, second] = [(); 2].map(|()| Grid::new([5.0, 4.0], [24, 20], 0.01, batwing));
        let png = |grid: &Grid| super::grid(&grid.picture("a")).to_png(1.0);
        assert_eq!(png(&first), png(&second));
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
                let ([width, height], _) = decoded(&super::grid(&grid.picture(name)).to_png(1.0));
                assert!((500..1200).contains(&width) && (200..1300).contains(&height));
            }
        }
    }
}
