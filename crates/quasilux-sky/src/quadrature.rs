//! Integrals over the sky of functions that have a kink at the sun.

use crate::point::SkyPoint;
use libm::{cos, sin};
use std::f64::consts::{FRAC_PI_2, PI};

/// Nodes of a rule of Gauss and Legendre on [-1, 1], of the positive half, and their weights:
/// Abramowitz and Stegun, "Handbook of mathematical functions" (1964), table 25.4, n = 16.
const NODES: [[f64; 2]; 8] = [
    [0.095_012_509_837_637_44, 0.189_450_610_455_068_5],
    [0.281_603_550_779_258_9, 0.182_603_415_044_923_6],
    [0.458_016_777_657_227_37, 0.169_156_519_395_002_54],
    [0.617_876_244_402_643_7, 0.149_595_988_816_576_73],
    [0.755_404_408_355_003, 0.124_628_971_255_533_87],
    [0.865_631_202_387_831_7, 0.095_158_511_682_492_78],
    [0.944_575_023_073_232_6, 0.062_253_523_938_647_89],
    [0.989_400_934_991_649_9, 0.027_152_459_411_754_095],
];

/// The integral of f over the solid angle above the horizon, of functions that are smooth but for
/// the sun, and symmetric about the vertical plane through it.
pub(crate) fn over_the_sky(sun: [f64; 3], f: impl Fn([f64; 3]) -> f64) -> f64 {
    let sun = SkyPoint::from_direction(sun);
    let zenith = (90.0 - sun.altitude_deg).to_radians().min(FRAC_PI_2);
    let (azimuth, mut sum) = (sun.azimuth_deg.to_radians(), 0.0);
    // The sun is in a corner of panels, which narrow towards it, and those towards the horizon.
    let zeniths = [0.0, 0.75 * zenith, zenith, 0.75 * zenith + 0.25 * FRAC_PI_2, 0.9 * FRAC_PI_2];
    let mut edges: Vec<f64> = zeniths.into_iter().chain([0.98 * FRAC_PI_2, FRAC_PI_2]).collect();
    edges.sort_by(f64::total_cmp);
    for zenith_panel in edges.array_windows() {
        for (zenith, height) in nodes(zenith_panel) {
            let horizontal = sin(zenith);
            for azimuth_panel in [0.0, 0.06 * PI, 0.3 * PI, PI].array_windows() {
                for (aside, width) in nodes(azimuth_panel) {
                    let azimuth = azimuth + aside;
                    let (x, y) = (horizontal * sin(azimuth), horizontal * cos(azimuth));
                    sum += 2.0 * height * width * horizontal * f([x, y, cos(zenith)]);
                }
            }
        }
    }
    sum
}

/// Places in an interval with their weights.
fn nodes([low, high]: &[f64; 2]) -> impl Iterator<Item = (f64, f64)> {
    let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
    let both = NODES.into_iter().flat_map(|[x, w]| [[-x, w], [x, w]]);
    both.map(move |[x, w]| (centre + half * x, half * w))
}
