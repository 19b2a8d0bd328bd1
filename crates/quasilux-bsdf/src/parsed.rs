//! The result of parsing the file of a measured surface.

use crate::measured::MeasuredBsdf;
use crate::warning::Warning;

/// A file that was read, with what was odd about it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Parsed {
    /// The surface.
    pub bsdf: MeasuredBsdf,
    /// What was tolerated, left out or made up; each rule at most once, at its first place.
    pub warnings: Vec<Warning>,
}
