//! Pixels that are much brighter than the sky around them, such as a sun.

use super::Panorama;
use crate::point::SkyPoint;
use libm::{acos, cos, sin};
use std::f64::consts::{FRAC_1_PI, TAU};

/// A pixel counts as bright from this many times the mean luminance of the sky on.
const BRIGHT: f64 = 10.0;

/// A pixel that is much brighter than the sky around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrightPixel {
    /// Its number in the panorama.
    pub index: usize,
    /// Its solid angle in sr.
    pub solid_angle_sr: f64,
    /// Its luminance in cd/m2, as the picture has it.
    pub luminance_cd_m2: f64,
}

impl Panorama {
    /// The pixels that are more than ten times as bright as the mean of the sky, which is the
    /// horizontal illuminance over pi, by ascending index.
    #[must_use]
    pub fn bright_pixels(&self) -> Vec<BrightPixel> {
        let least = BRIGHT * FRAC_1_PI * self.horizontal_illuminance_lx();
        let all = self.luminances_cd_m2.iter().enumerate();
        let bright = all.filter(|(_, cd_m2)| f64::from(**cd_m2) > least);
        let pixel = |(index, cd_m2): (usize, &f32)| {
            let [a, b] = self.zenith_angles(index / self.width);
            // cos(a) - cos(b)
            let height = 2.0 * sin(0.5 * (a + b)) * sin(0.5 * (b - a));
            let solid_angle_sr = TAU / self.width as f64 * height;
            BrightPixel { index, solid_angle_sr, luminance_cd_m2: f64::from(*cd_m2) }
        };
        bright.map(pixel).collect()
    }

    /// The number of the pixel that shows a direction, a unit vector; `None` below the horizon.
    #[must_use]
    pub fn pixel_of(&self, direction: [f64; 3]) -> Option<usize> {
        (direction[2] >= 0.0).then(|| self.pixel_at(direction))
    }

    /// A direction in a pixel, a unit vector: uniform over its solid angle for uniform `u`.
    #[must_use]
    pub fn direction_in(&self, index: usize, u: [f64; 2]) -> [f64; 3] {
        let [row, column] = [index / self.width, index % self.width];
        let [top, bottom] = self.zenith_angles(row).map(cos);
        let zenith = acos((top + (bottom - top) * u[0]).clamp(0.0, 1.0));
        let turns = (column as f64 + u[1]) / self.width as f64 - 0.5;
        let azimuth_deg = 360.0 * turns + self.middle_azimuth_deg;
        SkyPoint { altitude_deg: 90.0 - zenith.to_degrees(), azimuth_deg }.to_direction()
    }
}
