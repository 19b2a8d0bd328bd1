//! How a sequence is made random without losing its evenness: a closed set, one file a variant.

mod cranley_patterson;
mod digital_shift;
mod digits;
mod owen;

pub(crate) use cranley_patterson::{rotate_unit, rotate_word};
pub(crate) use digital_shift::digital_shift;
pub(crate) use digits::{nested_radical_inverse, shifted_radical_inverse};
pub(crate) use owen::{OwenKey, shuffle_index};

/// A randomisation; each coordinate of a randomised point is uniform on [0, 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Randomization {
    /// The points as they are: no error estimate is possible.
    None,
    /// Random rotation of Cranley and Patterson: one random number a dimension is added, modulo 1.
    CranleyPattersonRotation,
    /// Random digital shift: the digits of a coordinate are added to those of one random number,
    /// without carry, in the base of the dimension. The equal steps of Hammersley's first dimension
    /// have no digits: they are rotated.
    DigitalShift,
    /// Owen's nested uniform scrambling: each digit is permuted at random, anew for each value of
    /// the digits before it. Smooth integrands gain an order: their error falls like N^-1.5. The
    /// equal steps of Hammersley's first dimension are rotated by whole steps, and each point is
    /// uniform within its step.
    Owen,
}

impl Randomization {
    /// Every randomisation by the name that users write.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("none", Self::None),
        ("rotation", Self::CranleyPattersonRotation),
        ("shift", Self::DigitalShift),
        ("owen", Self::Owen),
    ];

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
