//! One of the views on the sheet: its frame, its projection, and where things lie in it that are
//! far outside.

use super::bounds::{Bounds, length_text};
use super::projection::Projection;
use crate::drawing::Frame;
use glam::{DVec2, DVec3};

/// Room around the geometry within the frame, for what lies a little outside.
pub(crate) const MARGIN_PX: f64 = 40.0;
/// What lies beyond the frame is drawn this far inside of its border.
const PIN_PX: f64 = 16.0;

/// A view of the world in a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    pub(crate) frame: Frame,
    pub(crate) projection: Projection,
    /// What fits into the frame.
    pub(crate) bounds: Bounds,
}

/// Where something is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Pin {
    pub(crate) place_px: DVec2,
    /// Where it lies beyond the frame: which way, and how far in words.
    pub(crate) beyond: Option<Beyond>,
}

/// The way to something beyond the frame.
#[derive(Clone, Debug)]
pub(crate) struct Beyond {
    /// Unit vector on the sheet.
    pub(crate) direction: DVec2,
    /// How far it is from what fits into the frame.
    pub(crate) text: String,
}

impl View {
    /// Whether a place on the sheet lies inside the frame.
    pub(crate) fn holds(&self, place_px: DVec2) -> bool {
        let corner = DVec2::from(self.frame.corner_px);
        let end = corner + DVec2::from(self.frame.size_px);
        place_px.cmpge(corner).all() && place_px.cmple(end).all()
    }

    /// Where a point is drawn: at its place, or at the border nearest to it.
    pub(crate) fn pin(&self, point_m: DVec3) -> Pin {
        let place = self.projection.place(point_m);
        let corner = DVec2::from(self.frame.corner_px);
        let end = corner + DVec2::from(self.frame.size_px);
        if place.cmpge(corner).all() && place.cmple(end).all() {
            return Pin { place_px: place, beyond: None };
        }
        let nearest = place.clamp(corner + PIN_PX, end - PIN_PX);
        let direction = (place - nearest).normalize_or(DVec2::X);
        let distance_m = self.bounds.outside(point_m).map_or(0.0, |o| o.distance_m());
        let text = length_text(distance_m);
        Pin { place_px: nearest, beyond: Some(Beyond { direction, text }) }
    }
}
