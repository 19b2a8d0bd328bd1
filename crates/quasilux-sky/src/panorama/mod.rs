//! The sky of a picture: luminances of a panorama in Radiance's RGBE format.
//!
//! The picture shows all directions in an equirectangular projection: twice as wide as high, the
//! zenith along its upper edge, the nadir along its lower one, azimuths growing to the right, as
//! who stands in the middle sees them. Its upper half is the sky. Each pixel has one luminance, so
//! that the integral over the sky is an exact sum.

mod bright;
mod header;
mod rgbe;

use crate::point::SkyPoint;
pub use bright::BrightPixel;
use header::Header;
use libm::sin;
use quasilux_text::{ParseError, Position, Warning, Warnings};
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt;

/// Luminances of the pixels of a sky.
#[derive(Clone, PartialEq)]
pub struct Panorama {
    /// Pixels around the sky.
    width: usize,
    /// Half of the rows of the picture, which may be a whole number and a half.
    rows_to_horizon: f64,
    /// The azimuth of the middle of the picture, clockwise from north.
    middle_azimuth_deg: f64,
    /// In cd/m2, row by row from the zenith, each row from its left end.
    luminances_cd_m2: Vec<f32>,
}

/// Deviations of a panorama that are lived with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PanoramaWarning {
    /// The file names primaries of its colours. They are taken for Radiance's own.
    Primaries,
}

/// A panorama with what is odd in its file.
#[derive(Clone, Debug)]
pub struct ParsedPanorama {
    /// The panorama; its middle is in the north.
    pub panorama: Panorama,
    /// Deviations that were lived with.
    pub warnings: Vec<Warning<PanoramaWarning>>,
}

/// The widest picture.
const MAX_WIDTH: usize = 16_384;
/// No pixel is brighter: a thousand suns.
const MAX_CD_M2: f64 = 1e12;

impl Panorama {
    /// Reads a picture in Radiance's RGBE or XYZE format (G. Ward, "The RADIANCE picture file
    /// format", in the reference manual of Radiance), and takes its values for radiances in
    /// W/(sr m2) as Radiance does: a luminance is 179 lm/W times 0.265 R + 0.670 G + 0.065 B, or
    /// times Y. Exposures and colour corrections of the file are undone.
    ///
    /// It takes no more than 12 bytes for each pixel of the sky, 16 384 for each byte of a file
    /// that it refuses, and 256 KiB.
    ///
    /// # Errors
    /// With the line of the header for other files, pictures that are not twice as wide as high or
    /// wider than 16 384 pixels, and pixels that are cut short.
    pub fn parse(bytes: &[u8]) -> Result<ParsedPanorama, ParseError> {
        quasilux_text::refuse_web_page(bytes)?;
        let mut warnings = Warnings::default();
        let header = Header::read(bytes, &mut warnings)?;
        let [width, height] = header.size;
        let at = Position { line: header.lines, column: 1 };
        if width != 2 * height || !(2..=MAX_WIDTH).contains(&width) {
            let found = format!("a picture of {width} x {height} pixels");
            let expected =
                format!("a panorama, twice as wide as high and at most {MAX_WIDTH} wide");
            return Err(ParseError::new(at, found, expected));
        }
        let mut pixels = rgbe::Pixels::new(&bytes[header.bytes..], width);
        let mut luminances_cd_m2 = Vec::new();
        for row in 0..height {
            let Some(scanline) = pixels.next_scanline() else {
                let found = format!("row {} of {height}, which is cut short or damaged", row + 1);
                return Err(ParseError::new(at, found, "all pixels of the picture"));
            };
            if row >= height.div_ceil(2) {
                continue;
            }
            for pixel in scanline {
                let cd_m2 = header.luminance_cd_m2(rgbe::values(*pixel));
                if !(0.0..=MAX_CD_M2).contains(&cd_m2) {
                    let found = format!("a luminance of {cd_m2:e} cd/m2 in row {}", row + 1);
                    return Err(ParseError::new(at, found, "at most 1e12 cd/m2"));
                }
                luminances_cd_m2.push(cd_m2 as f32);
            }
        }
        let rows_to_horizon = 0.5 * height as f64;
        let panorama = Self { width, rows_to_horizon, middle_azimuth_deg: 0.0, luminances_cd_m2 };
        Ok(ParsedPanorama { panorama, warnings: warnings.into_vec() })
    }

