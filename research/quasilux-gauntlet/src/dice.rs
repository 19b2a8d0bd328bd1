//! Parameters of a room, from a hash of its number.

use glam::DVec3;
use std::f64::consts::TAU;
use std::fmt;

/// A number that makes one room of a family differ from another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// What it is, with its unit.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
}

/// Draws what a room is made of, and remembers what has a name.
pub(super) struct Dice {
    state: u64,
    pub(super) drawn: Vec<Parameter>,
}

impl Dice {
    /// Those of a room: of its number and of the name of its family, FNV-1a of which tells families
    /// apart, so that a new family changes no other.
    pub(super) fn new(family: &str, number: u64) -> Self {
        let name = family.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        Self { state: name ^ number.wrapping_mul(0xd134_2543_de82_ef95), drawn: Vec::new() }
    }

    /// Uniform in [0, 1): splitmix64 (Steele, Lea and Flood 2014).
    pub(super) fn unit(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = self.state;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform between two values.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform between two values, rounded to three digits, under a name.
    pub(super) fn draw(&mut self, name: &'static str, low: f64, high: f64) -> f64 {
        let value = rounded(self.between(low, high));
        self.tell(name, value)
    }

    /// The same uniform in the logarithm.
    pub(super) fn log(&mut self, name: &'static str, low: f64, high: f64) -> f64 {
        let value = self.between(libm::log(low), libm::log(high));
        let value = rounded(libm::exp(value));
        self.tell(name, value)
    }

    /// A whole number from `low` to `high`, under a name.
    pub(super) fn count(&mut self, name: &'static str, low: u32, high: u32) -> u32 {
        let steps = f64::from(high - low + 1);
        let count = low + (self.unit() * steps) as u32;
        self.tell(name, f64::from(count));
        count
    }

    /// Whether a thing is there that half the rooms have, under a name.
    pub(super) fn coin(&mut self, name: &'static str) -> bool {
        self.count(name, 0, 1) == 1
    }

    /// Remembers a value.
    pub(super) fn tell(&mut self, name: &'static str, value: f64) -> f64 {
        self.drawn.push(Parameter { name, value });
        value
    }

    /// A place in a box.
    pub(super) fn within(&mut self, low: DVec3, high: DVec3) -> DVec3 {
        DVec3::new(
            rounded(self.between(low.x, high.x)),
            rounded(self.between(low.y, high.y)),
            rounded(self.between(low.z, high.z)),
        )
    }

    /// Where a sensor looks: up, along an axis, or anywhere.
    pub(super) fn normal(&mut self) -> DVec3 {
        let choice = self.unit();
        if choice < 0.4 {
            return DVec3::Z;
        }
        if choice < 0.8 {
            let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::NEG_Z];
            return axes[(self.unit() * 5.0) as usize];
        }
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = libm::sincos(TAU * self.unit());
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cos, radius * sin, z).normalize()
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.name, (self.value * 1e6).round() / 1e6)
    }
}

/// To three significant digits.
fn rounded(value: f64) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let digits = libm::floor(libm::log10(value.abs()));
    let unit = libm::pow(10.0, digits - 2.0);
    libm::round(value / unit) * unit
}
