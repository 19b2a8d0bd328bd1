//! What changes in a room over a year of hours: blinds, and electric light that daylight dims.

use crate::Scene;

/// Blinds, drawn or not: two states of one room.
#[derive(Clone, Debug)]
pub struct Blinds {
    /// The scene while they are closed. It has the sensors of the other, in the same order.
    pub closed: Scene,
    /// When they are.
    pub control: BlindsControl,
}

/// When blinds are closed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BlindsControl {
    /// While more than 2 % of the points of a sensor get more than 1000 lx straight from the sun
    /// through open blinds (IES LM-83); of all sensors together without a number.
    Sunlight {
        /// The number of the sensor.
        sensor: Option<usize>,
    },
    /// Said for each interval of the weather file.
    Schedule {
        /// Whether they are closed.
        is_closed: Vec<bool>,
    },
}

/// Electric light that brings a sensor to its target where daylight does not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElectricLight {
    /// The number of the sensor whose average counts.
    pub sensor: usize,
    /// The illuminance that it is to have, in lx: at full power the lamps give it alone.
    pub target_lx: f64,
    /// At full power, in W.
    pub power_w: f64,
    /// In W while people are there, however much daylight there is.
    pub min_power_w: f64,
}
