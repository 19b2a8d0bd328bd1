//! Which value gets which colour, and at which values the contour lines and the legend's ticks lie.
//!
//! Values that span more than [`LINEAR_RATIO`] have a logarithmic scale: on a linear one all small
//! values would have the same colour.

use super::cells::Cell;
use super::colour_map;
use super::decades::Decades;
use crate::style::Colour;
use crate::ticks::{Tick, Ticks};

/// About as many contour lines as a reader can tell apart.
const MAX_LEVELS: usize = 8;
/// At most this many ticks on the legend.
const MAX_TICKS: usize = 14;
/// The largest ratio of positive values on a linear scale.
const LINEAR_RATIO: f64 = 50.0;
/// The largest number of decades on a logarithmic scale.
const MAX_DECADES: f64 = 6.0;

/// A linear or logarithmic scale between two round numbers.
pub(crate) struct ValueScale {
    /// Ends: values, or their logarithms to the base of ten.
    low: f64,
    high: f64,
    is_logarithmic: bool,
    /// Where contour lines lie; none where the values do not differ by more than their intervals.
    pub(crate) levels: Vec<Level>,
    /// Ticks of the legend, both ends among them.
    pub(crate) ticks: Vec<Tick>,
}

/// A value with a contour line.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Level {
    pub(crate) value: f64,
    pub(crate) label: String,
}

impl ValueScale {
    /// The scale for the values of grids.
    ///
    /// A linear one begins at zero unless all values lie in the upper half: then differences would
    /// be lost. Its contour lines are never closer than twice the median half-width, so that noise
    /// is not drawn as structure.
    pub(crate) fn from_cells(cells: &[Cell]) -> Self {
        let values = || cells.iter().filter_map(|cell| cell.value);
        let low = values().reduce(f64::min).unwrap_or(0.0);
        let high = values().reduce(f64::max).unwrap_or(0.0);
        let least_step = 2.0 * median_half_width(cells);
        let span = high - low;
        if span <= least_step || span <= 1e-9 * high.abs().max(low.abs()) {
            return Self::constant(low, high);
        }
        let least = values().filter(|value| *value > 0.0).reduce(f64::min);
        match least {
            Some(least) if low >= 0.0 && high > LINEAR_RATIO * least => {
                Self::logarithmic(least, high)
            }
            _ => Self::linear(low, high, least_step),
        }
    }

    fn linear(low: f64, high: f64, least_step: f64) -> Self {
        let mut levels = Ticks::within(low, high, MAX_LEVELS, least_step);
        levels.values.retain(|level| *level > low && *level < high);
        let step = levels.step;
        let base = if low >= 0.0 && low < 0.5 * high { 0.0 } else { low };
        let (low, high) = ((base / step).floor() * step, (high / step).ceil() * step);
        Self::between(low, high, &levels, step)
    }

    fn constant(low: f64, high: f64) -> Self {
        let (low, high) = (low.min(0.0), if high > 0.0 || low < 0.0 { high.max(0.0) } else { 1.0 });
        let step = Ticks::within(low, high, MAX_LEVELS, 0.0).step;
        let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
        Self::between(low, high, &Ticks::within(0.0, 0.0, MAX_LEVELS, 0.0), 0.0)
    }

    /// A linear scale between two numbers.
    fn between(low: f64, high: f64, levels: &Ticks, least_step: f64) -> Self {
        let share = |value: f64| (value - low) / (high - low);
        let ticks = Ticks::within(low, high, MAX_TICKS, least_step).marks(share);
        let level = |value: &f64| Level { value: *value, label: levels.label(*value) };
        let levels = levels.values.iter().map(level).collect();
        Self { low, high, is_logarithmic: false, levels, ticks }
    }

    /// A scale between two positive numbers.
    fn logarithmic(least: f64, most: f64) -> Self {
        let decades = Decades::around(least.max(most * libm::exp10(-MAX_DECADES)), most);
        let [low, high] = decades.ends();
        let inside = decades.values.iter().filter(|value| least < **value && **value < most);
        let inside: Vec<f64> = inside.copied().collect();
        let step = if inside.len() > MAX_LEVELS + 4 { 3 } else { 1 };
        let is_power = |value: &f64| step == 1 || Decades::is_power_of_ten(*value);
        let level = |value: f64| Level { value, label: Decades::label(value) };
        let levels = inside.into_iter().filter(is_power).map(level).collect();
        Self { low, high, is_logarithmic: true, levels, ticks: decades.marks() }
    }

