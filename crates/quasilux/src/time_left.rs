//! The time that is left of some work, as progress tells it: the same rule for runs, pictures and
//! years.

use quasilux_report::number::brief;

/// Before this share of the work seems to be over, the pace says little of the whole: predictions
/// were off by factors of a thousand and more.
const MIN_SHARE: f64 = 0.02;

/// Seconds left at the pace so far, of which a share of the work took `elapsed_s`; `None` where it
/// is too early to tell. Work that goes on takes a second at least.
pub(crate) fn seconds_left(share: f64, elapsed_s: f64) -> Option<f64> {
    (share >= MIN_SHARE).then(|| (elapsed_s * (1.0 - share) / share).max(1.0))
}

/// [`seconds_left`] in words.
pub(crate) fn in_words(share: f64, elapsed_s: f64) -> String {
    let left_s = seconds_left(share, elapsed_s).map(|left_s| brief(left_s, 2));
    left_s.map_or_else(|| "time left not known yet".to_owned(), |left_s| format!("{left_s} s left"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_takes_as_long_as_what_is_done() {
        assert_eq!(in_words(0.25, 10.0), "30 s left");
        assert_eq!(in_words(0.5, 12_345.0), "12345 s left");
    }

    /// Nothing is told too early, and nothing that still goes on takes no time.
    #[test]
    fn neither_a_wild_guess_nor_nothing_is_left() {
        for share in [0.0, 1e-9, 0.019] {
            assert_eq!(in_words(share, 8.0), "time left not known yet");
        }
        assert_eq!(in_words(0.999, 10.0), "1 s left");
        assert_eq!(in_words(1.0, 10.0), "1 s left");
    }
}
