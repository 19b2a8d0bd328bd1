//! Elements that a sparse accessor replaces: numbers in rising order, and their values.
//!
//! glTF 2.0 Specification (2021), section 3.6.2.3.

use super::gltf_elements::{Elements, whole};
use ::gltf::accessor::sparse::{IndexType, Sparse};
use std::sync::Arc;

#[derive(Debug)]
pub(super) struct Replaced<'b> {
    numbers: Elements<'b>,
    /// Bytes of a number.
    size: usize,
    values: Elements<'b>,
    count: usize,
}

impl<'b> Replaced<'b> {
    /// `size` is that of a value in bytes.
    pub(super) fn new(
        name: &str,
        sparse: &Sparse<'_>,
        buffers: &'b [Arc<Vec<u8>>],
        size: usize,
    ) -> Result<Self, String> {
        let (count, indices, values) = (sparse.count(), sparse.indices(), sparse.values());
        let index_size = match indices.index_type() {
            IndexType::U8 => 1,
            IndexType::U16 => 2,
            IndexType::U32 => 4,
        };
        let part = |part: &str| format!("{name}: the list of replaced {part}");
        let (view, at) = (indices.view(), indices.offset());
        let numbers = Elements::new(&part("numbers"), &view, at, buffers, [count, index_size])?;
        let (view, at) = (values.view(), values.offset());
        let values = Elements::new(&part("values"), &view, at, buffers, [count, size])?;
        let replaced = Self { numbers, size: index_size, values, count };
        if (1..count).any(|i| replaced.number(i - 1) >= replaced.number(i)) {
            return Err(format!("{}: not in rising order; expected each once", part("numbers")));
        }
        Ok(replaced)
    }

    /// The highest of the numbers.
    pub(super) fn highest(&self) -> Option<usize> {
        Some(self.number(self.count.checked_sub(1)?))
    }

    /// The value of element `i` from its first byte on, if it is replaced.
    pub(super) fn element(&self, i: usize) -> Option<&'b [u8]> {
        let (mut low, mut high) = (0, self.count);
        while low < high {
            let middle = low + (high - low) / 2;
            if self.number(middle) < i { low = middle + 1 } else { high = middle }
        }
        (low < self.count && self.number(low) == i).then(|| self.values.element(low))
    }

    fn number(&self, i: usize) -> usize {
        whole(self.numbers.element(i), self.size)
    }
}
