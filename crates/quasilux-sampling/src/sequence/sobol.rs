//! The Sobol' sequence with the direction numbers of Joe and Kuo, by index.
//!
//! I. M. Sobol', "On the distribution of points in a cube and the approximate evaluation of
//! integrals" (USSR Comput. Math. Math. Phys. 7, 1967); P. Bratley and B. L. Fox, "Algorithm 659"
//! (ACM TOMS 14, 1988) for the recurrence; S. Joe and F. Y. Kuo, "Constructing Sobol sequences with
//! better two-dimensional projections" (SIAM J. Sci. Comput. 30, 2008) for the numbers, which lie
//! in `data/joe_kuo_1024.txt`.
//!
//! Coordinate j of point i is the product of the generator matrix C_j with the binary digits of i,
//! over the field of two elements. The matrices have 64 columns, so the period is 2^64 points.
//! Points come in natural order: point 0 is the origin and is kept (A. B. Owen, "On dropping the
//! first Sobol' point", 2020). Deviation from most libraries, which walk in Gray-code order.

use super::binary::BinaryMatrices;
use std::sync::LazyLock;

const DIRECTION_NUMBERS: &str = include_str!("../../data/joe_kuo_1024.txt");

/// How many dimensions there are before padding begins.
pub(crate) const DIMENSIONS: u32 = 1024;

/// The matrices, built at the first call.
pub(crate) fn matrices() -> &'static BinaryMatrices {
    static MATRICES: LazyLock<BinaryMatrices> = LazyLock::new(|| {
        let lines = DIRECTION_NUMBERS.lines().filter(|line| !line.starts_with('#'));
        let columns = std::iter::once(identity_columns()).chain(lines.map(columns));
        let matrices = BinaryMatrices::new(columns.map(|columns| columns.map(u64::reverse_bits)));
        assert_eq!(matrices.dimensions(), DIMENSIONS, "rows of the direction numbers");
        matrices
    });
    &MATRICES
}

/// The first dimension: the radical inverse in base 2.
fn identity_columns() -> [u64; 64] {
    std::array::from_fn(|k| 1 << (63 - k))
}

/// The 64 columns of a generator matrix, first row in the top bit, from one line `d s a m_1 ..
/// m_s`: v_k = m_k 2^(64 - k) for k <= s, and then v_k = a_1 v_(k-1) + .. + a_(s-1) v_(k-s+1) +
/// v_(k-s) + v_(k-s) / 2^s with carry-less sums.
fn columns(line: &str) -> [u64; 64] {
    let mut numbers =
        line.split(' ').map(|field| field.parse::<u64>().expect("direction numbers are integers"));
    let mut next = || numbers.next().expect("a line of direction numbers is d s a m_1 .. m_s");
    let _dimension = next();
    let degree = next() as usize;
    let inner_coefficients = next();
    let mut columns = [0_u64; 64];
    for (k, column) in columns.iter_mut().enumerate().take(degree) {
        *column = next() << (63 - k);
    }
    for k in degree..64 {
        let mut column = columns[k - degree] ^ (columns[k - degree] >> degree);
        for i in 1..degree {
            if (inner_coefficients >> (degree - 1 - i)) & 1 == 1 {
                column ^= columns[k - i];
            }
        }
        columns[k] = column;
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, one bit at a time.
    fn slow_digits(columns: &[u64; 64], index: u64) -> u64 {
        let product = (0..64).filter(|k| (index >> k) & 1 == 1).fold(0, |sum, k| sum ^ columns[k]);
        product.reverse_bits()
    }

    #[test]
    fn tables_equal_the_bitwise_definition() {
        let matrices = matrices();
        let lines = DIRECTION_NUMBERS.lines().filter(|line| !line.starts_with('#'));
        for (line, dimension) in lines.zip(1..) {
            let columns = columns(line);
            for step in 0..64 {
                let index = crate::hash::mix(step) >> step;
                assert_eq!(matrices.digits(index, dimension), slow_digits(&columns, index));
            }
        }
    }

    /// The triangular form makes every coordinate alone a (0, m, 1)-net for each m up to 64.
    #[test]
    fn matrices_are_unit_upper_triangular() {
        for line in DIRECTION_NUMBERS.lines().filter(|line| !line.starts_with('#')) {
            for (k, column) in columns(line).iter().enumerate() {
                assert_eq!(column.trailing_zeros() as usize, 63 - k, "column {k} of line {line}");
            }
        }
    }
}
