//! Bytes to numbers: whatever the bytes are, the answer is numbers or an error, and no length that
//! they claim takes memory before so many bytes are there.

use thiserror::Error;

/// Why bytes are no state of this run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum StateError {
    /// They end before the state does, or go on behind it.
    #[error("the state has another length than it says")]
    Length,
    /// What they say cannot be, or belongs to another scene or other settings.
    #[error("{0} does not fit this scene and these settings")]
    Unfit(&'static str),
    /// Surveys and pilots come to other decisions here than where the state comes from.
    #[error("surveys and pilots decide otherwise here than where this was made")]
    Decisions,
}

/// Bytes that are read from the front.
#[derive(Clone, Debug)]
pub(crate) struct Reader<'b>(&'b [u8]);

impl<'b> Reader<'b> {
    pub(crate) fn new(bytes: &'b [u8]) -> Self {
        Self(bytes)
    }

    /// So many bytes.
    pub(crate) fn bytes(&mut self, count: usize) -> Result<&'b [u8], StateError> {
        let (bytes, rest) = self.0.split_at_checked(count).ok_or(StateError::Length)?;
        self.0 = rest;
        Ok(bytes)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], StateError> {
        let (bytes, rest) = self.0.split_first_chunk().ok_or(StateError::Length)?;
        self.0 = rest;
        Ok(*bytes)
    }

    pub(crate) fn u8(&mut self) -> Result<u8, StateError> {
        Ok(u8::from_le_bytes(self.array()?))
    }

    pub(crate) fn bool(&mut self) -> Result<bool, StateError> {
        match self.u8()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => Err(StateError::Unfit("a flag")),
        }
    }

    pub(crate) fn u32(&mut self) -> Result<u32, StateError> {
        Ok(u32::from_le_bytes(self.array()?))
    }

    pub(crate) fn u64(&mut self) -> Result<u64, StateError> {
        Ok(u64::from_le_bytes(self.array()?))
    }

    pub(crate) fn i64(&mut self) -> Result<i64, StateError> {
        Ok(i64::from_le_bytes(self.array()?))
    }

    pub(crate) fn i128(&mut self) -> Result<i128, StateError> {
        Ok(i128::from_le_bytes(self.array()?))
    }

    pub(crate) fn f64(&mut self) -> Result<f64, StateError> {
        Ok(f64::from_bits(self.u64()?))
    }

    /// What there may be.
    pub(crate) fn option<T>(
        &mut self,
        read: impl FnOnce(&mut Self) -> Result<T, StateError>,
    ) -> Result<Option<T>, StateError> {
        if self.bool()? { read(self).map(Some) } else { Ok(None) }
    }

    /// A list of things of so many bytes each, at least.
    pub(crate) fn length(&mut self, bytes_each: usize) -> Result<usize, StateError> {
        let length = usize::try_from(self.u64()?).map_err(|_| StateError::Length)?;
        let bytes = length.checked_mul(bytes_each).ok_or(StateError::Length)?;
        if bytes > self.0.len() { Err(StateError::Length) } else { Ok(length) }
    }

    /// A list that has so many things.
    pub(crate) fn expect_length(&mut self, expected: usize) -> Result<(), StateError> {
        if self.u64()? == expected as u64 { Ok(()) } else { Err(StateError::Unfit("a list")) }
    }

    pub(crate) fn f64s(&mut self) -> Result<Vec<f64>, StateError> {
        (0..self.length(size_of::<f64>())?).map(|_| self.f64()).collect()
    }

    pub(crate) fn text(&mut self) -> Result<String, StateError> {
        let length = self.length(1)?;
        let text = std::str::from_utf8(self.bytes(length)?);
        text.map(str::to_owned).map_err(|_| StateError::Unfit("a text"))
    }

    /// Bytes with their length before them.
    pub(crate) fn block(&mut self) -> Result<&'b [u8], StateError> {
        let length = self.length(1)?;
        self.bytes(length)
    }

    /// Adds a count.
    pub(crate) fn add_u64(&mut self, sum: &mut u64) -> Result<(), StateError> {
        *sum = sum.checked_add(self.u64()?).ok_or(StateError::Unfit("a count"))?;
        Ok(())
    }

    /// Adds a number of quanta.
    pub(crate) fn add_i64(&mut self, sum: &mut i64) -> Result<(), StateError> {
        *sum = sum.checked_add(self.i64()?).ok_or(StateError::Unfit("a sum"))?;
        Ok(())
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
        out.i128(-3);
        out.f64s(&[0.5, -0.0]);
        out.text("ü");
        out.block(|out| out.bool(true));
        let bytes = out.finish();
        let read = |bytes: &[u8]| -> Result<(), StateError> {
            let mut from = Reader::new(bytes);
            assert_eq!(from.i128()?, -3);
            let numbers = from.f64s()?;
            assert!(numbers[0] == 0.5 && numbers[1].is_sign_negative());
            assert_eq!(from.text()?, "ü");
            assert_eq!(from.block()?, [1]);
            from.end()
        };
        assert_eq!(read(&bytes), Ok(()));
        for length in 0..bytes.len() {
            assert_eq!(read(&bytes[..length]), Err(StateError::Length), "{length}");
        }
        assert_eq!(read(&[&bytes[..], &[0]].concat()), Err(StateError::Length));
    }

    /// A claimed length of 2^60 numbers is refused before memory is taken for them.
    #[test]
    fn claims_take_no_memory() {
        let mut out = Writer::default();
        out.u64(1 << 60);
        out.f64(0.0);
        let bytes = out.finish();
        assert_eq!(Reader::new(&bytes).f64s(), Err(StateError::Length));
        assert_eq!(Reader::new(&bytes).text(), Err(StateError::Length));
        assert_eq!(Reader::new(&bytes).block(), Err(StateError::Length));
    }
}
