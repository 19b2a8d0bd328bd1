//! Where a part of a scene is put: rotation, scale, mirror image and shift of `xform`.

use glam::{DMat3, DVec3};

/// A similarity: `p` goes to `turn * (scale * p) + shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frame {
    /// Orthogonal; its determinant is -1 where the part is mirrored.
    pub(crate) turn: DMat3,
    /// Above 0.
    pub(crate) scale: f64,
    pub(crate) shift: DVec3,
}

impl Default for Frame {
    fn default() -> Self {
        Self { turn: DMat3::IDENTITY, scale: 1.0, shift: DVec3::ZERO }
    }
}

impl Frame {
    pub(super) fn shifted(by: DVec3) -> Self {
        Self { shift: by, ..Self::default() }
    }

    pub(super) fn scaled(by: f64) -> Self {
        Self { scale: by, ..Self::default() }
    }

    pub(super) fn turned(turn: DMat3) -> Self {
        Self { turn, ..Self::default() }
    }

    /// A turn about an axis, 0 to 2 for x to z; quarter turns are exact.
    pub(super) fn about(axis: usize, degrees: f64) -> Self {
        let (sin, cos) = sincos(degrees);
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut columns = [DVec3::X, DVec3::Y, DVec3::Z];
        columns[a][a] = cos;
        columns[a][b] = sin;
        columns[b][b] = cos;
        columns[b][a] = -sin;
        Self::turned(DMat3::from_cols(columns[0], columns[1], columns[2]))
    }

    /// A mirror image across the plane that an axis stands on.
    pub(super) fn mirrored(axis: usize) -> Self {
        let mut diagonal = DVec3::ONE;
        diagonal[axis] = -1.0;
        Self::turned(DMat3::from_diagonal(diagonal))
    }

    /// This frame, and then `next`.
    pub(super) fn then(&self, next: &Self) -> Self {
        Self {
            turn: next.turn * self.turn,
            scale: self.scale * next.scale,
            shift: next.point(self.shift),
        }
    }

    pub(super) fn point(&self, point: DVec3) -> DVec3 {
        self.turn * (point * self.scale) + self.shift
    }

    pub(super) fn direction(&self, direction: DVec3) -> DVec3 {
        self.turn * direction
    }

    pub(crate) fn is_mirrored(&self) -> bool {
        self.turn.determinant() < 0.0
    }

    /// Whether all of it is a number that geometry may have.
    pub(super) fn is_finite(&self) -> bool {
        let is_fine = |it: f64| it.abs() <= 1e15;
        self.turn.to_cols_array().into_iter().all(is_fine)
            && self.shift.to_array().into_iter().all(is_fine)
            && (1e-15..=1e15).contains(&self.scale)
    }
}

/// Sine and cosine of an angle in degrees; those of quarter turns are exact.
pub(crate) fn sincos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        rest => libm::sincos(rest.to_radians()),
    }
}
