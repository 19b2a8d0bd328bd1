//! Luminaires: the text of their photometric files, and where they hang.
//!
//! Honeybee turns a luminaire of `ies2rad`, which aims down -z with its half-plane of 0 degrees
//! along +x, by `xform -rz spin -ry tilt -rz rotation -t point`: a point p goes to
//! Rz(rotation) Ry(tilt) Rz(spin) p, and is moved.

use super::Writer;
use super::text::{number, quoted, vector};
use crate::LoadError;
use crate::honeybee::{Luminaire, LuminaireInstance, Model};
use crate::radiance::sincos;
use glam::DVec3;

/// Most that a luminaire may be dimmed by, as in project files.
const MAX_FACTOR: f64 = 1e9;

/// Directions that a luminaire's placement names.
struct Turned {
    aim: DVec3,
    c0: DVec3,
}

impl Writer<'_> {
    /// Writes the luminaires; how many hang somewhere.
    pub(super) fn luminaires(&mut self, model: &Model) -> Result<usize, LoadError> {
        let Some(radiance) = model.radiance() else { return Ok(0) };
        let mut count = 0;
        for (which, luminaire) in radiance.luminaires.iter().enumerate() {
            let place = format!("properties.radiance.luminaires[{which}]");
            let instances = luminaire.instances();
            if instances.is_empty() {
                self.findings.note(&place, "a luminaire that hangs nowhere is left out");
                continue;
            }
            let content = content(luminaire).ok_or_else(|| self.refusal(&place, NO_CONTENT))?;
            let factor = self.factor(luminaire, &place)?;
            let name = luminaire.identifier.as_deref().unwrap_or("luminaire");
            let file = self.file(name, ".ies", content.as_bytes().to_vec());
            for instance in instances {
                self.instance(instance, &file, factor);
            }
            count += instances.len();
        }
        Ok(count)
    }

    fn refusal(&self, place: &str, what: &str) -> LoadError {
        LoadError::new(self.terms.model, None, format!("{place}: {what}"))
    }

    /// Factor on the light of the file.
    fn factor(&mut self, luminaire: &Luminaire, place: &str) -> Result<f64, LoadError> {
        let lamp = luminaire.custom_lamp.as_ref();
        if lamp.is_some() {
            self.findings.note(place, "the colour of its custom lamp is left out");
        }
        let factors = [
            ("light_loss_factor", luminaire.light_loss_factor),
            ("candela_multiplier", luminaire.candela_multiplier),
            ("custom_lamp.depreciation_factor", lamp.and_then(|lamp| lamp.depreciation_factor)),
        ];
        let mut product = 1.0;
        for (key, factor) in factors {
            let factor = factor.unwrap_or(1.0);
            product *= factor;
            if !(factor > 0.0 && product <= MAX_FACTOR) {
                let what = format!("{key} is {factor}; expected a factor above 0, at most 1e9");
                return Err(self.refusal(place, &what));
            }
        }
        Ok(product)
    }

    fn instance(&mut self, instance: &LuminaireInstance, file: &str, factor: f64) {
        let point = instance.point;
        let Turned { aim, c0 } = turned(instance);
        self.text.section("[[luminaires]]");
        self.text.key("photometry", &quoted(file));
        self.text.key("position", &vector(DVec3::new(point.x, point.y, point.z)));
        self.text.key("aim", &vector(aim));
        self.text.key("c0", &vector(c0));
        if factor != 1.0 {
            self.text.key("dimming", &number(factor));
        }
    }
}

const NO_CONTENT: &str = "no ies_content; expected the text of the IES file, as Honeybee writes it";

/// The text of the file, which may stand in place of its name.
fn content(luminaire: &Luminaire) -> Option<&str> {
    let path = luminaire.ies_path.as_deref();
    let is_text = |text: &&str| text.trim_start().to_ascii_uppercase().starts_with("IESNA");
    let content = luminaire.ies_content.as_deref().filter(|text| !text.trim().is_empty());
    content.or(path.filter(is_text))
}

fn turned(instance: &LuminaireInstance) -> Turned {
    let [spin, tilt, rotation] = [instance.spin, instance.tilt, instance.rotation];
    let turn = |direction| about_z(about_y(about_z(direction, spin), tilt), rotation);
    Turned { aim: turn(DVec3::NEG_Z), c0: turn(DVec3::X) }
}

fn about_z(v: DVec3, degrees: f64) -> DVec3 {
    let (sin, cos) = sincos(degrees);
    DVec3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
}

fn about_y(v: DVec3, degrees: f64) -> DVec3 {
    let (sin, cos) = sincos(degrees);
    DVec3::new(v.x * cos + v.z * sin, v.y, v.z * cos - v.x * sin)
}
