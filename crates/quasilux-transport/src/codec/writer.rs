//! Values to bytes.

use serde::Serialize;

/// Bytes that grow.
#[derive(Clone, Debug, Default)]
pub(crate) struct Writer(Vec<u8>);

impl Writer {
    /// Continues after these bytes.
    pub(crate) fn behind(bytes: &[u8]) -> Self {
        Self(bytes.to_vec())
    }

    /// A value in the postcard format.
    pub(crate) fn value(&mut self, value: &(impl Serialize + ?Sized)) {
        let bytes = postcard::to_extend(value, std::mem::take(&mut self.0));
        self.0 = bytes.expect("values of a run have lengths, and memory does not fail");
    }

    /// Bytes as they are, without their number.
    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        self.0.extend_from_slice(bytes);
    }

    /// Everything that `put` writes, preceded by its length.
    pub(crate) fn block(&mut self, put: impl FnOnce(&mut Self)) {
        let mut block = Self::default();
        put(&mut block);
        self.value(&block.0.len());
        self.bytes(&block.0);
    }

    pub(crate) fn finish(self) -> Vec<u8> {
        self.0
    }
}