    /// Place on the scale, 0 at its low end and 1 at its high one.
    pub(crate) fn share(&self, value: f64) -> f64 {
        if !self.is_logarithmic {
            return (value - self.low) / (self.high - self.low);
        }
        if value > 0.0 {
            ((libm::log10(value) - self.low) / (self.high - self.low)).max(0.0)
        } else {
            0.0
        }
    }

    /// Whether a value lies between the ends.
    pub(crate) fn holds(&self, value: f64) -> bool {
        let place = if self.is_logarithmic { libm::log10(value) } else { value };
        (self.low..=self.high).contains(&place)
    }

    /// The colour of a value.
    pub(crate) fn colour(&self, value: f64) -> Colour {
        colour_map::colour(self.share(value))
    }

    /// The values at both ends.
    pub(crate) fn ends(&self) -> [f64; 2] {
        let ends = [self.low, self.high];
        if self.is_logarithmic { ends.map(libm::exp10) } else { ends }
    }

    /// Whether equal ratios have equal distances.
    pub(crate) fn is_logarithmic(&self) -> bool {
        self.is_logarithmic
    }
}

fn median_half_width(cells: &[Cell]) -> f64 {
    let mut all: Vec<f64> = cells.iter().filter_map(|cell| cell.half_width).collect();
    all.sort_by(f64::total_cmp);
    all.get(all.len() / 2).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::Grid;

    fn scale(noise: f64, lx: impl Fn(f64, f64) -> f64) -> ValueScale {
        ValueScale::from_cells(&Grid::new([4.0, 4.0], [10, 10], noise, lx).cells)
    }

    fn levels(scale: &ValueScale) -> Vec<f64> {
        scale.levels.iter().map(|level| level.value).collect()
    }

    #[test]
    fn covers_the_values_between_round_numbers() {
        let wide = scale(0.0, |x, _| 100.0 + 500.0 * x);
        assert_eq!((wide.low, wide.high), (0.0, 600.0));
        assert_eq!(levels(&wide), [200.0, 300.0, 400.0, 500.0]);
        let narrow = scale(0.0, |x, _| 480.0 + 40.0 * x);
        assert_eq!((narrow.low, narrow.high), (480.0, 520.0));
        let label = |tick: Option<&Tick>| tick.and_then(|tick| tick.label.clone());
        assert_eq!(label(narrow.ticks.first()).as_deref(), Some("480"));
        assert_eq!(label(narrow.ticks.last()).as_deref(), Some("520"));
    }

    #[test]
    fn noise_is_not_drawn_as_structure() {
        let step = |scale: &ValueScale| levels(scale)[1] - levels(scale)[0];
        let quiet = scale(0.0, |x, _| 480.0 + 40.0 * x);
        let noisy = scale(0.007, |x, _| 480.0 + 40.0 * x);
        assert!(step(&noisy) > step(&quiet));
        assert!(scale(0.2, |x, _| 480.0 + 40.0 * x).levels.is_empty());
    }

    #[test]
    fn constants_of_any_size_have_a_scale() {
        for lx in [0.0, 1e-12, 0.3, 500.0, 1e12, -4.0] {
            let scale = scale(0.0, |_, _| lx);
            assert!(scale.levels.is_empty());
            assert!((0.0..=1.0).contains(&scale.share(lx)), "{lx}");
            assert!(scale.ticks.len() >= 2, "{lx}");
        }
    }

    /// Ratios are those of the largest and the smallest positive value of ten columns.
    #[test]
    fn a_wide_range_is_logarithmic() {
        let spanning =
            |ratio: f64| scale(0.0, move |x, _| 800.0 * libm::pow(ratio, (x - 0.95) / 0.9));
        assert!(!spanning(45.0).is_logarithmic());
        let wide = spanning(1e3);
        assert!(wide.is_logarithmic());
        assert_eq!(levels(&wide), [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0]);
        assert!((wide.share(libm::sqrt(0.5 * 1000.0)) - 0.5).abs() < 1e-12);
        let decades = spanning(1e5);
        assert_eq!(levels(&decades), [0.01, 0.1, 1.0, 10.0, 100.0]);
        assert!(scale(0.0, |x, _| if x < 0.5 { 0.0 } else { 100.0 }).share(0.0) == 0.0);
        assert!(!scale(0.0, |x, _| if x < 0.5 { 0.0 } else { 100.0 }).is_logarithmic());
    }
}
