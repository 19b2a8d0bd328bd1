//! Pieces of a text between blanks and commas, with their places.

use crate::Deviation;
use crate::ReadError;
use crate::number::Written;
use crate::report::{Position, Warnings, quoted};

/// Values below count as zero: sums and quotients of them would lose digits to underflow.
const SMALLEST_VALUE: f64 = 1e-100;

/// The pieces of a text between blanks and commas, with the places they have if nothing in the text was escaped.
pub(super) struct Pieces<'t> {
    rest: &'t str,
    at: Position,
    style: Style,
}

/// What counts as a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Style {
    /// Words.
    Plain,
    /// Words, and each brace by itself.
    Braces,
    /// Words, but none from a semicolon to the end of its line.
    Comments,
}

impl<'t> Pieces<'t> {
    pub(super) fn new(text: &'t str, at: Position, style: Style) -> Self {
        Self { rest: text, at, style }
    }

    /// Where the next piece is looked for.
    pub(super) fn at(&self) -> Position {
        self.at
    }

    /// Goes on by so many bytes.
    fn skip(&mut self, bytes: usize) -> &'t str {
        let (skipped, rest) = self.rest.split_at(bytes);
        let mut characters = skipped.chars().chain(rest.chars().take(1)).peekable();
        for _ in 0..skipped.chars().count() {
            let character = characters.next();
            let ends_line = match character {
                Some('\r') => characters.peek() != Some(&'\n'),
                _ => character == Some('\n'),
            };
            if ends_line {
                self.at = Position { line: self.at.line + 1, column: 1 };
            } else {
                self.at.column += 1;
            }
        }
        self.rest = rest;
        skipped
    }
}

impl<'t> Iterator for Pieces<'t> {
    type Item = Written<'t>;

    fn next(&mut self) -> Option<Written<'t>> {
        let is_gap = |character: char| character.is_whitespace() || character == ',';
        let style = self.style;
        let is_mark = |character: char| match style {
            Style::Plain => false,
            Style::Braces => matches!(character, '{' | '}'),
            Style::Comments => character == ';',
        };
        loop {
            let gap = self.rest.find(|character| !is_gap(character))?;
            self.skip(gap);
            if style != Style::Comments || !self.rest.starts_with(';') {
                break;
            }
            let comment = self.rest.find(['\n', '\r']).unwrap_or(self.rest.len());
            self.skip(comment);
        }
        let at = self.at;
        let length = match self.rest.find(|c| is_gap(c) || is_mark(c)) {
            Some(0) => 1,
            Some(length) => length,
            None => self.rest.len(),
        };
        Some(Written { text: self.skip(length), at })
    }
}

/// A value of a scattering distribution: negative and tiny ones count as zero.
pub(super) fn value(piece: Written<'_>, warnings: &mut Warnings) -> Result<f64, ReadError> {
    let value = piece.number("a value in 1/sr")?.value;
    if value < 0.0 {
        let expected = "no negative value (read as 0)";
        warnings.push(Deviation::NegativeScattering, piece.at, quoted(piece.text), expected);
    }
    Ok(if value < SMALLEST_VALUE { 0.0 } else { value })
}
