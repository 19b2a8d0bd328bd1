//! What is wrong with a user's files, and where.
//!
//! One message, one line: `file:line:column: what is wrong; what was expected`, and where a name
//! was misspelt the nearest valid one.

use crate::nearest::nearest;
use quasilux_text::Position;
use std::fmt;

/// A value with its span: where the project file gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place in the project file.
    pub place: Position,
}

/// Why a project cannot be loaded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoadError {
    file: String,
    place: Option<Position>,
    message: String,
    suggestion: Option<String>,
}

/// An oddity that was lived with.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// The file, as the project file writes it.
    pub file: String,
    /// The place in it, where there is one.
    pub place: Option<Position>,
    /// The oddity, and what was done about it.
    pub message: String,
}

impl LoadError {
    pub(crate) fn new(file: &str, place: Option<Position>, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), place, message: message.into(), suggestion: None }
    }

    /// Offers the candidate nearest to `name`, if one is near.
    pub(crate) fn offer<'a>(
        mut self,
        name: &str,
        candidates: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        self.suggestion = nearest(name, candidates).map(str::to_owned);
        self
    }

    /// The file that is wrong, as the project file writes it.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The place in the file, where there is one.
    #[must_use]
    pub fn place(&self) -> Option<Position> {
        self.place
    }

    /// The error, and what was expected.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.message
    }

    /// The valid key or name nearest to the misspelt one.
    #[must_use]
    pub fn suggestion(&self) -> Option<&str> {
        self.suggestion.as_deref()
    }
}

impl Warning {
    pub(crate) fn new(file: &str, place: Option<Position>, message: impl Into<String>) -> Self {
        Self { file: file.to_owned(), place, message: message.into() }
    }
}

impl std::error::Error for LoadError {}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_line(f, &self.file, self.place, &self.message)?;
        match &self.suggestion {
            Some(name) => write!(f, "; did you mean \"{name}\"?"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write_line(f, &self.file, self.place, &self.message)
    }
}

fn write_line(
    f: &mut fmt::Formatter<'_>,
    file: &str,
    place: Option<Position>,
    message: &str,
) -> fmt::Result {
    match place {
        Some(place) => write!(f, "{file}:{place}: {message}"),
        None => write!(f, "{file}: {message}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_line_with_place_and_nearest_name() {
        let place = Some(Position { line: 3, column: 7 });
        let error = LoadError::new("a.toml", place, "unknown key \"sped\"");
        assert_eq!(error.to_string(), "a.toml:3:7: unknown key \"sped\"");
        let error = error.offer("sped", ["seed", "counts"]);
        assert_eq!(error.to_string(), "a.toml:3:7: unknown key \"sped\"; did you mean \"seed\"?");
        let error = LoadError::new("b.glb", None, "no triangles");
        assert_eq!(error.to_string(), "b.glb: no triangles");
    }
}
