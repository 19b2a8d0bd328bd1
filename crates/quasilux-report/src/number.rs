//! Numbers as text: as many digits as their intervals carry, and no more.
//!
//! The half-width decides. Its digits follow the rounding rule of the Particle Data Group (Workman
//! et al. 2022, Review of Particle Physics, section 5.3 of the introduction): two digits where its
//! leading ones lie below 355, one digit up to 949, and what is above is rounded to 1000, keeping
//! two. The value is rounded to the same place.

use crate::figure::Figure;
pub use quasilux_drawing::number::brief;
pub(crate) use quasilux_drawing::number::{among_others, shared_place};
use quasilux_drawing::number::{decimal_exponent, to_place};

/// A value is never written with more significant digits than this, however narrow its interval.
const MAX_DIGITS: i32 = 6;
/// Significant digits of a value without an interval.
const DIGITS_WITHOUT_INTERVAL: i32 = 4;

/// A figure as text, value and half-width rounded to the same place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FigureText {
    /// The value; a dash where there is none.
    pub value: String,
    /// The half-width, where there is one.
    pub half_width: Option<String>,
}

impl FigureText {
    /// `498.0 ± 1.1`, or the value alone.
    #[must_use]
    pub fn joined(&self) -> String {
        match &self.half_width {
            Some(half_width) => format!("{} ± {half_width}", self.value),
            None => self.value.clone(),
        }
    }
}

/// Rounds a figure to the digits that its half-width leaves it.
///
/// Where the half-width is below the last of six digits, it is rounded up to one unit of that
/// digit: what is written never claims more than what is known. A half-width of zero stays zero.
#[must_use]
pub fn figure_text(figure: Figure) -> FigureText {
    let Some(value) = figure.value else {
        return FigureText { value: "-".into(), half_width: None };
    };
    let finest = decimal_exponent(value).map_or(0, |e| e - MAX_DIGITS + 1);
    let Some(half_width) = figure.half_width else {
        let place = decimal_exponent(value).map_or(0, |e| e - DIGITS_WITHOUT_INTERVAL + 1);
        return FigureText { value: to_place(value, place), half_width: None };
    };
    let Some(wanted) = last_place(half_width) else {
        let place = decimal_exponent(value).map_or(0, |e| e - DIGITS_WITHOUT_INTERVAL + 1);
        return FigureText { value: to_place(value, place), half_width: Some("0".into()) };
    };
    if value != 0.0 && wanted < finest {
        let unit = libm::exp10(f64::from(finest));
        let half_width = (half_width / unit).ceil().max(1.0) * unit;
        return FigureText {
            value: to_place(value, finest),
            half_width: Some(to_place(half_width, finest)),
        };
    }
    FigureText { value: to_place(value, wanted), half_width: Some(to_place(half_width, wanted)) }
}

/// The shortest text that reads back as exactly this number.
#[must_use]
pub fn exact(x: f64) -> String {
    format!("{x:?}")
}

/// A number of things: `2 048 samples`, `1 thread`.
#[must_use]
pub fn plural(n: u64, one: &str) -> String {
    format!("{} {one}{}", count(n), if n == 1 { "" } else { "s" })
}

/// A count with its thousands set apart by spaces: `1 048 576`.
#[must_use]
pub fn count(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// Memory of this many bytes: `1.5 GiB`, `96 MiB`.
#[must_use]
pub fn memory(bytes: u64) -> String {
    let mib = bytes as f64 / f64::from(1 << 20);
    if mib < 1000.0 { format!("{mib:.0} MiB") } else { format!("{:.1} GiB", mib / 1024.0) }
}

/// The place of the last digit to write of a half-width, as a power of ten; `None` for zero.
fn last_place(half_width: f64) -> Option<i32> {
    let exponent = decimal_exponent(half_width)?;
    let leading = half_width / libm::exp10(f64::from(exponent));
    Some(if leading < 3.545 { exponent - 1 } else { exponent })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(value: f64, half_width: f64) -> String {
        figure_text(Figure { value: Some(value), half_width: Some(half_width) }).joined()
    }

    #[test]
    fn digits_follow_the_half_width() {
        assert_eq!(text(498.04, 1.1), "498.0 ± 1.1");
        assert_eq!(text(498.04, 3.5449), "498.0 ± 3.5");
        assert_eq!(text(498.04, 3.56), "498 ± 4");
        assert_eq!(text(498.04, 9.6), "498 ± 10");
        assert_eq!(text(498.04, 0.96), "498.0 ± 1.0");
        assert_eq!(text(0.428_31, 0.008_7), "0.428 ± 0.009");
        assert_eq!(text(12_345.0, 1_234.0), "12300 ± 1200");
        assert_eq!(text(0.2, 5.0), "0 ± 5");
        assert_eq!(text(-0.2, 5.0), "0 ± 5");
    }

    #[test]
    fn narrow_intervals_are_rounded_up_not_away() {
        assert_eq!(text(500.0, 1e-9), "500.000 ± 0.001");
        assert_eq!(text(500.0, 0.0), "500.0 ± 0");
        assert_eq!(text(0.0, 0.0), "0 ± 0");
        assert_eq!(text(0.0, 0.011), "0.000 ± 0.011");
    }

    #[test]
    fn huge_and_tiny_numbers_get_an_exponent() {
        assert_eq!(text(4.98e12, 1.1e10), "4.980e12 ± 1.1e10");
        assert_eq!(text(4.98e-12, 1.1e-14), "4.980e-12 ± 1.1e-14");
    }

    #[test]
    fn figures_without_interval_or_value() {
        let alone = figure_text(Figure { value: Some(498.0412), half_width: None });
        assert_eq!(alone.joined(), "498.0");
        let none = figure_text(Figure { value: None, half_width: None });
        assert_eq!(none.joined(), "-");
    }

    #[test]
    fn counts_memory_and_exact_numbers() {
        assert_eq!(count(1_048_576), "1 048 576");
        assert_eq!(count(999), "999");
        assert_eq!((memory(96 << 20), memory(3 << 29)), ("96 MiB".into(), "1.5 GiB".into()));
        assert_eq!(exact(0.1), "0.1");
    }
}
