//! Handing out the coordinates of one sample.
//!
//! Discrete choices share a coordinate by modified superposition: each takes log2(1 / p) bits of it,
//! p the probability of what was chosen, and leaves the rest to the next. Only the first digits of a
//! coordinate are evenly spread, log2 N of N points, so the rest soon is no better than
//! pseudo-random, or a constant where nothing is randomised. The rule: a choice opens a fresh
//! coordinate when those before it took [`SHARED_BITS`](SampleCursor::SHARED_BITS) or more of the
//! open one. It depends on the choices of the sample and not on N, so that a longer run extends a
//! shorter one, and decisions keep their coordinates.

use crate::choice::{BoolChoice, Choice, choose_bool, choose_weights};
use crate::{Discrete, PointSet};

/// Hands out the coordinates of one sample in order and counts them.
///
/// The count is the sample's *constructive dimension*: how many coordinates it consumed until it
/// ended.
/// ```
/// use quasilux_sampling::{PointSet, Randomization, SampleCursor, Sequence};
/// let points = PointSet::new(Sequence::Sobol, Randomization::None, 0);
/// let mut cursor = SampleCursor::new(&points, 1);
/// assert_eq!(cursor.next_1d(), 0.5);
/// assert_eq!(cursor.next_2d(), [0.5, 0.5]);
/// assert_eq!(cursor.used(), 3);
/// ```
#[derive(Clone, Debug)]
pub struct SampleCursor<'a> {
    points: &'a PointSet,
    index: u64,
    dimension: u32,
    used: u32,
    /// What choices left of their coordinate, and the probability of all of them.
    open: Open,
}

#[derive(Clone, Copy, Debug)]
struct Open {
    rest: f64,
    probability: f64,
}

impl Open {
    /// Nothing is left.
    const NONE: Self = Self { rest: 0.0, probability: 0.0 };
}

impl<'a> SampleCursor<'a> {
    /// A coordinate from which choices took as many bits is not used further. A run of a million
    /// points has 20 even digits; a choice among a thousand luminaires takes ten and ends the
    /// coordinate, events with two outcomes share one.
    pub const SHARED_BITS: u32 = 8;

    /// Starts at the first coordinate of point `index`.
    #[inline]
    #[must_use]
    pub const fn new(points: &'a PointSet, index: u64) -> Self {
        Self { points, index, dimension: 0, used: 0, open: Open::NONE }
    }

    /// The next coordinate.
    #[inline]
    pub fn next_1d(&mut self) -> f64 {
        let coordinate = self.points.coordinate(self.index, self.dimension);
        self.dimension = self.dimension.saturating_add(1);
        self.used = self.used.saturating_add(1);
        coordinate
    }

    /// The next two coordinates.
    #[inline]
    pub fn next_2d(&mut self) -> [f64; 2] {
        [self.next_1d(), self.next_1d()]
    }

    /// True with probability `p_true`, on a coordinate that other choices share.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, SampleCursor, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let mut cursor = SampleCursor::new(&points, 1);
    /// let heads = (0..16).filter(|_| cursor.choose_bool(0.5)).count();
    /// assert_eq!(cursor.used(), 2);
    /// assert!(heads <= 16);
    /// ```
    #[inline]
    pub fn choose_bool(&mut self, p_true: f64) -> bool {
        let u = self.open_coordinate();
        let BoolChoice { value, rest } = choose_bool(u, p_true);
        let probability = if value { p_true.min(1.0) } else { 1.0 - p_true.max(0.0) };
        self.leave(rest, probability);
        value
    }

    /// Chooses as [`choose_weights`] does, on a coordinate that other choices share; `None`, and
    /// nothing consumed, where it gives `None`.
    pub fn choose(&mut self, weights: impl Iterator<Item = f64> + Clone) -> Option<Choice> {
        let before = self.clone();
        let u = self.open_coordinate();
        let choice = choose_weights(u, weights);
        match choice {
            Some(choice) => self.leave(choice.rest, choice.probability),
            None => *self = before,
        }
        choice
    }

    /// Chooses from a table, on a coordinate that other choices share.
    #[inline]
    pub fn choose_from(&mut self, distribution: &Discrete) -> Choice {
        let u = self.open_coordinate();
        let choice = distribution.choose(u);
        self.leave(choice.rest, choice.probability);
        choice
    }

    /// What choices left of their coordinate, for a decision that is not discrete; a fresh one where
    /// they took too much of it, by the rule of this module. Ends the shared coordinate.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, SampleCursor, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let mut cursor = SampleCursor::new(&points, 7);
    /// let survives = cursor.choose_bool(0.5);
    /// let direction = [cursor.rest_1d(), cursor.next_1d()];
    /// assert_eq!(cursor.used(), 2);
    /// # let _ = (survives, direction);
    /// ```
    #[inline]
    pub fn rest_1d(&mut self) -> f64 {
        let rest = self.open_coordinate();
        self.close();
        rest
    }

    /// Ends the coordinate that choices share: the next takes a fresh one.
    #[inline]
    pub fn close(&mut self) {
        self.open = Open::NONE;
    }

    #[inline]
    fn open_coordinate(&mut self) -> f64 {
        const SPENT: f64 = 1.0 / (1_u64 << SampleCursor::SHARED_BITS) as f64;
        if self.open.probability <= SPENT {
            self.open = Open { rest: self.next_1d(), probability: 1.0 };
        }
        self.open.rest
    }

    #[inline]
    fn leave(&mut self, rest: f64, probability: f64) {
        self.open = Open { rest, probability: self.open.probability * probability };
    }

    /// Goes on at `dimension`, for an assignment of coordinates to decisions that is fixed ahead;
    /// what is skipped does not count as used. It never goes back, so that no coordinate serves
    /// twice. What choices left of theirs is left behind.
    #[inline]
    pub fn skip_to(&mut self, dimension: u32) {
        self.close();
        self.dimension = self.dimension.max(dimension);
    }

    /// The dimension of the next coordinate.
    #[inline]
    #[must_use]
    pub const fn dimension(&self) -> u32 {
        self.dimension
    }

    /// How many coordinates were handed out.
    #[inline]
    #[must_use]
    pub const fn used(&self) -> u32 {
        self.used
    }
}
