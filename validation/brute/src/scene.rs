//! What there is.

use crate::hint::Lookout;
use crate::light::PointLight;
use crate::triangle::Triangle;
use glam::DVec3;

/// A scene; lengths in m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// All surfaces.
    pub triangles: Vec<Triangle>,
    /// Lights that are no surfaces.
    pub lights: Vec<PointLight>,
    /// Where light is asked for.
    pub sensors: Vec<Sensor>,
    /// Where to look for it.
    pub hints: Vec<Lookout>,
    /// The share of directions that go to the hints, from the sensor; at least 0, less than 1.
    pub hint_share: f64,
    /// The same after many bounces; it goes down to it by a third each time.
    pub late_hint_share: f64,
}

/// A place that light is asked for at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Where, in m.
    pub position: DVec3,
    /// Unit normal: light from its side counts.
    pub normal: DVec3,
}

impl Scene {
    /// The share of directions that go to the hints after so many diffuse bounces.
    pub(crate) fn share_of_hints(&self, bounces: u32) -> f64 {
        let falling = (0..bounces.min(32)).fold(self.hint_share, |share, _| share / 1.5);
        falling.max(self.late_hint_share.min(self.hint_share))
    }
}
