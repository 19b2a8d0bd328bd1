//! The triangles of one glTF primitive.

use super::builder::MeshBuilder;
use super::gltf_accessor::Accessor;
use ::gltf::Semantic;
use ::gltf::mesh::{Mode, Primitive};
use glam::{DMat4, DVec3};
use std::sync::Arc;

/// Where the triangles of a primitive go.
pub(super) struct Target<'a> {
    pub(super) object: u32,
    pub(super) material: u32,
    pub(super) world_from_node: DMat4,
    /// Name of the object, for messages.
    pub(super) name: &'a str,
}

impl Target<'_> {
    /// Name of the object in messages: the start of its own name.
    fn object_name(&self) -> String {
        format!("object \"{}\"", self.name.chars().take(60).collect::<String>())
    }
}

/// Reads a primitive into `builder`; returns 1 if it has no triangles by its mode, else 0.
pub(super) fn read(
    primitive: &Primitive<'_>,
    buffers: &[Arc<Vec<u8>>],
    target: &Target<'_>,
    builder: &mut MeshBuilder,
) -> Result<u64, String> {
    let mode = primitive.mode();
    if matches!(mode, Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
        return Ok(1);
    }
    let positions = primitive
        .get(&Semantic::Positions)
        .ok_or_else(|| format!("{} has a primitive without positions", target.object_name()))?;
    let positions = Accessor::positions(&positions, buffers)?;
    let indices = primitive.indices().map(|indices| Accessor::indices(&indices, buffers));
    let indices = indices.transpose()?;
    let corners = indices.as_ref().map_or(positions.count(), Accessor::count);

    // A mirroring transform turns front sides over [3.7.4]: two corners change places.
    let mirrored = target.world_from_node.determinant() < 0.0;
    let position = |corner: usize| -> Result<DVec3, String> {
        let vertex = match &indices {
            Some(indices) => indices.index(corner),
            None => corner,
        };
        let local = positions.position(vertex).ok_or_else(|| {
            let object = target.object_name();
            format!("{object} refers to vertex {vertex}, but has {}", positions.count())
        })?;
        Ok(target.world_from_node.transform_point3(local))
    };
    for triangle in 0..triangles(mode, corners) {
        let [a, b, c] = corners_of(mode, triangle);
        let [b, c] = if mirrored { [c, b] } else { [b, c] };
        let corners = [position(a)?, position(b)?, position(c)?];
        builder
            .triangle(target.object, target.material, corners)
            .map_err(|error| error.message(&target.object_name()))?;
    }
    Ok(0)
}

/// The number of triangles that this many corners make; corners left over are ignored [3.7.2.1].
fn triangles(mode: Mode, corners: usize) -> usize {
    match mode {
        Mode::TriangleStrip | Mode::TriangleFan => corners.saturating_sub(2),
        _ => corners / 3,
    }
}

/// The corners of triangle `i` [3.7.2.1].
fn corners_of(mode: Mode, i: usize) -> [usize; 3] {
    match mode {
        Mode::TriangleStrip => [i, i + 1 + i % 2, i + 2 - i % 2],
        Mode::TriangleFan => [i + 1, i + 2, 0],
        _ => [3 * i, 3 * i + 1, 3 * i + 2],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_turn_alike() {
        let strip: Vec<_> = (0..3).map(|i| corners_of(Mode::TriangleStrip, i)).collect();
        assert_eq!(strip, [[0, 1, 2], [1, 3, 2], [2, 3, 4]]);
        let fan: Vec<_> = (0..2).map(|i| corners_of(Mode::TriangleFan, i)).collect();
        assert_eq!(fan, [[1, 2, 0], [2, 3, 0]]);
        assert_eq!(triangles(Mode::TriangleStrip, 5), 3);
        assert_eq!(triangles(Mode::TriangleFan, 1), 0);
        assert_eq!(triangles(Mode::Triangles, 8), 2);
    }
}
