//! A sky for who asks it for very many directions.

use crate::gradation::Gradation;
use crate::point::dot;
use crate::sky::Sky;

/// Intervals of the table.
const INTERVALS: usize = 512;

/// A sky whose luminances around the sun come from a table: within 10^-4 of those of the sky.
#[derive(Clone, Debug)]
pub struct TabulatedSky {
    sky: Sky,
    around_sun: Option<AroundSun>,
}

/// The factor of the luminance that depends on the angle from the sun, by the chord of the angle:
/// near the sun, where it has a kink, the two are the same.
#[derive(Clone, Debug)]
struct AroundSun {
    gradation: Gradation,
    sun: [f64; 3],
    unit_cd_m2: f64,
    values: Vec<f64>,
}

impl TabulatedSky {
    /// The table of a sky.
    #[must_use]
    pub fn new(sky: &Sky) -> Self {
        let around_sun = sky.gradation().map(|(gradation, sun, unit_cd_m2)| {
            let value = |node: usize| {
                let chord = 2.0 * node as f64 / INTERVALS as f64;
                gradation.around_sun(1.0 - 0.5 * chord * chord)
            };
            AroundSun { gradation, sun, unit_cd_m2, values: (0..=INTERVALS).map(value).collect() }
        });
        Self { sky: sky.clone(), around_sun }
    }

    /// The luminance in a direction, a unit vector, in cd/m2; 0 below the horizon.
    #[must_use]
    pub fn luminance_cd_m2(&self, direction: [f64; 3]) -> f64 {
        let Some(table) = &self.around_sun else { return self.sky.luminance_cd_m2(direction) };
        if direction[2] < 0.0 {
            return 0.0;
        }
        let chord = (2.0 - 2.0 * dot(direction, table.sun)).clamp(0.0, 4.0).sqrt();
        let place = chord * (0.5 * INTERVALS as f64);
        let node = (place as usize).min(INTERVALS - 1);
        let part = place - node as f64;
        let around = table.values[node] + part * (table.values[node + 1] - table.values[node]);
        (table.unit_cd_m2 * table.gradation.below_zenith(direction[2]) * around).max(0.0)
    }
}
