//! What a view shows: the plan all of it, for luminaires hang above the cut; an elevation what is
//! before the viewer, who stands at the cut.

use super::cut::Plane;
use glam::DVec3;

/// What of things in space a view shows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scope {
    /// The cut; `None` where things on both sides of it are shown.
    pub(crate) cut: Option<Plane>,
    /// Things that stand this little behind the viewer stand at the cut.
    pub(crate) hair_m: f64,
}

impl Scope {
    /// Whether a thing at a place is before the viewer.
    pub(crate) fn holds(&self, place_m: DVec3) -> bool {
        self.cut.is_none_or(|plane| plane.has_below(place_m, self.hair_m))
    }

    /// What of a triangle is before the viewer.
    pub(crate) fn triangles(&self, corners: [DVec3; 3]) -> Vec<[DVec3; 3]> {
        self.cut.map_or_else(|| vec![corners], |plane| plane.triangles_below(corners))
    }

    /// What of a segment is before the viewer.
    pub(crate) fn segment(&self, ends: [DVec3; 2]) -> Option<[DVec3; 2]> {
        self.cut.map_or(Some(ends), |plane| plane.part_below(ends))
    }
}
