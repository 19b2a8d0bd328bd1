//! What is wrong with the description of a sky.

/// A value that makes no sky: which one, and what was expected.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{name} is {found}; expected {expected}")]
pub struct SkyError {
    /// The name of the quantity, with its unit.
    pub name: &'static str,
    /// Its value.
    pub found: String,
    /// What it may be.
    pub expected: &'static str,
}

impl SkyError {
    pub(crate) fn new(
        name: &'static str,
        found: impl std::fmt::Display,
        expected: &'static str,
    ) -> Self {
        Self { name, found: found.to_string(), expected }
    }

    /// Refuses a number outside of a range, or none.
    pub(crate) fn check(
        name: &'static str,
        value: f64,
        range: std::ops::RangeInclusive<f64>,
        expected: &'static str,
    ) -> Result<(), Self> {
        if range.contains(&value) { Ok(()) } else { Err(Self::new(name, value, expected)) }
    }
}
