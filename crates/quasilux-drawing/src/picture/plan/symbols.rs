//! How lights, sensors and cameras are drawn in a view.

use super::hull::hull;
use super::ink;
use super::labels::Box;
use super::model::{PlanCamera, PlanGrid, PlanLuminaire};
use super::projection::Projection;
use crate::drawing::Drawing;
use crate::style::{Anchor, Colour, INK, Stroke, TextStyle};
use crate::text::width_px;
use glam::{DVec2, DVec3};

/// A luminaire's symbol is at least this long and wide.
const MIN_PX: f64 = 9.0;
/// Length of the tick toward C0 beyond the symbol.
pub(crate) const TICK_PX: f64 = 7.0;
/// Length of an arrow in the plane of the sheet.
const ARROW_PX: f64 = 24.0;
/// An arrow shorter than this share of its length is not drawn.
const SEEN: f64 = 0.12;
/// Half the length of a pointer to the north.
const NORTH_RADIUS_PX: f64 = 20.0;
/// Corners of a round outline.
const ROUND: usize = 24;

/// How a symbol is inked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ink {
    pub(crate) fill: Colour,
    pub(crate) line: Stroke,
}

impl Ink {
    pub(crate) const LAMP: Self = Self { fill: ink::LAMP, line: ink::LAMP_LINE };
    pub(crate) const FAULT: Self = Self { fill: ink::FAULT_FILL, line: ink::FAULT_LINE };
}

/// The outline of a luminaire around the middle of its symbol: its luminous opening, or what can be
/// seen of a smaller one.
pub(crate) fn opening(luminaire: &PlanLuminaire, projection: &Projection) -> Vec<DVec2> {
    let least_m = MIN_PX / projection.px_per_m;
    let size = luminaire.opening_m;
    let [length, width] = [size.x, size.y].map(|side| 0.5 * side.max(least_m));
    let height = 0.5 * size.z.max(0.5 * least_m);
    let c90 = luminaire.c0.cross(luminaire.aim);
    let place = |[x, y, z]: [f64; 3]| {
        let offset = luminaire.c0 * (x * length) + c90 * (y * width) + luminaire.aim * (z * height);
        projection.direction(offset) * projection.px_per_m
    };
    let section: Vec<[f64; 2]> = if luminaire.is_round {
        let angle = |k| std::f64::consts::TAU * k as f64 / ROUND as f64;
        let corner = |k| {
            let (sin, cos) = libm::sincos(angle(k));
            [cos, sin]
        };
        (0..ROUND).map(corner).collect()
    } else {
        vec![[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
    };
    let ends = [-1.0, 1.0];
    hull(ends.iter().flat_map(|&z| section.iter().map(move |&[x, y]| place([x, y, z]))).collect())
}

/// How far points reach to the sides.
pub(crate) fn reach(outline: &[DVec2]) -> DVec2 {
    outline.iter().fold(DVec2::ZERO, |reach, p| reach.max(p.abs()))
}

/// Draws a luminaire with its tick toward C0, and with its aim where it is seen.
pub(crate) fn luminaire(
    drawing: &mut Drawing,
    at: DVec2,
    luminaire: &PlanLuminaire,
    projection: &Projection,
    ink: Ink,
) {
    let outline = opening(luminaire, projection);
    polygon(drawing, at, &outline, ink);
    let c0 = projection.direction(luminaire.c0);
    if c0.length() > 0.3 {
        let way = c0.normalize();
        let edge = outline.iter().map(|p| p.dot(way)).fold(0.0, f64::max);
        drawing.lines(&[[at + way * edge, at + way * (edge + TICK_PX)]], ink.line);
    }
    arrow(drawing, at, projection.direction(luminaire.aim), ink.line);
}

/// A filled outline around a place.
pub(crate) fn polygon(drawing: &mut Drawing, at: DVec2, outline: &[DVec2], ink: Ink) {
    let outline: Vec<DVec2> = outline.iter().map(|p| *p + at).collect();
    drawing.region(std::slice::from_ref(&outline), ink.fill);
    let closed: Vec<[f64; 2]> =
        outline.iter().chain(outline.first()).map(|p| p.to_array()).collect();
    drawing.line(&closed, ink.line);
}

/// An arrow along the part of a unit direction that lies in the sheet, none where that is short.
pub(crate) fn arrow(drawing: &mut Drawing, from: DVec2, direction: DVec2, stroke: Stroke) {
    let tip = arrow_tip(direction);
    if tip != DVec2::ZERO {
        pointer(drawing, from, from + tip, stroke);
    }
}

/// Where such an arrow ends, from its beginning.
pub(crate) fn arrow_tip(direction: DVec2) -> DVec2 {
    let length = direction.length();
    if length > SEEN { direction / length * (ARROW_PX * length.max(0.5)) } else { DVec2::ZERO }
}

/// A line with a head at its end.
pub(crate) fn pointer(drawing: &mut Drawing, from: DVec2, to: DVec2, stroke: Stroke) {
    let back = (from - to).normalize_or_zero() * (3.0 + 2.5 * stroke.width_px);
    let aside = back.perp() * 0.45;
    drawing.lines(&[[from, to + back * 0.8]], stroke);
    drawing.region(&[vec![to, to + back + aside, to + back - aside]], stroke.colour);
}

/// A pointer to the north around a place, with its name beyond the tip.
pub(crate) fn north(drawing: &mut Drawing, at: DVec2, to: DVec2, name: &str) {
    let (tail, tip) = (at - to * NORTH_RADIUS_PX, at + to * NORTH_RADIUS_PX);
    pointer(drawing, tail, tip, Stroke::solid(INK, 1.6));
    // As far from the tip as the word reaches that way.
    let half_word = DVec2::new(0.5 * width_px(name, 14.0), 5.0);
    let beyond = 6.0 + (half_word * to.abs()).length();
    let base = tip + to * beyond + DVec2::Y * half_word.y;
    drawing.text(base.to_array(), TextStyle::new(14.0, INK, Anchor::Middle), name);
}

/// A ray of eight arms: a light without direction.
pub(crate) fn star(drawing: &mut Drawing, at: DVec2, ink: Ink) {
    let arms: Vec<[DVec2; 2]> = (0..8)
        .map(|k| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / 8.0);
            [6.0, 11.0].map(|r| at + DVec2::new(cos, sin) * r)
        })
        .collect();
    drawing.lines(&arms, ink.line);
    drawing.disk(at.to_array(), 5.0, ink.line.colour);
    drawing.disk(at.to_array(), 3.6, ink.fill);
}

