//! Bytes to values.

use serde::de::DeserializeOwned;
use thiserror::Error;

/// Why bytes are no state of this run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum StateError {
    /// They end before the state does, or go on behind it.
    #[error("the state is not as long as it says")]
    Length,
    /// Contents that cannot be, or that belong to another scene or other settings.
    #[error("{0} does not fit this scene and these settings")]
    Unfit(&'static str),
    /// Surveys and pilots come to other decisions here than where the state comes from.
    #[error(
        "surveys and pilots decide otherwise than when this was written: the build, the scene or \
         the settings differ"
    )]
    Decisions,
}

/// Bytes that are read from the front.
#[derive(Clone, Debug)]
pub(crate) struct Reader<'b>(&'b [u8]);

impl<'b> Reader<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Self {
        Self(bytes)
    }

    /// The next `count` bytes.
    pub(crate) fn bytes(&mut self, count: usize) -> Result<&'b [u8], StateError> {
        let (bytes, rest) = self.0.split_at_checked(count).ok_or(StateError::Length)?;
        self.0 = rest;
        Ok(bytes)
    }

    /// A value in the postcard format.
    pub(crate) fn value<T: DeserializeOwned>(&mut self) -> Result<T, StateError> {
        let (value, rest) = postcard::take_from_bytes(self.0).map_err(|error| match error {
            postcard::Error::DeserializeUnexpectedEnd => StateError::Length,
            _ => StateError::Unfit("a value"),
        })?;
        self.0 = rest;
        Ok(value)
    }

    /// The length of a list, which has to be this one.
    pub(crate) fn expect_length(&mut self, expected: usize) -> Result<(), StateError> {
        let length: usize = self.value()?;
        if length == expected { Ok(()) } else { Err(StateError::Unfit("a list")) }
    }

    /// Bytes preceded by their length.
    pub(crate) fn block(&mut self) -> Result<&'b [u8], StateError> {
        let length = self.value()?;
        self.bytes(length)
    }

    /// Adds a count.
    pub(crate) fn add_count(&mut self, sum: &mut u64) -> Result<(), StateError> {
        super::add_count(sum, self.value()?).ok_or(StateError::Unfit("a count"))
    }

    /// Adds a number of quanta.
    pub(crate) fn add_quanta(&mut self, sum: &mut i64) -> Result<(), StateError> {
        super::add_quanta(sum, self.value()?).ok_or(StateError::Unfit("a sum"))
    }

    /// Nothing more may follow.
    pub(crate) fn end(self) -> Result<(), StateError> {
        if self.0.is_empty() { Ok(()) } else { Err(StateError::Length) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::codec::Writer;

    #[test]
    fn what_was_written_is_read() {
        let mut out = Writer::default();
        out.value(&-3_i128);
        out.value(&[0.5, -0.0]);
        out.value("ü");
        out.block(|out| out.value(&true));
        let bytes = out.finish();
        let read = |bytes: &[u8]| -> Result<(), StateError> {
            let mut from = Reader::new(bytes);
            assert_eq!(from.value(), Ok(-3_i128));
            let numbers: [f64; 2] = from.value()?;
            assert!(numbers[0] == 0.5 && numbers[1].is_sign_negative());
            assert_eq!(from.value::<String>()?, "ü");
            assert_eq!(from.block()?, [1]);
            from.end()
        };
        assert_eq!(read(&bytes), Ok(()));
        for length in 1..bytes.len() {
            assert_eq!(read(&bytes[..length]), Err(StateError::Length), "{length}");
        }
        assert_eq!(read(&[&bytes[..], &[0]].concat()), Err(StateError::Length));
    }

    /// A claimed length of 2^60 elements is refused before memory is taken for them.
    #[test]
    fn claims_take_no_memory() {
        let mut out = Writer::default();
        out.value(&(1_u64 << 60));
        out.value(&0.0);
        let bytes = out.finish();
        assert_eq!(Reader::new(&bytes).value::<Vec<f64>>(), Err(StateError::Length));
        assert_eq!(Reader::new(&bytes).value::<Vec<Vec<u64>>>(), Err(StateError::Length));
        assert_eq!(Reader::new(&bytes).value::<String>(), Err(StateError::Length));
        assert_eq!(Reader::new(&bytes).block(), Err(StateError::Length));
    }
}
