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
    /// Of the next character.
    column: usize,
}

/// Characters between words: other blanks belong to names.
fn is_blank(c: char) -> bool {
    c.is_ascii_whitespace() || c == '\x0b'
}

impl<'t> Words<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        Self { text, rest: text.char_indices().peekable(), line: 1, column: 1 }
    }

    /// Where the next character stands.
    pub(super) fn place(&self) -> Position {
        Position { line: self.line, column: self.column }
    }

    fn step(&mut self) -> Option<char> {
        let (_, c) = self.rest.next()?;
        self.column += 1;
        if c == '\n' {
            self.line += 1;
            self.column = 1;
        }
        Some(c)
    }

    /// The first character that is no blank, which stays.
    pub(super) fn skip_blanks(&mut self) -> Option<char> {
        loop {
            let &(_, c) = self.rest.peek()?;
            if !is_blank(c) {
                return Some(c);
            }
            self.step();
        }
    }

    /// Passes the rest of the line.
    pub(super) fn pass_comment(&mut self) {
        while self.rest.peek().is_some_and(|&(_, c)| c != '\n') {
            self.step();
        }
    }

    /// The rest of a command; a line that ends with a backslash goes on in the next one.
    pub(super) fn rest_of_command(&mut self) -> &'t str {
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
            if (is_quoted && c == first) || (!is_quoted && is_blank(c)) {
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
            self.pass_comment();
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
        words.pass_comment();
        assert_eq!(words.skip_blanks(), Some('!'));
        assert_eq!(words.rest_of_command(), "!cmd \\\n more");
        assert_eq!(words.next().unwrap().place.line, 5);
        assert_eq!(words.next(), None);
        assert_eq!(Words::new("\"open").next().unwrap().text, "open");
    }

    #[test]
    fn comments_end_with_their_line() {
        let mut words = Words::new("# by C:\\\n0 # to D:\\\n 1");
        assert_eq!(words.next_behind_comments().unwrap().text, "0");
        assert_eq!(words.next_behind_comments().unwrap().text, "1");
        assert_eq!(Words::new("a\u{a0}b c").next().unwrap().text, "a\u{a0}b");
    }

    /// A line of many words takes no time that grows with its square.
    #[test]
    fn columns_of_long_lines_are_cheap() {
        let text = "1 ".repeat(400_000);
        let mut words = Words::new(&text);
        let mut last = None;
        while let Some(word) = words.next() {
            last = Some(word.place.column);
        }
        assert_eq!(last, Some(799_999));
    }
}