/// A direction by the usual sign: an arrow in the sheet, a ring with a dot toward the viewer, a
/// ring with a cross away.
pub(crate) fn normal(drawing: &mut Drawing, at: DVec2, normal: DVec3, projection: &Projection) {
    let across = projection.direction(normal);
    if across.length() > 0.3 {
        arrow(drawing, at, across, ink::SENSOR_LINE);
        return;
    }
    drawing.disk(at.to_array(), 6.0, ink::SENSOR);
    drawing.disk(at.to_array(), 4.7, [255; 3]);
    if normal.dot(projection.toward()) > 0.0 {
        drawing.disk(at.to_array(), 1.9, ink::SENSOR);
    } else {
        let arms = [DVec2::splat(3.4), DVec2::new(3.4, -3.4)];
        drawing.lines(&arms.map(|arm| [at - arm, at + arm]), ink::SENSOR_LINE);
    }
}

/// The outline of a grid on the sheet, not closed.
pub(crate) fn corners_of(grid: &PlanGrid<'_>) -> [DVec3; 4] {
    let [u, v] = grid.edges_m;
    [DVec3::ZERO, u, u + v, v].map(|corner| grid.origin_m + corner)
}

/// A sample of a grid's points, at most `most` along each edge.
pub(crate) fn sample_of(grid: &PlanGrid<'_>, most: u32) -> Vec<DVec3> {
    let shares = grid.counts.map(|count| {
        let shown = count.clamp(1, most);
        let place = move |k: u32| {
            let cell = (u64::from(k) * 2 + 1) * u64::from(count) / (2 * u64::from(shown));
            (cell as f64 + 0.5) / f64::from(count.max(1))
        };
        (0..shown).map(place).collect::<Vec<f64>>()
    });
    let [u, v] = grid.edges_m;
    let row = |t: &f64| {
        let start = grid.origin_m + v * *t;
        shares[0].iter().map(move |s| start + u * *s).collect::<Vec<_>>()
    };
    shares[1].iter().flat_map(row).collect()
}

/// Draws a camera, the pyramid of what it sees cut off near its place, and returns what it covers.
pub(crate) fn camera(
    drawing: &mut Drawing,
    at: DVec2,
    camera: &PlanCamera<'_>,
    projection: &Projection,
) -> Box {
    const DEPTH_PX: f64 = 34.0;
    let ahead = camera.corners.iter().sum::<DVec3>().normalize_or_zero();
    let corner = |direction: &DVec3| {
        let depth = direction.dot(ahead).max(0.25);
        projection.direction(*direction / depth) * DEPTH_PX
    };
    let apex = std::iter::once(DVec2::ZERO);
    let outline = hull(apex.chain(camera.corners.iter().map(corner)).collect());
    polygon(drawing, at, &outline, Ink { fill: ink::CAMERA_FILL, line: ink::CAMERA_LINE });
    drawing.disk(at.to_array(), 3.5, ink::CAMERA);
    let (low, high) =
        outline.iter().fold((DVec2::splat(-3.0), DVec2::splat(3.0)), |(low, high), p| {
            (low.min(*p), high.max(*p))
        });
    Box { low: at + low, high: at + high }
}
