//! An orthographic view of the world on the sheet.

use glam::{DVec2, DVec3};

/// Where places of the world lie on the sheet. The viewer looks against `right` x `up`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    /// Unit directions in the world that run to the right and upward on the sheet.
    pub(crate) right: DVec3,
    pub(crate) up: DVec3,
    /// The place of the world, and where it lies on the sheet.
    pub(crate) anchor_m: DVec3,
    pub(crate) anchor_px: DVec2,
    pub(crate) px_per_m: f64,
}

impl Projection {
    /// Direction toward the viewer.
    pub(crate) fn toward(&self) -> DVec3 {
        self.right.cross(self.up)
    }

    /// Where a place of the world lies on the sheet.
    pub(crate) fn place(&self, point_m: DVec3) -> DVec2 {
        self.anchor_px + self.direction(point_m - self.anchor_m) * self.px_per_m
    }

    /// What of a direction of the world lies in the sheet, y down; as long as its part in the plane
    /// of the sheet.
    pub(crate) fn direction(&self, direction: DVec3) -> DVec2 {
        DVec2::new(direction.dot(self.right), -direction.dot(self.up))
    }
}
