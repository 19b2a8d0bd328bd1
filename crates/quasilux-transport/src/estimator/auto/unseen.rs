//! Light through openings that no path met: what visibility tests can leave unseen.
//!
//! Bidirectional paths ask for light that they then do not see, for something stands in the way:
//! a wall, as a rule, and now and then a wall with a keyhole. Of n paths that asked for light of the
//! size c behind something and never saw it, no more than 3 / n of the walls can be open (at 95 %),
//! so no more than `3 c / n` can be missing. Where that is less than the half-width of a sensor
//! point, n paths are enough; else the point has no interval.
//!
//! That would take n = c / half-width however small an opening is. All sensor points together look
//! for openings: where none of their paths saw light of that size in [`MAX_TESTS`] tries, openings
//! must be less than about `1e-5` of what paths meet, and are given up. Where one did, each sensor
//! point has to see it for itself.

use crate::path::sections::PathScores;

/// Paths of all such sensor points together that look for openings.
pub(super) const MAX_TESTS: u64 = 1 << 18;
/// Of no event among n, the mean number is less than this with 95 %.
const RULE_OF_THREE: f64 = 3.0;

/// What bidirectional paths of one sensor point asked for.
pub(super) struct Tests {
    pub(super) scores: PathScores,
    pub(super) paths: u64,
    /// Of its value, over the reference of the scores.
    pub(super) half_width: f64,
}

/// What is known of light behind openings.
pub(super) struct Unseen {
    /// The sensor points where some may be missing.
    pub(super) points: Vec<bool>,
    /// Whether more paths would settle that for all of them.
    pub(super) wants_more: bool,
}

impl Unseen {
    pub(super) fn new(tests: &[Tests]) -> Self {
        let is_open = |test: &Tests| {
            let missing = RULE_OF_THREE * test.scores.blocked.typical() / test.paths.max(1) as f64;
            missing > test.half_width
        };
        let open: Vec<bool> = tests.iter().map(is_open).collect();
        let own = || tests.iter().zip(&open).filter(|(_, open)| **open).map(|(test, _)| test);
        let tried: u64 = own().map(|test| test.paths).sum();
        let seen: u64 = own().map(Tests::seen).sum();
        let is_settled = seen == 0 && tried >= MAX_TESTS;
        let wants_more = own().next().is_some() && tried < MAX_TESTS;
        let points = if is_settled { vec![false; open.len()] } else { open };
        Self { points, wants_more }
    }
}

impl Tests {
    /// How often it saw light as large as what was blocked.
    fn seen(&self) -> u64 {
        self.scores.seen.count_from(self.scores.blocked.typical())
    }
}
