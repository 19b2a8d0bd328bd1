//! The sampler: hands out the coordinates of one sample in order.
//!
//! Discrete choices share a coordinate by modified superposition: each takes some of its bits, and
//! leaves the rest to the next. Only the first digits of a coordinate are evenly spread, log2 N of
//! N points, so the rest soon is no better than pseudo-random, or a constant where nothing is
//! randomised. The rule: a choice is charged the bits that its distribution needs on average (its
//! entropy, rounded up), known before its outcome, and opens a fresh coordinate when it would bring
//! the open one above [`SHARED_BITS`](Sampler::SHARED_BITS). It depends neither on N, so that a
//! longer run extends a shorter one, nor on outcomes: decisions keep their coordinates as long as
//! the distributions before them are the same.

use crate::discrete::Discrete;
use crate::discrete_sample::{BoolSample, DiscreteSample, choose_bool, choose_weights};
use crate::hash::mix;
use crate::point_set::PointSet;

/// Past all dimensions: nothing was made ahead.
const NONE_AHEAD: u64 = 1 << 32;

/// Hands out the coordinates of one sample in order and counts them.
///
/// The count is the sample's *constructive dimension*: how many coordinates it consumed until it
/// ended.
/// ```
/// use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
/// let points = PointSet::new(Sequence::Sobol, Randomization::None, 0);
/// let mut sampler = Sampler::new(&points, 1);
/// assert_eq!(sampler.next_1d(), 0.5);
/// assert_eq!(sampler.next_2d(), [0.5, 0.5]);
/// assert_eq!(sampler.used(), 3);
/// ```
#[derive(Clone, Debug)]
pub struct Sampler<'a> {
    points: &'a PointSet,
    index: u64,
    dimension: u32,
    used: u32,
    open: Option<Open>,
    /// Coordinates made ahead, and the dimension of the first.
    ahead: [f64; 2],
    ahead_from: u64,
    /// The key of the splits that led here; 0 before the first.
    branch: u64,
}

/// What choices left of a coordinate.
#[derive(Clone, Copy, Debug)]
struct Open {
    u_remapped: f64,
    /// Bits that they were charged.
    spent: u32,
}

impl<'a> Sampler<'a> {
    /// No coordinate is shared by choices that need more bits together. A run of a million points
    /// has 20 even digits; a choice among a thousand facets takes ten and has its coordinate for
    /// itself, events with two outcomes share one.
    pub const SHARED_BITS: u32 = 8;

    /// Starts at the first coordinate of point `index`.
    #[inline]
    #[must_use]
    pub const fn new(points: &'a PointSet, index: u64) -> Self {
        Self {
            points,
            index,
            dimension: 0,
            used: 0,
            open: None,
            ahead: [0.0; 2],
            ahead_from: NONE_AHEAD,
            branch: 0,
        }
    }

    /// The sampler of child `child` of a sample that is split here, counted from 1; child 0 goes on
    /// with this sampler itself.
    ///
    /// It goes on at this dimension with a randomisation of its own, which is a function of the way
    /// to it: the dimensions at which its ancestors were split, and which children they were. So
    /// all children of one way, over all indices, have coordinates of one randomised sequence, and
    /// no two ways share any. Dimensions that its ancestors used are not used again: the digits of
    /// a point are the same in each randomisation but for a permutation, so what became of its
    /// ancestors would decide what becomes of the child, and no number of samples would average
    /// that out.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let mut parent = Sampler::new(&points, 7);
    /// let mut children = [parent.child(1), parent.child(2)];
    /// assert_ne!(children[0].next_1d(), children[1].next_1d());
    /// assert_eq!(parent.next_1d(), points.coordinate(7, 0));
    /// ```
    #[must_use]
    pub const fn child(&self, child: u32) -> Self {
        let place = (self.dimension as u64) << 32 | child as u64;
        // A key of 0 is the points' own.
        let branch = mix(self.branch ^ mix(place)) | 1;
        Self { branch, dimension: self.dimension, ..Self::new(self.points, self.index) }
    }

