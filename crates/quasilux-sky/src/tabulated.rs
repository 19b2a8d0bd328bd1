//! A sky for who asks it for very many directions.

use crate::gradation::Gradation;
use crate::point::dot;
use crate::sky::Sky;
use std::f64::consts::SQRT_2;

/// Intervals of each half of the table.
const INTERVALS: usize = 512;

/// A sky whose luminances around the sun come from a table: within 10^-4 of those of the sky.
#[derive(Clone, Debug)]
pub struct TabulatedSky {
    sky: Sky,
    around_sun: Option<AroundSun>,
}

/// The factor of the luminance that depends on the angle from the sun: by the chord of that angle
/// on the side of the sun, where it has a kink that the chord follows, and by the chord of the
/// angle from the opposite point on the other side.
#[derive(Clone, Debug)]
struct AroundSun {
    gradation: Gradation,
    sun: [f64; 3],
    unit_cd_m2: f64,
    near: Vec<f64>,
    far: Vec<f64>,
}

impl TabulatedSky {
    /// The table of a sky.
    #[must_use]
    pub fn new(sky: &Sky) -> Self {
        let distribution = sky.distribution();
        let around_sun = distribution.as_gradation().map(|gradation| {
            let half = |side: f64| {
                let value = |node: usize| {
                    let chord = SQRT_2 * node as f64 / INTERVALS as f64;
                    gradation.around_sun(side * (1.0 - 0.5 * chord * chord))
                };
                (0..=INTERVALS).map(value).collect()
            };
            AroundSun {
                gradation: *gradation,
                sun: distribution.sun(),
                unit_cd_m2: sky.unit_cd_m2(),
                near: half(1.0),
                far: half(-1.0),
            }
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
        let cos = dot(direction, table.sun);
        let half = if cos < 0.0 { &table.far } else { &table.near };
        let chord = (2.0 - 2.0 * cos.abs()).max(0.0).sqrt();
        let place = chord * (INTERVALS as f64 / SQRT_2);
        let node = (place as usize).min(INTERVALS - 1);
        let part = place - node as f64;
        let around = half[node] + part * (half[node + 1] - half[node]);
        (table.unit_cd_m2 * table.gradation.below_zenith(direction[2]) * around).max(0.0)
    }
}
