//! What is outside: sky, ground, sun.

use crate::random::Xoshiro;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// Half the angle that the sun's disk fills, in degrees.
const SUN_HALF_ANGLE_DEG: f64 = 0.2665;

/// The sky above the horizon and the ground below, without end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// How it is distributed.
    pub model: SkyModel,
    /// Luminance at the zenith in cd/m^2.
    pub zenith_luminance_cd_m2: f64,
    /// Luminance of the ground in cd/m^2: its reflectance times what falls on it over pi.
    pub ground_luminance_cd_m2: f64,
}

/// How the luminance of a sky is distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkyModel {
    /// The same everywhere.
    Uniform,
    /// The traditional overcast sky of the CIE (Moon and Spencer 1942): `(1 + 2 sin altitude) / 3`
    /// of the zenith.
    Overcast,
    /// The CIE standard overcast sky, type 1 of ISO 15469:2004.
    StandardOvercast,
}

/// The sun: a disk of even luminance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sun {
    /// Unit direction to its middle.
    pub direction: DVec3,
    /// What it gives on a plane across its rays, in lx.
    pub normal_illuminance_lx: f64,
}

impl SkyModel {
    /// Luminance over that of the zenith by the sine of the altitude.
    fn relative(self, sine: f64) -> f64 {
        match self {
            Self::Uniform => 1.0,
            Self::Overcast => (1.0 + 2.0 * sine) / 3.0,
            // Gradation I, a = 4 and b = -0.7, and indicatrix 1, which is even.
            Self::StandardOvercast => {
                let gradation = |sine: f64| 1.0 + 4.0 * libm::exp(-0.7 / sine.max(1e-9));
                gradation(sine) / gradation(1.0)
            }
        }
    }
}

impl Sky {
    /// The luminance that comes from a unit direction, in cd/m^2.
    #[must_use]
    pub fn luminance_cd_m2(&self, direction: DVec3) -> f64 {
        if direction.z > 0.0 {
            self.zenith_luminance_cd_m2 * self.model.relative(direction.z)
        } else {
            self.ground_luminance_cd_m2
        }
    }

    /// What the sky gives on an open horizontal plane, in lx: a midpoint sum of
    /// `2 pi L(sine) sine` over the sine of the altitude.
    #[must_use]
    pub fn horizontal_illuminance_lx(&self) -> f64 {
        let steps = 20_000;
        let value = |i| {
            let sine = (f64::from(i) + 0.5) / f64::from(steps);
            self.model.relative(sine) * sine
        };
        let sum: f64 = (0..steps).map(value).sum();
        TAU * self.zenith_luminance_cd_m2 * sum / f64::from(steps)
    }

    /// The same sky over ground of this reflectance, which the sun may light too.
    #[must_use]
    pub fn over_ground(self, reflectance: f64, sun: Option<&Sun>) -> Self {
        let sun_lx = sun.map_or(0.0, |it| it.normal_illuminance_lx * it.direction.z.max(0.0));
        let lx = self.horizontal_illuminance_lx() + sun_lx;
        Self { ground_luminance_cd_m2: reflectance * lx / PI, ..self }
    }
}

impl Sun {
    /// `1 - cos` of half its angle, with all digits.
    fn depth() -> f64 {
        let sine = libm::sin(0.5 * SUN_HALF_ANGLE_DEG.to_radians());
        2.0 * sine * sine
    }

    /// The solid angle of its disk in sr.
    #[must_use]
    pub fn solid_angle_sr() -> f64 {
        TAU * Self::depth()
    }

    /// The luminance of its disk in cd/m^2: illuminance over `pi sin^2`, the projected solid angle.
    #[must_use]
    pub fn luminance_cd_m2(&self) -> f64 {
        let sine = libm::sin(SUN_HALF_ANGLE_DEG.to_radians());
        self.normal_illuminance_lx / (PI * sine * sine)
    }

    /// Whether a unit direction points at its disk.
    pub(crate) fn is_met(&self, direction: DVec3) -> bool {
        // |a - b|^2 / 2 = 1 - cos, without a difference near 1.
        0.5 * (direction - self.direction).length_squared() <= Self::depth()
    }

    /// A unit direction to its disk, density `1 / solid_angle_sr`.
    pub(crate) fn sample(&self, random: &mut Xoshiro) -> DVec3 {
        let depth = random.uniform() * Self::depth();
        let radius = (depth * (2.0 - depth)).sqrt();
        let (sin, cos) = libm::sincos(TAU * random.uniform());
        let (s, t) = self.direction.any_orthonormal_pair();
        (s * (radius * cos) + t * (radius * sin) + self.direction * (1.0 - depth)).normalize()
    }
}
