//! What stands around a grid, drawn over its false colours: lines in which its plane cuts surfaces,
//! edges of what stands behind the plane, windows, and the luminaires before it.

use super::cells::{GridPicture, Surroundings};
use super::layout::Layout;
use super::plan::{
    Bounds, Ink, Plane, Projection, Scope, TICK_PX, WindowSet, WindowView, edges, opening,
    outlines, star, thinned,
};
use crate::drawing::{Drawing, Frame};
use crate::style::{Colour, Stroke, WHITE};
use glam::{DVec2, DVec3};

/// Edges are shown to this depth behind the plane, or to this share of the geometry's height.
const DEPTH_M: f64 = 2.0;
const DEPTH_SHARE: f64 = 0.4;
/// Edges shorter than this are not looked at.
const MIN_PX: f64 = 0.5;
/// Width of the white line under outlines of windows.
const HALO_PX: f64 = 3.0;
const MAX_LINES: usize = 8000;
const MAX_LUMINAIRES: usize = 1000;

const CUT: Colour = [0x18; 3];
const EDGE: Colour = [0x50; 3];
const LAMP: Colour = [0x7a, 0x2e, 0x00];

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
    let plane = grid.plane();
    let height_m = Bounds::of_surfaces(surfaces).map_or(0.0, |bounds| bounds.size_m().z);
    let depth_m = DEPTH_M.max(DEPTH_SHARE * height_m);
    let behind = Plane { normal: -plane.normal, offset_m: depth_m - plane.offset_m };
    let found = edges(surfaces, &[plane.normal], MIN_PX / projection.px_per_m);
    let on_sheet = |ends: [DVec3; 2]| ends.map(|end| projection.place(end));
    let seen = found
        .iter()
        .filter(|edge| edge.is_seen(0))
        .filter_map(|edge| behind.part_below(plane.part_below(edge.ends_m)?));
    let lines = thinned(seen.map(on_sheet), frame, MAX_LINES);
    drawing.lines(&lines, Stroke::solid(WHITE, 1.8));
    drawing.lines(&lines, Stroke::solid(EDGE, 0.8));
    let cut = thinned(surfaces.cut(plane).map(on_sheet), frame, MAX_LINES);
    drawing.lines(&cut, Stroke::solid(WHITE, 4.0));
    drawing.lines(&cut, Stroke::solid(CUT, 2.2));
    let windows = WindowSet::new(surfaces, grid.surroundings.openings_m, &found);
    let cut = (!grid.is_level()).then_some(plane);
    let scope = Scope { cut, hair_m: 0.0 };
    let windows = windows.seen(&WindowView { projection: *projection, frame, scope });
    windows.draw_faces(drawing, frame, Some(HALO_PX));
    windows.draw_lines(drawing);
}

