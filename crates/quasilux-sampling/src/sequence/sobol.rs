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
        let first = sobol_columns(0, &[1; 64]);
        let matrices = BinaryMatrices::new(std::iter::once(first).chain(lines.map(columns)));
        assert_eq!(matrices.dimensions(), DIMENSIONS, "rows of the direction numbers");
        matrices
    });
    &MATRICES
}

/// The generator matrix of one dimension of a Sobol' sequence as its 64 columns, first row (1/2) in
/// bit 0: the digits of the indices 1, 2, 4, ..
///
/// `initial` are the odd numbers m_1 .. m_s, m_k below 2^k, and `inner_coefficients` the bits a_1
/// .. a_(s-1) of the primitive polynomial x^s + a_1 x^(s-1) + .. + 1, a_1 the highest. The first
/// dimension, the radical inverse in base 2, is that of 64 ones.
///
/// ```
/// use quasilux_sampling::{PointSet, Randomization, Sequence, sobol_columns};
/// let points = PointSet::new(Sequence::Sobol, Randomization::None, 0);
/// // Joe and Kuo's third dimension, x^2 + x + 1: point 2 is at 1/4 + 1/2.
/// let columns = sobol_columns(1, &[1, 3]);
/// assert_eq!(columns[1], 0b11);
/// assert_eq!(points.coordinate(2, 2), 0.75);
/// ```
#[must_use]
pub fn sobol_columns(inner_coefficients: u64, initial: &[u64]) -> [u64; 64] {
    columns_from_the_top(inner_coefficients, initial).map(u64::reverse_bits)
}

/// The columns with the first row in the top bit: v_k = m_k 2^(64 - k) for k <= s, and then v_k =
/// a_1 v_(k-1) + .. + a_(s-1) v_(k-s+1) + v_(k-s) + v_(k-s) / 2^s with carry-less sums.
fn columns_from_the_top(inner_coefficients: u64, initial: &[u64]) -> [u64; 64] {
    let degree = initial.len();
    let mut columns = [0_u64; 64];
    for (k, (column, number)) in columns.iter_mut().zip(initial).enumerate() {
        *column = number << (63 - k);
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

/// The columns of a line `d s a m_1 .. m_s`.
fn columns(line: &str) -> [u64; 64] {
    let numbers: Vec<u64> = line
        .split(' ')
        .map(|field| field.parse().expect("direction numbers are integers"))
        .collect();
    let [_dimension, degree, inner_coefficients, initial @ ..] = &*numbers else {
        panic!("a line of direction numbers is d s a m_1 .. m_s");
    };
    assert_eq!(initial.len() as u64, *degree, "numbers m_1 .. m_s");
    sobol_columns(*inner_coefficients, initial)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The definition, one bit at a time.
    fn slow_digits(columns: &[u64; 64], index: u64) -> u64 {
        (0..64).filter(|k| (index >> k) & 1 == 1).fold(0, |sum, k| sum ^ columns[k])
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
                assert_eq!(column.ilog2() as usize, k, "column {k} of line {line}");
            }
        }
    }
}
