//! Axes: from values to places along them, and their ticks.

use crate::number::brief;
use crate::ticks::{Tick, Ticks};

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// By their differences.
    Linear,
    /// By their ratios; ticks are powers of this base, at least 2. Values must be positive.
    Log(u32),
}

/// An axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// What it shows, with the unit; empty for no label.
    pub label: String,
    /// How values are spread.
    pub scale: Scale,
    low: f64,
    high: f64,
    /// Distance of the ticks, where it is not chosen by the range.
    step: Option<f64>,
}

impl Axis {
    /// An axis from `low` to `high`.
    ///
    /// # Panics
    /// When `low` is not below `high`, or not positive where the scale needs it.
    #[must_use]
    pub fn new(label: &str, scale: Scale, [low, high]: [f64; 2]) -> Self {
        let allowed = low < high && (low > 0.0 || scale == Scale::Linear);
        assert!(allowed && (high - low).is_finite(), "no axis from {low} to {high}");
        Self { label: label.to_owned(), scale, low, high, step: None }
    }

    /// The same axis with ticks at the multiples of a positive step; only for [`Scale::Linear`].
    #[must_use]
    pub fn with_step(self, step: f64) -> Self {
        Self { step: Some(step), ..self }
    }

    /// An axis that holds all values that it can show, and ends a little outside them; where there
    /// are none, an axis near 1.
    #[must_use]
    pub fn around(label: &str, scale: Scale, values: impl IntoIterator<Item = f64>) -> Self {
        let shown = |x: &f64| x.is_finite() && (*x > 0.0 || scale == Scale::Linear);
        let [low, high] = values
            .into_iter()
            .filter(shown)
            .map(|x| scale.spread(x))
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        let [low, high] = if low > high { [0.0, 1.0] } else { [low, high] };
        let room = if low < high { 0.05 * (high - low) } else { 0.5 };
        Self::new(label, scale, [low - room, high + room].map(|x| scale.gathered(x)))
    }

    /// The place of a value: 0 at the low end, 1 at the high one; not finite where there is none.
    #[must_use]
    pub fn share(&self, value: f64) -> f64 {
        let [low, high] = [self.low, self.high].map(|x| self.scale.spread(x));
        (self.scale.spread(value) - low) / (high - low)
    }

    /// The marks, at most `most` of them with text.
    #[must_use]
    pub fn ticks(&self, most: usize) -> Vec<Tick> {
        match self.scale {
            Scale::Linear if self.step.is_some_and(|step| step > 0.0) => self.multiples(),
            Scale::Linear => {
                Ticks::within(self.low, self.high, most, 0.0).marks(|value| self.share(value))
            }
            Scale::Log(base) => self.powers(base, most),
        }
    }

    /// The multiples of the step.
    fn multiples(&self) -> Vec<Tick> {
        let step = self.step.unwrap_or(f64::INFINITY);
        let (first, last) = ((self.low / step).ceil() as i64, (self.high / step).floor() as i64);
        let tick = |value: f64| Tick { share: self.share(value), label: Some(brief(value, 6)) };
        (first..=last).map(|i| tick(i as f64 * step)).collect()
    }

    /// Whole powers of the base; of many, each second, third .. has its text.
    fn powers(&self, base: u32, most: usize) -> Vec<Tick> {
        let first = (self.scale.spread(self.low) - 1e-9).ceil() as i64;
        let last = (self.scale.spread(self.high) + 1e-9).floor() as i64;
        if last - first < 1 {
            return self.numbers(most);
        }
        let stride = ((last - first) / most.max(2) as i64 + 1).max(1);
        let tick = |power: i64| Tick {
            share: self.share(self.scale.gathered(power as f64)),
            label: (power % stride == 0).then(|| format!("{base}^{{{}}}", signed(power))),
        };
        (first..=last).map(tick).collect()
    }

    /// Where the axis spans less than a power: 1, 2 and 5 times powers of ten, or else evenly
    /// spaced round numbers.
    fn numbers(&self, most: usize) -> Vec<Tick> {
        let (first, last) = (libm::log10(self.low).floor(), libm::log10(self.high).ceil());
        let powers = (first as i32..=last as i32).map(|power| libm::exp10(f64::from(power)));
        let mut values: Vec<f64> = powers
            .flat_map(|power| [1.0, 2.0, 5.0].map(|digit| digit * power))
            .filter(|value| (self.low..=self.high).contains(value))
            .collect();
        if !(2..=most).contains(&values.len()) {
            values = Ticks::within(self.low, self.high, most.min(4), 0.0).values;
        }
        let tick = |value: &f64| Tick { share: self.share(*value), label: Some(brief(*value, 3)) };
        values.iter().map(tick).collect()
    }
}

impl Scale {
    fn spread(self, value: f64) -> f64 {
        match self {
            Self::Linear => value,
            Self::Log(base) => libm::log(value) / libm::log(f64::from(base)),
        }
    }

    fn gathered(self, spread: f64) -> f64 {
        match self {
            Self::Linear => spread,
            Self::Log(base) => {
                libm::pow(f64::from(base), spread).clamp(f64::MIN_POSITIVE, f64::MAX)
            }
        }
    }
}

fn signed(power: i64) -> String {
    if power < 0 { format!("\u{2212}{}", -power) } else { power.to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_where_they_belong() {
        let axis = Axis::new("N", Scale::Log(2), [1.0, 1024.0]);
        let ticks = axis.ticks(6);
        assert_eq!(ticks.len(), 11);
        assert_eq!(ticks[4].label.as_deref(), Some("2^{4}"));
        assert_eq!(ticks[5].label, None);
        assert!((ticks[5].share - 0.5).abs() < 1e-12);
        let errors = Axis::around("", Scale::Log(10), [1e-7, 0.3, 0.0, f64::NAN]);
        let labels: Vec<String> = errors.ticks(4).into_iter().filter_map(|t| t.label).collect();
        assert_eq!(labels, ["10^{\u{2212}6}", "10^{\u{2212}4}", "10^{\u{2212}2}", "10^{0}"][..3]);
    }

    #[test]
    fn narrow_axes_have_round_numbers() {
        let labels = |range| -> Vec<String> {
            let axis = Axis::new("", Scale::Log(10), range);
            axis.ticks(6).into_iter().filter_map(|tick| tick.label).collect()
        };
        assert_eq!(labels([0.02, 0.6]), ["0.02", "0.05", "0.1", "0.2", "0.5"]);
        assert_eq!(labels([30.0, 41.0]), ["30", "35", "40"]);
    }

    #[test]
    fn a_step_can_be_given() {
        let axis = Axis::new("gamma", Scale::Linear, [-90.0, 90.0]).with_step(30.0);
        let ticks = axis.ticks(3);
        let labels: Vec<&str> = ticks.iter().filter_map(|tick| tick.label.as_deref()).collect();
        assert_eq!(labels, ["-90", "-60", "-30", "0", "30", "60", "90"]);
        assert_eq!(ticks[3].share, 0.5);
    }

    #[test]
    fn every_axis_has_two_ends() {
        for values in [vec![], vec![1.0], vec![f64::NAN, 0.0], vec![1e-300, 1e300]] {
            for scale in [Scale::Linear, Scale::Log(10)] {
                let axis = Axis::around("", scale, values.clone());
                assert!(axis.low < axis.high);
                assert!(axis.ticks(5).iter().all(|t| (-1e-6..=1.0 + 1e-6).contains(&t.share)));
            }
        }
    }
}
