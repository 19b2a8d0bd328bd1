//! Views as cameras: perspective ones alone.

use super::Writer;
use super::text::{number, quoted, vector};
use crate::Camera;
use crate::honeybee::{Model, View};

/// Pixels along the longer edge of a picture.
const LONGER_EDGE: f64 = 800.0;
/// The angle of a view that says none, in degrees.
const USUAL_SIZE_DEG: f64 = 60.0;
/// Sine of the smallest angle between a line of sight and what is up, as in project files.
const MIN_SINE: f64 = 1e-6;

impl Writer<'_> {
    /// Writes the views; their number.
    pub(super) fn views(&mut self, model: &Model) -> usize {
        let Some(radiance) = model.radiance() else { return 0 };
        let mut count = 0;
        for view in radiance.views.iter() {
            let place = format!("view \"{}\"", view.identifier);
            match odd(view) {
                Some(note) => self.findings.note(&place, note),
                None => {
                    self.view(view, &place);
                    count += 1;
                }
            }
        }
        count
    }

    fn view(&mut self, view: &View, place: &str) {
        if view.fore_clip.is_some() || view.aft_clip.is_some() {
            self.findings.note(place, "its clipping planes are left out");
        }
        let name = self.names.new_name(&view.identifier, &["", Camera::FALSE_COLOUR_ENDING]);
        if name != view.identifier {
            let note = "its name is taken, or none for a file: the picture has another one";
            self.findings.note(place, note);
        }
        let [across, upright] = sizes_deg(view);
        let half_tangent = |degrees: f64| libm::tan(0.5 * degrees.to_radians());
        let [width, height] = [across, upright].map(half_tangent);
        let pixels = |edge: f64| number((LONGER_EDGE * edge / width.max(height)).round().max(1.0));
        self.text.section("[[cameras]]");
        self.text.key("name", &quoted(&name));
        self.text.key("position", &vector(view.position.0));
        self.text.key("target", &vector(view.position.0 + view.direction.0));
        if let Some(up) = view.up_vector {
            self.text.key("up", &vector(up.0));
        }
        self.text.key("vertical_fov_deg", &number(upright));
        self.text.key("resolution", &format!("[{}, {}]", pixels(width), pixels(height)));
    }
}

/// Horizontal and vertical angles.
fn sizes_deg(view: &View) -> [f64; 2] {
    [view.h_size, view.v_size].map(|size| size.unwrap_or(USUAL_SIZE_DEG))
}

/// Why there is no camera like a view.
fn odd(view: &View) -> Option<&'static str> {
    let kind = view.view_type.as_deref().unwrap_or("v");
    let is_moved = |by: Option<f64>| by.is_some_and(|by| by != 0.0);
    let is_angle = |degrees: f64| degrees > 0.0 && degrees < 180.0;
    let direction = view.direction.0.normalize_or_zero();
    let up = view.up_vector.map_or(glam::DVec3::Z, |up| up.0).normalize_or_zero();
    if kind != "v" {
        return Some("only perspective views (view_type v) become cameras: left out");
    }
    if is_moved(view.shift) || is_moved(view.lift) {
        return Some("a view with shift or lift is left out");
    }
    if !sizes_deg(view).into_iter().all(is_angle) {
        return Some("h_size and v_size of a perspective view lie between 0 and 180: left out");
    }
    if direction.cross(up).length() < MIN_SINE {
        return Some("a view whose direction is along up_vector is left out");
    }
    None
}
