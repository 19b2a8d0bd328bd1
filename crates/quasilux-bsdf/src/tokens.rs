//! Tokens of a text between blanks and commas, with their places.

use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::{ParseError, Position, Token, quoted};

/// Values below count as zero: sums and quotients of them would lose digits to underflow.
const MIN_VALUE: f64 = 1e-100;

/// The tokens of a text between blanks and commas, with the places they have if nothing in the text
/// was escaped.
pub(super) struct Tokens<'t> {
    rest: &'t str,
    at: Position,
    style: Style,
}

/// What counts as a token.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Style {
    /// Words.
    Plain,
    /// Words, and each brace by itself.
    Braces,
    /// Words, but none from a semicolon to the end of its line.
    Comments,
}

impl<'t> Tokens<'t> {
    pub(super) fn new(text: &'t str, at: Position, style: Style) -> Self {
        Self { rest: text, at, style }
    }

    /// Where the next token is looked for.
    pub(super) fn at(&self) -> Position {
        self.at
    }

    /// Goes on by this many bytes. Line feed, carriage return and both together end a line.
    fn skip(&mut self, bytes: usize) -> &'t str {
        let (skipped, rest) = self.rest.split_at(bytes);
        let following = skipped.bytes().skip(1).chain(rest.bytes().next());
        let followed = skipped.bytes().zip(following.map(Some).chain([None]));
        for (byte, next) in followed {
            let ends_line = byte == b'\n' || byte == b'\r' && next != Some(b'\n');
            if ends_line {
                self.at = Position { line: self.at.line + 1, column: 1 };
            } else if byte & 0xC0 != 0x80 {
                // Not inside a character of several bytes.
                self.at.column += 1;
            }
        }
        self.rest = rest;
        skipped
    }
}

impl<'t> Iterator for Tokens<'t> {
    type Item = Token<'t>;

    fn next(&mut self) -> Option<Token<'t>> {
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
        Some(Token { text: self.skip(length), at })
    }
}

/// A value of a scattering distribution: negative and tiny ones count as zero.
pub(super) fn value(token: Token<'_>, warnings: &mut Warnings) -> Result<f64, ParseError> {
    let value = token.number("a value in 1/sr")?.value;
    if value < 0.0 {
        let expected = "no negative value (read as 0)";
        warnings.push(WarningKind::NegativeScattering, token.at, quoted(token.text), expected);
    }
    Ok(if value < MIN_VALUE { 0.0 } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str, style: Style) -> Vec<(&str, usize, usize)> {
        let found = Tokens::new(text, Position { line: 5, column: 3 }, style);
        found.map(|token| (token.text, token.at.line, token.at.column)).collect()
    }

    #[test]
    fn pieces_know_their_places() {
        let plain = tokens(" 1,2\r\n é3\r4\n\t5{6};7", Style::Plain);
        let expected = [("1", 5, 4), ("2", 5, 6), ("é3", 6, 2), ("4", 7, 1), ("5{6};7", 8, 2)];
        assert_eq!(plain, expected);
        let braces = tokens("{1 }{", Style::Braces);
        assert_eq!(braces, [("{", 5, 3), ("1", 5, 4), ("}", 5, 6), ("{", 5, 7)]);
        let comments = tokens("1;; 2\n;3\n4 ;", Style::Comments);
        assert_eq!(comments, [("1", 5, 3), ("4", 7, 1)]);
        assert!(tokens(" ,\n", Style::Plain).is_empty());
    }
}
