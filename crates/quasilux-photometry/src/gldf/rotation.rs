//! How a light emitter is turned: `Rotation` with X, Y, Z and G0 in degrees.
//!
//! GLDF 1.0.0-rc.3 names the axes and no more. *Our reading:* the frame is that of the luminaire
//! (C0 along +x, C90 along +y, up +z); angles are right-handed, as mathematics counts them; the
//! order is that of L3D, "fixed to ZXY" about local axes (L3D XML reference, `Rotation`), so the
//! matrix is Rz Rx Ry; G0, the turn of the photometry about its own axis gamma = 0, comes first and
//! turns C0 toward C90. With G0 = 90 the street side of an IES file, which is C0 in the example of
//! the documentation ("IES 90 degrees rotation around G0 for street luminaires"), becomes that of
//! CIE files, C90.

use super::GldfError;
use super::figures::number;
use glam::{DMat3, DVec3};
use quasilux_text::xml::Element;

/// Turns by less than this are none, in radians.
const NONE_RAD: f64 = 1e-9;

/// The turn of a light emitter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    /// From the frame of the photometry to that of the luminaire.
    pub(super) luminaire_from_photometry: DMat3,
    /// X, Y, Z and G0 in degrees.
    pub(super) angles_deg: [f64; 4],
}

impl Turn {
    /// Reads the turn of a light emitter; none without `Rotation`.
    pub(super) fn read(light: &Element<'_>) -> Result<Self, GldfError> {
        let mut angles_deg = [0.0; 4];
        if let Some(rotation) = light.child("Rotation") {
            for (angle, name) in angles_deg.iter_mut().zip(["X", "Y", "Z", "G0"]) {
                *angle = number(rotation, name)?.unwrap_or(0.0) % 360.0;
            }
        }
        let [x, y, z, g0] = angles_deg.map(f64::to_radians);
        let turns = about(DVec3::Z, z) * about(DVec3::X, x) * about(DVec3::Y, y);
        Ok(Self { luminaire_from_photometry: turns * about(DVec3::Z, g0), angles_deg })
    }

    /// Whether nothing is turned.
    pub(super) fn is_none(&self) -> bool {
        self.angles_deg.iter().all(|angle| angle.to_radians().abs() < NONE_RAD)
    }
}

/// A right-handed turn about a unit axis; a quarter turn is exact.
fn about(axis: DVec3, angle_rad: f64) -> DMat3 {
    let (sin, cos) = libm::sincos(angle_rad);
    let clean = |value: f64| if value.abs() < NONE_RAD { 0.0 } else { value };
    let (sin, cos) = (clean(sin), clean(cos));
    let turned = |v: DVec3| {
        let along = axis * axis.dot(v);
        along + (v - along) * cos + axis.cross(v) * sin
    };
    DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_text::xml;

    fn turn(rotation: &str) -> DMat3 {
        let text =
            format!("<FixedLightEmitter><Rotation>{rotation}</Rotation></FixedLightEmitter>");
        Turn::read(&xml::parse(&text).unwrap()).unwrap().luminaire_from_photometry
    }

    #[test]
    fn each_angle_turns_about_its_axis() {
        let down = DVec3::NEG_Z;
        for (rotation, of_down, of_c0) in [
            ("<X>90</X>", DVec3::Y, DVec3::X),
            ("<Y>90</Y>", DVec3::NEG_X, DVec3::NEG_Z),
            ("<Z>90</Z>", DVec3::NEG_Z, DVec3::Y),
            ("<G0>90</G0>", DVec3::NEG_Z, DVec3::Y),
            ("<X>180</X><G0>90</G0>", DVec3::Z, DVec3::NEG_Y),
            ("<X>90</X><Z>90</Z>", DVec3::NEG_X, DVec3::Y),
            // The order is fixed: Y first, about the luminaire's own axis, then X, then Z.
            ("<X>90</X><Y>90</Y>", DVec3::NEG_X, DVec3::Y),
            ("<Y>90</Y><Z>90</Z>", DVec3::NEG_Y, DVec3::NEG_Z),
            ("<X>360</X><Y>0</Y>", DVec3::NEG_Z, DVec3::X),
        ] {
            let turn = turn(rotation);
            assert!((turn * down - of_down).length() < 1e-12, "{rotation}: {}", turn * down);
            assert!((turn * DVec3::X - of_c0).length() < 1e-12, "{rotation}: {}", turn * DVec3::X);
        }
    }
}
