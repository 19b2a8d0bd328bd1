//! Views that a picture can be taken of.

use super::radiance::View;
use glam::DVec3;

/// The angle of a view that says none, in degrees.
const USUAL_SIZE_DEG: f64 = 60.0;
/// Sine of the smallest angle between a line of sight and what is up, as in project files.
const MIN_SINE: f64 = 1e-6;

impl View {
    /// Horizontal and vertical angles.
    pub(crate) fn sizes_deg(&self) -> [f64; 2] {
        [self.h_size, self.v_size].map(|size| size.unwrap_or(USUAL_SIZE_DEG))
    }

    /// Why there is no camera like a self.
    pub(crate) fn why_no_camera(&self) -> Option<&'static str> {
        let kind = self.view_type.as_deref().unwrap_or("v");
        let is_moved = |by: Option<f64>| by.is_some_and(|by| by != 0.0);
        let is_angle = |degrees: f64| degrees > 0.0 && degrees < 180.0;
        let direction = self.direction.0.normalize_or_zero();
        let up = self.up_vector.map_or(DVec3::Z, |up| up.0).normalize_or_zero();
        if kind != "v" {
            return Some("only perspective views (view_type v) become cameras: left out");
        }
        if is_moved(self.shift) || is_moved(self.lift) {
            return Some("a view with shift or lift is left out");
        }
        if !self.sizes_deg().into_iter().all(is_angle) {
            return Some("h_size and v_size of a perspective view lie between 0 and 180: left out");
        }
        if direction.cross(up).length() < MIN_SINE {
            return Some("a view whose direction is along up_vector is left out");
        }
        None
    }
}
