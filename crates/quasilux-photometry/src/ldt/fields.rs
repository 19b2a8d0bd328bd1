//! One field a line: texts, counts and numbers with their places.

use crate::angles::Number;
use crate::report::{Position, Warnings, quoted};
use crate::{Deviation, ReadError};

/// Greatest magnitude of a number: products of three stay finite.
const LARGEST_NUMBER: f64 = 1e18;

/// Reads a file line by line.
pub(super) struct Fields<'t> {
    lines: &'t [&'t str],
    next: usize,
}

impl<'t> Fields<'t> {
    pub(super) fn new(lines: &'t [&'t str]) -> Self {
        Self { lines, next: 0 }
    }

    /// The next line, trimmed.
    pub(super) fn text(&mut self, what: &str) -> Result<(&'t str, Position), ReadError> {
        let Some(line) = self.lines.get(self.next) else {
            return Err(ReadError::new(self.end(), "the end of the file", what));
        };
        self.next += 1;
        let blanks = line.chars().take_while(|c| c.is_whitespace()).count();
        let column = if blanks == line.chars().count() { 1 } else { blanks + 1 };
        Ok((line.trim(), Position { line: self.next, column }))
    }

    /// The next line as a finite number.
    pub(super) fn number(
        &mut self,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Number, ReadError> {
        let (text, at) = self.text(what)?;
        let value = match text.split_once(',') {
            Some((whole, part)) => parse(&format!("{whole}.{part}")),
            None => parse(text),
        };
        let Some(value) = value else {
            let found = if text.is_empty() { "an empty line".to_owned() } else { quoted(text) };
            return Err(ReadError::new(at, found, what));
        };
        if text.contains(',') {
            let expected = "a decimal point (read as one)";
            warnings.push(Deviation::DecimalComma, at, quoted(text), expected);
        }
        Ok(Number { value, at })
    }

    /// The next line as a number, where an empty one counts as zero.
    pub(super) fn number_or_zero(
        &mut self,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Number, ReadError> {
        if self.lines.get(self.next).is_some_and(|line| line.trim().is_empty()) {
            let (_, at) = self.text(what)?;
            warnings.push(Deviation::EmptyNumber, at, "an empty line", what);
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
    ) -> Result<(usize, Position), ReadError> {
        let number = self.number(what, warnings)?;
        let (line, at) = (self.lines[self.next - 1].trim(), number.at);
        let fits = number.value.floor() == number.value
            && (least as f64..=f64::from(u32::MAX)).contains(&number.value);
        if !fits {
            let expected = format_args!("{what}, an integer of at least {least}").to_string();
            return Err(ReadError::new(at, quoted(line), expected));
        }
        if line.contains(['.', ',', 'e', 'E']) {
            warnings.push(Deviation::CountWithPoint, at, quoted(line), "an integer");
        }
        Ok((number.value as usize, at))
    }

    /// The next `count` lines as numbers.
    pub(super) fn list(
        &mut self,
        count: usize,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Vec<Number>, ReadError> {
        (0..count).map(|_| self.number(what, warnings)).collect()
    }

    /// Refuses a count of lines that the file has not got, before anything is made of it.
    pub(super) fn check_room(
        &self,
        count: usize,
        at: Position,
        what: &str,
    ) -> Result<(), ReadError> {
        let left = self.lines.len() - self.next;
        if count <= left {
            return Ok(());
        }
        let found = format!("a count that asks for {count} lines of {what}");
        Err(ReadError::new(at, found, format_args!("no more than the {left} lines that follow")))
    }

    /// The first line with text on it among those that are left.
    pub(super) fn rest(&mut self) -> Option<(&'t str, Position)> {
        let is_text = |line: &&str| !line.trim_matches([' ', '\t', '\u{1A}', '\0']).is_empty();
        self.next += self.lines[self.next..].iter().position(is_text)?;
        self.text("").ok()
    }

    fn end(&self) -> Position {
        Position { line: self.lines.len() + 1, column: 1 }
    }
}

/// A finite number of usual size; no words such as `inf`.
fn parse(text: &str) -> Option<f64> {
    let is_numeric = |c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | 'e' | 'E');
    let value: f64 = text.chars().all(is_numeric).then(|| text.parse().ok())??;
    (value.abs() <= LARGEST_NUMBER).then_some(value)
}
