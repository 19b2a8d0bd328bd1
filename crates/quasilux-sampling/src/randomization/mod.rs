//! How a sequence is made random without losing its evenness: a closed set, one file a variant.

mod cranley_patterson;
mod digital_shift;
mod digits;
mod owen;
mod owen_lanes;

pub(crate) use cranley_patterson::{rotate_unit, rotate_word};
pub(crate) use digital_shift::digital_shift;
pub(crate) use digits::{nested_radical_inverse, shifted_radical_inverse};
pub(crate) use owen::{OwenKey, shuffle_index};
pub(crate) use owen_lanes::OwenLanes;

use crate::parse_name_error::ParseNameError;
use std::fmt;
use std::str::FromStr;

/// A randomisation; each coordinate of a randomised point is uniform on [0, 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Randomization {
    /// The points as they are: no error estimate is possible.
    None,
    /// Random rotation of Cranley and Patterson: one random number a dimension is added, modulo 1.
    #[cfg_attr(feature = "serde", serde(rename = "rotation"))]
    CranleyPattersonRotation,
    /// Random digital shift: the digits of a coordinate are added to those of one random number,
    /// without carry, in the base of the dimension. The equal steps of Hammersley's first dimension
    /// have no digits: they are rotated.
    #[cfg_attr(feature = "serde", serde(rename = "shift"))]
    DigitalShift,
    /// Owen's nested uniform scrambling: each digit is permuted at random, anew for each value of
    /// the digits before it. Smooth integrands gain an order: their error falls like N^-1.5. The
    /// equal steps of Hammersley's first dimension are rotated by whole steps, and each point is
    /// uniform within its step.
    Owen,
}

impl Randomization {
    /// Every randomisation.
    pub const ALL: [Self; 4] =
        [Self::None, Self::CranleyPattersonRotation, Self::DigitalShift, Self::Owen];

    /// The name that users write.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::CranleyPattersonRotation => "rotation",
            Self::DigitalShift => "shift",
            Self::Owen => "owen",
        }
    }
}

impl fmt::Display for Randomization {
    /// The name that users write.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Randomization {
    type Err = ParseNameError;

    /// The randomisation of a name that users write.
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    ///
    /// ```
    /// use quasilux_sampling::Randomization;
    /// assert_eq!("shift".parse(), Ok(Randomization::DigitalShift));
    /// let error = "scrambled".parse::<Randomization>().unwrap_err();
    /// assert!(error.to_string().contains("none, rotation, shift, owen"));
    /// ```
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        Self::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| ParseNameError {
            kind: "randomisation",
            name: name.to_owned(),
            expected: "none, rotation, shift, owen",
        })
    }
}
