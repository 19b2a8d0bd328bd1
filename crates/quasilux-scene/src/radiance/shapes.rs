//! Surfaces of Radiance, in the coordinates of the scene.

use super::document::{Primitive, shown};
use super::frame::Frame;
use glam::DVec3;

/// The shape of a surface. Its front is where its normals point.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// Counter-clockwise seen from the front; holes by seams.
    Polygon(Vec<DVec3>),
    Sphere {
        centre: DVec3,
        radius: f64,
        is_inward: bool,
    },
    /// Cylinder, tube, cone or cup, without ends.
    Cone {
        from: DVec3,
        to: DVec3,
        from_radius: f64,
        to_radius: f64,
        is_inward: bool,
    },
    Ring {
        centre: DVec3,
        /// Of length 1.
        normal: DVec3,
        inner_radius: f64,
        outer_radius: f64,
    },
    /// Something far away, in a direction of length 1, within a cone of this full angle.
    Source {
        direction: DVec3,
        angle_deg: f64,
    },
}

/// Where a surface is put, and whether its front becomes its back.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    pub(super) frame: Frame,
    pub(super) is_inverted: bool,
}

/// Whether a type of primitives is one of surfaces.
pub(super) fn is_surface(kind: &str) -> bool {
    matches!(
        kind,
        "source"
            | "sphere"
            | "bubble"
            | "polygon"
            | "cone"
            | "cup"
            | "cylinder"
            | "tube"
            | "ring"
            | "mesh"
            | "instance"
    )
}

impl Shape {
    /// The shape of a surface, as it is put; `Err` says what was expected.
    pub(super) fn from_primitive(
        primitive: &Primitive,
        placement: &Placement,
    ) -> Result<Self, String> {
        let Placement { frame, is_inverted } = placement;
        let reals = primitive.reals.as_slice();
        let vector = |at: usize| DVec3::new(reals[at], reals[at + 1], reals[at + 2]);
        let point = |at: usize| frame.point(vector(at));
        let radius = |at: usize| reals[at].abs() * frame.scale;
        let needs = |count: usize| expect(primitive, reals.len() == count, &count.to_string());
        let kind = &*primitive.kind;
        Ok(match kind {
            "polygon" => {
                let is_fine = reals.len() >= 9 && reals.len().is_multiple_of(3);
                expect(primitive, is_fine, "three for each of at least 3 corners")?;
                let mut corners: Vec<DVec3> = (0..reals.len()).step_by(3).map(point).collect();
                if *is_inverted != frame.is_mirrored() {
                    corners.reverse();
                }
                Self::Polygon(corners)
            }
            "sphere" | "bubble" => {
                needs(4)?;
                let turned = (kind == "bubble") != (reals[3] < 0.0);
                let (centre, radius) = (point(0), radius(3));
                Self::Sphere { centre, radius, is_inward: turned != *is_inverted }
            }
            "cylinder" | "tube" => {
                needs(7)?;
                let is_inward = ((kind == "tube") != (reals[6] < 0.0)) != *is_inverted;
                let (from_radius, to_radius) = (radius(6), radius(6));
                Self::Cone { from: point(0), to: point(3), from_radius, to_radius, is_inward }
            }
            "cone" | "cup" => {
                needs(8)?;
                Self::cone(primitive, placement)?
            }
            "ring" => {
                needs(8)?;
                Self::ring(primitive, placement)?
            }
            "source" => {
                needs(4)?;
                let direction = frame.direction(vector(0)).try_normalize();
                let direction = direction.ok_or_else(|| about(primitive, "no direction"))?;
                Self::Source { direction, angle_deg: reals[3].abs() }
            }
            "mesh" => return Err(about(primitive, MESH)),
            _ => return Err(about(primitive, INSTANCE)),
        })
    }
}

impl Shape {
    /// A cone or a cup by its 8 real arguments.
    fn cone(primitive: &Primitive, placement: &Placement) -> Result<Self, String> {
        let Placement { frame, is_inverted } = placement;
        let reals = primitive.reals.as_slice();
        let point = |at: usize| frame.point(DVec3::new(reals[at], reals[at + 1], reals[at + 2]));
        let signs = [reals[6], reals[7]].map(|it| if it == 0.0 { 0.0 } else { it.signum() });
        let sign = signs[0] + signs[1];
        if sign == 0.0 {
            return Err(about(primitive, "radii of two signs, or none; expected two of one"));
        }
        let is_inward = ((&*primitive.kind == "cup") != (sign < 0.0)) != *is_inverted;
        let [from_radius, to_radius] = [6, 7].map(|at| reals[at].abs() * frame.scale);
        Ok(Self::Cone { from: point(0), to: point(3), from_radius, to_radius, is_inward })
    }

    /// A ring by its 8 real arguments.
    fn ring(primitive: &Primitive, placement: &Placement) -> Result<Self, String> {
        let Placement { frame, is_inverted } = placement;
        let reals = primitive.reals.as_slice();
        let vector = |at: usize| DVec3::new(reals[at], reals[at + 1], reals[at + 2]);
        let normal = frame.direction(vector(3)).try_normalize();
        let normal = normal.ok_or_else(|| about(primitive, "a normal of no length"))?;
        let normal = if *is_inverted { -normal } else { normal };
        let [a, b] = [6, 7].map(|at| reals[at].abs() * frame.scale);
        let centre = frame.point(vector(0));
        Ok(Self::Ring { centre, normal, inner_radius: a.min(b), outer_radius: a.max(b) })
    }
}

const MESH: &str = "a compiled mesh, which is not read; convert the OBJ file that it was made of \
                    by obj2rad, or name that in the project";
const INSTANCE: &str = "an octree, which is not read; name the scene file that it was made of by \
                        !xform in its place";

fn about(primitive: &Primitive, what: &str) -> String {
    format!("{} \"{}\" has {what}", primitive.kind, shown(&primitive.name))
}

fn expect(primitive: &Primitive, is_fine: bool, count: &str) -> Result<(), String> {
    if is_fine {
        return Ok(());
    }
    let found = primitive.reals.len();
    Err(about(primitive, &format!("{found} real arguments; expected {count}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// As `getcone` of Radiance has signs of radii.
    #[test]
    fn negative_radii_turn_cones_inside_out() {
        let cone = |kind: &str, radii: [f64; 2]| {
            let reals = vec![0.0, 0.0, 0.0, 0.0, 0.0, 1.0, radii[0], radii[1]];
            let kind = kind.into();
            let primitive = Primitive { kind, reals, ..Primitive::default() };
            let placement = Placement { frame: Frame::default(), is_inverted: false };
            match Shape::from_primitive(&primitive, &placement) {
                Ok(Shape::Cone { is_inward, .. }) => Some(is_inward),
                _ => None,
            }
        };
        assert_eq!(cone("cone", [1.0, 0.0]), Some(false));
        assert_eq!(cone("cone", [-1.0, 0.0]), Some(true));
        assert_eq!(cone("cone", [-1.0, -2.0]), Some(true));
        assert_eq!(cone("cup", [0.0, -2.0]), Some(false));
        assert_eq!(cone("cone", [1.0, -2.0]), None);
        assert_eq!(cone("cup", [0.0, 0.0]), None);
    }
}
