//! More or less light of one distribution, and linear luminaires of another length.

use crate::{Axis, Grid, LuminousOpening, Photometry, SphericalTable, TableError};

/// Two sides that differ by less than this part have no longer one.
const EQUAL: f64 = 1e-3;

/// A linear luminaire that was made longer or shorter.
#[derive(Clone, Debug)]
pub struct OfLength {
    /// The luminaire at its new length.
    pub photometry: Photometry,
    /// The axis along which it is long: C0-C180 or C90-C270.
    pub axis: Axis,
    /// The length of the luminous opening in the file, in m.
    pub length_of_file_m: f64,
}

/// Why a luminaire has no other length.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LengthError {
    /// The opening has no horizontal extent.
    #[error("a luminous opening without a length")]
    NoLength,
    /// The opening is round, seen from below.
    #[error("a round luminous opening ({0})")]
    Round(&'static str),
    /// No side of the opening is longer than the other.
    #[error("a luminous opening whose sides are both {side_m} m")]
    Square {
        /// Both sides, in m.
        side_m: f64,
    },
    /// The intensities leave the range of a table.
    #[error("intensities out of range: {0}")]
    Table(TableError),
}

impl Photometry {
    /// A luminaire with the same distribution and `factor` times the intensities, flux and flux of
    /// the lamps; its power stays.
    ///
    /// # Errors
    /// [`TableError`] where `factor` is negative or an intensity leaves the range of a table.
    pub fn scaled(&self, factor: f64) -> Result<Self, TableError> {
        let grid = self.table().grid();
        let values = grid.values.iter().map(|value| value * factor).collect();
        let table = SphericalTable::new(Grid { values, ..grid })?;
        let mut facts = self.facts().clone();
        facts.candela_factor *= factor;
        facts.lumens_per_lamp = facts.lumens_per_lamp.map(|lumens| lumens * factor);
        if let Some(eulumdat) = &mut facts.eulumdat {
            eulumdat.lamps_flux_lm *= factor;
        }
        Ok(Self::new(table, facts).with_name(self.name()))
    }

    /// A linear luminaire cut to another length, in m: flux, power and the longer horizontal side
    /// of its luminous opening are scaled alike, the directions in which it shines stay.
    ///
    /// That side lies along C90-C270 in EULUMDAT and TM-33 and along C0-C180 in LM-63, by their
    /// own conventions; what counts here is which one is longer.
    ///
    /// # Errors
    /// [`LengthError`] where the opening has no longer side.
    pub fn with_length(&self, length_m: f64) -> Result<OfLength, LengthError> {
        let shape = self.facts().shape();
        let size_m = shape.size_m();
        let (x, y) = (size_m.x, size_m.y);
        if x.max(y) <= 0.0 {
            return Err(LengthError::NoLength);
        }
        if shape.is_round() {
            return Err(LengthError::Round(shape.name()));
        }
        if (x - y).abs() <= EQUAL * x.max(y) {
            return Err(LengthError::Square { side_m: x });
        }
        let axis = if x > y { Axis::X } else { Axis::Y };
        let length_of_file_m = x.max(y);
        let factor = length_m / length_of_file_m;
        let longer = self.scaled(factor).map_err(LengthError::Table)?;
        let mut facts = longer.facts().clone();
        facts.opening = stretched(&facts.opening, axis, factor);
        facts.input_watts *= factor;
        if let Some(eulumdat) = &mut facts.eulumdat {
            // The housing is as much longer as what shines: its ends stay what they are.
            let housing_m = &mut eulumdat.housing_m[usize::from(axis == Axis::X)];
            if *housing_m > 0.0 {
                *housing_m = (*housing_m + length_m - length_of_file_m).max(length_m);
            }
        }
        let photometry = Self::new(longer.table().clone(), facts).with_name(self.name());
        Ok(OfLength { photometry, axis, length_of_file_m })
    }
}

/// The opening with its side along `axis` scaled; signs, which are the shape, stay.
fn stretched(opening: &LuminousOpening, axis: Axis, factor: f64) -> LuminousOpening {
    let [width, length] = if axis == Axis::X { [1.0, factor] } else { [factor, 1.0] };
    LuminousOpening {
        width_m: opening.width_m * width,
        length_m: opening.length_m * length,
        height_m: opening.height_m,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_ies;
    use glam::DVec3;

    fn file(opening: &str) -> Photometry {
        let text = format!(
            "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 {opening}\n1 1 20\n0 45 90\n0\n\
             300 200 0\n"
        );
        read_ies(text.as_bytes()).unwrap().photometry
    }

    #[test]
    fn a_longer_luminaire_gives_more_of_the_same_light() {
        for (opening, axis, size_m) in [
            ("0.1 1.2 0", Axis::X, DVec3::new(3.0, 0.1, 0.0)),
            ("1.2 0.1 0.05", Axis::Y, DVec3::new(0.1, 3.0, 0.05)),
            ("0 1.2 0", Axis::X, DVec3::new(3.0, 0.0, 0.0)),
            ("-0.1 1.2 -0.1", Axis::X, DVec3::new(3.0, 0.1, 0.1)),
        ] {
            let file = file(opening);
            let longer = file.with_length(3.0).unwrap();
            assert_eq!((longer.axis, longer.length_of_file_m), (axis, 1.2), "{opening}");
            let photometry = longer.photometry;
            let size = photometry.facts().shape().size_m();
            assert!((size - size_m).length() < 1e-12, "{opening}: {size}");
            assert_eq!(photometry.facts().shape().solid(), file.facts().shape().solid());
            let ratio = photometry.flux_lm() / file.flux_lm();
            assert!((ratio - 2.5).abs() < 1e-12, "{opening}: {ratio}");
            let down = DVec3::new(0.6, 0.0, -0.8);
            let ratio = photometry.intensity_cd(down) / file.intensity_cd(down);
            assert!((ratio - 2.5).abs() < 1e-12, "{opening}: {ratio}");
            assert!((photometry.facts().input_watts - 50.0).abs() < 1e-12);
            assert!((photometry.rated_flux_lm().unwrap() - 2500.0).abs() < 1e-9);
        }
    }

    #[test]
    fn openings_without_a_longer_side_have_no_other_length() {
        let error = |opening| file(opening).with_length(2.0).unwrap_err();
        assert_eq!(error("0 0 0"), LengthError::NoLength);
        assert_eq!(error("0 0 0.3"), LengthError::NoLength);
        assert_eq!(error("-0.6 -0.6 0"), LengthError::Round("disk"));
        assert_eq!(error("-0.6 -1.2 0"), LengthError::Round("ellipse"));
        assert_eq!(error("0.6 0.6 0"), LengthError::Square { side_m: 0.6 });
    }
}
