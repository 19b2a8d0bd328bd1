//! A fixed discrete distribution, sampled by inversion.
//!
//! A cumulative table with a guide table before it (H.-C. Chen and Y. Asau, "On generating random
//! variates from an empirical distribution", AIIE Trans. 6, 1974): expected time O(1). Not the
//! alias method: that map is not monotone, so it tears neighbouring coordinates apart and a
//! low-discrepancy sequence loses its evenness in it; nor does it give back a remapped coordinate.

use crate::discrete_sample::{DiscreteSample, is_weight, remap};

/// A distribution over the indices of a list of weights.
///
/// ```
/// use quasilux_sampling::Discrete;
/// let distribution = Discrete::new(&[1.0, 0.0, 3.0]).unwrap();
/// let choice = distribution.sample(0.625);
/// assert_eq!((choice.index, choice.pdf, choice.u_remapped), (2, 0.75, 0.5));
/// ```
#[derive(Clone, Debug)]
pub struct Discrete {
    /// `cumulative[i]` is the probability of the entries 0 ..= i; the last is 1.
    cumulative: Vec<f64>,
    /// `guide[b]` is the first entry whose cumulative probability lies in bucket b or later.
    guide: Vec<u32>,
    total: f64,
    bits: u32,
}

impl Discrete {
    /// The distribution proportional to `weights`.
    ///
    /// `None` when there is no positive finite total, when a weight is negative or NaN, or for more
    /// than 2^32 - 1 entries.
    #[must_use]
    pub fn new(weights: &[f64]) -> Option<Self> {
        if weights.len() >= u32::MAX as usize || !weights.iter().copied().all(is_weight) {
            return None;
        }
        let mut cumulative = prefix_sums(weights)?;
        let total = cumulative.last().copied().filter(|total| *total > 0.0)?;
        for sum in &mut cumulative {
            *sum /= total;
        }
        let guide = guide_table(&cumulative);
        let bits = entropy(&cumulative).ceil() as u32;
        Some(Self { cumulative, guide, total, bits })
    }

    /// The bits of a coordinate that a choice takes on average: the entropy, rounded up.
    #[must_use]
    pub const fn bits(&self) -> u32 {
        self.bits
    }

    /// The entry at which the cumulative probability passes u: non-decreasing in u, and never one
    /// of weight 0. A u outside [0, 1) counts as the nearer bound, NaN as 0.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: f64) -> DiscreteSample {
        let u = u.max(0.0);
        let bucket = bucket(u, self.guide.len() - 1).min(self.guide.len() - 2);
        let (first, last) = (self.guide[bucket] as usize, self.guide[bucket + 1] as usize);
        let index = first + self.cumulative[first..last].partition_point(|sum| *sum <= u);
        let [low, high] = self.bounds(index);
        DiscreteSample { index, pdf: high - low, u_remapped: remap(u, low, high) }
    }

    /// The coordinate that [`sample`](Self::sample) maps to this entry and to `u_remapped`.
    #[must_use]
    pub fn invert(&self, index: usize, u_remapped: f64) -> f64 {
        let [low, high] = self.bounds(index);
        low + u_remapped * (high - low)
    }

    /// The probability with which an entry is chosen: its weight over the total, to within 2^-52 of
    /// the whole.
    #[inline]
    #[must_use]
    pub fn pdf(&self, index: usize) -> f64 {
        let [low, high] = self.bounds(index);
        high - low
    }

    /// The sum of the weights.
    #[must_use]
    pub const fn total(&self) -> f64 {
        self.total
    }

    /// The number of entries, those of weight 0 included.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "a distribution has at least one entry")]
    pub const fn len(&self) -> usize {
        self.cumulative.len()
    }

    #[inline]
    fn bounds(&self, index: usize) -> [f64; 2] {
        let low = if index == 0 { 0.0 } else { self.cumulative[index - 1] };
        [low, self.cumulative[index]]
    }
}

/// Minus the sum of p log2 p (Shannon 1948), less a little so that 1024 equal entries have 10 bits.
fn entropy(cumulative: &[f64]) -> f64 {
    let mut below = 0.0;
    let mut bits = -1e-9;
    for &sum in cumulative {
        let p = sum - below;
        if p > 0.0 {
            bits -= p * libm::log2(p);
        }
        below = sum;
    }
    bits
}

/// Non-decreasing sums with the rounding errors carried along (A. Neumaier, 1974); `None` on
/// overflow.
fn prefix_sums(weights: &[f64]) -> Option<Vec<f64>> {
    let (mut sum, mut carry, mut last) = (0.0_f64, 0.0, 0.0_f64);
    let next = |weight: &f64| {
        let next = sum + weight;
        carry += if sum >= *weight { (sum - next) + weight } else { (weight - next) + sum };
        sum = next;
        last = last.max(sum + carry);
        last
    };
    let sums = weights.iter().map(next).collect();
    sum.is_finite().then_some(sums)
}

/// One bucket an entry. `bucket` does not decrease, so an entry before `guide[b]` has a cumulative
/// probability below any u of bucket b, whatever the rounding.
fn guide_table(cumulative: &[f64]) -> Vec<u32> {
    let buckets = cumulative.len();
    let mut guide = Vec::with_capacity(buckets + 1);
    let mut entry = 0;
    for b in 0..=buckets {
        while bucket(cumulative[entry], buckets) < b {
            entry += 1;
        }
        guide.push(entry as u32);
    }
    guide
}

#[inline]
fn bucket(u: f64, buckets: usize) -> usize {
    (u * buckets as f64) as usize
}
