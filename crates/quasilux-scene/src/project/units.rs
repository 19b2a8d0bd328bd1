//! Units of length: what the numbers of geometry files and of the project file's positions mean.

use super::document::Section;
use crate::LoadError;

/// A unit of length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LengthUnit {
    /// 1 m.
    #[default]
    Metre,
    /// 0.01 m.
    Centimetre,
    /// 0.001 m.
    Millimetre,
    /// 0.0254 m exactly (international inch, 1959).
    Inch,
    /// 0.3048 m exactly.
    Foot,
}

impl LengthUnit {
    /// All units, from the one that needs no word to the rarest.
    pub const ALL: [Self; 5] =
        [Self::Metre, Self::Centimetre, Self::Millimetre, Self::Inch, Self::Foot];

    /// The name in a project file.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Inch => "in",
            Self::Foot => "ft",
        }
    }

    /// Its length in m.
    #[must_use]
    pub const fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 0.01,
            Self::Millimetre => 0.001,
            Self::Inch => 0.0254,
            Self::Foot => 0.3048,
        }
    }
}

/// The unit that a key gives, or the metre.
pub(super) fn read<'a>(section: &Section<'a>, key: &'a str) -> Result<LengthUnit, LoadError> {
    let Some(value) = section.get(key) else { return Ok(LengthUnit::Metre) };
    let name = value.name(&LengthUnit::ALL.map(LengthUnit::name), &[])?;
    let unit = LengthUnit::ALL.into_iter().find(|unit| unit.name() == name);
    Ok(unit.unwrap_or_default())
}
