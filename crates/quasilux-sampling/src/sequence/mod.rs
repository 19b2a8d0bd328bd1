//! Which points: a closed set, one file a variant.

mod random;
mod sobol;

pub(crate) use random::random_digits;
pub(crate) use sobol::SobolMatrices;

/// A sequence of points in the unit cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sequence {
    /// Sobol's sequence (LP-tau): each aligned block of 2^m points fills the cells of a grid
    /// evenly.
    Sobol,
    /// Pseudo-random points, by a counter-based generator.
    Random,
}

impl Sequence {
    /// Every sequence by the name that users write.
    pub const NAMES: [(&'static str, Self); 2] = [("sobol", Self::Sobol), ("random", Self::Random)];

    /// The name that users write.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sobol => "sobol",
            Self::Random => "random",
        }
    }
}
