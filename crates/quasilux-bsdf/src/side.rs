//! The sides of a thin sheet, and the modes of scattering: reflection and transmission.

use quasilux_sampling::ParseNameError;
use std::fmt;
use std::str::FromStr;

/// A side of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The side that a file calls the front; the measured side of a reflection without sides.
    Front,
    /// The other side.
    Back,
}

/// Where scattered light goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ScatteringMode {
    /// Back to the side that it came from.
    Reflection,
    /// To the other side.
    Transmission,
}

impl Side {
    /// Both sides.
    pub const ALL: [Self; 2] = [Self::Front, Self::Back];

    /// The other side.
    #[must_use]
    pub const fn other(self) -> Self {
        match self {
            Self::Front => Self::Back,
            Self::Back => Self::Front,
        }
    }

    /// `front` or `back`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Back => "back",
        }
    }
}

impl ScatteringMode {
    /// Both modes.
    pub const ALL: [Self; 2] = [Self::Reflection, Self::Transmission];

    /// `reflection` or `transmission`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Reflection => "reflection",
            Self::Transmission => "transmission",
        }
    }
}

impl fmt::Display for Side {
    /// Its [name](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Side {
    type Err = ParseNameError;

    /// The side of that [name](Self::name).
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        let known = Self::ALL.into_iter().find(|known| known.name() == name);
        known.ok_or_else(|| ParseNameError::new("side", name, "front, back"))
    }
}

impl fmt::Display for ScatteringMode {
    /// Its [name](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for ScatteringMode {
    type Err = ParseNameError;

    /// The scattering mode of that [name](Self::name).
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        let known = Self::ALL.into_iter().find(|known| known.name() == name);
        known
            .ok_or_else(|| ParseNameError::new("scattering mode", name, "reflection, transmission"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sides_and_modes_are_read_back_from_their_names() {
        assert!(Side::ALL.into_iter().all(|side| side.to_string().parse() == Ok(side)));
        assert!(ScatteringMode::ALL.into_iter().all(|mode| mode.to_string().parse() == Ok(mode)));
        let error = "absorption".parse::<ScatteringMode>().unwrap_err();
        assert!(error.to_string().contains("expected reflection, transmission"));
    }
}
