//! Which points: a closed set, one file a variant.

mod binary;
pub(crate) mod faure4;
pub(crate) mod halton;
pub(crate) mod hammersley;
mod independent;
mod radical_inverse;
mod radix;
pub(crate) mod sobol;

pub(crate) use binary::BinaryMatrices;
pub(crate) use independent::independent_digits;
pub use radical_inverse::radical_inverse;
pub(crate) use radix::Radix;
pub use sobol::sobol_columns;

use crate::parse_name_error::ParseNameError;
use std::fmt;
use std::str::FromStr;

/// A sequence of points in the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Sequence {
    /// Sobol's sequence (LP-tau): each aligned block of 2^m points fills the cells of a grid
    /// evenly.
    Sobol,
    /// Halton's sequence: the radical inverse in another prime base for each dimension.
    Halton,
    /// Halton's sequence behind an axis of equal steps, for a number of points that is known ahead.
    ///
    /// The points are those of the indices 0 .. `points`, *all* of them: any part of them leaves
    /// part of the first dimension out. Past them the first dimension begins again. No points count
    /// as one.
    Hammersley {
        /// How many points there are.
        points: u64,
    },
    /// The sequence of Faure and Niederreiter over the field of four elements: each aligned block
    /// of 4^m points is as even as can be in four dimensions at once, and pairs of blocks of four
    /// dimensions are independent.
    Faure4,
    /// Pseudo-random points, by a counter-based generator.
    #[cfg_attr(feature = "serde", serde(rename = "random"))]
    Independent,
}

impl Sequence {
    /// The sequences that need no number of points.
    pub const ALL: [Self; 4] = [Self::Sobol, Self::Halton, Self::Faure4, Self::Independent];

    /// Every sequence, Hammersley's for that number of points.
    #[must_use]
    pub const fn all_for(points: u64) -> [Self; 5] {
        let hammersley = Self::Hammersley { points };
        [Self::Sobol, Self::Halton, hammersley, Self::Faure4, Self::Independent]
    }

    /// The name that users write.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sobol => "sobol",
            Self::Halton => "halton",
            Self::Hammersley { .. } => "hammersley",
            Self::Faure4 => "faure4",
            Self::Independent => "random",
        }
    }

    /// The same sequence for another number of points, where it is made for one.
    #[must_use]
    pub const fn with_points(self, points: u64) -> Self {
        match self {
            Self::Hammersley { .. } => Self::Hammersley { points },
            Self::Sobol | Self::Halton | Self::Faure4 | Self::Independent => self,
        }
    }

    /// The number of points that the sequence is made for, if it must be known ahead.
    #[must_use]
    pub const fn points(self) -> Option<u64> {
        match self {
            Self::Hammersley { points } => Some(points),
            Self::Sobol | Self::Halton | Self::Faure4 | Self::Independent => None,
        }
    }
}

impl fmt::Display for Sequence {
    /// The name that users write, for Hammersley's points followed by a colon and their number.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Hammersley { points } => f.pad(&format!("hammersley:{points}")),
            Self::Sobol | Self::Halton | Self::Faure4 | Self::Independent => f.pad(self.name()),
        }
    }
}

impl FromStr for Sequence {
    type Err = ParseNameError;

    /// The sequence that [`Display`](fmt::Display) writes so.
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    ///
    /// ```
    /// use quasilux_sampling::Sequence;
    /// assert_eq!("random".parse(), Ok(Sequence::Independent));
    /// assert_eq!("hammersley:64".parse(), Ok(Sequence::Hammersley { points: 64 }));
    /// assert!("hammersley".parse::<Sequence>().is_err());
    /// ```
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        let points = name.strip_prefix("hammersley:").and_then(|points| points.parse().ok());
        let hammersley = points.map(|points| Self::Hammersley { points });
        hammersley.or_else(|| Self::ALL.into_iter().find(|kind| kind.name() == name)).ok_or_else(
            || ParseNameError {
                kind: "sequence",
                name: name.to_owned(),
                expected: "sobol, halton, hammersley:POINTS, faure4, random",
            },
        )
    }
}
