//! Which luminance gets which colour.
//!
//! Luminances of a room span decades, so the scale is logarithmic, between numbers 1, 2 or 5 times
//! a power of ten. It ends above the brightest pixel and begins below all but the darkest 1 % of
//! those with light, at most four decades lower. What is below has the colour of its low end.

use super::colour_map;
use super::decades::Decades;
use super::frame::Legend;
use crate::style::Colour;

/// Share of the lit pixels that may be too dark for the scale.
const TOO_DARK: f64 = 0.01;
/// The largest number of decades that the scale spans.
const MAX_DECADES: f64 = 4.0;

/// A logarithmic scale of luminance.
pub(crate) struct LuminanceScale {
    /// Logarithms to the base of ten of its ends.
    low: f64,
    high: f64,
    /// The round numbers from end to end.
    decades: Decades,
}

impl LuminanceScale {
    /// The scale for a picture.
    pub(crate) fn new(luminances_cd_m2: &[f32]) -> Self {
        let lit = |luminance: &f32| *luminance > 0.0 && luminance.is_finite();
        let mut lit: Vec<f32> = luminances_cd_m2.iter().copied().filter(lit).collect();
        lit.sort_unstable_by(f32::total_cmp);
        let dark = lit.get((TOO_DARK * lit.len() as f64) as usize).copied();
        let (dark, bright) = (dark.unwrap_or(1.0), lit.last().copied().unwrap_or(10.0));
        let [dark, bright] = [dark, bright].map(f64::from);
        let decades = Decades::around(dark.max(bright * libm::exp10(-MAX_DECADES)), bright);
        let [low, high] = decades.ends();
        Self { low, high, decades }
    }

    /// Place on the scale, 0 at its low end and 1 at its high one.
    pub(crate) fn share(&self, luminance_cd_m2: f64) -> f64 {
        if luminance_cd_m2 > 0.0 {
            (libm::log10(luminance_cd_m2) - self.low) / (self.high - self.low)
        } else {
            0.0
        }
    }

    /// The luminances at its low and its high end, in cd/m2.
    pub(crate) fn ends_cd_m2(&self) -> [f64; 2] {
        [self.low, self.high].map(libm::exp10)
    }

    /// The colour of a luminance.
    pub(crate) fn colour(&self, luminance_cd_m2: f64) -> Colour {
        colour_map::colour(self.share(luminance_cd_m2))
    }

    pub(crate) fn legend(&self) -> Legend<'static> {
        let ticks = self.decades.marks();
        let inner = ticks.get(1..ticks.len() - 1).unwrap_or_default();
        let marks = inner.iter().map(|tick| tick.share).collect();
        Legend { unit: "cd/m²", marks, ticks, target: None }
    }
}

#[cfg(test)]
mod tests {
    use super::super::decades::HAIR;
    use super::*;

    #[test]
    fn ends_and_ticks_are_round() {
        let room = LuminanceScale::new(&[3.4, 17.0, 88.0, 410.0]);
        assert_eq!(room.decades.values, [2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0]);
        assert_eq!((room.share(2.0), room.share(500.0)), (0.0, 1.0));
        assert!((room.share(libm::sqrt(1000.0)) - 0.5).abs() < 1e-12);
        let labels: Vec<String> =
            room.legend().ticks.into_iter().filter_map(|tick| tick.label).collect();
        assert_eq!(labels, ["2", "5", "10", "20", "50", "100", "200", "500"]);
        let dim = LuminanceScale::new(&[0.01, 0.05]);
        assert_eq!(dim.decades.values, [0.01, 0.02, 0.05]);
    }

    #[test]
    fn any_picture_has_a_scale() {
        for luminances in
            [&[][..], &[0.0], &[7.0], &[1e-30, 1.0], &[1e-30, 1e30], &[0.0, 1e-38], &[f32::NAN]]
        {
            let scale = LuminanceScale::new(luminances);
            assert!((2..=15).contains(&scale.decades.values.len()), "{luminances:?}");
            assert!(luminances.iter().all(|&l| scale.share(f64::from(l)) < 1.0 + HAIR));
            assert!(!scale.legend().ticks.is_empty());
        }
    }

    #[test]
    fn a_few_dark_pixels_do_not_stretch_it() {
        let mut luminances = vec![50.0; 200];
        luminances[0] = 1e-3;
        assert_eq!(LuminanceScale::new(&luminances).decades.values, [50.0, 100.0]);
    }
}
