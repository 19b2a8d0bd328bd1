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

    /// The luminances in directions, unit vectors, in cd/m2; 0 below the horizon. Directions of one
    /// height behind one another take less time.
    pub fn luminances_cd_m2<'d>(
        &'d self,
        directions: &'d [[f64; 3]],
    ) -> impl Iterator<Item = f64> + 'd {
        let mut last = f64::NAN;
        let mut below_zenith = 0.0;
        directions.iter().map(move |&direction| {
            let Some(table) = &self.around_sun else { return self.sky.luminance_cd_m2(direction) };
            let [_, _, z] = direction;
            if z < 0.0 {
                return 0.0;
            }
            if z != last {
                last = z;
                below_zenith = table.unit_cd_m2 * table.gradation.below_zenith(z);
            }
            (below_zenith * table.at(dot(direction, table.sun))).max(0.0)
        })
    }
}

impl AroundSun {
    /// The factor by the cosine of the angle from the sun.
    fn at(&self, cos: f64) -> f64 {
        let half = if cos < 0.0 { &self.far } else { &self.near };
        let chord = (2.0 - 2.0 * cos.abs()).max(0.0).sqrt();
        let place = chord * (INTERVALS as f64 / SQRT_2);
        let node = (place as usize).min(INTERVALS - 1);
        let part = place - node as f64;
        half[node] + part * (half[node + 1] - half[node])
    }
}
