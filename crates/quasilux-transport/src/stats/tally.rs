//! Sums that do not depend on their order: fixed-point integers.
//!
//! A contribution is rounded to a whole number of quanta and added as an integer, so that any
//! order, thread count or split gives the same bits. The quantum is a power of two fixed before
//! sampling from the light that the scene can get, so dimming all lights scales it with them.

use crate::codec::{Sums, add_count};
use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

/// Quanta per unit of the reference, as a power of two: contributions down to 2^-80 of it count.
const FINENESS: i32 = 80;
/// Larger contributions, in quanta, are refused; 2^23 of the largest fit the sum.
const MAX_CONTRIBUTION: f64 = (1_u128 << 104) as f64;

/// Larger contributions to a counter of 64 bits, in quanta, are refused; 2^7 of the largest fit.
const MAX_COUNTED: f64 = (1_u64 << 56) as f64;

/// Quanta of a contribution to a counter of 64 bits, `per_unit` of them to its unit; `None` where
/// it is not finite, negative or too large, for the caller to count as invalid.
#[inline]
pub(crate) fn checked_quanta(contribution: f64, per_unit: f64) -> Option<i64> {
    let quanta = contribution * per_unit;
    let is_valid = (0.0..=MAX_COUNTED).contains(&quanta);
    is_valid.then(|| round_positive(quanta) as i64)
}

/// The nearest integer, the even one of two, of a number from 0 to 2^63: without the call that
/// `round_ties_even` is where processors of the base instruction set are compiled for.
#[inline]
fn round_positive(x: f64) -> f64 {
    /// From here on every number is an integer, so sums with it are rounded to integers.
    const INTEGERS: f64 = (1_u64 << 52) as f64;
    if x < INTEGERS { (x + INTEGERS) - INTEGERS } else { x }
}

/// The size of one step of a tally: a power of two, in the unit of the contributions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Quantum {
    size: f64,
    per_unit: f64,
    reference: f64,
}

impl Quantum {
    /// The quantum for contributions that are about as large as `reference` (positive, finite).
    pub(crate) fn for_reference(reference: f64) -> Self {
        let exponent = (libm::ilogb(reference) - FINENESS).clamp(-1000, 1000);
        let [size, per_unit] = [exponent, -exponent].map(|exponent| libm::ldexp(1.0, exponent));
        Self { size, per_unit, reference }
    }

    /// The reference that it was made for.
    pub(crate) fn reference(self) -> f64 {
        self.reference
    }

    /// The value of a sum.
    pub(crate) fn value(self, sum: Sum) -> f64 {
        sum.quanta as f64 * self.size
    }
}

/// A sum of contributions, and how many of them could not be added. There are many: packed they
/// take 24 bytes and not 32.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[repr(Rust, packed(8))]
pub(crate) struct Sum {
    quanta: i128,
    /// Contributions that were not finite, too large, or wrongly negative.
    pub(crate) invalid: u64,
}

impl Sum {
    /// Whether nothing but zeros was added.
    pub(crate) fn is_zero(&self) -> bool {
        self.quanta == 0
    }

    /// Adds a contribution that may be negative, as corrections are.
    #[inline]
    pub(crate) fn add_signed(&mut self, contribution: f64, quantum: Quantum) {
        let quanta = (contribution * quantum.per_unit).round_ties_even();
        let valid = quanta.abs() <= MAX_CONTRIBUTION;
        match self.quanta.checked_add(if valid { quanta as i128 } else { 0 }) {
            Some(sum) if valid => self.quanta = sum,
            _ => self.invalid += 1,
        }
    }

    /// Adds a contribution that cannot be negative.
    #[inline]
    pub(crate) fn add(&mut self, contribution: f64, quantum: Quantum) {
        if contribution >= 0.0 {
            self.add_signed(contribution, quantum);
        } else {
            self.invalid += 1;
        }
    }
}

impl AddAssign for Sum {
    fn add_assign(&mut self, other: Self) {
        // Parts of a run that each fit may overflow together only past 2^23 largest contributions.
        match self.quanta.checked_add(other.quanta) {
            Some(sum) => self.quanta = sum,
            None => self.invalid += 1,
        }
        self.invalid += other.invalid;
    }
}

impl Sums for Sum {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        self.quanta = self.quanta.checked_add(other.quanta)?;
        add_count(&mut self.invalid, other.invalid)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_does_not_matter() {
        let quantum = Quantum::for_reference(1000.0);
        let terms: Vec<f64> = (1..1000).map(|i| 1e3 / f64::from(i * i)).collect();
        let total = |terms: &mut dyn Iterator<Item = &f64>| {
            let mut sum = Sum::default();
            terms.for_each(|&t| sum.add(t, quantum));
            sum
        };
        let forward = total(&mut terms.iter());
        assert_eq!(forward, total(&mut terms.iter().rev()));
        assert!((quantum.value(forward) - terms.iter().sum::<f64>()).abs() < 1e-9);
    }

    #[test]
    fn what_cannot_be_added_is_counted() {
        let quantum = Quantum::for_reference(1.0);
        let mut sum = Sum::default();
        for bad in [f64::NAN, f64::INFINITY, -1.0, 1e30] {
            sum.add(bad, quantum);
        }
        sum.add_signed(-1.0, quantum);
        sum.add(3.0, quantum);
        assert_eq!((sum.invalid, quantum.value(sum)), (4, 2.0));
    }

    #[test]
    fn rounding_is_to_the_nearest_and_to_even() {
        let large = (1_u64 << 52) as f64;
        for x in [0.0, 0.49, 0.5, 0.51, 1.5, 2.5, 1e9 + 0.5, large - 0.5, large + 1.0, 9e18] {
            assert_eq!(round_positive(x), x.round_ties_even(), "{x}");
        }
    }

    #[test]
    fn counters_refuse_what_they_cannot_add() {
        let refused = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -1e-300, 1e300];
        for bad in refused {
            assert_eq!(checked_quanta(bad, 1024.0), None, "{bad}");
        }
        let counted = [0.0, -0.0, 0.25, 2.5 / 1024.0].map(|good| checked_quanta(good, 1024.0));
        assert_eq!(counted, [Some(0), Some(0), Some(256), Some(2)]);
    }

    #[test]
    fn the_quantum_follows_the_lights() {
        for reference in [1e-200, 1e-9, 1.0, 7e5, 1e200] {
            let quantum = Quantum::for_reference(reference);
            let mut sum = Sum::default();
            sum.add(reference * 1e-6, quantum);
            let relative = quantum.value(sum) / (reference * 1e-6) - 1.0;
            assert!(relative.abs() < 1e-12, "{reference}: {relative}");
        }
    }
}
