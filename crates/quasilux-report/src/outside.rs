//! What shines on the building from outside, and what share of it comes in.

use crate::figure::Figure;
use quasilux_scene::Scene;

/// Light outside, where nothing shades it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// Of the sky, and of the sun where its disk shines, on a horizontal plane, in lx.
    pub horizontal_illuminance_lx: f64,
    /// Whether all light inside comes from the sky: neither lamps nor the sun shine.
    pub is_sky_alone: bool,
}

impl Outside {
    /// `None` where nothing is outside.
    #[must_use]
    pub fn new(scene: &Scene) -> Option<Self> {
        scene.environment.as_ref().map(|environment| Self {
            horizontal_illuminance_lx: environment.horizontal_illuminance_lx(),
            is_sky_alone: scene.lights.is_empty() && environment.sun.is_none(),
        })
    }

    /// The daylight factor, a share: illuminance over the horizontal illuminance of the sky outside
    /// (CIE 16:1970). `None` under lamps and in sunlight, which it does not count.
    #[must_use]
    pub fn daylight_factor(&self, illuminance_lx: Figure) -> Option<Figure> {
        let outside_lx = self.horizontal_illuminance_lx;
        (self.is_sky_alone && outside_lx > 0.0).then(|| Figure {
            value: illuminance_lx.value.map(|lx| lx / outside_lx),
            half_width: illuminance_lx.half_width.map(|lx| lx / outside_lx),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn daylight_factors_are_shares_of_the_sky_alone() {
        let inside = Figure { value: Some(200.0), half_width: Some(2.0) };
        let sky = Outside { horizontal_illuminance_lx: 10_000.0, is_sky_alone: true };
        let expected = Figure { value: Some(0.02), half_width: Some(0.0002) };
        assert_eq!(sky.daylight_factor(inside), Some(expected));
        let with_lamps = Outside { is_sky_alone: false, ..sky };
        assert_eq!(with_lamps.daylight_factor(inside), None);
        let night = Outside { horizontal_illuminance_lx: 0.0, ..sky };
        assert_eq!(night.daylight_factor(inside), None);
    }
}
