//! The direct ratios of field 27.
//!
//! The utilisation factor method needs the share of a luminaire's flux that falls on the working
//! plane directly, in a square room of index k = a b / (h (a + b)), a = b = 2 k h with the
//! luminaires at height h above the plane. Here the luminaires cover the ceiling evenly. A ray in
//! direction (gamma, C) moves by h tan(gamma) across the room, so that of all luminaires the share
//!
//! (1 - |tan gamma cos C| / 2k) (1 - |tan gamma sin C| / 2k), no factor below 0,
//!
//! sends it to the plane, and the ratio is the mean of this over the luminaire's flux.
//!
//! Deviation: tables for the method (CIE 40, CIE 52, LiTG) put a finite number of luminaires at
//! stated places; their ratios differ by some hundredths.

use crate::SphericalTable;
use glam::DVec3;

/// The room indices of field 27.
pub(super) const ROOM_INDICES: [f64; 10] = [0.6, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0];

/// Rays along each coordinate of the inverse transform.
const RAYS: u32 = 128;

/// Share of the flux that reaches the working plane, for each room index; 0 without light.
///
/// By the midpoint rule over the inverse transform: each ray carries the same flux.
pub(super) fn direct_ratios(table: &SphericalTable) -> [f64; 10] {
    let mut sums = [0.0; 10];
    let midpoint = |i: u32| (f64::from(i) + 0.5) / f64::from(RAYS);
    for i in 0..RAYS {
        for j in 0..RAYS {
            let Some(sample) = table.sample([midpoint(i), midpoint(j)]) else {
                return sums;
            };
            for (sum, index) in sums.iter_mut().zip(ROOM_INDICES) {
                *sum += share(sample.direction, index);
            }
        }
    }
    sums.map(|sum| sum / f64::from(RAYS * RAYS))
}

/// Share of the luminaires whose ray in that direction meets the plane. In the frame of the table,
/// where gamma = 0 is +z.
fn share(direction: DVec3, room_index: f64) -> f64 {
    if direction.z <= 0.0 {
        return 0.0;
    }
    let side = 2.0 * room_index;
    let along = |moved: f64| (1.0 - (moved / direction.z).abs() / side).max(0.0);
    along(direction.x) * along(direction.y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Grid, Symmetry};
    use std::f64::consts::{FRAC_PI_2, PI};

    fn table(theta_rad: Vec<f64>, values: Vec<f64>) -> SphericalTable {
        let (phi_rad, symmetry) = (vec![0.0], Symmetry::Rotational);
        SphericalTable::new(Grid { theta_rad, phi_rad, symmetry, values }).unwrap()
    }

    /// A Lambertian ceiling and floor: the ratio is the view factor of two equal squares of side
    /// X = 2k at distance 1 (Howell, catalogue of configuration factors, C-11).
    #[test]
    fn lambertian_ratios_are_view_factors_of_two_squares() {
        let theta_rad: Vec<f64> = (0..=900).map(|i| f64::from(i) / 900.0 * FRAC_PI_2).collect();
        let values = theta_rad.iter().map(|&theta| libm::cos(theta).max(0.0)).collect();
        let ratios = direct_ratios(&table(theta_rad, values));
        for (ratio, k) in ratios.into_iter().zip(ROOM_INDICES) {
            let x = 2.0 * k;
            let root = (1.0 + x * x).sqrt();
            let factor = 2.0 / (PI * x * x)
                * (0.5 * libm::log((1.0 + x * x) * (1.0 + x * x) / (1.0 + 2.0 * x * x))
                    + 2.0 * x * root * libm::atan(x / root)
                    - 2.0 * x * libm::atan(x));
            assert!((ratio - factor).abs() < 2e-4, "k = {k}: {ratio} for {factor}");
        }
    }

    #[test]
    fn narrow_beams_hit_and_uplights_miss() {
        let beam = table(vec![0.0, 1e-4], vec![1.0, 1.0]);
        assert!(direct_ratios(&beam).iter().all(|ratio| (ratio - 1.0).abs() < 2e-4));
        let up = table(vec![FRAC_PI_2, PI], vec![1.0, 1.0]);
        assert_eq!(direct_ratios(&up), [0.0; 10]);
        let dark = table(vec![0.0, PI], vec![0.0, 0.0]);
        assert_eq!(direct_ratios(&dark), [0.0; 10]);
    }
}
