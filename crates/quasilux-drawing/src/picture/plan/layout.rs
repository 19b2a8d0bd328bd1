//! Where the views lie on the sheet, and at which scale: the plan, the front elevation below it,
//! the side elevation beside that (third-angle projection), and one scale for all.

use super::bounds::Bounds;
use super::projection::Projection;
use super::view::{MARGIN_PX, View};
use crate::drawing::Frame;
use glam::{DVec2, DVec3};

pub(crate) const LEFT_PX: f64 = 70.0;
pub(crate) const RIGHT_PX: f64 = 30.0;
/// Between views: room for numbers of axes and for the heading of the next view.
const GAP_PX: DVec2 = DVec2::new(64.0, 76.0);
/// What all views have together for the geometry, from left to right and from top to bottom.
const ROOM_PX: DVec2 = DVec2::new(900.0, 800.0);
/// A view is at least this long and wide, also where there is nothing to be seen.
const MIN_PX: f64 = 150.0;

/// The views, and the rest of the rectangle around them.
pub(crate) struct Layout {
    /// Plan, front and side.
    pub(crate) views: [View; 3],
    /// Right of the plan and above the side elevation.
    pub(crate) corner: Frame,
    /// Below the views.
    pub(crate) bottom_px: f64,
    /// Width of everything.
    pub(crate) width_px: f64,
}

impl Layout {
    /// The layout of what lies within `bounds`, below `top_px`.
    pub(crate) fn new(bounds: &Bounds, top_px: f64) -> Self {
        let size_m = bounds.size_m().max(DVec3::splat(1e-9));
        let px_per_m = (ROOM_PX.x / (size_m.x + size_m.y)).min(ROOM_PX.y / (size_m.y + size_m.z));
        let length = |size_m: f64| (size_m * px_per_m + 2.0 * MARGIN_PX).max(MIN_PX).ceil();
        let [x, y, z] = size_m.to_array().map(length);
        let right = LEFT_PX + x + GAP_PX.x;
        let below = top_px + y + GAP_PX.y;
        let frame = |corner_px, size_px| Frame { corner_px, size_px };
        let corner = frame([right, top_px], [y, y]);
        let view = |frame: Frame, right, up| View {
            frame,
            projection: Projection {
                right,
                up,
                anchor_m: bounds.centre_m(),
                anchor_px: DVec2::from(frame.at([0.5, 0.5])),
                px_per_m,
            },
            bounds: *bounds,
        };
        let views = [
            view(frame([LEFT_PX, top_px], [x, y]), DVec3::X, DVec3::Y),
            view(frame([LEFT_PX, below], [x, z]), DVec3::X, DVec3::Z),
            view(frame([right, below], [y, z]), DVec3::Y, DVec3::Z),
        ];
        let width_px = (right + y + RIGHT_PX).max(760.0);
        Self { views, corner, bottom_px: below + z + 50.0, width_px }
    }

    /// Makes room above everything.
    pub(crate) fn move_down(&mut self, by_px: f64) {
        for view in &mut self.views {
            view.frame.corner_px[1] += by_px;
            view.projection.anchor_px.y += by_px;
        }
        self.corner.corner_px[1] += by_px;
        self.bottom_px += by_px;
    }
}
