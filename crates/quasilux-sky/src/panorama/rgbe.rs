//! Pixels of four bytes: three mantissas with one exponent, in runs.
//!
//! G. Ward, "Real pixels" (Graphics Gems II, 1991), and the two ways of writing runs in Radiance's
//! picture files.

/// The shortest and the longest scanline whose components are written one after the other.
const PLANAR_WIDTHS: std::ops::RangeInclusive<usize> = 8..=0x7fff;
/// A run of one byte is longer than this; below are bytes that differ.
const RUN: u8 = 128;
/// Exponents are stored with this added, and mantissas are below 1 where they are bytes.
const EXPONENT_OFFSET: i32 = 128 + 8;

/// Reads scanlines one after the other.
pub(super) struct Pixels<'b> {
    rest: &'b [u8],
    scanline: Vec<[u8; 4]>,
}

/// Red, green and blue, or X, Y and Z.
pub(super) fn values([r, g, b, exponent]: [u8; 4]) -> [f64; 3] {
    if exponent == 0 {
        return [0.0; 3];
    }
    let unit = libm::ldexp(1.0, i32::from(exponent) - EXPONENT_OFFSET);
    // The middle of what the byte stands for, as Radiance takes it.
    [r, g, b].map(|mantissa| (f64::from(mantissa) + 0.5) * unit)
}

impl<'b> Pixels<'b> {
    pub(super) fn new(bytes: &'b [u8], width: usize) -> Self {
        Self { rest: bytes, scanline: vec![[0; 4]; width] }
    }

    /// The pixels of the next scanline; `None` where bytes are missing or runs do not fit.
    pub(super) fn next_scanline(&mut self) -> Option<&[[u8; 4]]> {
        let first = self.pixel()?;
        let width = self.scanline.len();
        let [a, b, high, low] = first;
        if [a, b] == [2, 2] && high < RUN && PLANAR_WIDTHS.contains(&width) {
            if usize::from(high) << 8 | usize::from(low) != width {
                return None;
            }
            (0..4).try_for_each(|channel| self.plane(channel))?;
        } else {
            self.interleaved(first)?;
        }
        Some(&self.scanline)
    }

    /// One component of all pixels, in runs and bytes that differ.
    fn plane(&mut self, channel: usize) -> Option<()> {
        let width = self.scanline.len();
        let mut column = 0;
        while column < width {
            let code = self.byte()?;
            let is_run = code > RUN;
            let count = usize::from(if is_run { code - RUN } else { code });
            if count == 0 || column + count > width {
                return None;
            }
            let (bytes, rest) = self.rest.split_at_checked(if is_run { 1 } else { count })?;
            self.rest = rest;
            for (i, pixel) in self.scanline[column..column + count].iter_mut().enumerate() {
                pixel[channel] = bytes[if is_run { 0 } else { i }];
            }
            column += count;
        }
        Some(())
    }

    /// Whole pixels; one with mantissas of 1 repeats the pixel before, and the next of its kind
    /// has the higher digits of the number.
    fn interleaved(&mut self, first: [u8; 4]) -> Option<()> {
        let width = self.scanline.len();
        let (mut column, mut shift) = (0_usize, 0_u32);
        let mut pixel = first;
        loop {
            if let [1, 1, 1, digits] = pixel {
                let count = usize::from(digits).checked_shl(shift).filter(|_| shift < 24)?;
                let before = *self.scanline.get(column.checked_sub(1)?)?;
                self.scanline.get_mut(column..column.checked_add(count)?)?.fill(before);
                column += count;
                shift += 8;
            } else {
                *self.scanline.get_mut(column)? = pixel;
                column += 1;
                shift = 0;
            }
            if column == width {
                return Some(());
            }
            pixel = self.pixel()?;
        }
    }

    fn byte(&mut self) -> Option<u8> {
        let (byte, rest) = self.rest.split_first()?;
        self.rest = rest;
        Some(*byte)
    }

    fn pixel(&mut self) -> Option<[u8; 4]> {
        let (pixel, rest) = self.rest.split_first_chunk::<4>()?;
        self.rest = rest;
        Some(*pixel)
    }
}
