//! Some rows of an OpenEXR layer, compressed without loss.
//!
//! ZIP in the words of the format: bytes at even and at odd places are put apart, each byte is
//! replaced by its difference to the one before plus 128, and the result is deflated (RFC 1950, RFC
//! 1951). Where that makes it no smaller, the bytes are stored as they are.

use miniz_oxide::deflate::compress_to_vec_zlib;

/// The usual compromise between size and time.
const LEVEL: u8 = 6;

/// The bytes as the format stores them.
pub(super) fn compressed(bytes: Vec<u8>) -> Vec<u8> {
    let every_second = |from: usize| bytes.iter().skip(from).step_by(2).copied();
    let mut before = None;
    let differences: Vec<u8> = every_second(0)
        .chain(every_second(1))
        .map(|byte| match before.replace(byte) {
            Some(before) => byte.wrapping_sub(before).wrapping_add(128),
            None => byte,
        })
        .collect();
    let deflated = compress_to_vec_zlib(&differences, LEVEL);
    if deflated.len() < bytes.len() { deflated } else { bytes }
}

#[cfg(test)]
mod tests {
    use super::compressed;
    use miniz_oxide::inflate::decompress_to_vec_zlib;

    #[test]
    fn what_repeats_becomes_smaller_and_what_does_not_stays() {
        let cubes = (1_u32..65).map(|i| i.wrapping_mul(i).wrapping_mul(i));
        let noise: Vec<u8> = cubes.map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
        assert_eq!(compressed(noise.clone()), noise);
        let constant = [3_u8, 7].repeat(500);
        let stored = compressed(constant);
        assert!(stored.len() < 40, "{}", stored.len());
        // Threes first, then sevens: differences of zero but for the first byte and the change.
        let differences = decompress_to_vec_zlib(&stored).expect("deflated bytes");
        assert_eq!((differences[0], differences[1], differences[500]), (3, 128, 132));
    }
}
