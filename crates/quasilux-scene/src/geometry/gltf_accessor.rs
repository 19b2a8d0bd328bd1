//! Numbers in glTF buffers, with every bound checked before the first is read.
//!
//! glTF 2.0 Specification (2021), section 3.6.2. Nothing is copied, so a count in a header costs
//! nothing: the bytes behind it must exist.

use ::gltf::accessor::{DataType, Dimensions};
use glam::DVec3;
use std::sync::Arc;

/// A view of numbers in a buffer; all elements lie within it.
#[derive(Debug)]
pub(super) struct Accessor<'b> {
    /// From the first element to the end of the buffer view.
    bytes: &'b [u8],
    stride: usize,
    count: usize,
    data_type: DataType,
}

impl<'b> Accessor<'b> {
    /// Vertex positions: three 32-bit floats each.
    pub(super) fn positions(
        accessor: &::gltf::Accessor<'_>,
        buffers: &'b [Arc<Vec<u8>>],
    ) -> Result<Self, String> {
        let kind = (accessor.data_type(), accessor.dimensions());
        if kind != (DataType::F32, Dimensions::Vec3) {
            let message = "has positions of another type; expected three 32-bit floats";
            return Err(format!("accessor {} {message}", accessor.index()));
        }
        Self::new(accessor, buffers, 12)
    }

    /// Vertex indices: unsigned integers of 8, 16 or 32 bits.
    pub(super) fn indices(
        accessor: &::gltf::Accessor<'_>,
        buffers: &'b [Arc<Vec<u8>>],
    ) -> Result<Self, String> {
        let size = match (accessor.data_type(), accessor.dimensions()) {
            (DataType::U8, Dimensions::Scalar) => 1,
            (DataType::U16, Dimensions::Scalar) => 2,
            (DataType::U32, Dimensions::Scalar) => 4,
            _ => {
                let message = "has indices of another type; expected unsigned integers";
                return Err(format!("accessor {} {message}", accessor.index()));
            }
        };
        Self::new(accessor, buffers, size)
    }

    fn new(
        accessor: &::gltf::Accessor<'_>,
        buffers: &'b [Arc<Vec<u8>>],
        size: usize,
    ) -> Result<Self, String> {
        let index = accessor.index();
        if accessor.sparse().is_some() {
            return Err(format!("accessor {index} is sparse, which is not built"));
        }
        let view = accessor
            .view()
            .ok_or_else(|| format!("accessor {index} has no buffer view; expected one"))?;
        let count = accessor.count();
        let stride = view.stride().unwrap_or(size);
        if stride < size {
            return Err(format!(
                "accessor {index} has a stride of {stride}; expected {size} or more"
            ));
        }
        let data_type = accessor.data_type();
        let bytes = buffers
            .get(view.buffer().index())
            .and_then(|buffer| buffer.get(view.offset()..)?.get(..view.length()))
            .ok_or_else(|| format!("buffer view {} reaches beyond its buffer", view.index()))?;
        let bytes = bytes.get(accessor.offset()..).unwrap_or_default();
        let needed = match count.checked_sub(1) {
            None => Some(0),
            Some(steps) => stride.checked_mul(steps).and_then(|n| n.checked_add(size)),
        };
        if needed.is_none_or(|needed| needed > bytes.len()) {
            return Err(format!(
                "accessor {index} says {count} elements; expected no more than its buffer view \
                 of {} bytes holds",
                view.length()
            ));
        }
        Ok(Self { bytes, stride, count, data_type })
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Position number `i`, if there are so many.
    pub(super) fn position(&self, i: usize) -> Option<DVec3> {
        if i >= self.count {
            return None;
        }
        let at = i * self.stride;
        let coordinate = |axis: usize| f64::from(f32::from_le_bytes(self.word(at + 4 * axis)));
        Some(DVec3::new(coordinate(0), coordinate(1), coordinate(2)))
    }

    /// Index number `i`, which must be below the count.
    pub(super) fn index(&self, i: usize) -> usize {
        let at = i * self.stride;
        match self.data_type {
            DataType::U8 => usize::from(self.bytes[at]),
            DataType::U16 => usize::from(u16::from_le_bytes(self.word(at))),
            _ => u32::from_le_bytes(self.word(at)) as usize,
        }
    }

    fn word<const N: usize>(&self, at: usize) -> [u8; N] {
        std::array::from_fn(|byte| self.bytes[at + byte])
    }
}
