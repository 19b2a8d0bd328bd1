//! The CIE flux code: a luminaire's distribution in five numbers.
//!
//! CIE 52 (1982), EN 13032-2 (2004): cumulative fluxes FCL1 to FCL4 in the cones about nadir of
//! solid angle pi/2, pi, 3 pi/2 and 2 pi (gamma up to 41.4, 60, 75.5 and 90 degrees), and the same
//! about zenith, FCU1 to FCU4. N1 to N3 are FCL1 to FCL3 over FCL4, N4 is the downward flux
//! fraction (DFF), N5 the light output ratio (LOR), all in per cent.

use super::ZonalFlux;
use std::f64::consts::PI;

/// Cosines of the cones' half-angles: equal steps of solid angle.
const COSINES: [f64; 4] = [0.75, 0.5, 0.25, 0.0];

/// The CIE flux code, and its counterpart for light upwards, as shares from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FluxCode {
    /// N1 to N3: FCL1/FCL4, FCL2/FCL4 and FCL3/FCL4; zero where nothing shines down.
    pub lower: [f64; 3],
    /// N4: the downward flux fraction.
    pub downward: f64,
    /// N5: the light output ratio; 1 for absolute photometry, where the flux measured is the
    /// luminaire's own.
    pub light_output_ratio: f64,
    /// FCU1/FCU4, FCU2/FCU4 and FCU3/FCU4; zero where nothing shines up.
    pub upper: [f64; 3],
    /// The upward flux fraction.
    pub upward: f64,
}

impl FluxCode {
    pub(super) fn new(zones: &ZonalFlux<'_>, light_output_ratio: Option<f64>) -> Self {
        let total_lm = zones.total_lm();
        let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
        let lower_lm = COSINES.map(|cosine| zones.below_lm(libm::acos(cosine)));
        let upper_lm =
            COSINES.map(|cosine| (total_lm - zones.below_lm(PI - libm::acos(cosine))).max(0.0));
        let code = |cones: [f64; 4]| [0, 1, 2].map(|cone| share(cones[cone], cones[3]));
        Self {
            lower: code(lower_lm),
            downward: share(lower_lm[3], total_lm),
            light_output_ratio: light_output_ratio.unwrap_or(1.0),
            upper: code(upper_lm),
            upward: share(upper_lm[3], total_lm),
        }
    }

    /// N1 to N5 in per cent.
    pub fn percent(&self) -> [f64; 5] {
        let [n1, n2, n3] = self.lower;
        [n1, n2, n3, self.downward, self.light_output_ratio].map(|share| 100.0 * share)
    }
}
