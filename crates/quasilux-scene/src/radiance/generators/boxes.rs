//! `genbox material name x y z`: a box from the origin, its faces outward, or inward with `-i`.

use super::{number, polygon};
use crate::radiance::document::{Primitive, shown};
use glam::DVec3;

#[derive(Clone, Debug)]
pub(in crate::radiance) struct Genbox {
    material: String,
    name: String,
    size: DVec3,
    is_inverted: bool,
}

/// Corners of the faces, seen from outside; of a number, bits 0 to 2 are those of x to z.
const FACES: [&str; 6] = ["1540", "4620", "2310", "3267", "5137", "6457"];

impl Genbox {
    pub(super) fn parse(words: &[String]) -> Result<Self, String> {
        let [material, name, ..] = words else {
            return Err("genbox lacks an argument; expected material, name, x, y and z".to_owned());
        };
        let [x, y, z] =
            [number(words, 2, "genbox")?, number(words, 3, "genbox")?, number(words, 4, "genbox")?];
        let mut is_inverted = false;
        for option in &words[5..] {
            match option.as_str() {
                "-i" => is_inverted = true,
                other => {
                    return Err(format!(
                        "the option {} of genbox is not read, which makes plain boxes here; run \
                         it, save what it prints as a file, and name that by !xform in its place",
                        shown(other)
                    ));
                }
            }
        }
        let size = DVec3::new(x, y, z);
        if size.min_element() <= 0.0 {
            return Err("a side of genbox has no length; expected three above 0".to_owned());
        }
        Ok(Self { material: material.clone(), name: name.clone(), size, is_inverted })
    }

    pub(super) fn primitives(&self) -> Vec<Primitive> {
        let corner = |digit: u8| {
            let bit = |bit: u8| f64::from(((digit - b'0') >> bit) & 1);
            self.size * DVec3::new(bit(0), bit(1), bit(2))
        };
        let face = |face: &str| {
            let mut corners: Vec<DVec3> = face.bytes().map(corner).collect();
            if self.is_inverted {
                corners.reverse();
            }
            polygon(&self.material, format!("{}.{face}", self.name), corners.into_iter())
        };
        FACES.into_iter().map(face).collect()
    }
}
