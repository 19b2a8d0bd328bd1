//! Light through openings that no path met: what visibility tests can leave unseen.
//!
//! Bidirectional paths ask for light that they then do not see, for something stands in the way:
//! a wall, as a rule, and now and then a wall with a keyhole. Of n paths that asked for light of
//! the size c behind something and never saw it, no more than 3 / n of the walls can be open (at
//! 95 %), so no more than `3 c / n` can be missing. Where that is less than the half-width of a
//! sensor point, n paths are enough; else the point has no interval.
//!
//! All sensor points where the paths of one are not enough look for the same openings, so what
//! counts for them is the number of paths from all of them together, as long as none of them saw
//! light of that size. Where one did, each of them has to see it for itself: more paths of all
//! points settle it where they are fewer than those of a relief of these.

use crate::path::sections::PathScores;

/// Paths of all such sensor points together that may be spent on this beyond their share of a run.
pub(super) const MAX_TESTS: u64 = 1 << 20;
/// Of no event among n, the mean number is less than this with 95 %.
const RULE_OF_THREE: f64 = 3.0;
/// Light that was seen and is so large a part of what was blocked is of the same size.
const SAME_SIZE: f64 = 1.0 / 16.0;

/// What bidirectional paths of one sensor point asked for.
pub(super) struct Tests {
    pub(super) scores: PathScores,
    pub(super) paths: u64,
    /// Of its value, over the reference of the scores.
    pub(super) half_width: f64,
}

/// What is not known of light behind openings.
pub(super) struct Unseen {
    /// The sensor points where some may be missing.
    pub(super) points: Vec<bool>,
    /// Whether more paths would settle that for all of them.
    pub(super) wants_more: bool,
}

impl Unseen {
    /// Where nobody looks yet, of so many sensor points.
    pub(super) fn nothing(points: usize) -> Self {
        Self { points: vec![false; points], wants_more: false }
    }

    /// By the tests of all sensor points, of which one that bidirectional paths take over gets this
    /// many paths at least.
    pub(super) fn new(tests: &[Tests], paths_of_relief: u64) -> Self {
        let needed: Vec<f64> = tests.iter().map(Tests::needed_paths).collect();
        let open =
            || tests.iter().zip(&needed).filter(|(own, needed)| own.paths as f64 <= **needed);
        let together: u64 = open().map(|(own, _)| own.paths).sum();
        let is_seen = open().any(|(own, _)| own.saw_such_light());
        let is_short = |needed: f64| is_seen || together as f64 <= needed;
        let points = tests
            .iter()
            .zip(&needed)
            .map(|(own, needed)| own.paths as f64 <= *needed && is_short(*needed));
        let most = open().fold(0.0, |most: f64, (_, needed)| most.max(*needed));
        let of_relief = open().count() as f64 * paths_of_relief as f64;
        let wants_more = if is_seen {
            most * tests.len() as f64 <= of_relief
        } else {
            together as f64 <= most && most <= MAX_TESTS as f64
        };
        let wants_more = wants_more && most > 0.0;
        Self { points: points.collect(), wants_more }
    }
}

impl Tests {
    /// Whether it saw light as large as what was blocked.
    fn saw_such_light(&self) -> bool {
        self.scores.seen.count_from(SAME_SIZE * self.scores.blocked.typical()) > 0
    }

    /// Paths after which openings that none of them met are too small to matter.
    fn needed_paths(&self) -> f64 {
        let blocked = RULE_OF_THREE * self.scores.blocked.typical();
        if blocked > 0.0 { blocked / self.half_width } else { 0.0 }
    }
}
