//! The standards of luminaire files, by edition: ANSI/IES LM-63, EULUMDAT, ANSI/IES TM-33.

use quasilux_sampling::ParseNameError;
use std::fmt;
use std::str::FromStr;

/// The standard that a file claims to follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Standard {
    /// ANSI/IES LM-63 (.ies), by edition.
    Lm63(IesStandard),
    /// EULUMDAT (.ldt).
    Eulumdat,
    /// ANSI/IES TM-33 (.xml), by edition.
    Tm33(Tm33Edition),
}

/// The edition of ANSI/IES TM-33 that a file claims to follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Tm33Edition {
    /// ATLA S001, from which TM-33 was made: root element `ATLA_S001` or `ATLA_S001_A`.
    AtlaS001,
    /// TM-33-18: root element `IESTM33`.
    Of2018,
    /// TM-33-23: root element `IESTM33-22`.
    Of2023,
}

/// The edition of ANSI/IES LM-63 that a file claims to follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum IesStandard {
    /// LM-63-1986: no identifying line; free label lines before `TILT=`.
    Lm63Of1986,
    /// LM-63-1991: first line `IESNA91`.
    Lm63Of1991,
    /// LM-63-1995: first line `IESNA:LM-63-1995`.
    Lm63Of1995,
    /// LM-63-2002: first line `IESNA:LM-63-2002`.
    Lm63Of2002,
    /// LM-63-2019: first line `IES:LM-63-2019`.
    Lm63Of2019,
}

impl IesStandard {
    /// All of them, the earliest first.
    pub const ALL: [Self; 5] =
        [Self::Lm63Of1986, Self::Lm63Of1991, Self::Lm63Of1995, Self::Lm63Of2002, Self::Lm63Of2019];
}

impl Standard {
    /// All standards and editions.
    pub const ALL: [Self; 9] = [
        Self::Lm63(IesStandard::Lm63Of1986),
        Self::Lm63(IesStandard::Lm63Of1991),
        Self::Lm63(IesStandard::Lm63Of1995),
        Self::Lm63(IesStandard::Lm63Of2002),
        Self::Lm63(IesStandard::Lm63Of2019),
        Self::Eulumdat,
        Self::Tm33(Tm33Edition::AtlaS001),
        Self::Tm33(Tm33Edition::Of2018),
        Self::Tm33(Tm33Edition::Of2023),
    ];

    /// The name of the standard with that of its edition, such as `LM-63-2002`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lm63(edition) => edition.name(),
            Self::Eulumdat => "EULUMDAT",
            Self::Tm33(edition) => edition.name(),
        }
    }
}

impl IesStandard {
    /// `LM-63-1986` to `LM-63-2019`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lm63Of1986 => "LM-63-1986",
            Self::Lm63Of1991 => "LM-63-1991",
            Self::Lm63Of1995 => "LM-63-1995",
            Self::Lm63Of2002 => "LM-63-2002",
            Self::Lm63Of2019 => "LM-63-2019",
        }
    }
}

impl Tm33Edition {
    /// `ATLA S001`, `TM-33-18` or `TM-33-23`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AtlaS001 => "ATLA S001",
            Self::Of2018 => "TM-33-18",
            Self::Of2023 => "TM-33-23",
        }
    }
}

impl fmt::Display for Standard {
    /// Its [name](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Display for IesStandard {
    /// Its [name](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Display for Tm33Edition {
    /// Its [name](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Standard {
    type Err = ParseNameError;

    /// The standard of that [name](Self::name).
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        let known = Self::ALL.into_iter().find(|standard| standard.name() == name);
        let expected = "EULUMDAT, ATLA S001, or LM-63 or TM-33 with the year, such as LM-63-2002";
        known.ok_or_else(|| ParseNameError::new("standard", name, expected))
    }
}

impl FromStr for IesStandard {
    type Err = ParseNameError;

    /// The edition of that [name](Self::name).
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        let known = Self::ALL.into_iter().find(|edition| edition.name() == name);
        let expected = "LM-63-1986, LM-63-1991, LM-63-1995, LM-63-2002, LM-63-2019";
        known.ok_or_else(|| ParseNameError::new("edition of LM-63", name, expected))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn standards_are_read_back_from_their_names() {
        for standard in Standard::ALL {
            assert_eq!(standard.to_string().parse(), Ok(standard));
            if let Standard::Lm63(edition) = standard {
                assert_eq!(edition.to_string().parse(), Ok(edition));
            }
        }
        assert!("LM-63".parse::<Standard>().is_err());
        assert!("TM-33-18".parse::<IesStandard>().is_err());
    }
}
