//! Numbers in glTF buffers, with every bound checked before the first is read.
//!
//! glTF 2.0 Specification (2021), sections 3.6.2 and 3.11 (integers for -1 to 1);
//! `KHR_mesh_quantization` for positions of 8 and 16 bits. Nothing is copied, so a count in a
//! header costs nothing: the bytes behind it must exist.

use super::gltf_elements::{Elements, first, whole};
use super::gltf_sparse::Replaced;
use ::gltf::accessor::{DataType, Dimensions};
use glam::DVec3;
use std::sync::Arc;

/// A view of vectors or single numbers in a buffer.
#[derive(Debug)]
pub(super) struct Accessor<'b> {
    /// `None` where all are 0 that are not replaced.
    elements: Option<Elements<'b>>,
    replaced: Option<Replaced<'b>>,
    count: usize,
    number: Number,
}

/// How numbers stand in bytes.
#[derive(Clone, Copy, Debug)]
struct Number {
    data_type: DataType,
    /// Whether whole numbers stand for 0 to 1 or -1 to 1.
    is_normalized: bool,
}

impl<'b> Accessor<'b> {
    /// Vertex positions: three 32-bit floats each, or three quantized numbers.
    pub(super) fn positions(
        accessor: &::gltf::Accessor<'_>,
        buffers: &'b [Arc<Vec<u8>>],
    ) -> Result<Self, String> {
        if accessor.dimensions() != Dimensions::Vec3 || accessor.data_type() == DataType::U32 {
            let message = "has positions of another type; expected three floats, or three \
                           integers of 8 or 16 bits";
            return Err(format!("accessor {} {message}", accessor.index()));
        }
        Self::new(accessor, buffers, 3 * accessor.data_type().size())
    }

    /// Vertex indices: unsigned integers of 8, 16 or 32 bits.
    pub(super) fn indices(
        accessor: &::gltf::Accessor<'_>,
        buffers: &'b [Arc<Vec<u8>>],
    ) -> Result<Self, String> {
        let is_whole = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
        if accessor.dimensions() != Dimensions::Scalar || !is_whole {
            let message = "has indices of another type; expected unsigned integers";
            return Err(format!("accessor {} {message}", accessor.index()));
        }
        Self::new(accessor, buffers, accessor.data_type().size())
    }

    fn new(
        accessor: &::gltf::Accessor<'_>,
        buffers: &'b [Arc<Vec<u8>>],
        size: usize,
    ) -> Result<Self, String> {
        let name = format!("accessor {}", accessor.index());
        let count = accessor.count();
        let replaced = accessor.sparse().map(|sparse| Replaced::new(&name, &sparse, buffers, size));
        let replaced = replaced.transpose()?;
        let elements = match accessor.view() {
            Some(view) => {
                Some(Elements::new(&name, &view, accessor.offset(), buffers, [count, size])?)
            }
            None if replaced.is_some() => None,
            None => return Err(format!("{name} has no buffer view; expected one")),
        };
        if replaced.as_ref().and_then(Replaced::highest).is_some_and(|highest| highest >= count) {
            return Err(format!("{name} replaces elements beyond its {count}"));
        }
        let number =
            Number { data_type: accessor.data_type(), is_normalized: accessor.normalized() };
        Ok(Self { elements, replaced, count, number })
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Position number `i`, if there are this many.
    pub(super) fn position(&self, i: usize) -> Option<DVec3> {
        if i >= self.count {
            return None;
        }
        let Some(bytes) = self.element(i) else { return Some(DVec3::ZERO) };
        let size = self.number.data_type.size();
        let [x, y, z] = [0, 1, 2].map(|axis| self.number.read(&bytes[axis * size..]));
        Some(DVec3::new(x, y, z))
    }

    /// Index number `i`, which must be below the count.
    pub(super) fn index(&self, i: usize) -> usize {
        self.element(i).map_or(0, |bytes| whole(bytes, self.number.data_type.size()))
    }

    /// From its first byte on; `None` where it is 0.
    fn element(&self, i: usize) -> Option<&'b [u8]> {
        let replaced = self.replaced.as_ref().and_then(|replaced| replaced.element(i));
        replaced.or_else(|| Some(self.elements.as_ref()?.element(i)))
    }
}

impl Number {
    fn read(self, bytes: &[u8]) -> f64 {
        let scaled = |value: f64, most: f64| match self.is_normalized {
            true => (value / most).max(-1.0),
            false => value,
        };
        match self.data_type {
            DataType::I8 => scaled(f64::from(i8::from_le_bytes(first(bytes))), 127.0),
            DataType::U8 => scaled(f64::from(bytes[0]), 255.0),
            DataType::I16 => scaled(f64::from(i16::from_le_bytes(first(bytes))), 32767.0),
            DataType::U16 => scaled(f64::from(u16::from_le_bytes(first(bytes))), 65535.0),
            DataType::U32 => f64::from(u32::from_le_bytes(first(bytes))),
            DataType::F32 => f64::from(f32::from_le_bytes(first(bytes))),
        }
    }
}
