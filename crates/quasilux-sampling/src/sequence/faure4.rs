//! A (0, 4)-sequence in base 4: perfectly even in four dimensions at once.
//!
//! H. Faure, "Discrepance de suites associees a un systeme de numeration (en dimension s)" (Acta
//! Arith. 41, 1982): powers of the Pascal matrix make s-dimensional nets with t = 0 in a prime base
//! b >= s; H. Niederreiter, "Point sets and sequences with small discrepancy" (Monatsh. Math. 104,
//! 1987) has it for the field of any prime power. A. Ahmed et al., "SZ sequences: binary-based (0,
//! 2^q)-sequences" (arXiv 2505.20434, 2025) revived the fields of 2^q elements for rendering: their
//! matrices are binary, so that points and scrambles cost what Sobol's do. Here q = 2: each aligned
//! block of 4^m points has one point in each of the 4^m boxes of any shape 4^-a x 4^-b x 4^-c x
//! 4^-d with a + b + c + d = m. Sobol's first four dimensions have t = 3 in base 2.
//!
//! Coordinate x of the field {0, 1, w, w + 1}, w^2 = w + 1, has the matrix with entries (c over r)
//! x^(c - r) in row r, column c. A field element a + b w stands for the two digits a, b, of which a
//! is the lower bit of the index and the first digit of the coordinate: each matrix is unit upper
//! triangular over bits as well, and the first coordinate is the radical inverse in base 2.

use super::binary::BinaryMatrices;
use std::sync::LazyLock;

/// How many dimensions there are before padding begins.
pub(crate) const DIMENSIONS: u32 = 4;

/// The matrices, built at the first call.
pub(crate) fn matrices() -> &'static BinaryMatrices {
    static MATRICES: LazyLock<BinaryMatrices> =
        LazyLock::new(|| BinaryMatrices::new((0..DIMENSIONS as u64).map(columns)));
    &MATRICES
}

/// The columns of one binary matrix, first row in bit 0.
fn columns(x: u64) -> [u64; 64] {
    let mut columns = [0; 64];
    for c in 0..32_u32 {
        // x^(c - r) for r = c, c - 1, .. 0.
        let mut power = 1;
        for r in (0..=c).rev() {
            if binomial_is_odd(c, r) {
                columns[2 * c as usize] |= power << (2 * r);
                columns[2 * c as usize + 1] |= field_product(power, 2) << (2 * r);
            }
            power = field_product(power, x);
        }
    }
    columns
}

/// E. Kummer (1852): (c over r) is odd where no digit of r exceeds that of c.
fn binomial_is_odd(c: u32, r: u32) -> bool {
    r & !c == 0
}

/// The product of a + b w and c + d w, as bits a, b and c, d.
fn field_product(x: u64, y: u64) -> u64 {
    let (a, b, c, d) = (x & 1, x >> 1, y & 1, y >> 1);
    ((a & c) ^ (b & d)) | ((a & d) ^ (b & c) ^ (b & d)) << 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_is_a_field() {
        for x in 1..4 {
            let mut products: Vec<u64> = (0..4).map(|y| field_product(x, y)).collect();
            products.sort_unstable();
            assert_eq!(products, [0, 1, 2, 3]);
            for (y, z) in (0..16).map(|i| (i / 4, i % 4)) {
                assert_eq!(field_product(x, y), field_product(y, x));
                assert_eq!(
                    field_product(field_product(x, y), z),
                    field_product(x, field_product(y, z))
                );
                assert_eq!(field_product(x, y ^ z), field_product(x, y) ^ field_product(x, z));
            }
        }
    }

    #[test]
    fn matrices_are_unit_upper_triangular() {
        for x in 0..4 {
            for (k, column) in columns(x).iter().enumerate() {
                assert_eq!(column.ilog2() as usize, k, "column {k} of coordinate {x}");
            }
        }
        assert_eq!(columns(0), std::array::from_fn(|k| 1 << k));
    }
}
