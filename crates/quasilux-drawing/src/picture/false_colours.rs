//! The false colours of grids and cameras, for whoever draws them in a way of their own.

use super::cells::Cell;
use super::colour_map;
use super::luminance_scale::LuminanceScale;
use super::scale::ValueScale;
use crate::style::Colour;

/// What a false-colour picture of some values is drawn with.
#[derive(Clone, Debug, PartialEq)]
pub struct FalseColourScale {
    /// The value of the first colour.
    pub low: f64,
    /// The value of the last colour.
    pub high: f64,
    /// Whether equal ratios have equal distances, and not equal differences.
    pub is_logarithmic: bool,
    /// Where contour lines lie, ascending; none where values do not differ by more than their
    /// intervals.
    pub levels: Vec<ContourLevel>,
}

/// A value with a contour line.
#[derive(Clone, Debug, PartialEq)]
pub struct ContourLevel {
    /// The value.
    pub value: f64,
    /// The same with the digits that tell it from others.
    pub label: String,
}

impl FalseColourScale {
    /// That of the pictures of grids with these cells.
    #[must_use]
    pub fn from_cells(cells: &[Cell]) -> Self {
        let scale = ValueScale::from_cells(cells);
        let [low, high] = scale.ends();
        let levels = scale.levels.iter();
        Self {
            low,
            high,
            is_logarithmic: scale.is_logarithmic(),
            levels: levels
                .map(|level| ContourLevel { value: level.value, label: level.label.clone() })
                .collect(),
        }
    }

    /// That of the pictures of a camera with these luminances, in cd/m2: logarithmic, without
    /// contour lines. What is below its low end has the first colour.
    #[must_use]
    pub fn from_luminances(luminances_cd_m2: &[f32]) -> Self {
        let [low, high] = LuminanceScale::new(luminances_cd_m2).ends_cd_m2();
        Self { low, high, is_logarithmic: true, levels: Vec::new() }
    }
}

/// This many colours at equal distances along the scale, both ends among them.
#[must_use]
pub fn false_colours(count: usize) -> Vec<Colour> {
    let last = count.saturating_sub(1).max(1) as f64;
    (0..count).map(|number| colour_map::colour(number as f64 / last)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::Grid;

    /// The scale of ten columns from 150 to 550 lx, as the picture has it.
    #[test]
    fn the_scale_is_that_of_the_picture() {
        let grid = Grid::new([4.0, 4.0], [10, 10], 0.0, |x, _| 100.0 + 500.0 * x);
        let scale = FalseColourScale::from_cells(&grid.cells);
        assert_eq!((scale.low, scale.high, scale.is_logarithmic), (0.0, 600.0, false));
        let labels: Vec<&str> = scale.levels.iter().map(|level| level.label.as_str()).collect();
        assert_eq!(labels, ["200", "300", "400", "500"]);
        let wide = Grid::new([4.0, 4.0], [10, 10], 0.0, |x, _| libm::exp10(4.0 * x));
        let scale = FalseColourScale::from_cells(&wide.cells);
        assert!(scale.is_logarithmic && scale.low > 0.0 && scale.high <= 1e4, "{scale:?}");
    }

    /// Round numbers around the luminances, but for the darkest.
    #[test]
    fn the_scale_of_luminances_is_that_of_the_picture() {
        let mut luminances = vec![3.4; 200];
        luminances[..3].copy_from_slice(&[0.0, 0.01, 410.0]);
        let scale = FalseColourScale::from_luminances(&luminances);
        assert!(scale.is_logarithmic && scale.levels.is_empty(), "{scale:?}");
        assert!((scale.low - 2.0).abs() < 1e-12 && (scale.high - 500.0).abs() < 1e-9, "{scale:?}");
    }

    #[test]
    fn colours_run_from_end_to_end() {
        let colours = false_colours(11);
        assert_eq!((colours[0], colours[10]), (colour_map::colour(0.0), colour_map::colour(1.0)));
        assert_eq!(false_colours(1), [colour_map::colour(0.0)]);
        assert_eq!(false_colours(0), [[0; 3]; 0]);
    }
}
