//! Keys of the project file: which ones a section takes, and what they are.
//!
//! Readers refuse what is not in these tables, so `docs/project-reference.md`, which is written
//! from them, has every key.

/// A key of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Key {
    /// As it is written.
    pub name: &'static str,
    /// Values that it takes, with the unit and the range: Markdown, as the other texts.
    pub takes: &'static str,
    /// Default; `None` where it may not be left out.
    pub default: Option<&'static str>,
    /// Meaning, in a sentence without a full stop.
    pub meaning: &'static str,
}

/// The keys of a section, or of one kind of it.
#[derive(Clone, Copy, Debug)]
pub struct KeyTable {
    /// As it is written: `[scene]`, `[[sensors]]`.
    pub section: &'static str,
    /// The line that makes it one of this kind; empty where there is but one kind.
    pub kind: &'static str,
    /// Purpose of the table.
    pub about: &'static str,
    /// Keys that its reader takes; it refuses all others.
    pub keys: &'static [Key],
}

/// One that has to be given.
pub(super) const fn required(
    name: &'static str,
    takes: &'static str,
    meaning: &'static str,
) -> Key {
    Key { name, takes, default: None, meaning }
}

/// One that may be left out.
pub(super) const fn optional(
    name: &'static str,
    takes: &'static str,
    default: &'static str,
    meaning: &'static str,
) -> Key {
    Key { name, takes, default: Some(default), meaning }
}

/// Values of positions and edges.
pub(super) const POSITION: &str = "`[x, y, z]` in m";
/// Values of directions.
pub(super) const DIRECTION: &str = "direction `[x, y, z]` of any length";
/// Values of shares of light.
pub(super) const SHARES: &str = "share, or `[r, g, b]`, 0 to 1";

impl KeyTable {
    /// The name of the section at the root of the project file: `scene`, `sensors`.
    #[must_use]
    pub fn name(&self) -> &'static str {
        let inner = self.section.trim_matches(['[', ']']);
        inner.split_once('.').map_or(inner, |(name, _)| name)
    }
}
