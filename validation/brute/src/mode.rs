//! How light is found.

use crate::sensor::Sensor;

/// How light is found. All ways find the same but for what they are said to miss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Paths from the sensors, lights asked for at each vertex. Misses the light of point lights
    /// that comes to a vertex or a sensor over mirrors, panes as mirrors, or through bodies.
    Paths,
    /// Walks from the lights, each vertex that scatters joined to all sensors. What it sends to a
    /// sensor over mirrors or through bodies is counted on its area, and so is the light of point
    /// lights that comes so without any vertex; a point without a disc misses both. Other light
    /// without a vertex in between is asked for from the sensor, which looks at the hints.
    Joins,
    /// The same, but on sensors whose values are means over areas all light is counted that comes
    /// without a vertex in between, or from the last vertex through an aim: for narrow beams, the
    /// sun through small openings, bright rooms behind keyholes.
    BeamsAndJoins,
    /// As [`Self::Joins`], but light whose last vertex is seen from the sensor through an aim is
    /// found by a path that starts there: for sensors that look into a bright room through a
    /// keyhole. It misses in that light what [`Self::Paths`] misses.
    KeyholesAndJoins,
    /// Walks from the lights, counted where they cross the area of a sensor: all light, for points
    /// as means over their discs; a point without a disc gets nothing.
    Photons,
}

impl Mode {
    /// Whether light without a vertex between light and sensor is counted.
    pub(crate) const fn counts_direct(self, sensor: &Sensor) -> bool {
        match self {
            Self::Paths | Self::Joins | Self::KeyholesAndJoins => false,
            Self::BeamsAndJoins => sensor.has_area(),
            Self::Photons => true,
        }
    }

    /// Whether vertices are not joined to a sensor through aims.
    pub(crate) const fn leaves_out_aimed(self, sensor: &Sensor) -> bool {
        match self {
            Self::KeyholesAndJoins => true,
            Self::BeamsAndJoins => sensor.has_area(),
            Self::Paths | Self::Joins | Self::Photons => false,
        }
    }
}
