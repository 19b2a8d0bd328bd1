//! Decimal numbers as text, rounded to a decimal place or to a number of significant digits.

/// Places of the last digit outside this range are written with an exponent.
const PLAIN_PLACES: std::ops::RangeInclusive<i32> = -9..=6;

/// A number with at most `digits` significant digits, trailing zeros of the fraction removed.
#[must_use]
pub fn brief(x: f64, digits: i32) -> String {
    let place = decimal_exponent(x).map_or(0, |e| e - digits + 1);
    let text = to_place(x, place.min(0));
    if text.contains('.') && !text.contains('e') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text
}

/// The exponent of a number in scientific notation; `None` for zero and what is not finite.
#[must_use]
pub fn decimal_exponent(x: f64) -> Option<i32> {
    if x == 0.0 || !x.is_finite() {
        return None;
    }
    let text = format!("{x:e}");
    text.split_once('e').and_then(|(_, exponent)| exponent.parse().ok())
}

/// Rounds to a multiple of 10^`place` and writes no digit below it.
#[must_use]
pub fn to_place(x: f64, place: i32) -> String {
    if !PLAIN_PLACES.contains(&place) {
        let digits = decimal_exponent(x).map_or(0, |e| (e - place).max(0));
        return format!("{x:.*e}", digits as usize);
    }
    let text = if place <= 0 {
        format!("{x:.*}", place.unsigned_abs() as usize)
    } else {
        let unit = libm::exp10(f64::from(place));
        format!("{:.0}", (x / unit).round() * unit)
    };
    let is_zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

/// The decimal place to which numbers that stand side by side are written: three digits of the
/// largest one, and no place above the units.
#[must_use]
pub fn shared_place(numbers: impl Iterator<Item = f64>) -> i32 {
    let largest = numbers.fold(0.0_f64, |most, x| most.max(x.abs()));
    decimal_exponent(largest).map_or(0, |exponent| exponent - 2).min(0)
}

/// A number among others: to their place, and one that is much smaller with two digits.
#[must_use]
pub fn among_others(x: f64, place: i32) -> String {
    match decimal_exponent(x) {
        Some(exponent) if exponent <= place => brief(x, 2),
        _ => to_place(x, place),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trailing_zeros_are_removed_from_fractions_alone() {
        assert_eq!(brief(0.1 + 0.2, 4), "0.3");
        assert_eq!(brief(1500.0, 4), "1500");
        assert_eq!(brief(0.0, 4), "0");
        assert_eq!(brief(123_456.0, 3), "123456");
    }

    /// Between a tenth and a thousand times the unit, and a small one among large ones.
    #[test]
    fn numbers_side_by_side_have_one_place() {
        let numbers = [412.46, 143.0, 2.345, 0.0, 0.046];
        let place = shared_place(numbers.into_iter());
        assert_eq!(numbers.map(|x| among_others(x, place)), ["412", "143", "2.3", "0", "0.046"]);
        assert_eq!(shared_place([0.0123, -0.2].into_iter()), -3);
        assert_eq!(shared_place([2194.0].into_iter()), 0);
    }

    #[test]
    fn exponents_are_those_of_the_shortest_text() {
        assert_eq!(decimal_exponent(9.999_999_999e5), Some(5));
        assert_eq!(decimal_exponent(0.0), None);
        assert_eq!(to_place(-0.04, -1), "0.0");
    }
}
