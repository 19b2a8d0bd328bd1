//! How a sequence is made random without losing its evenness: a closed set, one file a variant.

mod owen;
mod shift;

pub(crate) use owen::{OwenKey, shuffle_index};
pub(crate) use shift::shift;

/// A randomisation; each coordinate of a randomised point is uniform on [0, 1).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Randomization {
    /// The points as they are: no error estimate is possible.
    None,
    /// Random digital shift: the digits of a coordinate are added to those of one random number,
    /// without carry.
    Shift,
    /// Owen's nested uniform scrambling: each digit is flipped at random, anew for each value of
    /// the digits before it. Smooth integrands gain an order: their error falls like N^-1.5.
    Owen,
}

impl Randomization {
    /// Every randomisation by the name that users write.
    pub const NAMES: [(&'static str, Self); 3] =
        [("none", Self::None), ("shift", Self::Shift), ("owen", Self::Owen)];

    /// The name that users write.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Shift => "shift",
            Self::Owen => "owen",
        }
    }
}
