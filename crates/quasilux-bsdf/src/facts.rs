//! What the file of a measured surface says beside its tables.

use quasilux_sampling::ParseNameError;
use std::fmt;
use std::str::FromStr;

/// What a file says about its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BsdfFacts {
    /// The format that the file has.
    pub format: BsdfFormat,
    /// Empty where the file gives none.
    pub name: String,
    /// Empty where the file gives none.
    pub manufacturer: String,
    /// Thickness of the sheet; light is scattered as if it had none.
    pub thickness_m: Option<f64>,
}

/// The formats of measured surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum BsdfFormat {
    /// LBNL WINDOW XML, a matrix over Klems patches.
    WindowKlems,
    /// LBNL WINDOW XML, a tensor tree.
    WindowTensorTree,
    /// Integra DDR or DDT.
    Ddr,
    /// MERL binary.
    Merl,
    /// ASTM E1392 text.
    Astm,
}

impl BsdfFormat {
    /// All formats.
    pub const ALL: [Self; 5] =
        [Self::WindowKlems, Self::WindowTensorTree, Self::Ddr, Self::Merl, Self::Astm];

    /// The name that messages and documents give it, such as `MERL`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::WindowKlems => "WINDOW XML, Klems",
            Self::WindowTensorTree => "WINDOW XML, tensor tree",
            Self::Ddr => "DDR",
            Self::Merl => "MERL",
            Self::Astm => "ASTM E1392",
        }
    }
}

impl fmt::Display for BsdfFormat {
    /// Its [name](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for BsdfFormat {
    type Err = ParseNameError;

    /// The format of that [name](Self::name).
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        let known = Self::ALL.into_iter().find(|format| format.name() == name);
        let expected = "WINDOW XML, Klems; WINDOW XML, tensor tree; DDR; MERL; ASTM E1392";
        known.ok_or_else(|| ParseNameError::new("format", name, expected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_read_back_from_their_names() {
        assert!(BsdfFormat::ALL.into_iter().all(|format| format.to_string().parse() == Ok(format)));
        assert!("RGL".parse::<BsdfFormat>().is_err());
    }
}
