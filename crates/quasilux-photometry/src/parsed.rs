//! The result of parsing a luminaire file.

use crate::{Photometry, Warning};

/// A luminaire file that was parsed, with what was odd about it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Parsed {
    /// The luminaire.
    pub photometry: Photometry,
    /// Deviations from the standard that were tolerated; each kind at most once, at its first
    /// position.
    pub warnings: Vec<Warning>,
}
