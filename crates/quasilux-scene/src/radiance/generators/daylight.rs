//! `gendaylit`: a sky of Perez, Seals and Michalsky (1993) by two irradiances.

use super::number;
use super::sky::{When, primitive, when};
use crate::radiance::document::{Primitive, shown};
use glam::DVec3;

/// The file of functions that its sky refers to here, where it has not been computed yet.
pub(in crate::radiance) const FILE: &str = "gendaylit";

#[derive(Clone, Debug)]
pub(in crate::radiance) struct Gendaylit {
    sun: DVec3,
    direct_normal_w_m2: f64,
    diffuse_horizontal_w_m2: f64,
    has_sun: bool,
    ground_reflectance: f64,
}

impl Gendaylit {
    pub(super) fn parse(words: &[String]) -> Result<Self, String> {
        let When { sun, used } = when("gendaylit", words, "")?;
        let mut irradiances = None;
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
                "-a" | "-o" | "-m" | "-y" => {}
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
        let sky =
            Self { sun, direct_normal_w_m2, diffuse_horizontal_w_m2, has_sun, ground_reflectance };
        Ok(sky)
    }

    pub(super) fn primitives(&self) -> Vec<Primitive> {
        let [x, y, z] = self.sun.to_array();
        let has_sun = f64::from(u8::from(self.has_sun));
        let (direct, diffuse) = (self.direct_normal_w_m2, self.diffuse_horizontal_w_m2);
        let reals = vec![direct, diffuse, x, y, z, has_sun, self.ground_reflectance];
        let strings = vec!["skybright".into(), FILE.into()];
        vec![Primitive { strings, ..primitive("void", "brightfunc", "skyfunc", reals) }]
    }
}
