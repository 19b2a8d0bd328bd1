//! The all-weather sky of Perez: luminances and illuminances of an hour of which the irradiances
//! are known.
//!
//! R. Perez, R. Seals, J. Michalsky, "All-weather model for sky luminance distribution" (Solar
//! Energy 50, 1993, and the erratum in 51) for the distribution; R. Perez et al., "Modeling
//! daylight availability and irradiance components from direct and global irradiance" (Solar Energy
//! 44, 1990) for clearness, brightness and luminous efficacies.
//!
//! Conventions are those of Radiance's `gendaylit` (2021), but:
//! - the sky is scaled to the diffuse illuminance by an exact integral, where `gendaylit` sums 145
//!   patches;
//! - the sun of the model is held above the horizon, so that the hours around sunrise have a sky;
//! - where the formula has no positive luminance anywhere, the sky is uniform;
//! - skies whose b is positive, which `gendaylit` draws black, have the nearest brightness for
//!   which it is not ([`Perez::is_held`]).
//!
//! With b above 0 the gradation `1 + a exp(b / cos Z)` grows without end towards the horizon: a sky
//! with the sun at 3 degrees and 900 W/m2 of it would have a horizon of 10^8 cd/m2. None of the six
//! gradations of the CIE (S 011) has such a b. Brightness far from that of the skies to which the
//! coefficients were fitted is what makes it, and Perez et al. hold theirs to 0.2 at least between
//! clearnesses of 1.065 and 2.8 for the same reason. The illuminance of the sky stays that of its
//! irradiance.

use crate::error::SkyError;
use crate::gradation::Gradation;
use crate::point::SkyPoint;
use libm::{cos, exp, log, pow};
use std::f64::consts::TAU;

/// What a weather file says of an hour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Irradiance {
    /// Of the sun, on a plane across its rays, in W/m2.
    pub direct_normal_w_m2: f64,
    /// Of the sky, on a horizontal plane, in W/m2.
    pub diffuse_horizontal_w_m2: f64,
}

/// The sky of an hour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perez {
    /// The sun of the model.
    sun: SkyPoint,
    clearness: f64,
    brightness: f64,
    /// The brightness of the distribution, and whether it had to be held.
    shape_brightness: f64,
    is_held: bool,
    diffuse_illuminance_lx: f64,
    normal_illuminance_lx: f64,
}

/// The solar constant in W/m2, as Radiance has it.
pub(crate) const SOLAR_CONSTANT_W_M2: f64 = 1367.0;
/// More than the atmosphere lets through at any time, in W/m2.
const MAX_IRRADIANCE_W_M2: f64 = 2000.0;
/// The clearness from which on a sky is of the category before the last.
const MAX_CLEARNESS: f64 = 12.009;
/// Bounds of the brightness.
const MIN_BRIGHTNESS: f64 = 0.01;
const MAX_BRIGHTNESS: f64 = 0.6;
/// From here on up the sun is taken to be here: circumsolar light has no azimuth at the zenith.
const MAX_ALTITUDE_DEG: f64 = 87.0;
/// The gradation near the horizon is that at this cosine of the zenith angle.
const MIN_COS_ZENITH: f64 = 0.01;

/// The lowest clearness of each category but the first: Perez et al. 1990, table 1.
const CATEGORIES: [f64; 7] = [1.065, 1.23, 1.5, 1.95, 2.8, 4.5, 6.2];

