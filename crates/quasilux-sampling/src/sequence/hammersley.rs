//! The first dimension of Hammersley's point set: equal steps.
//!
//! J. M. Hammersley, "Monte Carlo methods for solving multivariable problems" (Ann. New York Acad.
//! Sci. 86, 1960): i / N stands before the first s - 1 dimensions of Halton's sequence, which takes
//! a logarithm off the discrepancy.

use crate::hash::{dimension_key, mix};
use crate::randomization::Randomization;
use crate::randomization::rotate_unit;
use crate::unit::ONE_BELOW;
use crate::unit::unit_from_word;

/// Coordinate 0 of point `index` of `points`.
pub(crate) fn step(points: u64, index: u64, randomization: Randomization, key: u64) -> f64 {
    let points = points.max(1);
    let index = index % points;
    let fraction = |place: f64| (place / points as f64).min(ONE_BELOW);
    match randomization {
        Randomization::None => fraction(index as f64),
        Randomization::CranleyPattersonRotation | Randomization::DigitalShift => {
            rotate_unit(fraction(index as f64), key, 0)
        }
        Randomization::Owen => {
            let key = dimension_key(key, 0);
            let start = (u128::from(key) * u128::from(points)) >> 64;
            let step = (u128::from(index) + start) % u128::from(points);
            let within = unit_from_word(mix(mix(key ^ index).wrapping_add(key)));
            fraction(step as f64 + within)
        }
    }
}
