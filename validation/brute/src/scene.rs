//! What there is.

use crate::hint::Lookout;
use crate::light::PointLight;
use crate::sensor::Sensor;
use crate::sky::{Sky, Sun};
use crate::triangle::Triangle;
use glam::DVec3;

/// A scene; lengths in m, +z is up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// All surfaces.
    pub triangles: Vec<Triangle>,
    /// Lights that are no surfaces.
    pub lights: Vec<PointLight>,
    /// The sky, and the ground below the horizon.
    pub sky: Option<Sky>,
    /// The sun.
    pub sun: Option<Sun>,
    /// Where light is asked for.
    pub sensors: Vec<Sensor>,
    /// Where paths from sensors look for it.
    pub hints: Vec<Lookout>,
    /// The share of directions that go to the hints, from the sensor; at least 0, less than 1.
    pub hint_share: f64,
    /// The same after many bounces; it goes down to it by a third each time.
    pub late_hint_share: f64,
    /// Where walks from the lights are sent: doors, keyholes, sensors, small things.
    pub aims: Vec<Lookout>,
    /// The share of their directions that go there, from the light and from each surface that
    /// scatters; at least 0, less than 1.
    pub aim_share: f64,
    /// Boxes by two corners where walks are worth more: a walk that turns in more of them than
    /// before goes on as [`Self::copies`] walks for each, of less flux.
    pub depths: Vec<[DVec3; 2]>,
    /// How many; 0 and 1 leave a walk as it is.
    pub copies: u32,
    /// Parallelograms with `u x v` toward the outside. Where there are any, walks from sky and sun
    /// start along lines through them alone, and light along all other lines is left out: they must
    /// cover every way in. Where there are none, walks start from a sphere around everything.
    pub openings: Vec<Lookout>,
}

/// A part of the light of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The light of this number.
    Light(usize),
    /// All triangles that shine.
    Emitters,
    /// The sky and the ground.
    Sky,
    /// The sun.
    Sun,
}

impl Scene {
    /// The share of directions that go to the hints after this many diffuse bounces.
    pub(crate) fn share_of_hints(&self, bounces: u32) -> f64 {
        let falling = (0..bounces.min(32)).fold(self.hint_share, |share, _| share / 1.5);
        falling.max(self.late_hint_share.min(self.hint_share))
    }

    /// In how many of the boxes a place is.
    pub(crate) fn depth(&self, place: DVec3) -> usize {
        let holds = |[low, high]: &&[DVec3; 2]| place.cmpge(*low).all() && place.cmple(*high).all();
        self.depths.iter().filter(holds).count()
    }

    /// Everything that shines in it, one by one.
    #[must_use]
    pub fn sources(&self) -> Vec<Source> {
        let emits = self.triangles.iter().any(|triangle| triangle.luminance_cd_m2 > 0.0);
        (0..self.lights.len())
            .map(Source::Light)
            .chain(emits.then_some(Source::Emitters))
            .chain(self.sky.map(|_| Source::Sky))
            .chain(self.sun.map(|_| Source::Sun))
            .collect()
    }

    /// The same scene where only these shine. What sources give by themselves adds up.
    #[must_use]
    pub fn lit_by(&self, sources: &[Source]) -> Self {
        let lights = (0..self.lights.len()).filter(|&n| sources.contains(&Source::Light(n)));
        let lights = lights.map(|number| self.lights[number].clone()).collect();
        let emits = sources.contains(&Source::Emitters);
        let dark = |triangle: &Triangle| Triangle { luminance_cd_m2: 0.0, ..*triangle };
        let triangles =
            if emits { self.triangles.clone() } else { self.triangles.iter().map(dark).collect() };
        Self {
            triangles,
            lights,
            sky: self.sky.filter(|_| sources.contains(&Source::Sky)),
            sun: self.sun.filter(|_| sources.contains(&Source::Sun)),
            ..self.clone()
        }
    }
}
