//! The words around a picture.

/// The words around a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Caption<'a> {
    /// The heading.
    pub title: &'a str,
    /// What the picture belongs to, at the right of the heading.
    pub project: &'a str,
    /// Facts below it; lines are broken between them.
    pub facts: &'a [String],
    /// How the values were made, at the bottom.
    pub method: &'a str,
    /// What restricts their use, below that; empty for nothing.
    pub caution: &'a str,
}