/// Luminous surfaces and point lights before the plane.
fn draw_other_lights(drawing: &mut Drawing, grid: &GridPicture<'_>, projection: &Projection) {
    let (plane, Surroundings { surfaces, .. }) = (grid.plane(), grid.surroundings);
    let is_before = |p: &DVec3| plane.normal.dot(*p) > plane.offset_m;
    for light in grid.surroundings.area_lights.iter().take(MAX_LUMINAIRES) {
        let corners = light.triangles.iter().filter_map(|&t| surfaces.triangle(t as usize));
        let before = corners.filter(|corners| corners.iter().any(is_before));
        let on_sheet = before.map(|corners| corners.map(|corner| projection.place(corner)));
        for ring in outlines(on_sheet) {
            draw_outline(drawing, &ring, None);
        }
    }
    let points = grid.surroundings.point_lights_m.iter().filter(|p| is_before(p));
    for &position_m in points.take(MAX_LUMINAIRES) {
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
    let plane = grid.plane();
    let before = grid
        .surroundings
        .luminaires
        .iter()
        .filter(|luminaire| plane.normal.dot(luminaire.position_m) > plane.offset_m);
    for luminaire in before.take(MAX_LUMINAIRES) {
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
    use super::super::plan::fixtures::{Shell, luminaire, room, room_with_window, upright};
    use super::super::plan::ink;
    use super::*;
    use crate::drawing::Shape;
    use crate::example::Grid;

    /// The ends of all lines of a colour over the plot.
    fn ends(shapes: &[Shape], colour: Colour) -> Vec<DVec2> {
        ends_of(shapes, &|stroke| stroke.colour == colour)
    }

    /// The ends of all lines of some strokes.
    fn ends_of(shapes: &[Shape], is_wanted: &dyn Fn(&Stroke) -> bool) -> Vec<DVec2> {
        let of = |shape: &Shape| match shape {
            Shape::Lines { lines, stroke } if is_wanted(stroke) => {
                lines.iter().flatten().map(|end| DVec2::from(*end)).collect()
            }
            Shape::Clipped { shapes, .. } => ends_of(shapes, is_wanted),
            _ => Vec::new(),
        };
        shapes.iter().flat_map(of).collect()
    }

    /// A window in the wall to the south, whose sill is above the grid: a line of glass between two
    /// faces of the wall. Without glass it is a gap, told by the hole or by its name.
    #[test]
    fn windows_above_the_grid_are_drawn_in_the_wall() {
        let grid = Grid::new([5.0, 3.0], [5, 3], 0.0, |x, _| x);
        let drawn = |shell: &Shell, openings_m: &[[DVec3; 4]]| {
            let surfaces = shell.surfaces();
            let surroundings = Surroundings { surfaces, openings_m, ..Surroundings::default() };
            crate::picture::grid(&GridPicture { surroundings, ..grid.picture("workplane") })
        };
        let px_per_m = 900.0 / 6.18;
        let frames = |drawing: &Drawing, stroke: Stroke| {
            let ends = ends_of(&drawing.shapes, &|own| *own == stroke);
            let wall = ends_of(&drawing.shapes, &|own| own.colour == CUT && own.width_px == 2.2);
            let corner = wall.into_iter().reduce(|a, b| DVec2::new(a.x.min(b.x), a.y.max(b.y)));
            let corner = corner.expect("a wall");
            let place = |end: DVec2| (end - corner) / px_per_m;
            ends.into_iter().map(place).collect::<Vec<_>>()
        };
        let is_window = |ends: &[DVec2]| {
            let x = |pick: fn(f64, f64) -> f64| ends.iter().map(|end| end.x).reduce(pick);
            assert!(ends.iter().all(|end| end.y.abs() < 0.01), "{ends:?}");
            let [from, to] = [x(f64::min), x(f64::max)].map(|x| x.expect("a window"));
            assert!((from - 2.0).abs() < 0.01 && (to - 4.0).abs() < 0.01, "{from} to {to}");
        };
        let glazed = drawn(&room_with_window(Some(1)), &[]);
        is_window(&frames(&glazed, ink::WINDOW_WALL));
        is_window(&frames(&glazed, ink::WINDOW_GLASS));
        let named = upright(0.0, [2.0, 1.2], [4.0, 2.2]);
        for gap in [drawn(&room_with_window(None), &[]), drawn(&room(), &[named])] {
            is_window(&frames(&gap, ink::WINDOW_WALL));
            assert!(frames(&gap, ink::WINDOW_GLASS).is_empty());
        }
        let walled = drawn(&room_with_window(Some(0)), &[]);
        assert!(frames(&walled, ink::WINDOW_WALL).is_empty());
    }

    /// The grid of 5 m x 3 m begins at (0.5, 0.5, 0.8): its plane cuts the walls of 6 m x 4 m and
    /// stands above the table; one luminaire hangs above it and one below.
    #[test]
    fn walls_table_and_luminaires_are_where_they_stand() {
        let (shell, grid) = (room(), Grid::new([5.0, 3.0], [5, 3], 0.0, |x, _| x));
        let luminaires = [[1.5, 2.0, 2.7], [4.5, 2.0, 0.3]].map(|at| luminaire(at.into()));
        let surroundings = Surroundings {
            surfaces: shell.surfaces(),
            luminaires: &luminaires,
            ..Surroundings::default()
        };
        let drawing =
            crate::picture::grid(&GridPicture { surroundings, ..grid.picture("workplane") });
        let px_per_m = 900.0 / 6.18;
        let low = |colour| ends(&drawing.shapes, colour).into_iter().reduce(DVec2::min);
        let high = |colour| ends(&drawing.shapes, colour).into_iter().reduce(DVec2::max);
        let extent_m = |colour| {
            let size = high(colour).expect("a line") - low(colour).expect("a line");
            size / px_per_m
        };
        assert!(extent_m(CUT).distance(DVec2::new(6.0, 4.0)) < 0.01, "{}", extent_m(CUT));
        let from_wall_m =
            |colour| (low(colour).expect("a line") - low(CUT).expect("a wall")) / px_per_m;
        // The floor has the edges of the walls, the table those that lie further in.
        let table = ends(&drawing.shapes, EDGE).into_iter().filter(|end| {
            let place = (*end - low(CUT).expect("a wall")) / px_per_m;
            place.cmpgt(DVec2::splat(0.1)).all() && place.cmplt(DVec2::new(5.9, 3.9)).all()
        });
        let table = table.reduce(DVec2::min).expect("a table") - low(CUT).expect("a wall");
        assert!((table / px_per_m).distance(DVec2::new(2.0, 2.0)) < 0.01, "{table}");
        // 1.2 m x 0.2 m, and the tick toward C0.
        let lamp_m = extent_m(LAMP) - DVec2::new(TICK_PX / px_per_m, 0.0);
        assert!(lamp_m.distance(DVec2::new(1.2, 0.2)) < 0.01, "{lamp_m}");
        assert!(from_wall_m(LAMP).distance(DVec2::new(0.9, 1.9)) < 0.01);
    }
}
