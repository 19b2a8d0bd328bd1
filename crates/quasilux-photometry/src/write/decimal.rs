//! Decimal numbers that read back to the value that was meant.

use crate::angles::radians;
use std::f64::consts::PI;

/// Numbers longer than this are written with an exponent.
const LONGEST: usize = 25;

/// Angles nearer than this, in radians, are one angle: the rounding of a few additions.
const SAME_ANGLE_RAD: f64 = 4e-15;

/// The shortest decimal that reads back to `x`; 0 for what no file can hold.
pub(crate) fn number(x: f64) -> String {
    if !x.is_finite() || x == 0.0 {
        return "0".to_owned();
    }
    let text = x.to_string();
    if text.len() > LONGEST { format!("{x:e}") } else { text }
}

/// The number near `guess` that a reader's arithmetic, `read`, turns into `target`: exactly if
/// there is one, and then one of at most 15 digits if there is one; otherwise the nearest.
///
/// Numbers that a file gave have few digits, and quotients of what was made of them miss those
/// digits by rounding only.
pub(crate) fn before(guess: f64, target: f64, read: impl Fn(f64) -> f64) -> f64 {
    let short: f64 = format!("{guess:.14e}").parse().unwrap_or(guess);
    let (up, down) = (guess.next_up(), guess.next_down());
    let candidates = [short, guess, up, down, up.next_up(), down.next_down()];
    let error = |x: f64| (read(x) - target).abs();
    let mut best = short;
    for candidate in candidates {
        if error(candidate) < error(best) {
            best = candidate;
        }
    }
    best
}

/// An angle in degrees. One that misses a multiple of 1e-9 degrees by rounding only is that
/// multiple: so the angles of a file come back as they were written.
pub(crate) fn degrees(angle_rad: f64) -> f64 {
    let exact = angle_rad / PI * 180.0;
    let short = (exact * 1e9).round() / 1e9;
    if (radians(short) - angle_rad).abs() <= SAME_ANGLE_RAD {
        short
    } else {
        before(exact, angle_rad, radians)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_back() {
        for x in [1.0, 0.1, -0.3048, 1e18, 123_456.789, 1e-30, f64::MIN_POSITIVE, 0.1 + 0.2] {
            let text = number(x);
            assert_eq!(text.parse::<f64>().unwrap(), x);
            assert!(text.len() <= LONGEST);
        }
        assert_eq!([number(-0.0), number(f64::NAN), number(f64::INFINITY)], ["0", "0", "0"]);
    }

    #[test]
    fn quotients_find_the_digits_they_came_from() {
        let factor = 2.873 * 0.95;
        for i in 1..2000 {
            let written = f64::from(i) * 0.7;
            let written: f64 = format!("{written:.2}").parse().unwrap();
            let value = written * factor;
            assert_eq!(before(value / factor, value, |x| x * factor), written);
        }
    }

    #[test]
    fn angles_come_back_as_written() {
        for i in 0..=36_000 {
            let written = f64::from(i) / 100.0;
            assert_eq!(degrees(radians(written)), written);
            let turned = radians(written) - 1.1 + 1.1;
            assert_eq!(degrees(turned), written);
        }
        let odd = 0.123_456_789_012_345;
        assert!((radians(degrees(odd)) - odd).abs() <= f64::EPSILON * odd);
    }
}
