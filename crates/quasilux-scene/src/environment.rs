//! What is outside: the sky, the sun, the ground, and the openings that they shine through.

use glam::DVec3;
use quasilux_sky::{CieType, LocalTime, Site, Sky, SkyPoint, sun_luminance_cd_m2};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2};

/// Everything beyond the triangles: light that comes from infinitely far away.
#[derive(Clone, Debug)]
pub struct Environment {
    /// The sky without the sun.
    pub sky: Sky,
    /// The sun, where its disk shines.
    pub sun: Option<Sun>,
    /// The share of light that the ground reflects, an endless plane below everything.
    pub ground_reflectance: f64,
    /// Where north is: degrees from +y, counter-clockwise seen from above.
    pub north_deg: f64,
    /// Where light may be asked for; they block nothing and need not be complete.
    pub openings: Vec<Opening>,
}

/// The disk of the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Its centre.
    pub centre: SkyPoint,
    /// Its illuminance on a plane across its rays, in lx.
    pub normal_illuminance_lx: f64,
}

/// A parallelogram that light from outside enters through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// A corner, in m.
    pub origin: DVec3,
    /// The edges from it, in m.
    pub u: DVec3,
    /// The other edge.
    pub v: DVec3,
}

/// Facts that a sky was made from, for reports.
#[derive(Clone, Debug, PartialEq)]
pub struct SkyFacts {
    /// How its luminances are distributed.
    pub model: SkyModel,
    /// Where on the earth it is, where that is known.
    pub site: Option<Site>,
    /// The time that the sun's place is of, by the clock of the site, where a time gave it.
    pub time: Option<LocalTime>,
    /// The centre of the sun, whether its disk shines or not; it may be below the horizon.
    pub sun: Option<SkyPoint>,
}

/// How the luminances of a sky are distributed.
#[derive(Clone, Debug, PartialEq)]
pub enum SkyModel {
    /// Evenly.
    Uniform,
    /// As a CIE standard general sky.
    Cie(CieType),
    /// By Perez, of irradiances in the project file.
    Perez,
    /// By Perez, of an interval of a weather file; of none where the project names no time.
    Weather {
        /// The file, as the project file writes it.
        file: String,
    },
    /// As a picture has them.
    Panorama {
        /// The file, as the project file writes it.
        file: String,
    },
}

impl SkyFacts {
    /// Whether the sky is that of no time: the project names a weather file, and no time.
    #[must_use]
    pub fn lacks_time(&self) -> bool {
        matches!(self.model, SkyModel::Weather { .. }) && self.time.is_none()
    }
}

impl Environment {
    /// The luminance of the sky or of the ground in a direction of the world, a unit vector, in
    /// cd/m2; without the disk of the sun.
    #[must_use]
    pub fn luminance_cd_m2(&self, direction: DVec3) -> f64 {
        if direction.z < 0.0 {
            self.ground_luminance_cd_m2()
        } else {
            self.sky.luminance_cd_m2(self.to_sky(direction))
        }
    }

    /// The luminance of the disk of the sun in cd/m2; 0 where it does not shine.
    #[must_use]
    pub fn sun_luminance_cd_m2(&self) -> f64 {
        self.sun.map_or(0.0, |sun| sun_luminance_cd_m2(sun.normal_illuminance_lx))
    }

    /// Towards the centre of the sun, a unit vector of the world.
    #[must_use]
    pub fn sun_direction(&self) -> Option<DVec3> {
        self.sun.map(|sun| self.towards(sun.centre))
    }

    /// Towards a point of the sky, a unit vector of the world.
    #[must_use]
    pub fn towards(&self, point: SkyPoint) -> DVec3 {
        turned(DVec3::from_array(point.to_direction()), self.north_deg)
    }

    /// The illuminance in lx on a horizontal plane that nothing shades: of the sky, and of the sun
    /// where its disk shines.
    #[must_use]
    pub fn horizontal_illuminance_lx(&self) -> f64 {
        let of_sun = self.sun.map_or(0.0, |sun| {
            let sine = libm::sin(sun.centre.altitude_deg.to_radians()).max(0.0);
            sun.normal_illuminance_lx * sine
        });
        self.sky.horizontal_illuminance_lx() + of_sun
    }

    /// Whether nothing shines: a sky of 0 lx without a sun.
    #[must_use]
    pub fn is_dark(&self) -> bool {
        self.sky.horizontal_illuminance_lx() <= 0.0 && self.sun.is_none()
    }

