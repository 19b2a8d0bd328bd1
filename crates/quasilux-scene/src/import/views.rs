//! Views as cameras: perspective ones alone.

use super::Writer;
use super::text::{number, quoted, vector};
use crate::Camera;
use crate::honeybee::{Model, View};

/// Pixels along the longer edge of a picture.
const LONGER_EDGE: f64 = 800.0;

impl Writer<'_> {
    /// Writes the views; their number.
    pub(super) fn views(&mut self, model: &Model) -> usize {
        let Some(radiance) = model.radiance() else { return 0 };
        let mut count = 0;
        for view in radiance.views.iter() {
            let place = format!("view \"{}\"", view.identifier);
            match view.why_no_camera() {
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
        let [across, upright] = view.sizes_deg();
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