    /// Whether it is a split sample's child, or comes from one: its coordinates are not those of
    /// its point set.
    #[inline]
    #[must_use]
    pub const fn is_branch(&self) -> bool {
        self.branch != 0
    }

    /// The same sample, if a split one the same child, among other points: from their coordinate
    /// `dimension` on.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let others = PointSet::new(Sequence::Sobol, Randomization::Owen, 2);
    /// let parent = Sampler::new(&points, 7);
    /// assert_eq!(parent.among(&others, 3).next_1d(), others.coordinate(7, 3));
    /// assert_ne!(parent.child(1).among(&others, 3).next_1d(), others.coordinate(7, 3));
    /// ```
    #[inline]
    #[must_use]
    pub const fn among<'p>(&self, points: &'p PointSet, dimension: u32) -> Sampler<'p> {
        Sampler { branch: self.branch, dimension, ..Sampler::new(points, self.index) }
    }

    /// The number of the point.
    #[inline]
    #[must_use]
    pub const fn index(&self) -> u64 {
        self.index
    }

    /// Takes coordinates `dimension` and `dimension` + 1 of its point, made together with those of
    /// other points by [`PointSet::fill_at`]: it will not make them again. A
    /// [branch](Self::is_branch) has others, and leaves these.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let (mut alone, mut supplied) = (Sampler::new(&points, 7), Sampler::new(&points, 7));
    /// supplied.supply(1, [1, 2].map(|dimension| points.coordinate(7, dimension)));
    /// assert_eq!([(); 4].map(|()| supplied.next_1d()), [(); 4].map(|()| alone.next_1d()));
    /// ```
    #[inline]
    pub fn supply(&mut self, dimension: u32, coordinates: [f64; 2]) {
        if self.branch == 0 {
            (self.ahead_from, self.ahead) = (u64::from(dimension), coordinates);
        }
    }

    /// The next coordinate.
    #[inline]
    pub fn next_1d(&mut self) -> f64 {
        let coordinate = match u64::from(self.dimension).wrapping_sub(self.ahead_from) {
            0 => self.ahead[0],
            1 => self.ahead[1],
            _ if self.branch == 0 => self.points.coordinate(self.index, self.dimension),
            _ => self.points.branch(self.branch).coordinate(self.index, self.dimension),
        };
        self.dimension = self.dimension.saturating_add(1);
        self.used = self.used.saturating_add(1);
        coordinate
    }

    /// The next two coordinates.
    #[inline]
    pub fn next_2d(&mut self) -> [f64; 2] {
        [self.next_1d(), self.next_1d()]
    }

    /// True with probability `p_true`, on a coordinate that other choices share; none is consumed
    /// where the outcome is certain.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let tosses = |index| {
    ///     let mut sampler = Sampler::new(&points, index);
    ///     let heads = (0..16).filter(|_| sampler.choose_bool(0.5)).count();
    ///     assert_eq!(sampler.used(), 2);
    ///     heads
    /// };
    /// // Each toss takes one bit of a coordinate, and 256 points have all values of 8 bits equally
    /// // often: exactly half of the 4096 tosses are heads, a single wrong one shows.
    /// assert_eq!((0..256).map(tosses).sum::<usize>(), 2048);
    /// ```
    #[inline]
    pub fn choose_bool(&mut self, p_true: f64) -> bool {
        if p_true <= 0.0 || p_true >= 1.0 {
            return p_true > 0.0;
        }
        let BoolSample { value, u_remapped } = choose_bool(self.shared_coordinate(1), p_true);
        self.leave(u_remapped, 1);
        value
    }

    /// Chooses as [`choose_weights`] does, on a coordinate that other choices share; `None`, and
    /// nothing consumed, where it gives `None`.
    pub fn sample_weights(
        &mut self,
        weights: impl Iterator<Item = f64> + Clone,
    ) -> Option<DiscreteSample> {
        let entries = weights.clone().filter(|weight| *weight > 0.0).count();
        if entries == 0 {
            return None;
        }
        let before = self.clone();
        let bits = entries.next_power_of_two().trailing_zeros();
        let choice = choose_weights(self.shared_coordinate(bits), weights);
        match choice {
            Some(choice) => self.leave(choice.u_remapped, bits),
            None => *self = before,
        }
        choice
    }

    /// Chooses from a table, on a coordinate that other choices share.
    #[inline]
    pub fn sample_discrete(&mut self, distribution: &Discrete) -> DiscreteSample {
        let bits = distribution.bits();
        let choice = distribution.sample(self.shared_coordinate(bits));
        self.leave(choice.u_remapped, bits);
        choice
    }

    /// Chooses from a table on a fresh coordinate that goes on, renormalised, to what hangs on the
    /// choice, however many bits the choice takes: a photon's light, and then the direction from
    /// it.
    ///
    /// The rule of this module is for chains of choices. Here a single one cuts its coordinate into
    /// intervals, and where a net's first coordinate falls into a dyadic interval, its points are a
    /// net again: the rest is even for each light, and the sample one dimension shorter. What is
    /// lost is evenness across the lights: in a hall of 1000 lamps the direct light of photons has
    /// 1.3 times the error that a third coordinate would give, with walls of reflectance 0.5 and
    /// 0.8 it has 1.1 and 1.0 times (2^16 photons).
    ///
    /// ```
    /// use quasilux_sampling::{Discrete, PointSet, Randomization, Sampler, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let mut sampler = Sampler::new(&points, 7);
    /// let light = sampler.choose_leading(&Discrete::new(&[1.0; 1000]).unwrap()).index;
    /// let direction = [sampler.remapped_1d(), sampler.next_1d()];
    /// assert_eq!(sampler.used(), 2);
    /// # let _ = (light, direction);
    /// ```
    #[inline]
    pub fn choose_leading(&mut self, distribution: &Discrete) -> DiscreteSample {
        let choice = distribution.sample(self.next_1d());
        let spent = distribution.bits().min(Self::SHARED_BITS);
        self.open = Some(Open { u_remapped: choice.u_remapped, spent });
        choice
    }

    /// What choices left of their coordinate, for a decision that is not discrete; a fresh one
    /// where they took too much of it, by the rule of this module. Ends the shared coordinate.
    ///
    /// ```
    /// use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
    /// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
    /// let mut sampler = Sampler::new(&points, 7);
    /// let survives = sampler.choose_bool(0.5);
    /// let direction = [sampler.remapped_1d(), sampler.next_1d()];
    /// assert_eq!(sampler.used(), 2);
    /// # let _ = (survives, direction);
    /// ```
    #[inline]
    pub fn remapped_1d(&mut self) -> f64 {
        match self.open.take() {
            Some(open) if open.spent <= Self::SHARED_BITS => open.u_remapped,
            _ => self.next_1d(),
        }
    }

    /// Ends the coordinate that choices share: the next takes a fresh one.
    #[inline]
    pub fn close(&mut self) {
        self.open = None;
    }

    /// What is left of the open coordinate if `bits` more fit, else a fresh one.
    #[inline]
    fn shared_coordinate(&mut self, bits: u32) -> f64 {
        let fits = |open: &Open| open.spent == 0 || open.spent + bits <= Self::SHARED_BITS;
        let open = match self.open.filter(fits) {
            Some(open) => open,
            None => Open { u_remapped: self.next_1d(), spent: 0 },
        };
        self.open = Some(open);
        open.u_remapped
    }

    #[inline]
    fn leave(&mut self, u_remapped: f64, bits: u32) {
        let spent = self.open.map_or(0, |open| open.spent) + bits;
        self.open = Some(Open { u_remapped, spent });
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
