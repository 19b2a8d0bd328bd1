//! The candela values: plane by plane in the file, angle by angle in the table.

use super::numbers::Numbers;
use crate::candela::intensity_cd;
use crate::warning::Warnings;
use quasilux_text::ParseError;

/// The candela values as they stand in the file.
pub(super) struct Planes {
    /// Vertical angles in each plane.
    pub(super) verticals: usize,
    /// Planes.
    pub(super) horizontals: usize,
    /// Intensity of one written candela.
    pub(super) factor: f64,
}

impl Planes {
    /// Intensities row by row: all planes at the first vertical angle, then the next.
    pub(super) fn read(
        &self,
        numbers: &mut Numbers<'_>,
        warnings: &mut Warnings,
    ) -> Result<Vec<f64>, ParseError> {
        let mut intensities_cd = vec![0.0; self.verticals * self.horizontals];
        for plane in 0..self.horizontals {
            numbers.start_record("the candela values of each plane", warnings);
            for vertical in 0..self.verticals {
                let candela = numbers.next("a candela value", warnings).map_err(|error| {
                    error.expecting(format_args!(
                        "candela value {} of {} in plane {} of {}",
                        vertical + 1,
                        self.verticals,
                        plane + 1,
                        self.horizontals
                    ))
                })?;
                intensities_cd[vertical * self.horizontals + plane] =
                    intensity_cd(candela, self.factor, warnings)?;
            }
        }
        Ok(intensities_cd)
    }
}
