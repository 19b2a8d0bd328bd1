//! Round numbers for axes, legends and contour lines: multiples of 1, 2 or 5 times a power of ten.

use crate::number::{decimal_exponent, to_place};

/// A mark on an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Its place: 0 at the low end, 1 at the high one.
    pub share: f64,
    /// Its text, where it has one.
    pub label: Option<String>,
}

/// Equally spaced round numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    /// Their distance: 1, 2 or 5 times a power of ten.
    pub step: f64,
    /// The numbers, ascending.
    pub values: Vec<f64>,
    /// Power of ten of the step's digit.
    place: i32,
}

impl Ticks {
    /// The round numbers in the closed range, at most `most` of them (at least 2), and their step
    /// not below `least_step`. A range that is empty or not finite has none.
    #[must_use]
    pub fn within(low: f64, high: f64, most: usize, least_step: f64) -> Self {
        let range = high - low;
        let fits = low.is_finite() && high.is_finite() && range > 0.0 && range.is_finite();
        let wanted = (range / most.max(2) as f64).max(least_step);
        let exponent = decimal_exponent(wanted).filter(|_| fits && wanted > 0.0);
        let Some(mut place) = exponent else {
            return Self { step: 0.0, values: Vec::new(), place: 0 };
        };
        let mut digit = 1;
        loop {
            let (first, last) = multiples(low, high, digit, place);
            let enough = step_of(digit, place) >= least_step * (1.0 - 1e-12);
            if enough && last - first < most.max(2) as f64 {
                let count = (last - first + 1.0).max(0.0) as usize;
                let values = (0..count).map(|i| multiple(first + i as f64, digit, place)).collect();
                return Self { step: step_of(digit, place), values, place };
            }
            (digit, place) = coarser(digit, place);
        }
    }

    /// The numbers as marks on an axis, at the shares of its length that `share` gives.
    pub(crate) fn marks(&self, share: impl Fn(f64) -> f64) -> Vec<Tick> {
        let mark = |value: &f64| Tick { share: share(*value), label: Some(self.label(*value)) };
        self.values.iter().map(mark).collect()
    }

    /// A tick as text, with as many decimals as the step needs.
    #[must_use]
    pub fn label(&self, value: f64) -> String {
        to_place(value, self.place.min(0))
    }
}

/// The next coarser round step.
fn coarser(digit: i32, place: i32) -> (i32, i32) {
    match digit {
        1 => (2, place),
        2 => (5, place),
        _ => (1, place + 1),
    }
}

fn step_of(digit: i32, place: i32) -> f64 {
    multiple(1.0, digit, place)
}

/// `n` steps; divided by a whole power of ten where it is a fraction, so that 3 x 0.1 is 0.3.
fn multiple(n: f64, digit: i32, place: i32) -> f64 {
    let power = libm::exp10(f64::from(place.abs()));
    if place < 0 { n * f64::from(digit) / power } else { n * f64::from(digit) * power }
}

/// The first and the last multiple of the step in the range, with a hair of tolerance at its ends.
fn multiples(low: f64, high: f64, digit: i32, place: i32) -> (f64, f64) {
    let step = step_of(digit, place);
    ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round() {
        let ticks = Ticks::within(0.0, 0.7, 8, 0.0);
        assert_eq!(ticks.values, [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
        assert_eq!(ticks.label(0.3), "0.3");
        let ticks = Ticks::within(213.0, 731.0, 8, 0.0);
        assert_eq!(ticks.values, [300.0, 400.0, 500.0, 600.0, 700.0]);
        let ticks = Ticks::within(-7.0, 8.0, 5, 0.0);
        assert_eq!(ticks.values, [-5.0, 0.0, 5.0]);
        let ticks = Ticks::within(0.0, 5e6, 6, 0.0);
        assert_eq!(ticks.label(ticks.values[1]), "1000000");
    }

    #[test]
    fn number_and_step_are_kept_for_any_range() {
        for i in 0..400 {
            let range = libm::exp10(f64::from(i) * 0.05 - 10.0);
            for low in [0.0, -0.3 * range, 17.3 * range] {
                let ticks = Ticks::within(low, low + range, 9, 0.0);
                assert!((3..=9).contains(&ticks.values.len()), "{low} {range} {ticks:?}");
                let mantissa = ticks.step / libm::exp10(f64::from(ticks.place));
                assert!([1.0, 2.0, 5.0].iter().any(|d| (mantissa - d).abs() < 1e-9));
                assert!(ticks.values.windows(2).all(|w| w[0] < w[1]));
            }
        }
    }

    #[test]
    fn least_step_holds_and_empty_ranges_have_no_ticks() {
        assert_eq!(Ticks::within(0.0, 10.0, 10, 4.0).step, 5.0);
        for (low, high) in [(1.0, 1.0), (2.0, 1.0), (0.0, f64::INFINITY), (f64::NAN, 1.0)] {
            assert!(Ticks::within(low, high, 8, 0.0).values.is_empty());
        }
    }
}
