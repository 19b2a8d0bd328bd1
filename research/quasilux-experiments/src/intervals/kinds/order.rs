//! Order statistics of replicates (Z. Pan, "Quasi-Monte Carlo confidence intervals using quantiles
//! of randomized nets", arXiv 2504.19138, 2025).
//!
//! A median lies between the k-th of R independent values and the k-th from above but for `2 P(X <
//! k)`, X binomial with R trials of 1/2. Means of nets scrambled linearly are asymptotically
//! symmetric around what they estimate, which is their median then. Deviation: our nets are
//! scrambled as Owen does, for which this is not shown.

use super::Limits;

pub(super) fn limits(replicates: &[f64], miss: f64) -> Limits {
    let mut sorted = replicates.to_vec();
    sorted.sort_by(f64::total_cmp);
    let rank = rank(sorted.len(), miss);
    match rank {
        0 => Limits { lower: f64::NEG_INFINITY, upper: f64::INFINITY },
        _ => Limits { lower: sorted[rank - 1], upper: sorted[sorted.len() - rank] },
    }
}

/// The largest k with `2 P(X < k) <= miss`; 0 where there is none.
fn rank(count: usize, miss: f64) -> usize {
    let mut probability = libm::pow(0.5, count as f64);
    let (mut below, mut rank) = (0.0, 0);
    while rank < count {
        below += probability;
        if 2.0 * below > miss {
            break;
        }
        probability *= (count - rank) as f64 / (rank + 1) as f64;
        rank += 1;
    }
    rank
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ranks of two-sided sign tests at 5 %, as printed (H. A. David and H. N. Nagaraja, Order
    /// Statistics, 2003, section 7.1): the 4th of 16, the 6th of 20; none of 5.
    #[test]
    fn ranks_of_the_sign_test() {
        assert_eq!([5, 6, 16, 20].map(|count| rank(count, 0.05)), [0, 1, 4, 6]);
    }

    #[test]
    fn it_is_between_two_of_the_values() {
        let values: Vec<f64> = (1..=16).rev().map(f64::from).collect();
        assert_eq!(limits(&values, 0.05), Limits { lower: 4.0, upper: 13.0 });
    }
}
