//! One field a line: texts, counts and numbers with their places.

use crate::count::Count;
use crate::warning::{WarningKind, Warnings};
use quasilux_text::{Number, ParseError, Position, Token, check_room, number_list};

/// Reads a file line by line.
pub(super) struct Fields<'t> {
    lines: &'t [&'t str],
    next: usize,
    /// Lumens of the lamps that stand for 0 lm; without them a file of 0 lm is refused.
    pub(super) for_zero_lm: Option<f64>,
}

impl<'t> Fields<'t> {
    pub(super) fn new(lines: &'t [&'t str]) -> Self {
        Self { lines, next: 0, for_zero_lm: None }
    }

    /// The next line, trimmed.
    pub(super) fn text(&mut self, what: &str) -> Result<Token<'t>, ParseError> {
        let Some(line) = self.lines.get(self.next) else {
            return Err(ParseError::new(self.end(), "the end of the file", what));
        };
        self.next += 1;
        let blanks = line.chars().take_while(|c| c.is_whitespace()).count();
        let column = if blanks == line.chars().count() { 1 } else { blanks + 1 };
        Ok(Token { text: line.trim(), at: Position { line: self.next, column } })
    }

    /// The next line as a finite number.
    pub(super) fn number(
        &mut self,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Number, ParseError> {
        self.text(what)?.number_with_comma(what, warnings)
    }

    /// The next line as a number, where an empty one counts as zero.
    pub(super) fn number_or_zero(
        &mut self,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Number, ParseError> {
        if self.lines.get(self.next).is_some_and(|line| line.trim().is_empty()) {
            let at = self.text(what)?.at;
            warnings.push(WarningKind::EmptyNumber, at, "an empty line", what);
            return Ok(Number { value: 0.0, at });
        }
        self.number(what, warnings)
    }

    /// The next line as an integer from `least` on.
    pub(super) fn count(
        &mut self,
        what: &str,
        least: usize,
        warnings: &mut Warnings,
    ) -> Result<Count, ParseError> {
        let written = self.text(what)?;
        let number = written.number_with_comma(what, warnings)?;
        Ok(Count { value: written.count(number, what, least, warnings)?, at: written.at })
    }

    /// The next `count` lines as numbers.
    pub(super) fn list(
        &mut self,
        count: usize,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Vec<Number>, ParseError> {
        number_list(count, what, || self.number(what, warnings))
    }

    /// Refuses a count of lines that the file has not got, before anything is made of it.
    pub(super) fn check_room(
        &self,
        count: usize,
        at: Position,
        what: &str,
    ) -> Result<(), ParseError> {
        check_room(count, self.lines.len() - self.next, at, what)
    }

    /// The first line with text on it among those that are left.
    pub(super) fn after_last(&mut self) -> Option<Token<'t>> {
        let is_text = |line: &&str| !line.trim_matches([' ', '\t', '\u{1A}', '\0']).is_empty();
        self.next += self.lines[self.next..].iter().position(is_text)?;
        self.text("").ok()
    }

    fn end(&self) -> Position {
        Position { line: self.lines.len() + 1, column: 1 }
    }
}
