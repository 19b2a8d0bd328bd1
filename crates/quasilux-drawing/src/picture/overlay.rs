//! What stands around a grid, drawn over its false colours: lines in which its plane cuts surfaces,
//! edges of what stands behind the plane, and the luminaires before it.

use super::cells::{GridPicture, Surroundings};
use super::layout::Layout;
use super::plan::{
    Bounds, Ink, Plane, Projection, TICK_PX, clipped, edges, opening, outlines, star, thinned,
};
use crate::drawing::{Drawing, Frame};
use crate::style::{Colour, Stroke, WHITE};
use glam::{DVec2, DVec3};

/// A picture shows the whole section of a room that is at most this many times as long as the
/// longer edge of the grid.
const MOST_WHOLE: f64 = 3.0;
/// Room around a grid that its picture may take for what stands there in a longer one, in its
/// longer edge.
const AROUND: f64 = 0.3;
/// Clear space outside of the walls, in the longer edge of the picture.
const BEYOND: f64 = 0.015;
/// Edges are shown to this depth behind the plane, or to this share of the geometry's height.
const DEPTH_M: f64 = 2.0;
const DEPTH_SHARE: f64 = 0.4;
/// Edges shorter than this are not looked at.
const LEAST_PX: f64 = 0.5;
const MOST_LINES: usize = 8000;
const MOST_LUMINAIRES: usize = 1000;

const CUT: Colour = [0x18; 3];
const EDGE: Colour = [0x50; 3];
const LAMP: Colour = [0x7a, 0x2e, 0x00];

/// The part of a grid's plane that its picture shows, from the grid's corner along its edges, in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Window {
    pub(super) low_m: DVec2,
    pub(super) high_m: DVec2,
}

impl Window {
    /// The grid, and the room around it, or of a large one the walls that are near.
    pub(super) fn new(grid: &GridPicture<'_>) -> Self {
        let [u_m, v_m] = grid.edges_m();
        let own = Self { low_m: DVec2::ZERO, high_m: DVec2::new(u_m, v_m) };
        let reach_m = AROUND * own.high_m.max_element();
        let around = Frame {
            corner_px: (own.low_m - reach_m).to_array(),
            size_px: (own.high_m + 2.0 * reach_m).to_array(),
        };
        let [u, v] = grid.directions();
        let origin = DVec3::from(grid.origin_m);
        let place = |p: DVec3| DVec2::new((p - origin).dot(u), (p - origin).dot(v));
        let cut = || grid.surroundings.surfaces.cut(plane(grid)).map(|ends| ends.map(place));
        let with = |window: Self, p: DVec2| Self {
            low_m: window.low_m.min(p),
            high_m: window.high_m.max(p),
        };
        let mut all = cut().flatten().fold(own, with);
        if all.size_m().max_element() > MOST_WHOLE * own.high_m.max_element() {
            all = cut().filter_map(|ends| clipped(ends, around)).flatten().fold(own, with);
        }
        if all == own {
            return own;
        }
        let beyond_m = BEYOND * all.size_m().max_element();
        Self { low_m: all.low_m - beyond_m, high_m: all.high_m + beyond_m }
    }

    pub(super) fn size_m(&self) -> DVec2 {
        self.high_m - self.low_m
    }
}

/// The plane of a grid; above it is where its picture is seen from.
fn plane(grid: &GridPicture<'_>) -> Plane {
    let [u, v] = grid.directions();
    let normal = u.cross(v).normalize_or_zero();
    Plane { normal, offset_m: normal.dot(DVec3::from(grid.origin_m)) }
}

/// Draws what stands around the grid.
pub(super) fn draw(drawing: &mut Drawing, layout: &Layout, grid: &GridPicture<'_>) {
    let frame = layout.plot();
    let Some(projection) = projection(layout, grid) else {
        return;
    };
    drawing.clipped(frame, |drawing| {
        draw_surfaces(drawing, frame, grid, &projection);
        draw_luminaires(drawing, grid, &projection);
        draw_other_lights(drawing, grid, &projection);
    });
}

/// From the world to the picture; none where a thin grid is not in true proportion.
fn projection(layout: &Layout, grid: &GridPicture<'_>) -> Option<Projection> {
    let [right, up] = grid.directions();
    let cells = layout.grid();
    let scales: Vec<f64> =
        cells.size_px.iter().zip(grid.edges_m()).map(|(px, edge_m)| px / edge_m).collect();
    let (low, high) = (scales[0].min(scales[1]), scales[0].max(scales[1]));
    let is_true = low.is_finite() && low > 0.0 && high < 1.1 * low;
    is_true.then(|| Projection {
        right,
        up,
        anchor_m: DVec3::from(grid.origin_m),
        anchor_px: DVec2::from(cells.at([0.0, 0.0])),
        px_per_m: low,
    })
}