/// By category a1 .. a4, b1 .. b4 and so on to e: Perez, Seals, Michalsky 1993, table 1.
const COEFFICIENTS: [[[f64; 4]; 5]; 8] = [
    [
        [1.3525, -0.2576, -0.2690, -1.4366],
        [-0.7670, 0.0007, 1.2734, -0.1233],
        [2.8000, 0.6004, 1.2375, 1.0000],
        [1.8734, 0.6297, 0.9738, 0.2809],
        [0.0356, -0.1246, -0.5718, 0.9938],
    ],
    [
        [-1.2219, -0.7730, 1.4148, 1.1016],
        [-0.2054, 0.0367, -3.9128, 0.9156],
        [6.9750, 0.1774, 6.4477, -0.1239],
        [-1.5798, -0.5081, -1.7812, 0.1080],
        [0.2624, 0.0672, -0.2190, -0.4285],
    ],
    [
        [-1.1000, -0.2515, 0.8952, 0.0156],
        [0.2782, -0.1812, -4.5000, 1.1766],
        [24.7219, -13.0812, -37.7000, 34.8438],
        [-5.0000, 1.5218, 3.9229, -2.6204],
        [-0.0156, 0.1597, 0.4199, -0.5562],
    ],
    [
        [-0.5484, -0.6654, -0.2672, 0.7117],
        [0.7234, -0.6219, -5.6812, 2.6297],
        [33.3389, -18.3000, -62.2500, 52.0781],
        [-3.5000, 0.0016, 1.1477, 0.1062],
        [0.4659, -0.3296, -0.0876, -0.0329],
    ],
    [
        [-0.6000, -0.3566, -2.5000, 2.3250],
        [0.2937, 0.0496, -5.6812, 1.8415],
        [21.0000, -4.7656, -21.5906, 7.2492],
        [-3.5000, -0.1554, 1.4062, 0.3988],
        [0.0032, 0.0766, -0.0656, -0.1294],
    ],
    [
        [-1.0156, -0.3670, 1.0078, 1.4051],
        [0.2875, -0.5328, -3.8500, 3.3750],
        [14.0000, -0.9999, -7.1406, 7.5469],
        [-3.4000, -0.1078, -1.0750, 1.5702],
        [-0.0672, 0.4016, 0.3017, -0.4844],
    ],
    [
        [-1.0000, 0.0211, 0.5025, -0.5119],
        [-0.3000, 0.1922, 0.7023, -1.6317],
        [19.0000, -5.0000, 1.2438, -1.9094],
        [-4.0000, 0.0250, 0.3844, 0.2656],
        [1.0468, -0.3788, -2.4517, 1.4656],
    ],
    [
        [-1.0500, 0.0289, 0.4260, 0.3590],
        [-0.3250, 0.1156, 0.7781, 0.0025],
        [31.0625, -14.5000, -46.1148, 55.3750],
        [-7.2312, 0.4050, 13.3500, 0.6234],
        [1.5000, -0.6426, 1.8564, 0.5636],
    ],
];

/// Efficacy of the sky's light by category, in lm/W: Perez et al. 1990, table 4.
const DIFFUSE_EFFICACY: [[f64; 4]; 8] = [
    [97.24, -0.46, 12.00, -8.91],
    [107.22, 1.15, 0.59, -3.95],
    [104.97, 2.96, -5.53, -8.77],
    [102.39, 5.59, -13.95, -13.90],
    [100.71, 5.94, -22.75, -23.74],
    [106.42, 3.83, -36.15, -28.83],
    [141.88, 1.90, -53.24, -14.03],
    [152.23, 0.35, -45.27, -7.98],
];

/// The same of the sun's light.
const DIRECT_EFFICACY: [[f64; 4]; 8] = [
    [57.20, -4.55, -2.98, 117.12],
    [98.99, -3.46, -1.21, 12.38],
    [109.83, -4.90, -1.71, -8.81],
    [110.34, -5.84, -1.99, -4.56],
    [106.36, -3.97, -1.75, -6.16],
    [107.19, -1.25, -1.51, -26.73],
    [105.75, 0.77, -1.26, -34.44],
    [101.18, 1.58, -1.10, -8.29],
];

impl Perez {
    /// The dew point that is taken where none is known, in degrees Celsius: about 2 cm of
    /// precipitable water.
    pub const DEW_POINT_C: f64 = 11.0;

    /// The sky of irradiances measured with the sun at a point, on a day of the year (from 1).
    ///
    /// # Errors
    /// For irradiances that are negative or above 2000 W/m2, and dew points beyond -90 and 60
    /// degrees Celsius.
    pub fn new(
        irradiance: Irradiance,
        sun: SkyPoint,
        day_of_year: u32,
        dew_point_c: f64,
    ) -> Result<Self, SkyError> {
        let Irradiance { direct_normal_w_m2: direct, diffuse_horizontal_w_m2: diffuse } =
            irradiance;
        let range = 0.0..=MAX_IRRADIANCE_W_M2;
        SkyError::check("direct_normal_w_m2", direct, range.clone(), "0 to 2000")?;
        SkyError::check("diffuse_horizontal_w_m2", diffuse, range, "0 to 2000")?;
        SkyError::check("the dew point in C", dew_point_c, -90.0..=60.0, "-90 to 60")?;
        let altitude_deg = sun.altitude_deg.clamp(0.0, MAX_ALTITUDE_DEG);
        let sun = SkyPoint { altitude_deg, ..sun };
        let zenith_deg = 90.0 - altitude_deg;
        let zenith = zenith_deg.to_radians();
        // Perez et al. 1990, equations 1 and 2; the air mass is that of Kasten (1966).
        let cubed = 1.041 * zenith * zenith * zenith;
        let clearness = ((diffuse + direct) / diffuse + cubed) / (1.0 + cubed);
        let air_mass = 1.0 / (cos(zenith) + 0.15 * pow(93.885 - zenith_deg, -1.253));
        let outside_w_m2 = SOLAR_CONSTANT_W_M2 * eccentricity(day_of_year);
        // Nothing over nothing is a night, of which no light is left to distribute.
        let clearness = if clearness.is_nan() { 1.0 } else { clearness.clamp(1.0, MAX_CLEARNESS) };
        let brightness = (diffuse * air_mass / outside_w_m2).clamp(MIN_BRIGHTNESS, MAX_BRIGHTNESS);
        let is_between = clearness > 1.065 && clearness < 2.8;
        let published = if is_between { brightness.max(0.2) } else { brightness };
        let shape_brightness = held(published, category_of(clearness), zenith);
        let mut perez = Self {
            sun,
            clearness,
            brightness,
            shape_brightness,
            is_held: shape_brightness != published,
            diffuse_illuminance_lx: 0.0,
            normal_illuminance_lx: 0.0,
        };
        let water_cm = exp(0.07 * dew_point_c - 0.075);
        perez.diffuse_illuminance_lx = diffuse * perez.diffuse_efficacy(water_cm, zenith);
        perez.normal_illuminance_lx = direct * perez.direct_efficacy(water_cm, zenith);
        Ok(perez)
    }

