//! A line of a weather file in fields that know their place.

use crate::local_time::LocalTime;
use quasilux_text::{ParseError, Position, Token, quoted};
use std::ops::RangeInclusive;

/// A leap year: files may have its 29th of February.
const LEAP_YEAR: i32 = 2000;

/// A line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row<'t> {
    line: usize,
    text: &'t str,
}

impl<'t> Row<'t> {
    pub(super) fn new(line: usize, text: &'t str) -> Self {
        Self { line, text }
    }

    pub(super) fn text(&self) -> &'t str {
        self.text
    }

    pub(super) fn start(&self) -> Position {
        Position { line: self.line, column: 1 }
    }

    /// Fields between commas, without blanks around them.
    pub(super) fn by_commas(&self) -> Vec<Token<'t>> {
        self.tokens(self.text.split(',').map(str::trim))
    }

    /// Fields between blanks.
    pub(super) fn by_blanks(&self) -> Vec<Token<'t>> {
        self.tokens(self.text.split_whitespace())
    }

    /// Parts of the line, in their order; each character is counted once, however many there are.
    fn tokens(&self, parts: impl Iterator<Item = &'t str>) -> Vec<Token<'t>> {
        let (mut counted, mut column) = (0, 1);
        let token = |part: &'t str| {
            let start = part.as_ptr() as usize - self.text.as_ptr() as usize;
            column += self.text[counted..start].chars().count();
            counted = start;
            Token { text: part, at: Position { line: self.line, column } }
        };
        parts.map(token).collect()
    }

    /// The field of this number; `what` is expected there.
    pub(super) fn field(
        &self,
        fields: &[Token<'t>],
        number: usize,
        what: &str,
    ) -> Result<Token<'t>, ParseError> {
        fields.get(number).copied().ok_or_else(|| {
            let column = self.text.chars().count() + 1;
            ParseError::new(Position { line: self.line, column }, "the end of the line", what)
        })
    }
}

/// A number within a range, as `what` says.
pub(super) fn number(
    token: &Token<'_>,
    range: RangeInclusive<f64>,
    what: &str,
) -> Result<f64, ParseError> {
    let value = token.number(what)?.value;
    if range.contains(&value) {
        Ok(value)
    } else {
        Err(ParseError::new(token.at, quoted(token.text), what))
    }
}

/// A month and a day of it.
pub(super) fn date(month: &Token<'_>, day: &Token<'_>) -> Result<[u32; 2], ParseError> {
    let whole = |token: &Token<'_>, most: f64, what: &str| {
        let value = number(token, 1.0..=most, what)?;
        if value.fract() == 0.0 {
            Ok(value as u32)
        } else {
            Err(ParseError::new(token.at, quoted(token.text), what))
        }
    };
    let date = [whole(month, 12.0, "a month, 1 to 12")?, whole(day, 31.0, "a day of the month")?];
    match LocalTime::new(LEAP_YEAR, date[0], date[1], 0.0) {
        Ok(_) => Ok(date),
        Err(_) => Err(ParseError::new(day.at, quoted(day.text), "a day of the month")),
    }
}