fn draw_surfaces(
    drawing: &mut Drawing,
    frame: Frame,
    grid: &GridPicture<'_>,
    projection: &Projection,
) {
    let surfaces = grid.surroundings.surfaces;
    let plane = plane(grid);
    let height_m = Bounds::of_surfaces(surfaces).map_or(0.0, |bounds| bounds.size_m().z);
    let depth_m = DEPTH_M.max(DEPTH_SHARE * height_m);
    let behind = Plane { normal: -plane.normal, offset_m: depth_m - plane.offset_m };
    let found = edges(surfaces, &[plane.normal], LEAST_PX / projection.px_per_m);
    let on_sheet = |ends: [DVec3; 2]| ends.map(|end| projection.place(end));
    let seen = found
        .iter()
        .filter(|edge| edge.is_seen(0))
        .filter_map(|edge| behind.part_below(plane.part_below(edge.ends_m)?));
    let lines = thinned(seen.map(on_sheet), frame, MOST_LINES);
    drawing.lines(&lines, Stroke::solid(WHITE, 1.8));
    drawing.lines(&lines, Stroke::solid(EDGE, 0.8));
    let cut = thinned(surfaces.cut(plane).map(on_sheet), frame, MOST_LINES);
    drawing.lines(&cut, Stroke::solid(WHITE, 4.0));
    drawing.lines(&cut, Stroke::solid(CUT, 2.2));
}

/// Luminous surfaces and point lights before the plane.
fn draw_other_lights(drawing: &mut Drawing, grid: &GridPicture<'_>, projection: &Projection) {
    let (plane, Surroundings { surfaces, .. }) = (plane(grid), grid.surroundings);
    let is_before = |p: &DVec3| plane.normal.dot(*p) > plane.offset_m;
    for light in grid.surroundings.area_lights.iter().take(MOST_LUMINAIRES) {
        let corners = light.triangles.iter().filter_map(|&t| surfaces.triangle(t as usize));
        let before = corners.filter(|corners| corners.iter().any(is_before));
        let on_sheet = before.map(|corners| corners.map(|corner| projection.place(corner)));
        for ring in outlines(on_sheet) {
            draw_outline(drawing, &ring, None);
        }
    }
    let points = grid.surroundings.point_lights_m.iter().filter(|p| is_before(p));
    for &position_m in points.take(MOST_LUMINAIRES) {
        star(drawing, projection.place(position_m), Ink::LAMP);
    }
}

/// A closed outline, and a tick at it.
fn draw_outline(drawing: &mut Drawing, outline: &[DVec2], tick: Option<[DVec2; 2]>) {
    let sides = (0..outline.len()).map(|k| [outline[k], outline[(k + 1) % outline.len()]]);
    let lines: Vec<[DVec2; 2]> = sides.chain(tick).collect();
    drawing.lines(&lines, Stroke::solid(WHITE, 3.2));
    drawing.lines(&lines, Stroke::solid(LAMP, 1.3));
}

fn draw_luminaires(drawing: &mut Drawing, grid: &GridPicture<'_>, projection: &Projection) {
    let plane = plane(grid);
    let before = grid
        .surroundings
        .luminaires
        .iter()
        .filter(|luminaire| plane.normal.dot(luminaire.position_m) > plane.offset_m);
    for luminaire in before.take(MOST_LUMINAIRES) {
        let at = projection.place(luminaire.position_m);
        let outline: Vec<DVec2> =
            opening(luminaire, projection).iter().map(|corner| at + *corner).collect();
        let c0 = projection.direction(luminaire.c0);
        let edge = outline.iter().map(|p| (*p - at).dot(c0)).fold(0.0, f64::max);
        let tick = [at + c0 * edge, at + c0 * (edge + TICK_PX)];
        draw_outline(drawing, &outline, (c0.length() > 0.9).then_some(tick));
    }
}

#[cfg(test)]
mod tests {
    use super::super::plan::fixtures::room;
    use super::*;
    use crate::example::Grid;

    /// A grid half a metre from walls of 6 m x 4 m, and the same in a hall.
    #[test]
    fn the_window_holds_near_walls() {
        let (near, grid) = (room(), Grid::new([5.0, 3.0], [5, 3], 0.0, |_, _| 1.0));
        let surroundings = Surroundings { surfaces: near.surfaces(), ..Surroundings::default() };
        let picture = GridPicture { surroundings, ..grid.picture("workplane") };
        let window = Window::new(&picture);
        let beyond = DVec2::splat(0.015 * 6.0);
        assert!(window.low_m.distance(DVec2::splat(-0.5) - beyond) < 1e-9, "{window:?}");
        assert!(window.high_m.distance(DVec2::new(5.5, 3.5) + beyond) < 1e-9, "{window:?}");
        let alone = Window::new(&grid.picture("workplane"));
        assert_eq!(alone, Window { low_m: DVec2::ZERO, high_m: DVec2::new(5.0, 3.0) });
        let hall = super::super::plan::fixtures::Shell::default()
            .with_box(DVec3::splat(-30.0), DVec3::splat(30.0));
        let surroundings = Surroundings { surfaces: hall.surfaces(), ..Surroundings::default() };
        let picture = GridPicture { surroundings, ..grid.picture("workplane") };
        assert_eq!(Window::new(&picture), alone);
    }
}
