//! The numbers behind the header: a stream of tokens with their places.

use crate::count::Count;
use crate::warning::{WarningKind, Warnings};
use quasilux_text::{Number, ParseError, Position, Token, check_room, number_list, quoted};

/// Reads numbers one by one across lines.
pub(super) struct Numbers<'t> {
    lines: &'t [&'t str],
    cursor: Cursor,
    /// The line of the number read last.
    last_line: Option<usize>,
    /// Whether a comma is a decimal point, instead of a separator.
    decimal_commas: bool,
}

/// A place to read on from.
#[derive(Clone, Copy)]
struct Cursor {
    /// Index of the line.
    line: usize,
    /// Bytes, and characters, of the line before this place: both, so that no line is counted
    /// twice.
    byte: usize,
    characters: usize,
}

impl<'t> Numbers<'t> {
    /// Starts at the line with index `line`.
    pub(super) fn new(lines: &'t [&'t str], line: usize) -> Self {
        let cursor = Cursor { line, byte: 0, characters: 0 };
        Self { lines, cursor, last_line: None, decimal_commas: false }
    }

    /// Numbers like 0,5: no comma separates two of them.
    pub(super) fn with_decimal_commas(self) -> Self {
        Self { decimal_commas: true, ..self }
    }

    /// The next number; `what` names it in an error.
    pub(super) fn next(
        &mut self,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Number, ParseError> {
        let written = self.written(what, warnings)?;
        self.number(written, what, warnings)
    }

    fn number(
        &self,
        written: Token<'t>,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Number, ParseError> {
        match self.decimal_commas {
            true => written.number_with_comma(what, warnings),
            false => written.number(what),
        }
    }

    /// The next number, which is a count of at least `least`.
    pub(super) fn count(
        &mut self,
        what: &str,
        least: usize,
        warnings: &mut Warnings,
    ) -> Result<Count, ParseError> {
        let written = self.written(what, warnings)?;
        let number = self.number(written, what, warnings)?;
        let value = written.count(number, what, least, warnings)?;
        Ok(Count { value, at: written.at })
    }

    /// `count` numbers in a row, none of them above what the rest of the file has room for.
    pub(super) fn list(
        &mut self,
        count: usize,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Vec<Number>, ParseError> {
        self.check_room(count, self.here(), what)?;
        number_list(count, what, || self.next(what, warnings))
    }

    /// An error unless `count` numbers fit into the rest of the file: each takes a digit and a
    /// separator.
    pub(super) fn check_room(
        &self,
        count: usize,
        at: Position,
        what: &str,
    ) -> Result<(), ParseError> {
        let room: usize = self.lines.iter().skip(self.cursor.line).map(|line| line.len() + 1).sum();
        check_room(count, room / 2 + 1, at, what)
    }

    /// Notes a record that starts on the line of the number before it.
    pub(super) fn start_record(&mut self, what: &str, warnings: &mut Warnings) {
        let cursor = self.cursor;
        if let Some(token) = self.token(warnings) {
            if self.last_line == Some(token.at.line) {
                let expected = format_args!("{what} to begin on a new line").to_string();
                warnings.push(WarningKind::RecordStart, token.at, quoted(token.text), expected);
            }
            self.cursor = cursor;
        }
    }

    /// The next token of any kind, for what stands behind the last number.
    pub(super) fn after_last(&mut self, warnings: &mut Warnings) -> Option<Token<'t>> {
        self.token(warnings)
    }

    fn written(&mut self, what: &str, warnings: &mut Warnings) -> Result<Token<'t>, ParseError> {
        let Some(token) = self.token(warnings) else {
            return Err(ParseError::new(self.end(), "the end of the file", what));
        };
        self.last_line = Some(token.at.line);
        Ok(token)
    }

    fn token(&mut self, warnings: &mut Warnings) -> Option<Token<'t>> {
        while let Some(&line) = self.lines.get(self.cursor.line) {
            let rest = &line[self.cursor.byte..];
            let is_separator = |c: char| is_blank(c) || (c == ',' && !self.decimal_commas);
            let skipped = rest.find(|c| !is_separator(c)).unwrap_or(rest.len());
            if let Some(semicolon) = rest[..skipped].find(';') {
                let mut before = self.cursor;
                before.advance(&rest[..semicolon]);
                let expected = "blanks or a comma between numbers";
                warnings.push(WarningKind::Semicolon, before.position(), "a semicolon", expected);
            }
            if skipped < rest.len() {
                let rest = &rest[skipped..];
                let text = &rest[..rest.find(is_separator).unwrap_or(rest.len())];
                self.cursor.advance(&line[self.cursor.byte..][..skipped]);
                let at = self.cursor.position();
                self.cursor.advance(text);
                return Some(Token { text, at });
            }
            self.cursor = Cursor { line: self.cursor.line + 1, byte: 0, characters: 0 };
        }
        None
    }

    /// The place to go on from.
    fn here(&self) -> Position {
        if self.cursor.line < self.lines.len() { self.cursor.position() } else { self.end() }
    }

    /// Behind the last character of the file.
    fn end(&self) -> Position {
        let column = self.lines.last().map_or(1, |line| line.chars().count() + 1);
        Position { line: self.lines.len().max(1), column }
    }
}

impl Cursor {
    fn advance(&mut self, text: &str) {
        self.byte += text.len();
        self.characters += text.chars().count();
    }

    fn position(&self) -> Position {
        Position { line: self.line + 1, column: self.characters + 1 }
    }
}

/// Blanks, semicolons, and the control characters that old systems leave at the end of a file.
fn is_blank(c: char) -> bool {
    c.is_whitespace() || c.is_control() || c == ';'
}
