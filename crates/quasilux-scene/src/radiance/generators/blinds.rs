//! `genblinds material name depth width height nslats angle [-r|+r radius]`: slats along y, the
//! first edge of each at x = 0, turned by the angle; curved ones are arcs of flat strips.

use super::{number, polygon};
use crate::radiance::document::{Primitive, shown};
use glam::DVec3;

#[derive(Clone, Debug)]
pub(in crate::radiance) struct Genblinds {
    material: String,
    name: String,
    depth: f64,
    width: f64,
    height: f64,
    slats: u32,
    angle_rad: f64,
    /// Radius of curvature, above 0 where slats bulge upward; 0 where they are flat.
    radius: f64,
}

const MAX_SLATS: f64 = 10_000.0;
/// Strips of curved slats turn by less than this.
const STRIP_RAD: f64 = std::f64::consts::PI / 60.0;

impl Genblinds {
    pub(super) fn parse(words: &[String]) -> Result<Self, String> {
        let [material, name, ..] = words else {
            return Err("genblinds lacks an argument; expected material, name, depth, width, \
                        height, number of slats and angle"
                .to_owned());
        };
        let number = |at| number(words, at, "genblinds");
        let [depth, width, height] = [number(2)?, number(3)?, number(4)?];
        let (slats, angle_deg) = (number(5)?, number(6)?);
        let radius = match words.get(7).map(String::as_str) {
            None => 0.0,
            Some("-r") => -number(8)?,
            Some("+r") => number(8)?,
            Some(other) => {
                let other = shown(other);
                return Err(format!(
                    "the option {other} of genblinds is not read; expected -r or +r"
                ));
            }
        };
        if !(1.0..=MAX_SLATS).contains(&slats) || slats.fract() != 0.0 {
            return Err(format!("genblinds has {slats} slats; expected 1 to {MAX_SLATS}"));
        }
        if depth <= 0.0 || width <= 0.0 || height <= 0.0 {
            return Err("genblinds has no size; expected lengths above 0".to_owned());
        }
        if radius != 0.0 && radius.abs() < 0.5 * depth {
            return Err(
                "the radius of genblinds is too small; expected half its depth, or more".to_owned()
            );
        }
        let (material, name, slats) = (material.clone(), name.clone(), slats as u32);
        let angle_rad = angle_deg.to_radians();
        Ok(Self { material, name, depth, width, height, slats, angle_rad, radius })
    }

    pub(super) fn primitives(&self) -> Vec<Primitive> {
        let section = self.section();
        let mut all = Vec::new();
        for slat in 0..self.slats {
            let z = (f64::from(slat) + 0.5) * self.height / f64::from(self.slats);
            for (strip, edge) in section.windows(2).enumerate() {
                let corner = |point: DVec3, y| point + DVec3::new(0.0, y, z);
                let [a, b] = [edge[0], edge[1]];
                let corners =
                    [corner(a, 0.0), corner(a, self.width), corner(b, self.width), corner(b, 0.0)];
                let name = format!("{}.{}.{strip}", self.name, slat + 1);
                all.push(polygon(&self.material, name, corners.into_iter()));
            }
        }
        all
    }

    /// A slat in the plane y = 0, edge by edge.
    fn section(&self) -> Vec<DVec3> {
        let radius = self.radius.abs();
        let half_rad = if radius > 0.0 { libm::asin(0.5 * self.depth / radius) } else { 0.0 };
        let strips = 1 + (2.0 * half_rad / STRIP_RAD) as usize;
        let (sin, cos) = libm::sincos(self.angle_rad);
        let point = |step: usize| {
            let share = step as f64 / strips as f64;
            let (x, z) = if radius > 0.0 {
                let (s, c) = libm::sincos((2.0 * share - 1.0) * half_rad);
                let sagitta = radius * (c - libm::cos(half_rad));
                (0.5 * self.depth + radius * s, sagitta * self.radius.signum())
            } else {
                (share * self.depth, 0.0)
            };
            DVec3::new(x * cos - z * sin, 0.0, x * sin + z * cos)
        };
        (0..=strips).map(point).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn blinds(text: &str) -> Result<Genblinds, String> {
        Genblinds::parse(&text.split(' ').map(str::to_owned).collect::<Vec<_>>())
    }

    /// Corners as `genblinds m bl .1 1 1 3 30` and `.. 1 0 +r 0.2` of Radiance 6.1 print them.
    #[test]
    fn slats_are_those_of_the_program() {
        let flat = blinds("m bl .1 1 1 3 30").unwrap().primitives();
        let last = [0.0866025403784, 1.0, 0.883333333333, 0.0866025403784, 0.0, 0.883333333333];
        assert_eq!((flat.len(), &*flat[2].name), (3, "bl.3.0"));
        let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-11);
        assert!(near(&flat[2].reals[6..], &last), "{:?}", flat[2].reals);
        let curved = blinds("m bl .1 1 1 1 0 +r 0.2").unwrap().primitives();
        assert_eq!(curved.len(), 10);
        let corner = [0.00984593294587, 1.0, 0.502278500208];
        assert!(near(&curved[0].reals[6..9], &corner), "{:?}", curved[0].reals);
        assert!(blinds("m bl .1 1 1 1e9 0").is_err() && blinds("m bl .1 1 1 1 0 -r .01").is_err());
    }
}
