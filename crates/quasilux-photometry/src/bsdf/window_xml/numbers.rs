//! Numbers in the text of elements, with their places.

use crate::Deviation;
use crate::ReadError;
use crate::number::{Number, Written};
use crate::report::{Position, Warnings, quoted};
use crate::xml::Element;

/// Values below count as zero: sums and quotients of them would lose digits to underflow.
const SMALLEST_VALUE: f64 = 1e-100;

/// The only number of an element.
pub(super) fn of_element(element: &Element<'_>) -> Result<Number, ReadError> {
    Written { text: element.text(), at: element.text_at }.number(element.name)
}

/// The pieces of a text between blanks and commas, with the places they have if nothing in the text was escaped; with
/// `braces`, each brace is a piece of its own.
pub(super) struct Pieces<'t> {
    rest: &'t str,
    at: Position,
    braces: bool,
}

impl<'t> Pieces<'t> {
    pub(super) fn new(element: &'t Element<'_>, braces: bool) -> Self {
        Self { rest: element.text(), at: element.text_at, braces }
    }

    /// Where the next piece is looked for.
    pub(super) fn at(&self) -> Position {
        self.at
    }

    /// Goes on by so many bytes.
    fn skip(&mut self, bytes: usize) -> &'t str {
        let (skipped, rest) = self.rest.split_at(bytes);
        for character in skipped.chars() {
            if character == '\n' {
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
        let braces = self.braces;
        let is_brace = |character: char| braces && matches!(character, '{' | '}');
        let gap = self.rest.find(|character| !is_gap(character))?;
        self.skip(gap);
        let at = self.at;
        let length = match self.rest.find(|c| is_gap(c) || is_brace(c)) {
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
