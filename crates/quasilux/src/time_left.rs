//! The time that is left of some work, as progress tells it: the same rule for runs, pictures and
//! years.

use quasilux_report::number::brief;

/// Before this share of the work seems to be over, the pace says little of the whole: predictions
/// were off by factors of a thousand and more.
const MIN_SHARE: f64 = 0.02;

/// Seconds left at the pace so far, of which a share of the work took `elapsed_s`, or until a time
/// limit; `None` where it is too early to tell. Work that goes on takes a second at least.
pub(crate) fn seconds_left(share: f64, elapsed_s: f64, limit_s: Option<f64>) -> Option<f64> {
    let at_this_pace_s = (share >= MIN_SHARE).then(|| elapsed_s * (1.0 - share) / share);
    at_this_pace_s.into_iter().chain(limit_s).reduce(f64::min).map(|left_s| left_s.max(1.0))
}

/// Seconds left in words.
pub(crate) fn in_words(left_s: Option<f64>) -> String {
    let left_s = left_s.map(|left_s| brief(left_s, 2));
    left_s.map_or_else(|| "time left not known yet".to_owned(), |left_s| format!("{left_s} s left"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_takes_as_long_as_what_is_done() {
        let words = |share, elapsed_s| in_words(seconds_left(share, elapsed_s, None));
        assert_eq!(words(0.25, 10.0), "30 s left");
        assert_eq!(words(0.5, 12_345.0), "12345 s left");
    }

    /// Nothing is told too early, and nothing that still goes on takes no time.
    #[test]
    fn neither_a_wild_guess_nor_nothing_is_left() {
        for share in [0.0, 1e-9, 0.019] {
            assert_eq!(in_words(seconds_left(share, 8.0, None)), "time left not known yet");
        }
        assert_eq!(seconds_left(0.999, 10.0, None), Some(1.0));
        assert_eq!(seconds_left(1.0, 10.0, Some(-0.1)), Some(1.0));
    }

    /// A limit is known from the start, and ends what would take longer.
    #[test]
    fn no_more_is_left_than_a_limit_leaves() {
        assert_eq!(seconds_left(0.0, 1.0, Some(3599.0)), Some(3599.0));
        assert_eq!(seconds_left(0.1, 10.0, Some(50.0)), Some(50.0));
        assert_eq!(seconds_left(0.5, 10.0, Some(50.0)), Some(10.0));
    }
}
