//! The bright pixels of a panorama, asked for one by one: a sun in a picture.

use glam::DVec3;
use quasilux_sampling::Discrete;
use quasilux_scene::Environment;
use quasilux_sky::{BrightPixel, Panorama};

/// The share of the samples that asks for bright pixels where others ask through openings.
const SHARE: f64 = 0.5;

/// Bright pixels, chosen by what they give.
pub(super) struct BrightSky<'a> {
    environment: &'a Environment,
    panorama: &'a Panorama,
    /// By ascending index.
    pixels: Vec<BrightPixel>,
    choice: Discrete,
    /// The share of the samples that asks for them.
    pub(super) share: f64,
}

impl<'a> BrightSky<'a> {
    /// `None` where the sky is none of a panorama, or has no bright pixels.
    pub(super) fn new(environment: &'a Environment, has_portals: bool) -> Option<Self> {
        let panorama = environment.sky.panorama()?;
        let pixels = panorama.bright_pixels();
        let weight = |pixel: &BrightPixel| pixel.luminance_cd_m2 * pixel.solid_angle_sr;
        let choice = Discrete::new(&pixels.iter().map(weight).collect::<Vec<f64>>())?;
        let share = if has_portals { SHARE } else { 1.0 };
        Some(Self { environment, panorama, pixels, choice, share })
    }

    /// A direction of the world to a bright pixel, by solid angle.
    pub(super) fn sample(&self, u: [f64; 2]) -> DVec3 {
        let choice = self.choice.sample(u[0]);
        let within = [choice.u_remapped, u[1]];
        let direction = self.panorama.direction_in(self.pixels[choice.index].index, within);
        self.environment.to_world(DVec3::from_array(direction))
    }

    /// Density in sr^-1 with which [`Self::sample`] gives a direction, a unit vector of the world.
    pub(super) fn pdf_sr(&self, direction: DVec3) -> f64 {
        let Some(index) = self.panorama.pixel_of(self.environment.to_sky(direction)) else {
            return 0.0;
        };
        let number = self.pixels.binary_search_by_key(&index, |pixel| pixel.index);
        number.map_or(0.0, |number| self.choice.pdf(number) / self.pixels[number].solid_angle_sr)
    }
}