    /// The same turned, so that its middle is at this azimuth, clockwise from north.
    #[must_use]
    pub fn with_middle_at(self, azimuth_deg: f64) -> Self {
        Self { middle_azimuth_deg: azimuth_deg, ..self }
    }

    /// How many pixels show the sky.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.luminances_cd_m2.len()
    }

    /// The luminance of the pixel that shows a direction, a unit vector; 0 below the horizon. The
    /// zenith itself, where all pixels of the first row meet, has their mean.
    #[must_use]
    pub fn luminance_cd_m2(&self, direction: [f64; 3]) -> f64 {
        let [x, y, z] = direction;
        if z < 0.0 {
            return 0.0;
        }
        if x == 0.0 && y == 0.0 {
            return self.rows().next().map_or(0.0, mean);
        }
        f64::from(self.luminances_cd_m2[self.pixel_at(direction)])
    }

    /// The index of the pixel that shows a direction above the horizon.
    fn pixel_at(&self, direction: [f64; 3]) -> usize {
        let SkyPoint { altitude_deg, azimuth_deg } = SkyPoint::from_direction(direction);
        let row = (90.0 - altitude_deg) / 90.0 * self.rows_to_horizon;
        let turns = (azimuth_deg - self.middle_azimuth_deg) / 360.0 + 0.5;
        let column = (turns - turns.floor()) * self.width as f64;
        let row = (row.max(0.0) as usize).min(self.rows().len() - 1);
        let column = (column as usize).min(self.width - 1);
        row * self.width + column
    }

    /// The illuminance of the sky on a horizontal plane in lx: the exact integral.
    #[must_use]
    pub fn horizontal_illuminance_lx(&self) -> f64 {
        let share = |row: usize| {
            // sin^2(b) - sin^2(a) = sin(a + b) sin(b - a)
            let [a, b] = self.zenith_angles(row);
            sin(a + b) * sin(b - a)
        };
        PI * self.rows().enumerate().map(|(row, pixels)| share(row) * mean(pixels)).sum::<f64>()
    }

    /// The pixel with the largest luminance: its centre.
    #[must_use]
    pub fn brightest(&self) -> SkyPoint {
        let all = self.luminances_cd_m2.iter().enumerate();
        let (index, _) = all.fold(
            (0, -1.0),
            |best: (usize, f32), (index, cd_m2)| {
                if *cd_m2 > best.1 { (index, *cd_m2) } else { best }
            },
        );
        let [row, column] = [index / self.width, index % self.width].map(|n| n as f64 + 0.5);
        let azimuth_deg = (column / self.width as f64 - 0.5) * 360.0 + self.middle_azimuth_deg;
        SkyPoint {
            altitude_deg: (90.0 - 90.0 * row / self.rows_to_horizon).max(0.0),
            azimuth_deg: azimuth_deg.rem_euclid(360.0),
        }
    }

    /// The zenith angles of the edges of a row in rad.
    fn zenith_angles(&self, row: usize) -> [f64; 2] {
        [row, row + 1].map(|row| (row as f64 / self.rows_to_horizon * FRAC_PI_2).min(FRAC_PI_2))
    }

    fn rows(&self) -> std::slice::ChunksExact<'_, f32> {
        self.luminances_cd_m2.chunks_exact(self.width)
    }
}

/// The mean of some luminances.
fn mean(luminances_cd_m2: &[f32]) -> f64 {
    let sum: f64 = luminances_cd_m2.iter().map(|cd_m2| f64::from(*cd_m2)).sum();
    sum / luminances_cd_m2.len() as f64
}

impl fmt::Debug for Panorama {
    /// Its size, and a number that another picture would not have: G. Fowler, L. Noll, K.-P. Vo
    /// and D. Eastlake, "The FNV non-cryptographic hash algorithm" (FNV-1a, 64 bits).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bytes = self.luminances_cd_m2.iter().flat_map(|cd_m2| cd_m2.to_bits().to_le_bytes());
        let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        f.debug_struct("Panorama")
            .field("width", &self.width)
            .field("rows_to_horizon", &self.rows_to_horizon)
            .field("middle_azimuth_deg", &self.middle_azimuth_deg)
            .field("hash", &hash)
            .finish()
    }
}