    /// Where the sun is in the model: between the horizon and 87 degrees.
    #[must_use]
    pub fn sun(&self) -> SkyPoint {
        self.sun
    }

    /// The sky's clearness, epsilon: 1 for an overcast sky.
    #[must_use]
    pub fn clearness(&self) -> f64 {
        self.clearness
    }

    /// The sky's brightness, delta.
    #[must_use]
    pub fn brightness(&self) -> f64 {
        self.brightness
    }

    /// Whether the luminances are those of another brightness, because of its own the formula makes
    /// a horizon that is brighter without bound.
    #[must_use]
    pub fn is_held(&self) -> bool {
        self.is_held
    }

    /// The horizontal illuminance of the sky alone, in lx.
    #[must_use]
    pub fn diffuse_illuminance_lx(&self) -> f64 {
        self.diffuse_illuminance_lx
    }

    /// The illuminance of the sun alone on a plane across its rays, in lx.
    #[must_use]
    pub fn normal_illuminance_lx(&self) -> f64 {
        self.normal_illuminance_lx
    }

    fn category(&self) -> usize {
        category_of(self.clearness)
    }

    /// Perez et al. 1990, equation 7.
    fn diffuse_efficacy(&self, water_cm: f64, zenith: f64) -> f64 {
        let [a, b, c, d] = DIFFUSE_EFFICACY[self.category()];
        (a + b * water_cm + c * cos(zenith) + d * log(self.brightness)).max(0.0)
    }

    /// Perez et al. 1990, equation 8.
    fn direct_efficacy(&self, water_cm: f64, zenith: f64) -> f64 {
        let [a, b, c, d] = DIRECT_EFFICACY[self.category()];
        (a + b * water_cm + c * exp(5.73 * zenith - 5.0) + d * self.brightness).max(0.0)
    }

    /// Perez, Seals, Michalsky 1993, equations 6 to 8.
    pub(crate) fn gradation(&self) -> Gradation {
        let (category, delta) = (self.category(), self.shape_brightness);
        let zenith = (90.0 - self.sun.altitude_deg).to_radians();
        let linear = |[x1, x2, x3, x4]: [f64; 4]| x1 + x2 * zenith + delta * (x3 + x4 * zenith);
        let [mut a, mut b, mut c, mut d, e] = COEFFICIENTS[category].map(linear);
        if self.is_held {
            // The gradation is the same everywhere, and counts no more.
            (a, b) = (0.0, 0.0);
        }
        if category == 0 {
            let [_, _, [c1, c2, c3, c4], [d1, d2, d3, d4], _] = COEFFICIENTS[0];
            c = exp(pow(delta * (c1 + c2 * zenith), c3)) - c4;
            d = -exp(delta * (d1 + d2 * zenith)) + d3 + delta * d4;
        }
        Gradation { a, b, c, d, e, offset: 0.0, min_cos_zenith: MIN_COS_ZENITH }
    }
}

fn category_of(clearness: f64) -> usize {
    CATEGORIES.iter().take_while(|lowest| clearness >= **lowest).count()
}

/// The brightness nearest to this one for which b is not positive, with the sun at this angle from
/// the zenith.
fn held(brightness: f64, category: usize, zenith: f64) -> f64 {
    let [b1, b2, b3, b4] = COEFFICIENTS[category][1];
    let (constant, slope) = (b1 + b2 * zenith, b3 + b4 * zenith);
    if constant + slope * brightness <= 0.0 { brightness } else { (-constant / slope).max(0.0) }
}

/// The square of the mean distance of the sun over that of a day: J. W. Spencer, "Fourier series
/// representation of the position of the sun" (Search 2, 1971).
pub(crate) fn eccentricity(day_of_year: u32) -> f64 {
    let day = TAU * (f64::from(day_of_year) - 1.0) / 365.0;
    let (sine, cosine) = (libm::sin(day), cos(day));
    let (sine_2, cosine_2) = (libm::sin(2.0 * day), cos(2.0 * day));
    1.000_11 + 0.034_221 * cosine + 0.001_28 * sine + 0.000_719 * cosine_2 + 0.000_077 * sine_2
}
