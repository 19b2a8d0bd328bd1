//! Generator matrices over the field of two elements, in the form that makes random access fast.

/// The matrices of several dimensions, 64 x 64 each: coordinate j of point i is the product of C_j
/// with the binary digits of i.
pub(crate) struct BinaryMatrices {
    /// `by_nibble[j][k][v]` is C_j times the digits v of 16^k, first digit in bit 0.
    by_nibble: Vec<[[u64; 16]; 16]>,
}

impl BinaryMatrices {
    /// From the columns of each matrix, first row in bit 0.
    pub(crate) fn new(columns: impl Iterator<Item = [u64; 64]>) -> Self {
        let by_nibble = columns.map(|columns| nibble_tables(&columns)).collect();
        Self { by_nibble }
    }

    /// How many dimensions there are before padding begins.
    #[inline]
    pub(crate) fn dimensions(&self) -> u32 {
        self.by_nibble.len() as u32
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

    /// The digits of the indices 0 .. 256, by which those of any aligned block of 256 differ from
    /// the digits of its first index.
    pub(crate) fn block_digits(&self, dimension: u32) -> [u64; 256] {
        let [low, high, ..] = &self.by_nibble[dimension as usize];
        std::array::from_fn(|i| low[i & 15] ^ high[i >> 4])
    }

    /// Column k of a matrix: the digits of index 2^k.
    pub(crate) fn column(&self, k: u32, dimension: u32) -> u64 {
        self.by_nibble[dimension as usize][k as usize / 4][1 << (k % 4)]
    }
}

fn nibble_tables(columns: &[u64; 64]) -> [[u64; 16]; 16] {
    std::array::from_fn(|k| {
        std::array::from_fn(|value| {
            (0..4)
                .filter(|bit| (value >> bit) & 1 == 1)
                .fold(0, |sum, bit| sum ^ columns[4 * k + bit])
        })
    })
}
