//! The sheet: plan, elevations and the texts around them.

use super::cut::Plane;
use super::model::PlanPicture;
use super::projection::Projection;
use crate::drawing::Drawing;
use crate::style::{Anchor, INK, Stroke, TextStyle};
use glam::{DVec2, DVec3};

/// Draws a room.
#[must_use]
pub fn plan(picture: &PlanPicture<'_>) -> Drawing {
    let mut drawing = Drawing::new(picture.title, [1000.0, 800.0]);
    drawing.text([40.0, 40.0], TextStyle::new(28.0, INK, Anchor::Start), picture.title);
    let mut points = picture.surfaces.corners().flatten();
    let first = points.next().unwrap_or(DVec3::ZERO);
    let [low, high] = points.fold([first; 2], |[low, high], p| [low.min(p), high.max(p)]);
    let size = (high - low).max(DVec3::splat(1e-6));
    let projection = Projection {
        right: DVec3::X,
        up: DVec3::Y,
        anchor_m: low,
        anchor_px: DVec2::new(60.0, 760.0),
        px_per_m: (880.0 / size.x).min(660.0 / size.y),
    };
    let plane = Plane { normal: DVec3::Z, offset_m: low.z + 0.4 * size.z };
    for ends in picture.surfaces.cut(plane) {
        let ends = ends.map(|end| projection.place(end).to_array());
        drawing.line(&ends, Stroke::solid(INK, 2.5));
    }
    for luminaire in picture.luminaires {
        drawing.disk(projection.place(luminaire.position_m).to_array(), 6.0, [230, 159, 0]);
    }
    for mark in picture.marks {
        let place = projection.place(mark.position_m).to_array();
        drawing.disk(place, 9.0, [200, 0, 0]);
        let style = TextStyle::new(12.0, [255; 3], Anchor::Middle);
        drawing.text([place[0], place[1] + 4.0], style, &mark.number.to_string());
    }
    drawing
}