    /// The luminance of the ground, lit by the whole sky, in cd/m2.
    #[must_use]
    pub fn ground_luminance_cd_m2(&self) -> f64 {
        self.ground_reflectance * self.horizontal_illuminance_lx() * FRAC_1_PI
    }

    /// From a direction of the world to one by the compass: x east, y north, z up.
    #[must_use]
    pub fn to_sky(&self, direction: DVec3) -> [f64; 3] {
        turned(direction, -self.north_deg).to_array()
    }

    /// From a direction by the compass, x east and y north, to one of the world.
    #[must_use]
    pub fn to_world(&self, direction: DVec3) -> DVec3 {
        turned(direction, self.north_deg)
    }
}

impl Opening {
    /// Its two triangles, with corners in m.
    #[must_use]
    pub fn triangles(&self) -> [[DVec3; 3]; 2] {
        let Self { origin, u, v } = *self;
        [[origin, origin + u, origin + u + v], [origin, origin + u + v, origin + v]]
    }
}

/// Counter-clockwise about the vertical, seen from above; quarter turns are exact.
fn turned(direction: DVec3, angle_deg: f64) -> DVec3 {
    let quarters = libm::round(angle_deg / 90.0);
    let (sin, cos) = libm::sincos((angle_deg / 90.0 - quarters) * FRAC_PI_2);
    let DVec3 { x, y, z } = direction;
    let (x, y) = (cos * x - sin * y, sin * x + cos * y);
    match quarters.rem_euclid(4.0) as u8 {
        1 => DVec3::new(-y, x, z),
        2 => DVec3::new(-x, -y, z),
        3 => DVec3::new(y, -x, z),
        _ => DVec3::new(x, y, z),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sky::{CieType, Distribution, SkyLevel};

    fn environment(north_deg: f64, sun: Option<Sun>) -> Environment {
        let centre = SkyPoint { altitude_deg: 30.0, azimuth_deg: 90.0 };
        let distribution = Distribution::cie(CieType::new(12).unwrap(), centre);
        let level = SkyLevel::HorizontalIlluminance { lx: 1000.0 };
        let sky = Sky::new(distribution, level).unwrap();
        Environment { sky, sun, ground_reflectance: 0.2, north_deg, openings: Vec::new() }
    }

    /// The brightest part of the sky turns with the compass: the sun is in the east.
    #[test]
    fn north_turns_the_sky() {
        let up = libm::sin(30_f64.to_radians());
        let flat = libm::cos(30_f64.to_radians());
        for (north_deg, towards) in [
            (0.0, DVec3::new(flat, 0.0, up)),
            (90.0, DVec3::new(0.0, flat, up)),
            (-90.0, DVec3::new(0.0, -flat, up)),
            (180.0, DVec3::new(-flat, 0.0, up)),
            (450.0, DVec3::new(0.0, flat, up)),
        ] {
            let centre = SkyPoint { altitude_deg: 30.0, azimuth_deg: 90.0 };
            let sun = Sun { centre, normal_illuminance_lx: 5000.0 };
            let outside = environment(north_deg, Some(sun));
            assert!((outside.sun_direction().unwrap() - towards).length() < 1e-12, "{north_deg}");
            let brightest = outside.luminance_cd_m2(towards);
            let others = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y, DVec3::Z];
            assert!(others.iter().all(|other| outside.luminance_cd_m2(*other) < brightest));
        }
        let (a, b) = (environment(30.0, None), environment(0.0, None));
        let direction = DVec3::new(0.3, -0.2, 0.9).normalize();
        let found = a.luminance_cd_m2(turned(direction, 30.0));
        assert!((found / b.luminance_cd_m2(direction) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_ground_reflects_sky_and_sun() {
        let centre = SkyPoint { altitude_deg: 30.0, azimuth_deg: 90.0 };
        let sun = Sun { centre, normal_illuminance_lx: 4000.0 };
        let outside = environment(0.0, Some(sun));
        assert!((outside.horizontal_illuminance_lx() - 3000.0).abs() < 1e-9);
        let expected = 0.2 * 3000.0 * FRAC_1_PI;
        assert!((outside.luminance_cd_m2(-DVec3::Z) - expected).abs() < 1e-9);
        assert_eq!(environment(0.0, None).sun_luminance_cd_m2(), 0.0);
    }
}
