//! Numbers as files write them: which tokens are numbers, which counts are plausible, and how many
//! values the rest of a file has room for.

use crate::{ParseError, Position, TextWarning, Warnings, quoted};

/// Largest magnitude of a number: products of a dozen stay finite.
const MAX_MAGNITUDE: f64 = 1e18;

/// Largest count: far above what any file holds, far below where an f64 skips integers.
const MAX_COUNT: f64 = 1e15;

/// A number and its position.
#[derive(Clone, Copy, Debug)]
pub struct Number {
    /// The value, finite and no larger than 1e18 in magnitude.
    pub value: f64,
    /// Where it begins.
    pub at: Position,
}

/// A word of the text, not yet parsed.
#[derive(Clone, Copy, Debug)]
pub struct Token<'t> {
    /// The characters of the file.
    pub text: &'t str,
    /// Where they begin.
    pub at: Position,
}

impl Token<'_> {
    /// The number; `what` names it in an error.
    ///
    /// # Errors
    /// Where the token is not a finite decimal number of at most 1e18 in magnitude.
    pub fn number(&self, what: &str) -> Result<Number, ParseError> {
        match parse(self.text) {
            Some(value) => Ok(Number { value, at: self.at }),
            None => Err(self.error(what)),
        }
    }

    /// The number, where a comma counts as a decimal point, with a warning.
    ///
    /// # Errors
    /// As [`Self::number`].
    pub fn number_with_comma<K>(
        &self,
        what: &str,
        warnings: &mut Warnings<K>,
    ) -> Result<Number, ParseError>
    where
        K: Copy + PartialEq + From<TextWarning>,
    {
        let Some((whole, part)) = self.text.split_once(',') else {
            return self.number(what);
        };
        let value = parse(&format!("{whole}.{part}")).ok_or_else(|| self.error(what))?;
        let expected = "a decimal point (read as one)";
        warnings.push(TextWarning::DecimalComma, self.at, quoted(self.text), expected);
        Ok(Number { value, at: self.at })
    }

    /// A number read from this token as an integer of at least `min`.
    ///
    /// # Errors
    /// Where it is no integer, below `min`, or above 1e15.
    pub fn count<K>(
        &self,
        number: Number,
        what: &str,
        min: usize,
        warnings: &mut Warnings<K>,
    ) -> Result<usize, ParseError>
    where
        K: Copy + PartialEq + From<TextWarning>,
    {
        let value = number.value;
        if value.fract() != 0.0 || !(min as f64..=MAX_COUNT).contains(&value) {
            let expected = format!("{what}: an integer of at least {min}");
            return Err(ParseError::new(self.at, quoted(self.text), expected));
        }
        if self.text.contains(['.', ',', 'e', 'E']) {
            let expected = format_args!("{what} without a decimal point").to_string();
            warnings.push(TextWarning::CountWithPoint, self.at, quoted(self.text), expected);
        }
        Ok(value as usize)
    }

    fn error(&self, what: &str) -> ParseError {
        let found = if self.text.is_empty() { "nothing".to_owned() } else { quoted(self.text) };
        ParseError::new(self.at, found, format_args!("{what} (a number, no more than 1e18)"))
    }
}

/// `count` numbers in a row.
///
/// # Errors
/// The first error of `next`, saying which number of the list it is about.
pub fn number_list(
    count: usize,
    what: &str,
    mut next: impl FnMut() -> Result<Number, ParseError>,
) -> Result<Vec<Number>, ParseError> {
    let number = |index: usize| {
        next().map_err(|error| error.expecting(format_args!("{what} {} of {count}", index + 1)))
    };
    (0..count).map(number).collect()
}

/// Refuses a count of values that the rest of the file cannot hold, before memory is taken for it.
///
/// # Errors
/// Where `count` is above `room`.
pub fn check_room(
    count: usize,
    room: usize,
    position: Position,
    what: &str,
) -> Result<(), ParseError> {
    if count <= room {
        return Ok(());
    }
    let found = format!("a count that asks for {count} {what}");
    let expected = format!("no more than the {room} that fit into the rest of the file");
    Err(ParseError::new(position, found, expected))
}

/// A finite number of usual size. Of what Rust reads as a number, words such as "inf" and "nan" are
/// not meant.
fn parse(text: &str) -> Option<f64> {
    let is_numeric = |b: u8| b.is_ascii_digit() || b"+-.eE".contains(&b);
    let value: f64 = text.bytes().all(is_numeric).then(|| text.parse().ok())??;
    (value.abs() <= MAX_MAGNITUDE).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    const AT: Position = Position { line: 3, column: 7 };

    #[test]
    fn only_finite_numbers_of_usual_size_are_numbers() {
        for (text, value) in [("1", 1.0), ("-.5", -0.5), ("+2.", 2.0), ("1E-3", 1e-3)] {
            assert_eq!(Token { text, at: AT }.number("a length").unwrap().value, value);
        }
        for text in ["", "inf", "nan", "0x1", "1e19", "1e999", "1 2", "1,5", "--1", "e"] {
            let error = Token { text, at: AT }.number("a length").expect_err(text);
            assert_eq!((error.line(), error.column()), (3, 7));
            assert!(error.expected().contains("a length"), "{error}");
        }
    }

    #[test]
    fn counts_are_whole_and_bounded() {
        let count = |text| {
            let (token, mut warnings) =
                (Token { text, at: AT }, Warnings::<TextWarning>::default());
            let number = token.number_with_comma("a count", &mut warnings)?;
            let count = token.count(number, "a count", 2, &mut warnings)?;
            Ok::<_, ParseError>((count, warnings.into_vec().len()))
        };
        assert_eq!(count("2"), Ok((2, 0)));
        assert_eq!(count("3.0"), Ok((3, 1)));
        assert_eq!(count("3,0"), Ok((3, 2)));
        for text in ["1", "2.5", "-3", "1e16"] {
            assert!(count(text).is_err(), "{text}");
        }
    }
}
