//! Sky, sun and ground.

use super::words::{Primitive, Words};
use super::{Exported, LM_PER_W};
use crate::Environment;
use glam::DVec3;
use quasilux_sky::SUN_RADIUS_DEG;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write;

/// Steps of the table of the sky from the horizon to the zenith, and around.
const ALTITUDE_STEPS: u32 = 180;
const AROUND_STEPS: u32 = 720;

/// Writes what shines from outside.
pub(super) fn write(environment: &Environment, words: &mut Words, exported: &mut Exported) {
    if environment.is_dark() {
        exported.note("the sky is dark, and left out; a sky of weather needs `time` of [sun]");
        return;
    }
    if let Some(direction) = environment.sun_direction() {
        let radiance = environment.sun_luminance_cd_m2() / LM_PER_W;
        words.of_numbers("void", "light", "solar", &[radiance; 3]);
        let [x, y, z] = direction.to_array();
        words.of_numbers("solar", "source", "sun", &[x, y, z, 2.0 * SUN_RADIUS_DEG]);
    }
    exported.add("sky.dat", table(environment));
    exported.note("the sky is a table in steps of half a degree");
    let texts = ["q_sky", "sky.dat", "quasilux.cal", "q_altitude", "q_around"].map(str::to_owned);
    let (modifier, kind, name) = ("void", "brightdata", "sky.d");
    words.add(Primitive { modifier, kind, name, texts: &texts, numbers: &[] });
    words.of_numbers("sky.d", "glow", "sky.g", &[1.0, 1.0, 1.0, 0.0]);
    words.of_numbers("sky.g", "source", "sky", &[0.0, 0.0, 1.0, 180.0]);
    let ground = environment.ground_luminance_cd_m2() / LM_PER_W;
    words.of_numbers("void", "glow", "ground.g", &[ground, ground, ground, 0.0]);
    words.of_numbers("ground.g", "source", "ground", &[0.0, 0.0, -1.0, 180.0]);
}

/// Radiances of the sky by altitude and around, in the format of Radiance's data files.
fn table(environment: &Environment) -> String {
    let mut text = format!("2\n0 90 {}\n0 360 {}\n", ALTITUDE_STEPS + 1, AROUND_STEPS + 1);
    for altitude in 0..=ALTITUDE_STEPS {
        let altitude = f64::from(altitude) / f64::from(ALTITUDE_STEPS) * FRAC_PI_2;
        let (up, flat) = libm::sincos(altitude);
        for around in 0..=AROUND_STEPS {
            let around_rad = f64::from(around % AROUND_STEPS) / f64::from(AROUND_STEPS) * TAU;
            let (y, x) = libm::sincos(around_rad);
            let direction = DVec3::new(flat * x, flat * y, up);
            let radiance = environment.luminance_cd_m2(direction) / LM_PER_W;
            let separator = if around == AROUND_STEPS { '\n' } else { ' ' };
            write!(text, "{radiance:.6e}{separator}").expect("strings grow");
        }
    }
    text
}
