//! Numbers as files write them: what counts as one, which counts are plausible, how many there is
//! room for.

use crate::report::{Position, Warnings, quoted};
use crate::{Deviation, ReadError};

/// Greatest magnitude of a number: products of a dozen stay finite.
const LARGEST_NUMBER: f64 = 1e18;

/// Greatest count: far above what any file holds, far below where an f64 skips integers.
const LARGEST_COUNT: f64 = 1e15;

/// A number and its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    pub(crate) value: f64,
    pub(crate) at: Position,
}

/// A piece of text that stands where a number should.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Written<'t> {
    pub(crate) text: &'t str,
    pub(crate) at: Position,
}

impl Written<'_> {
    /// The number; `what` names it in an error.
    pub(crate) fn number(&self, what: &str) -> Result<Number, ReadError> {
        match parse(self.text) {
            Some(value) => Ok(Number { value, at: self.at }),
            None => Err(self.error(what)),
        }
    }

    /// The number, where a comma counts as a decimal point.
    pub(crate) fn number_with_comma(
        &self,
        what: &str,
        warnings: &mut Warnings,
    ) -> Result<Number, ReadError> {
        let Some((whole, part)) = self.text.split_once(',') else {
            return self.number(what);
        };
        let value = parse(&format!("{whole}.{part}")).ok_or_else(|| self.error(what))?;
        let expected = "a decimal point (read as one)";
        warnings.push(Deviation::DecimalComma, self.at, quoted(self.text), expected);
        Ok(Number { value, at: self.at })
    }

    /// A number read from this text as an integer of at least `least`.
    pub(crate) fn count(
        &self,
        number: Number,
        what: &str,
        least: usize,
        warnings: &mut Warnings,
    ) -> Result<usize, ReadError> {
        let value = number.value;
        if value.fract() != 0.0 || !(least as f64..=LARGEST_COUNT).contains(&value) {
            let expected = format!("{what}: an integer of at least {least}");
            return Err(ReadError::new(self.at, quoted(self.text), expected));
        }
        if self.text.contains(['.', ',', 'e', 'E']) {
            let expected = format_args!("{what} without a decimal point").to_string();
            warnings.push(Deviation::CountWithPoint, self.at, quoted(self.text), expected);
        }
        Ok(value as usize)
    }

    fn error(&self, what: &str) -> ReadError {
        let found = if self.text.is_empty() { "nothing".to_owned() } else { quoted(self.text) };
        ReadError::new(self.at, found, format_args!("{what} (a number, no more than 1e18)"))
    }
}

/// `count` numbers in a row; an error says which one of them it is about.
pub(crate) fn list(
    count: usize,
    what: &str,
    mut next: impl FnMut() -> Result<Number, ReadError>,
) -> Result<Vec<Number>, ReadError> {
    let number = |index: usize| {
        next().map_err(|error| error.expecting(format_args!("{what} {} of {count}", index + 1)))
    };
    (0..count).map(number).collect()
}

/// Refuses a count of values that the rest of the file cannot hold, before anything is made of it.
pub(crate) fn check_room(
    count: usize,
    room: usize,
    at: Position,
    what: &str,
) -> Result<(), ReadError> {
    if count <= room {
        return Ok(());
    }
    let found = format!("a count that asks for {count} {what}");
    let expected = format!("no more than the {room} that fit into the rest of the file");
    Err(ReadError::new(at, found, expected))
}

/// A finite number of usual size. Of what Rust reads as a number, words such as "inf" and "nan" are
/// not meant.
fn parse(text: &str) -> Option<f64> {
    let is_numeric = |b: u8| b.is_ascii_digit() || b"+-.eE".contains(&b);
    let value: f64 = text.bytes().all(is_numeric).then(|| text.parse().ok())??;
    (value.abs() <= LARGEST_NUMBER).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: Position = Position { line: 3, column: 7 };

    #[test]
    fn only_finite_numbers_of_usual_size_are_numbers() {
        for (text, value) in [("1", 1.0), ("-.5", -0.5), ("+2.", 2.0), ("1E-3", 1e-3)] {
            assert_eq!(Written { text, at: AT }.number("a length").unwrap().value, value);
        }
        for text in ["", "inf", "nan", "0x1", "1e19", "1e999", "1 2", "1,5", "--1", "e"] {
            let error = Written { text, at: AT }.number("a length").expect_err(text);
            assert_eq!((error.line(), error.column()), (3, 7));
            assert!(error.expected().contains("a length"), "{error}");
        }
    }

    #[test]
    fn counts_are_whole_and_bounded() {
        let count = |text| {
            let (written, mut warnings) = (Written { text, at: AT }, Warnings::default());
            let number = written.number_with_comma("a count", &mut warnings)?;
            let count = written.count(number, "a count", 2, &mut warnings)?;
            Ok::<_, ReadError>((count, warnings.into_vec().len()))
        };
        assert_eq!(count("2"), Ok((2, 0)));
        assert_eq!(count("3.0"), Ok((3, 1)));
        assert_eq!(count("3,0"), Ok((3, 2)));
        for text in ["1", "2.5", "-3", "1e16"] {
            assert!(count(text).is_err(), "{text}");
        }
    }
}
