//! What a plan shows, as plain numbers: surfaces, lights, sensors, cameras and remarks in the
//! world's frame, in m, z up.

use glam::DVec3;

/// Triangles with shared corners.
#[derive(Clone, Copy, Debug, Default)]
pub struct Surfaces<'a> {
    /// Corners in m.
    pub positions_m: &'a [DVec3],
    /// Indices of the corners of each triangle; a triangle that names a corner that is not there is
    /// left out.
    pub triangles: &'a [[u32; 3]],
    /// The number of the material of each triangle; triangles without an entry have that of 0.
    pub material_of: &'a [u32],
    /// Whether light goes through the material of each number; through others it does not.
    pub lets_through: &'a [bool],
}

/// A room to be drawn in plan and elevations.
#[derive(Clone, Copy, Debug, Default)]
pub struct PlanPicture<'a> {
    /// The heading.
    pub title: &'a str,
    /// What stands in the room and around it.
    pub surfaces: Surfaces<'a>,
    /// Openings to the outside, the corners of each in turn.
    pub openings_m: &'a [[DVec3; 4]],
    /// Triangles that emit light, each in its group.
    pub area_lights: &'a [PlanAreaLight<'a>],
    /// Luminaires, in the order of their numbers, from 1.
    pub luminaires: &'a [PlanLuminaire],
    /// Lights without extent and direction.
    pub point_lights_m: &'a [DVec3],
    /// Sensors in a rectangle.
    pub grids: &'a [PlanGrid<'a>],
    /// Sensors at single points.
    pub points: &'a [PlanPoints<'a>],
    /// Cameras.
    pub cameras: &'a [PlanCamera<'a>],
    /// Remarks. Luminaires at their places are drawn in red.
    pub marks: &'a [PlanMark],
    /// Where north is: degrees from +y, counter-clockwise seen from above.
    pub north_deg: f64,
}

/// Emitting triangles of one kind.
#[derive(Clone, Copy, Debug)]
pub struct PlanAreaLight<'a> {
    /// What it is called.
    pub name: &'a str,
    /// Indices of its triangles; they emit from their front sides.
    pub triangles: &'a [u32],
}

/// A luminaire at its place.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanLuminaire {
    /// What it is called, the same for luminaires of one kind.
    pub name: String,
    /// Its place in m.
    pub position_m: DVec3,
    /// Unit direction of gamma = 0: where it is aimed.
    pub aim: DVec3,
    /// Unit direction of C0, square to `aim`.
    pub c0: DVec3,
    /// Lengths of its luminous opening along C0, along C90 and along `aim`, in m; zero where it has
    /// none.
    pub opening_m: DVec3,
    /// Whether the opening is round about `aim`.
    pub is_round: bool,
}

/// A rectangle of sensor points.
#[derive(Clone, Copy, Debug)]
pub struct PlanGrid<'a> {
    /// Its name.
    pub name: &'a str,
    /// The corner in m.
    pub origin_m: DVec3,
    /// Both edges in m.
    pub edges_m: [DVec3; 2],
    /// Numbers of cells along both edges.
    pub counts: [u32; 2],
    /// Unit normal: light from this side counts.
    pub normal: DVec3,
}

/// Single sensor points of one name.
#[derive(Clone, Copy, Debug)]
pub struct PlanPoints<'a> {
    /// Their name.
    pub name: &'a str,
    /// The points.
    pub points: &'a [PlanPoint],
}

/// One sensor point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanPoint {
    /// Its place in m.
    pub position_m: DVec3,
    /// Unit normal: light from this side counts.
    pub normal: DVec3,
}

/// A camera.
#[derive(Clone, Copy, Debug)]
pub struct PlanCamera<'a> {
    /// Its name.
    pub name: &'a str,
    /// Its place in m.
    pub position_m: DVec3,
    /// Unit directions to the corners of its picture, in turn.
    pub corners: [DVec3; 4],
}

/// A remark: a red balloon with its number at its place, and the text below.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanMark {
    /// The place in m; `None` for a remark on the whole.
    pub position_m: Option<DVec3>,
    /// The number in the balloon and before the text. Marks of one number share one text.
    pub number: u32,
    /// What is remarked.
    pub text: String,
}
