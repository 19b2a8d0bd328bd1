//! Modified superposition: a discrete choice takes what it needs of a coordinate and gives back the
//! rest.
//!
//! A. Voloboy, K. Dmitriev, E. Kopylov (2003): if u fell into [a, b), go on with (u - a) / (b - a),
//! which is uniform again. Each choice of probability p costs log2(1 / p) of the coordinate's 53
//! bits; of an unrandomised sequence only the first log2 N digits of N points are of use.

use crate::unit::ONE_BELOW;

/// The outcome of a choice among several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiscreteSample {
    /// Which was chosen.
    pub index: usize,
    /// With what probability.
    pub pdf: f64,
    /// The rest of the coordinate, uniform on [0, 1) and independent of the choice.
    pub u_remapped: f64,
}

/// The outcome of a choice between two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoolSample {
    /// Which was chosen.
    pub value: bool,
    /// The rest of the coordinate, uniform on [0, 1) and independent of the choice.
    pub u_remapped: f64,
}

/// True with probability `p_true`: where u < `p_true`.
///
/// A probability outside [0, 1] counts as the nearer bound, NaN as 0.
///
/// ```
/// use quasilux_sampling::{choose_bool, BoolSample};
/// assert_eq!(choose_bool(0.125, 0.25), BoolSample { value: true, u_remapped: 0.5 });
/// assert_eq!(choose_bool(0.625, 0.25), BoolSample { value: false, u_remapped: 0.5 });
/// ```
#[inline]
#[must_use]
pub fn choose_bool(u: f64, p_true: f64) -> BoolSample {
    if u < p_true {
        BoolSample { value: true, u_remapped: remap(u, 0.0, p_true.min(1.0)) }
    } else if p_true > 0.0 {
        BoolSample { value: false, u_remapped: remap(u, p_true.min(ONE_BELOW), 1.0) }
    } else {
        BoolSample { value: false, u_remapped: u }
    }
}

/// Chooses an entry of a short list with probability proportional to its weight, in two passes and
/// without a table.
///
/// `None` unless the weights have a positive finite total; none may be negative. An entry of weight
/// 0 is never chosen. For a list that is used often, build a [`Discrete`](crate::Discrete).
///
/// ```
/// use quasilux_sampling::choose_weights;
/// let choice = choose_weights(0.625, [1.0, 0.0, 3.0].into_iter()).unwrap();
/// assert_eq!((choice.index, choice.pdf, choice.u_remapped), (2, 0.75, 0.5));
/// assert_eq!(choose_weights(0.625, [0.0].into_iter()), None);
/// ```
#[must_use]
pub fn choose_weights(
    u: f64,
    weights: impl Iterator<Item = f64> + Clone,
) -> Option<DiscreteSample> {
    let mut total = 0.0;
    for weight in weights.clone() {
        if !is_weight(weight) {
            return None;
        }
        total += weight;
    }
    if !(total > 0.0 && total.is_finite()) {
        return None;
    }
    let target = u.max(0.0) * total;
    let mut chosen = None;
    let mut sum = 0.0;
    for (index, weight) in weights.enumerate() {
        let next = sum + weight;
        // A weight below the rounding of the sum has no share of the coordinate.
        if next > sum {
            let pdf = weight / total;
            chosen = Some(DiscreteSample { index, pdf, u_remapped: remap(target, sum, next) });
        }
        if target < next {
            break;
        }
        sum = next;
    }
    chosen
}

/// Whether a number can be a weight: not negative, infinite or NaN.
#[inline]
pub(crate) fn is_weight(weight: f64) -> bool {
    weight >= 0.0 && weight.is_finite()
}

/// Where u lies in [low, high), as a fraction in [0, 1).
#[inline]
pub(crate) fn remap(u: f64, low: f64, high: f64) -> f64 {
    ((u - low) / (high - low)).clamp(0.0, ONE_BELOW)
}
