//! The periodicity of one radical inverse.

use quasilux_sampling::radical_inverse;

/// Bases that are tried: those of the first dimensions, and the paper's example.
const BASES: [u32; 6] = [2, 3, 5, 7, 10, 11];
/// Multiples of the period.
const MULTIPLES: [u64; 3] = [1, 2, 7];

/// The indices of the paper's table 2.
pub(super) const TABLE_2: [u64; 4] = [123, 124, 132, 133];

/// How far inverses of indices b^k apart are apart.
pub(super) struct Inverse {
    pub(super) pairs: u64,
    /// The largest difference in units of b^-k.
    pub(super) largest: f64,
}

impl Inverse {
    /// Of all indices below `count` and all periods below it.
    pub(super) fn check(count: u64) -> Self {
        let mut inverse = Self { pairs: 0, largest: 0.0 };
        for base in BASES {
            let periods = std::iter::successors(Some(1), |period| Some(period * u64::from(base)));
            for period in periods.take_while(|period| *period < count) {
                for (index, multiple) in
                    (0..count).step_by(7).flat_map(|index| MULTIPLES.map(|n| (index, n)))
                {
                    let other = radical_inverse(base, index + multiple * period);
                    let difference = (radical_inverse(base, index) - other).abs();
                    inverse.pairs += 1;
                    inverse.largest = inverse.largest.max(difference * period as f64);
                }
            }
        }
        inverse
    }
}
