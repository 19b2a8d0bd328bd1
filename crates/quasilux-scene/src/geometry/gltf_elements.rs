//! Elements in a view of a glTF buffer, with every bound checked.

use std::sync::Arc;

/// Elements at equal distances; all of them lie within the bytes.
#[derive(Debug)]
pub(super) struct Elements<'b> {
    bytes: &'b [u8],
    stride: usize,
}

impl<'b> Elements<'b> {
    /// Elements of a view of a buffer, from an offset on: `count` of them, of `size` bytes each.
    pub(super) fn new(
        name: &str,
        view: &::gltf::buffer::View<'_>,
        offset: usize,
        buffers: &'b [Arc<Vec<u8>>],
        [count, size]: [usize; 2],
    ) -> Result<Self, String> {
        let stride = view.stride().unwrap_or(size);
        if stride < size {
            return Err(format!("{name} has a stride of {stride}; expected {size} or more"));
        }
        let bytes = buffers
            .get(view.buffer().index())
            .and_then(|buffer| buffer.get(view.offset()..)?.get(..view.length()))
            .ok_or_else(|| format!("buffer view {} reaches beyond its buffer", view.index()))?;
        let bytes = bytes.get(offset..).unwrap_or_default();
        let needed = match count.checked_sub(1) {
            None => Some(0),
            Some(steps) => stride.checked_mul(steps).and_then(|n| n.checked_add(size)),
        };
        if needed.is_none_or(|needed| needed > bytes.len()) {
            return Err(format!(
                "{name} says {count} elements; expected no more than its buffer view of {} bytes \
                 holds",
                view.length()
            ));
        }
        Ok(Self { bytes, stride })
    }

    /// From the first byte of element `i` on, which must be below the count.
    pub(super) fn element(&self, i: usize) -> &'b [u8] {
        &self.bytes[i * self.stride..]
    }
}

/// An unsigned integer of 1, 2 or 4 bytes.
pub(super) fn whole(bytes: &[u8], size: usize) -> usize {
    match size {
        1 => usize::from(bytes[0]),
        2 => usize::from(u16::from_le_bytes(first(bytes))),
        _ => u32::from_le_bytes(first(bytes)) as usize,
    }
}

/// Its first bytes.
pub(super) fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
    std::array::from_fn(|byte| bytes[byte])
}
