//! How light is found.

use crate::sensor::Sensor;

/// How light is found. All ways find the same but for what they are said to miss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Paths from the sensors, lights asked for at each vertex. Misses the light of point lights
    /// that comes to a vertex or a sensor over mirrors, panes as mirrors, or through bodies.
    Paths,
    /// Walks from the lights, each vertex that scatters joined to all sensors. Light that comes to
    /// a sensor over mirrors or through bodies is counted on its area; a point without a disc
    /// misses it. Light without a vertex in between is asked for from the sensor.
    Joins,
    /// The same, but light that comes straight from the lights to sensors with an area is counted:
    /// for narrow beams, and the sun through small openings.
    BeamsAndJoins,
    /// Walks from the lights, counted where they cross the area of a sensor: all light, for points
    /// as means over their discs; a point without a disc gets nothing.
    Photons,
}

impl Mode {
    /// Whether light without a vertex between light and sensor is counted.
    pub(crate) const fn counts_direct(self, sensor: &Sensor) -> bool {
        match self {
            Self::Paths | Self::Joins => false,
            Self::BeamsAndJoins => sensor.has_area(),
            Self::Photons => true,
        }
    }
}
