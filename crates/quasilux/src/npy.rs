//! Arrays of numbers as NumPy's .npy files (NEP 1), version 1.0.

/// The beginning of a file of 32-bit floats, little-endian, the last index fastest.
pub(crate) struct NpyHeader<'s> {
    /// How many there are along each axis.
    pub(crate) shape: &'s [usize],
}

/// What a header is a multiple of.
const ALIGNMENT: usize = 64;
/// What stands before its text: the magic string, the version and a length.
const PREFIX: usize = 10;

impl NpyHeader<'_> {
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let shape: String = self.shape.iter().map(|n| format!("{n}, ")).collect();
        let mut text = format!(
            "{{'descr': '<f4', 'fortran_order': False, 'shape': ({}), }}",
            shape.trim_end()
        );
        let length = (PREFIX + text.len() + 1).next_multiple_of(ALIGNMENT) - PREFIX;
        text.extend(std::iter::repeat_n(' ', length - 1 - text.len()));
        text.push('\n');
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((length as u16).to_le_bytes());
        bytes.extend(text.as_bytes());
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_aligned_and_say_the_shape() {
        for shape in [&[7][..], &[96, 2, 8760], &[1_000_000_000, 2, 525_600]] {
            let bytes = NpyHeader { shape }.bytes();
            assert_eq!(bytes.len() % ALIGNMENT, 0);
            assert_eq!(usize::from(bytes[8]) + 256 * usize::from(bytes[9]), bytes.len() - PREFIX);
            let text = std::str::from_utf8(&bytes[PREFIX..]).unwrap();
            assert!(text.ends_with('\n') && text.contains(&format!("'shape': ({}", shape[0])));
        }
        let text = String::from_utf8(NpyHeader { shape: &[3] }.bytes()[PREFIX..].to_vec());
        assert!(text.unwrap().contains("'shape': (3,), }"));
    }
}
