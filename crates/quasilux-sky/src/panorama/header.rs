//! The header of a picture of Radiance: lines of text, an empty one, and the resolution.

use super::PanoramaWarning;
use quasilux_text::{ParseError, Position, Warnings, quoted};

/// Lumens in a watt of white light, as Radiance has it.
const LM_W: f64 = 179.0;
/// What red, green and blue share in the luminance, with Radiance's primaries.
const LUMINANCE: [f64; 3] = [0.265, 0.670, 0.065];
/// Most bytes of a header.
const MAX_BYTES: usize = 1 << 20;

/// What a header says.
pub(super) struct Header {
    /// Width and height.
    pub(super) size: [usize; 2],
    /// Luminances in cd/m2 of a red, a green and a blue value of 1.
    factors: [f64; 3],
    /// Its length, with the line of the resolution.
    pub(super) lines: usize,
    pub(super) bytes: usize,
}

impl Header {
    pub(super) fn read(
        bytes: &[u8],
        warnings: &mut Warnings<PanoramaWarning>,
    ) -> Result<Self, ParseError> {
        let mut lines = Lines { bytes, at: 0, line: 0 };
        let expected = "#?RADIANCE, a picture in Radiance's RGBE format (.hdr)";
        let first = lines.next(expected)?;
        if !first.text.starts_with("#?") {
            let found = if bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
                "a picture in the format OpenEXR".to_owned()
            } else {
                quoted(&first.text)
            };
            return Err(ParseError::new(first.at(), found, expected));
        }
        let mut divisor = [1.0; 3];
        let mut is_xyz = false;
        loop {
            let line = lines.next("an empty line at the end of the header")?;
            let (key, value) = line.text.split_once('=').unwrap_or((&line.text, ""));
            match key.trim() {
                "" if line.text.is_empty() => break,
                "FORMAT" => is_xyz = line.format(value)?,
                "EXPOSURE" => {
                    let [exposure] = line.factors(value)?;
                    divisor = divisor.map(|factor| factor * exposure);
                }
                "COLORCORR" => {
                    let correction: [f64; 3] = line.factors(value)?;
                    divisor = [0, 1, 2].map(|channel| divisor[channel] * correction[channel]);
                }
                "PRIMARIES" => {
                    let expected = "Radiance's own primaries (taken for them)";
                    let found = quoted(&line.text);
                    warnings.push(PanoramaWarning::Primaries, line.at(), found, expected);
                }
                _ => {}
            }
        }
        let weights = if is_xyz { [0.0, 1.0, 0.0] } else { LUMINANCE };
        let factors = [0, 1, 2].map(|channel| LM_W * weights[channel] / divisor[channel]);
        let resolution = lines.next("the resolution, -Y HEIGHT +X WIDTH")?;
        let size = resolution.size()?;
        Ok(Self { size, factors, lines: lines.line, bytes: lines.at })
    }

    /// The luminance of a pixel's three values.
    pub(super) fn luminance_cd_m2(&self, values: [f64; 3]) -> f64 {
        // A value of none has no part in it, whatever the factor.
        let part = |channel: usize| {
            if values[channel] > 0.0 { values[channel] * self.factors[channel] } else { 0.0 }
        };
        part(0) + part(1) + part(2)
    }
}

/// The lines of a header.
struct Lines<'b> {
    bytes: &'b [u8],
    /// Bytes before the next line, and the number of the last one.
    at: usize,
    line: usize,
}

struct Line {
    text: String,
    number: usize,
}

impl Lines<'_> {
    fn next(&mut self, expected: &str) -> Result<Line, ParseError> {
        self.line += 1;
        let rest = &self.bytes[self.at..self.bytes.len().min(MAX_BYTES)];
        let position = Position { line: self.line, column: 1 };
        let Some(length) = rest.iter().position(|byte| *byte == b'\n') else {
            let found = if rest.is_empty() { "the end of the file" } else { "no end of the line" };
            // What is no text at all has no lines.
            let start = String::from_utf8_lossy(&rest[..rest.len().min(16)]);
            let found = if self.line == 1 { quoted(&start) } else { found.to_owned() };
            return Err(ParseError::new(position, found, expected));
        };
        self.at += length + 1;
        let text = String::from_utf8_lossy(&rest[..length]);
        Ok(Line { text: text.trim_end_matches('\r').to_owned(), number: self.line })
    }
}

impl Line {
    fn at(&self) -> Position {
        Position { line: self.number, column: 1 }
    }

    fn refuse(&self, expected: &str) -> ParseError {
        ParseError::new(self.at(), quoted(&self.text), expected)
    }

    /// Whether colours are X, Y and Z.
    fn format(&self, value: &str) -> Result<bool, ParseError> {
        match value.trim() {
            "32-bit_rle_rgbe" => Ok(false),
            "32-bit_rle_xyze" => Ok(true),
            _ => Err(self.refuse("FORMAT=32-bit_rle_rgbe or 32-bit_rle_xyze")),
        }
    }

    /// Positive numbers, this many.
    fn factors<const N: usize>(&self, value: &str) -> Result<[f64; N], ParseError> {
        let numbers: Vec<f64> =
            value.split_whitespace().map_while(|number| number.parse().ok()).collect();
        let is_factor = |number: &f64| (1e-30..=1e30).contains(number);
        let all: Option<[f64; N]> = numbers.try_into().ok();
        all.filter(|numbers| numbers.iter().all(is_factor))
            .ok_or_else(|| self.refuse(&format!("{N} numbers, 1e-30 to 1e30")))
    }

    /// The resolution of rows from the top, each from its left end.
    fn size(&self) -> Result<[usize; 2], ParseError> {
        let words: Vec<&str> = self.text.split_whitespace().collect();
        let size = match words.as_slice() {
            ["-Y", height, "+X", width] => width.parse().ok().zip(height.parse().ok()),
            _ => None,
        };
        let (width, height): (u32, u32) =
            size.ok_or_else(|| self.refuse("the resolution, -Y HEIGHT +X WIDTH"))?;
        Ok([width as usize, height as usize])
    }
}
