//! What the symbols mean, which way the axes run, and how long a metre is.

use super::contents::Contents;
use super::ink;
use super::layout::{LEFT_PX, Layout};
use super::model::PlanLuminaire;
use super::projection::Projection;
use super::symbols::{self, Ink};
use crate::drawing::{Drawing, Frame};
use crate::style::{Anchor, GREY, INK, Stroke, TextStyle};
use crate::text::width_px;
use crate::ticks::Ticks;
use glam::{DVec2, DVec3};

const SYMBOL_PX: f64 = 30.0;
const AFTER_PX: f64 = 22.0;
const LINE_PX: f64 = 26.0;
/// The free corner of the views has the key below compass and scale bar, if it is this wide.
const CORNER_PX: f64 = 330.0;
const IN_CORNER_PX: f64 = 140.0;

/// The middle of the pointer to a turned north, from the corner's own.
const NORTH_PX: DVec2 = DVec2::new(152.0, 44.0);

/// A symbol of the key, drawn around a place.
type Symbol = fn(&mut Drawing, DVec2);

/// The symbols that a picture needs, each with its meaning, broken into lines.
pub(crate) struct Key {
    lines: Vec<Vec<Entry>>,
    is_in_corner: bool,
}

struct Entry {
    symbol: Symbol,
    text: &'static str,
    left_px: f64,
}

