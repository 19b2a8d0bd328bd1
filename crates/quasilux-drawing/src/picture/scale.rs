//! Which value gets which colour, and at which values the contour lines and the legend's ticks lie.

use super::cells::Cell;
use super::colour_map;
use crate::style::Colour;
use crate::ticks::Ticks;

/// About as many contour lines as a reader can tell apart.
const MAX_LEVELS: usize = 8;
/// At most this many ticks on the legend.
const MAX_TICKS: usize = 14;

/// A linear scale between two round numbers.
pub(crate) struct ValueScale {
    low: f64,
    high: f64,
    /// Levels of the contour lines; none where the values do not differ by more than their
    /// intervals.
    pub(crate) levels: Ticks,
    /// Ticks of the legend, both ends among them.
    pub(crate) ticks: Ticks,
}

impl ValueScale {
    /// The scale for the values of a grid.
    ///
    /// It begins at zero unless all values lie in the upper half: then differences would be lost.
    /// Contour lines are never closer than twice the median half-width, so that noise is not drawn
    /// as structure.
    pub(crate) fn from_cells(cells: &[Cell]) -> Self {
        let values = || cells.iter().filter_map(|cell| cell.value);
        let low = values().reduce(f64::min).unwrap_or(0.0);
        let high = values().reduce(f64::max).unwrap_or(0.0);
        let least_step = 2.0 * median_half_width(cells);
        let span = high - low;
        if span <= least_step || span <= 1e-9 * high.abs().max(low.abs()) {
            return Self::constant(low, high);
        }
        let mut levels = Ticks::within(low, high, MAX_LEVELS, least_step);
        levels.values.retain(|level| *level > low && *level < high);
        let step = levels.step;
        let base = if low >= 0.0 && low < 0.5 * high { 0.0 } else { low };
        let (low, high) = ((base / step).floor() * step, (high / step).ceil() * step);
        let ticks = Ticks::within(low, high, MAX_TICKS, step);
        Self { low, high, levels, ticks }
    }

    fn constant(low: f64, high: f64) -> Self {
        let (low, high) = (low.min(0.0), if high > 0.0 || low < 0.0 { high.max(0.0) } else { 1.0 });
        let step = Ticks::within(low, high, MAX_LEVELS, 0.0).step;
        let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
        let ticks = Ticks::within(low, high, MAX_TICKS, 0.0);
        let levels = Ticks::within(0.0, 0.0, MAX_LEVELS, 0.0);
        Self { low, high, levels, ticks }
    }

    /// Place on the scale, 0 at its low end and 1 at its high one.
    pub(crate) fn share(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// The colour of a value.
    pub(crate) fn colour(&self, value: f64) -> Colour {
        colour_map::colour(self.share(value))
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

    #[test]
    fn covers_the_values_between_round_numbers() {
        let wide = scale(0.0, |x, _| 100.0 + 500.0 * x);
        assert_eq!((wide.low, wide.high), (0.0, 600.0));
        assert_eq!(wide.levels.values, [200.0, 300.0, 400.0, 500.0]);
        let narrow = scale(0.0, |x, _| 480.0 + 40.0 * x);
        assert_eq!((narrow.low, narrow.high), (480.0, 520.0));
        assert_eq!(narrow.ticks.values.first(), Some(&480.0));
        assert_eq!(narrow.ticks.values.last(), Some(&520.0));
    }

    #[test]
    fn noise_is_not_drawn_as_structure() {
        let quiet = scale(0.0, |x, _| 480.0 + 40.0 * x);
        let noisy = scale(0.02, |x, _| 480.0 + 40.0 * x);
        assert!(noisy.levels.step > quiet.levels.step);
        assert!(scale(0.2, |x, _| 480.0 + 40.0 * x).levels.values.is_empty());
    }

    #[test]
    fn constants_of_any_size_have_a_scale() {
        for lx in [0.0, 1e-12, 0.3, 500.0, 1e12, -4.0] {
            let scale = scale(0.0, |_, _| lx);
            assert!(scale.levels.values.is_empty());
            assert!((0.0..=1.0).contains(&scale.share(lx)), "{lx}");
            assert!(scale.ticks.values.len() >= 2, "{lx}");
        }
    }
}
