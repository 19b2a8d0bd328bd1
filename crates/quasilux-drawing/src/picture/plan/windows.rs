//! Windows: panes, openings to the outside, and holes in walls.
//!
//! Across the sheet a window is the wall's two faces, and the glass between them; seen from the
//! front it is its outline. A plan has all of them at whatever height, for many begin above the
//! sensors; a section has in its walls those that it cuts.

use super::edges::Edge;
use super::holes::holes;
use super::ink;
use super::model::Surfaces;
use super::projection::Projection;
use super::region::outlines;
use super::scope::Scope;
use super::thin::thinned;
use crate::drawing::{Drawing, Frame};
use crate::style::{Stroke, WHITE};
use glam::{DVec2, DVec3};

/// Most lines of a kind in one view.
const MAX_LINES: usize = 4000;
/// Sine of the angle between pane and the viewer's direction below which it is a line.
const EDGE_ON: f64 = 0.05;

/// Windows in triangles.
pub(crate) struct WindowSet {
    panes: Vec<[DVec3; 3]>,
    openings: Vec<[DVec3; 3]>,
}

/// Windows in a view.
pub(crate) struct SeenWindows {
    /// Panes and openings that are seen as lines.
    frames: Vec<[DVec2; 2]>,
    /// The panes among them.
    glass: Vec<[DVec2; 2]>,
    /// Outlines of panes that are seen from the front.
    faces: Vec<Vec<DVec2>>,
    /// Outlines of openings.
    gaps: Vec<Vec<DVec2>>,
}

/// How a view looks at windows.
#[derive(Clone, Copy)]
pub(crate) struct WindowView {
    pub(crate) projection: Projection,
    pub(crate) frame: Frame,
    /// What is shown of windows; in a section lines are those of its cut.
    pub(crate) scope: Scope,
}

impl WindowSet {
    /// The panes of surfaces, openings, and holes between the edges of the surfaces.
    pub(crate) fn new(surfaces: Surfaces<'_>, openings_m: &[[DVec3; 4]], edges: &[Edge]) -> Self {
        let corners = openings_m.iter().copied().chain(holes(edges));
        let corners = corners.filter(|corners| corners.iter().all(|corner| corner.is_finite()));
        let openings = corners.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Self { panes: surfaces.panes().collect(), openings }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.panes.is_empty() && self.openings.is_empty()
    }

    /// What a view shows of them.
    pub(crate) fn seen(&self, view: &WindowView) -> SeenWindows {
        let glass = view.lines(&self.panes);
        let openings = view.lines(&self.openings);
        let all = glass.iter().chain(&openings).copied();
        let frames = thinned(all, view.frame, MAX_LINES);
        SeenWindows {
            frames,
            glass: thinned(glass.into_iter(), view.frame, MAX_LINES),
            faces: view.faces(&self.panes),
            gaps: view.faces(&self.openings),
        }
    }
}

impl WindowView {
    fn is_edge_on(&self, [a, b, c]: [DVec3; 3]) -> bool {
        let normal = (b - a).cross(c - a).normalize_or_zero();
        normal.dot(self.projection.toward()).abs() < EDGE_ON
    }

    fn lines(&self, triangles: &[[DVec3; 3]]) -> Vec<[DVec2; 2]> {
        let edge_on = triangles.iter().copied().filter(|corners| self.is_edge_on(*corners));
        let place = |ends: [DVec3; 2]| ends.map(|end| self.projection.place(end));
        let line = |corners: [DVec3; 3]| match self.scope.cut {
            Some(plane) => plane.cut(corners).map(place),
            None => longest(corners.map(|corner| self.projection.place(corner))),
        };
        edge_on.filter_map(line).collect()
    }

    fn faces(&self, triangles: &[[DVec3; 3]]) -> Vec<Vec<DVec2>> {
        let facing = triangles.iter().copied().filter(|corners| !self.is_edge_on(*corners));
        let shown = facing.flat_map(|corners| self.scope.triangles(corners));
        outlines(shown.map(|corners| corners.map(|corner| self.projection.place(corner))))
    }
}

impl SeenWindows {
    /// Draws what is seen from the front: outlines, over a halo of a width or over a fill.
    pub(crate) fn draw_faces(&self, drawing: &mut Drawing, frame: Frame, halo_px: Option<f64>) {
        if halo_px.is_none() {
            drawing.region(&self.faces, ink::GLASS);
        }
        for (rings, stroke) in [(&self.gaps, ink::OPENING_LINE), (&self.faces, ink::GLASS_LINE)] {
            let sides = rings.iter().flat_map(|ring| {
                (0..ring.len()).map(move |k| [ring[k], ring[(k + 1) % ring.len()]])
            });
            let lines = thinned(sides, frame, MAX_LINES);
            if let Some(width_px) = halo_px {
                drawing.lines(&lines, Stroke::solid(WHITE, width_px));
            }
            drawing.lines(&lines, stroke);
        }
    }

    /// Draws what is seen as lines over the lines of walls.
    pub(crate) fn draw_lines(&self, drawing: &mut Drawing) {
        drawing.lines(&self.frames, ink::WINDOW_WALL);
        drawing.lines(&self.frames, ink::WINDOW_GAP);
        drawing.lines(&self.glass, ink::WINDOW_GLASS);
    }
}

/// The longest side of a triangle that is seen as a line.
fn longest([a, b, c]: [DVec2; 3]) -> Option<[DVec2; 2]> {
    let length = |[a, b]: &[DVec2; 2]| a.distance_squared(*b);
    [[a, b], [b, c], [c, a]].into_iter().max_by(|a, b| length(a).total_cmp(&length(b)))
}
