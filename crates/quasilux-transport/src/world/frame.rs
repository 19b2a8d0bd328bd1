//! Local frames around a normal.

use glam::DVec3;

/// A right-handed frame whose z axis is a unit vector.
///
/// It is continuous in that vector but for one pole (Duff et al. 2017, "Building an Orthonormal
/// Basis, Revisited", JCGT 6(1)).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    tangent: DVec3,
    bitangent: DVec3,
    n: DVec3,
}

impl Frame {
    /// The frame around a unit vector.
    #[inline]
    pub(crate) fn around(n: DVec3) -> Self {
        let sign = 1.0_f64.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Self {
            tangent: DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            bitangent: DVec3::new(b, sign + n.y * n.y * a, -n.y),
            n,
        }
    }

    /// The frame around a unit vector whose y axis is `up` in so far as it is square to that
    /// vector; any frame around it where nothing of `up` is.
    pub(crate) fn upright(n: DVec3, up: DVec3) -> Self {
        match (up - n * n.dot(up)).try_normalize() {
            Some(bitangent) => Self { tangent: bitangent.cross(n), bitangent, n },
            None => Self::around(n),
        }
    }

    /// A local direction in world coordinates.
    #[inline]
    pub(crate) fn to_world(self, local: DVec3) -> DVec3 {
        self.tangent * local.x + self.bitangent * local.y + self.n * local.z
    }

    /// A direction of the world in this frame.
    #[inline]
    pub(crate) fn to_local(self, world: DVec3) -> DVec3 {
        DVec3::new(self.tangent.dot(world), self.bitangent.dot(world), self.n.dot(world))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_orthonormal() {
        let up = DVec3::new(0.3, -1.2, 2.0);
        for n in [DVec3::Z, DVec3::NEG_Z, DVec3::X, DVec3::new(0.6, -0.64, 0.48)] {
            let upright = Frame::upright(n, up);
            assert!(upright.to_local(up).x.abs() < 1e-15 && upright.to_local(up).y > 0.0);
            are_orthonormal(upright, n);
            are_orthonormal(Frame::around(n), n);
        }
        are_orthonormal(Frame::upright(DVec3::Z, DVec3::NEG_Z), DVec3::Z);
    }

    fn are_orthonormal(frame: Frame, n: DVec3) {
        let [x, y, z] = DVec3::AXES.map(|axis| frame.to_world(axis));
        assert!((x.cross(y) - z).length() < 1e-15 && (z - n).length() < 1e-15);
        assert!((x.length() - 1.0).abs() < 1e-15 && x.dot(y).abs() < 1e-15);
        let direction = DVec3::new(0.48, 0.6, -0.64);
        assert!((frame.to_local(frame.to_world(direction)) - direction).length() < 1e-15);
    }
}