impl Key {
    /// The key for a width; in the free corner of the views where it fits.
    pub(crate) fn new(contents: &Contents<'_>, most_px: f64) -> Self {
        let (picture, layout) = (contents.picture, &contents.layout);
        let has_sensors = !picture.grids.is_empty() || !picture.points.is_empty();
        let all: [(bool, &'static str, Symbol); 9] = [
            (!picture.surfaces.triangles.is_empty(), "cut", draw_cut),
            (!picture.surfaces.triangles.is_empty(), "edges", draw_edges),
            (!contents.windows.is_empty(), "window at any height", draw_window),
            (!picture.luminaires.is_empty(), "luminaire: tick to C0, arrow along aim", draw_lamp),
            (!picture.point_lights_m.is_empty(), "point light", draw_star),
            (!picture.area_lights.is_empty(), "luminous surface, arrow where it shines", draw_glow),
            (!picture.grids.is_empty(), "sensor grid, some of its points", draw_grid),
            (has_sensors, "normal toward the viewer", draw_normal),
            (!picture.cameras.is_empty(), "camera", draw_camera),
        ];
        let needed = all.iter().filter(|(is_needed, ..)| *is_needed).count();
        let [wide, high] = layout.corner.size_px;
        let is_in_corner = wide >= CORNER_PX && high >= IN_CORNER_PX + LINE_PX * needed as f64;
        let most_px = if is_in_corner { 0.0 } else { most_px };
        let mut lines: Vec<Vec<Entry>> = vec![Vec::new()];
        let mut left_px = 0.0;
        for (_, text, symbol) in all.into_iter().filter(|(is_needed, ..)| *is_needed) {
            let length = SYMBOL_PX + 8.0 + width_px(text, ink::LABEL_PX) + AFTER_PX;
            if left_px > 0.0 && left_px + length > most_px {
                lines.push(Vec::new());
                left_px = 0.0;
            }
            if let Some(line) = lines.last_mut() {
                line.push(Entry { symbol, text, left_px });
            }
            left_px += length;
        }
        Self { lines, is_in_corner }
    }

    /// The height that it takes below the views.
    pub(crate) fn height_px(&self) -> f64 {
        if self.is_in_corner { 0.0 } else { LINE_PX * self.lines.len() as f64 }
    }

    pub(crate) fn draw(&self, drawing: &mut Drawing, layout: &Layout) {
        let corner = if self.is_in_corner {
            DVec2::from(layout.corner.corner_px) + DVec2::Y * IN_CORNER_PX
        } else {
            DVec2::new(LEFT_PX, layout.bottom_px)
        };
        let style = TextStyle::new(ink::LABEL_PX, GREY, Anchor::Start);
        for (number, line) in self.lines.iter().enumerate() {
            let middle = corner.y + LINE_PX * (number as f64 + 0.5);
            for Entry { symbol, text, left_px } in line {
                let left = corner.x + left_px;
                symbol(drawing, DVec2::new(left + 0.5 * SYMBOL_PX, middle));
                drawing.text([left + SYMBOL_PX + 8.0, middle + 4.6], style, text);
            }
        }
    }
}

fn draw_cut(drawing: &mut Drawing, at: DVec2) {
    drawing.lines(&[[at - DVec2::X * 13.0, at + DVec2::X * 13.0]], ink::CUT);
}

fn draw_edges(drawing: &mut Drawing, at: DVec2) {
    drawing.lines(&[[at - DVec2::X * 13.0, at + DVec2::X * 13.0]], ink::EDGE);
}

fn draw_window(drawing: &mut Drawing, at: DVec2) {
    let line = |reach_px: f64| [[at - DVec2::X * reach_px, at + DVec2::X * reach_px]];
    drawing.lines(&line(13.0), ink::CUT);
    for stroke in [ink::WINDOW_WALL, ink::WINDOW_GAP, ink::WINDOW_GLASS] {
        drawing.lines(&line(9.0), stroke);
    }
}

fn draw_lamp(drawing: &mut Drawing, at: DVec2) {
    let down = DVec3::NEG_Z;
    let lamp = PlanLuminaire {
        name: String::new(),
        position_m: DVec3::ZERO,
        aim: DVec3::new(0.0, -0.5, -0.8).normalize_or(down),
        c0: DVec3::X,
        opening_m: DVec3::new(14.0, 9.0, 0.0),
        is_round: false,
    };
    let projection = Projection {
        right: DVec3::X,
        up: DVec3::Y,
        anchor_m: DVec3::ZERO,
        anchor_px: DVec2::ZERO,
        px_per_m: 1.0,
    };
    symbols::luminaire(drawing, at - DVec2::Y * 3.0, &lamp, &projection, Ink::LAMP);
}

fn draw_star(drawing: &mut Drawing, at: DVec2) {
    symbols::star(drawing, at, Ink::LAMP);
}

fn draw_glow(drawing: &mut Drawing, at: DVec2) {
    let outline = [[-12.0, -6.0], [12.0, -6.0], [12.0, 6.0], [-12.0, 6.0]].map(DVec2::from);
    symbols::polygon(drawing, at, &outline, Ink { fill: ink::GLOW, line: ink::GLOW_LINE });
}

fn draw_grid(drawing: &mut Drawing, at: DVec2) {
    let (corner_px, size_px) = ((at - DVec2::new(13.0, 7.0)).to_array(), [26.0, 14.0]);
    drawing.outline(Frame { corner_px, size_px }, ink::SENSOR_EDGE);
    for x in [-7.0, 0.0, 7.0] {
        drawing.disk([at.x + x, at.y], 1.3, ink::SENSOR);
    }
}

fn draw_normal(drawing: &mut Drawing, at: DVec2) {
    drawing.disk(at.to_array(), 6.0, ink::SENSOR);
    drawing.disk(at.to_array(), 4.7, [255; 3]);
    drawing.disk(at.to_array(), 1.9, ink::SENSOR);
}

fn draw_camera(drawing: &mut Drawing, at: DVec2) {
    let outline = [[-12.0, 0.0], [12.0, -8.0], [12.0, 8.0]].map(DVec2::from);
    symbols::polygon(drawing, at, &outline, Ink { fill: ink::CAMERA_FILL, line: ink::CAMERA_LINE });
    drawing.disk([at.x - 12.0, at.y], 3.5, ink::CAMERA);
}

/// Draws the directions of x, y and north, and a scale bar into the free corner of the views.
pub(crate) fn compass_and_scale(drawing: &mut Drawing, layout: &Layout, north_deg: f64) {
    let is_turned = north_deg.rem_euclid(360.0) != 0.0;
    let corner = DVec2::from(layout.corner.corner_px);
    let stroke = Stroke::solid(INK, 1.6);
    let origin = corner + DVec2::new(12.0, 70.0);
    let style = |size_px, anchor| TextStyle::new(size_px, INK, anchor);
    let along_y = if is_turned { "y" } else { "y, north" };
    for (to, name, aside) in [([0.0, -54.0], along_y, [10.0, 8.0]), ([54.0, 0.0], "x", [9.0, 5.0])]
    {
        let tip = origin + DVec2::from(to);
        symbols::pointer(drawing, origin, tip, stroke);
        let base = tip + DVec2::from(aside);
        drawing.text(base.to_array(), style(14.0, Anchor::Start), name);
    }
    if is_turned {
        let (sin, cos) = libm::sincos(north_deg.to_radians());
        symbols::north(drawing, corner + NORTH_PX, DVec2::new(-sin, -cos), "north");
    }
    draw_scale(drawing, layout, corner);
}

/// Draws a bar of round lengths.
fn draw_scale(drawing: &mut Drawing, layout: &Layout, corner: DVec2) {
    let style = |size_px, anchor| TextStyle::new(size_px, INK, anchor);
    let px_per_m = layout.views[0].projection.px_per_m;
    let most_m = (layout.corner.size_px[0] - 40.0).clamp(60.0, 190.0) / px_per_m;
    let ticks = Ticks::within(0.0, most_m, 4, 0.0);
    let (Some(&unit_m), Some(&end_m)) = (ticks.values.get(1), ticks.values.last()) else {
        return;
    };
    let at = corner + DVec2::new(12.0, 112.0);
    let bar = |from_m: f64, to_m: f64| Frame {
        corner_px: (at + DVec2::X * from_m * px_per_m).to_array(),
        size_px: [(to_m - from_m) * px_per_m, 6.0],
    };
    for (k, &from_m) in ticks.values.iter().enumerate() {
        if from_m < end_m && k % 2 == 0 {
            drawing.fill(bar(from_m, (from_m + unit_m).min(end_m)), INK);
        }
        let unit = if from_m == end_m { " m" } else { "" };
        let place = at + DVec2::new(from_m * px_per_m, -5.0);
        let text = format!("{}{unit}", ticks.label(from_m));
        drawing.text(place.to_array(), style(12.0, Anchor::Middle), &text);
    }
    drawing.outline(bar(0.0, end_m), Stroke::solid(INK, 1.0));
}
