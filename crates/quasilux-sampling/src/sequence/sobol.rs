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

use std::sync::LazyLock;

const DIRECTION_NUMBERS: &str = include_str!("../../data/joe_kuo_1024.txt");

/// The generator matrices in the form that makes random access fast.
pub(crate) struct SobolMatrices {
    /// `by_nibble[j][k][v]` is C_j times the digits v of 16^k, first digit in bit 0.
    by_nibble: Vec<[[u64; 16]; 16]>,
}

impl SobolMatrices {
    /// How many dimensions there are before padding begins.
    pub(crate) const DIMENSIONS: u32 = 1024;

    /// The matrices, built at the first call.
    pub(crate) fn get() -> &'static Self {
        static MATRICES: LazyLock<SobolMatrices> = LazyLock::new(SobolMatrices::build);
        &MATRICES
    }

    /// The binary digits of a coordinate, the first (1/2) in bit 0.
    #[inline]
    pub(crate) fn digits(&self, index: u64, dimension: u32) -> u64 {
        let mut rest = index;
        let mut digits = 0;
        for table in &self.by_nibble[dimension as usize] {
            if rest == 0 {
                break;
            }
            digits ^= table[(rest & 15) as usize];
            rest >>= 4;
        }
        digits
    }

    fn build() -> Self {
        let mut by_nibble = vec![nibble_tables(&identity_columns())];
        for line in DIRECTION_NUMBERS.lines().filter(|line| !line.starts_with('#')) {
            by_nibble.push(nibble_tables(&columns(line)));
        }
        assert_eq!(by_nibble.len(), Self::DIMENSIONS as usize, "rows of the direction numbers");
        Self { by_nibble }
    }
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

fn nibble_tables(columns: &[u64; 64]) -> [[u64; 16]; 16] {
    std::array::from_fn(|k| {
        std::array::from_fn(|value| {
            (0..4)
                .filter(|bit| (value >> bit) & 1 == 1)
                .fold(0, |sum, bit| sum ^ columns[4 * k + bit])
        })
    })
    .map(|table: [u64; 16]| table.map(u64::reverse_bits))
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
        let matrices = SobolMatrices::get();
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
