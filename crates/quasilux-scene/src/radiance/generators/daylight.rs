//! `gendaylit`: a sky of Perez, Seals and Michalsky (1993) by two irradiances.

use super::number;
use super::sky::{NO_YEAR, When, primitive, when};
use crate::radiance::document::{Primitive, shown};
use crate::radiance::look::EFFICACY_LM_W;
use glam::DVec3;
use quasilux_sky::{Irradiance, Perez, SkyPoint};
use std::f64::consts::PI;

/// The file of functions that its sky refers to here, where it has not been computed yet.
pub(in crate::radiance) const FILE: &str = "gendaylit";

#[derive(Clone, Debug)]
pub(in crate::radiance) struct Gendaylit {
    sun: DVec3,
    direct_normal_w_m2: f64,
    diffuse_horizontal_w_m2: f64,
    has_sun: bool,
    ground_reflectance: f64,
    pub(super) remarks: Vec<&'static str>,
}

/// Full angle of the sun's disk in degrees, as the program writes it.
const SUN_DEG: f64 = 0.533;
/// A day on which the sun is at its mean distance, where none is told.
const MEAN_DAY: u32 = 94;

impl Gendaylit {
    pub(super) fn parse(words: &[String]) -> Result<Self, String> {
        let When { sun, used } = when("gendaylit", words)?;
        let mut irradiances = None;
        let mut remarks = Vec::new();
        let (mut has_sun, mut ground_reflectance) = (true, 0.2);
        let mut at = used;
        while let Some(option) = words.get(at) {
            at += 1;
            let value = |at| number(words, at, &format!("{option} of gendaylit"));
            match option.as_str() {
                "-s" => {
                    has_sun = false;
                    continue;
                }
                // Warnings of the program.
                "-w" => continue,
                "-W" => irradiances = Some([value(at)?, value(at + 1)?]),
                "-G" => irradiances = Some([value(at)? / sun.z.max(1e-3), value(at + 1)?]),
                "-g" => ground_reflectance = value(at)?,
                "-a" | "-o" | "-m" => {}
                "-y" => remarks.push(NO_YEAR),
                _ => {
                    return Err(format!(
                        "the option {} of gendaylit is not read; give the irradiances of sun and \
                         sky as -W or -G",
                        shown(option)
                    ));
                }
            }
            at += if matches!(option.as_str(), "-W" | "-G") { 2 } else { 1 };
        }
        let missing = || "gendaylit lacks the irradiances of sun and sky; give -W or -G".to_owned();
        let [direct_normal_w_m2, diffuse_horizontal_w_m2] = irradiances.ok_or_else(missing)?;
        Ok(Self {
            sun,
            direct_normal_w_m2,
            diffuse_horizontal_w_m2,
            has_sun,
            ground_reflectance,
            remarks,
        })
    }

    /// Radiance of the sun's disk; `None` where none shines.
    fn solar_radiance(&self) -> Option<f64> {
        let DVec3 { x, y, z } = self.sun;
        let altitude_deg = libm::atan2(z, libm::hypot(x, y)).to_degrees();
        let azimuth_deg = libm::atan2(x, y).to_degrees().rem_euclid(360.0);
        let irradiance = Irradiance {
            direct_normal_w_m2: self.direct_normal_w_m2,
            diffuse_horizontal_w_m2: self.diffuse_horizontal_w_m2,
        };
        let sun = SkyPoint { altitude_deg, azimuth_deg };
        let perez = Perez::new(irradiance, sun, MEAN_DAY, Perez::DEW_POINT_C).ok()?;
        let solid_angle = 2.0 * PI * (1.0 - libm::cos((0.5 * SUN_DEG).to_radians()));
        let radiance = perez.normal_illuminance_lx() / EFFICACY_LM_W / solid_angle;
        (self.has_sun && z > 0.0 && radiance > 0.0).then_some(radiance)
    }

    pub(super) fn primitives(&self) -> Vec<Primitive> {
        let [x, y, z] = self.sun.to_array();
        let has_sun = f64::from(u8::from(self.has_sun));
        let (direct, diffuse) = (self.direct_normal_w_m2, self.diffuse_horizontal_w_m2);
        let reals = vec![direct, diffuse, x, y, z, has_sun, self.ground_reflectance];
        let strings = vec!["skybright".into(), FILE.into()];
        let mut all = Vec::new();
        if let Some(radiance) = self.solar_radiance() {
            all.push(primitive("void", "light", "solar", vec![radiance; 3]));
            all.push(primitive("solar", "source", "sun", vec![x, y, z, SUN_DEG]));
        }
        all.push(Primitive { strings, ..primitive("void", "brightfunc", "skyfunc", reals) });
        all
    }
}
