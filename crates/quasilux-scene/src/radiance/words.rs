//! Words of a Radiance file, each with its line: separated by blanks, or between quotes.

use quasilux_text::Position;
use std::iter::Peekable;
use std::str::CharIndices;

/// A word, and where it stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Word<'t> {
    pub(super) text: &'t str,
    pub(super) place: Position,
    /// Whether it stood between quotes: it may then begin with a `#`.
    pub(super) is_quoted: bool,
}

/// Hands out the words of a text.
pub(super) struct Words<'t> {
    text: &'t str,
    rest: Peekable<CharIndices<'t>>,
    line: usize,
    /// Where the line begins.
    line_start: usize,
}

impl<'t> Words<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, rest: text.char_indices().peekable(), line: 1, line_start: 0 }
    }

    /// Where the next character stands.
    pub(super) fn place(&mut self) -> Position {
        let at = self.rest.peek().map_or(self.text.len(), |&(at, _)| at);
        Position { line: self.line, column: 1 + self.text[self.line_start..at].chars().count() }
    }

    fn step(&mut self) -> Option<char> {
        let (at, c) = self.rest.next()?;
        if c == '\n' {
            self.line += 1;
            self.line_start = at + 1;
        }
        Some(c)
    }

    /// The first character that is no blank, which stays.
    pub(super) fn skip_blanks(&mut self) -> Option<char> {
        loop {
            let &(_, c) = self.rest.peek()?;
            if !c.is_whitespace() {
                return Some(c);
            }
            self.step();
        }
    }

    /// The rest of the line; a line that ends with a backslash goes on in the next one.
    pub(super) fn rest_of_line(&mut self) -> &'t str {
        let start = self.rest.peek().map_or(self.text.len(), |&(at, _)| at);
        let mut is_continued = false;
        while let Some(&(at, c)) = self.rest.peek() {
            if c == '\n' && !is_continued {
                return &self.text[start..at];
            }
            is_continued = c == '\\' || (is_continued && c == '\r');
            self.step();
        }
        &self.text[start..]
    }

    /// The next word; `None` at the end.
    pub(super) fn next(&mut self) -> Option<Word<'t>> {
        let first = self.skip_blanks()?;
        let place = self.place();
        let is_quoted = first == '"' || first == '\'';
        if is_quoted {
            self.step();
        }
        let start = self.rest.peek().map_or(self.text.len(), |&(at, _)| at);
        let mut end = self.text.len();
        while let Some(&(at, c)) = self.rest.peek() {
            if (is_quoted && c == first) || (!is_quoted && c.is_whitespace()) {
                end = at;
                break;
            }
            self.step();
        }
        if is_quoted {
            self.step();
        }
        Some(Word { text: &self.text[start..end], place, is_quoted })
    }

    /// The next word that is not in a comment: of counts and numbers.
    pub(super) fn next_behind_comments(&mut self) -> Option<Word<'t>> {
        while self.skip_blanks()? == '#' {
            self.rest_of_line();
        }
        self.next()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_lines() {
        let mut words = Words::new("void 'a b'\n \"#1\"# x\n!cmd \\\n more\nend");
        let word = words.next().unwrap();
        assert_eq!((word.text, word.place.line, word.place.column), ("void", 1, 1));
        let word = words.next().unwrap();
        assert_eq!((word.text, word.place.column, word.is_quoted), ("a b", 6, true));
        let word = words.next().unwrap();
        assert_eq!((word.text, word.place.line, word.place.column), ("#1", 2, 2));
        assert_eq!(words.skip_blanks(), Some('#'));
        assert_eq!(words.rest_of_line(), "# x");
        assert_eq!(words.skip_blanks(), Some('!'));
        assert_eq!(words.rest_of_line(), "!cmd \\\n more");
        assert_eq!(words.next().unwrap().place.line, 5);
        assert_eq!(words.next(), None);
        assert_eq!(Words::new("\"open").next().unwrap().text, "open");
    }
}
