//! The round numbers of a logarithmic scale: 1, 2 and 5 times powers of ten.

use crate::number::brief;
use crate::ticks::Tick;

/// Numbers in 32 bits are this near to a round number where they are meant to be one.
pub(crate) const HAIR: f64 = 1e-6;

/// Round numbers, ascending, at least two.
pub(crate) struct Decades {
    pub(crate) values: Vec<f64>,
}

impl Decades {
    /// Those from the last one below `least` to the first one above `most`, both positive.
    pub(crate) fn around(least: f64, most: f64) -> Self {
        let first = step_below(libm::log10(least) + HAIR);
        let last = (step_below(libm::log10(most) - HAIR) + 1).max(first + 1);
        Self { values: (first..=last).map(round_number).collect() }
    }

    /// Logarithms to the base of ten of the first and the last number.
    pub(crate) fn ends(&self) -> [f64; 2] {
        [self.values.first(), self.values.last()]
            .map(|end| libm::log10(end.copied().unwrap_or(1.0)))
    }

    /// The numbers as marks on their scale.
    pub(crate) fn marks(&self) -> Vec<Tick> {
        let [low, high] = self.ends();
        let share = |value: f64| (libm::log10(value) - low) / (high - low);
        let mark = |value: &f64| Tick { share: share(*value), label: Some(Self::label(*value)) };
        self.values.iter().map(mark).collect()
    }

    /// A round number as text.
    pub(crate) fn label(value: f64) -> String {
        brief(value, 1)
    }

    /// Whether a round number is a power of ten.
    pub(crate) fn is_power_of_ten(value: f64) -> bool {
        let logarithm = libm::log10(value);
        (logarithm - logarithm.round()).abs() < HAIR
    }
}

/// The largest step whose number is at most 10^`logarithm`.
fn step_below(logarithm: f64) -> i32 {
    let decade = logarithm.floor();
    let rest = logarithm - decade;
    let within = i32::from(rest >= libm::log10(2.0)) + i32::from(rest >= libm::log10(5.0));
    3 * decade as i32 + within
}

/// 1, 2, 5, 10, 20, ... at step 0, 1, 2, ...; a fraction is divided by a whole power of ten.
fn round_number(step: i32) -> f64 {
    let digit = [1.0, 2.0, 5.0][step.rem_euclid(3) as usize];
    let decade = step.div_euclid(3);
    let power = libm::exp10(f64::from(decade.abs()));
    if decade < 0 { digit / power } else { digit * power }
}
