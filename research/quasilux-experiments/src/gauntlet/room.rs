//! What a hard room is: quadrilaterals, lamps, places and where to look.

use super::dice::{Dice, Parameter};
use glam::DVec3;

/// A room of the gauntlet, lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// Its number.
    pub number: u64,
    /// The name of its family.
    pub family: &'static str,
    /// What was drawn for it.
    pub parameters: Vec<Parameter>,
    /// Surfaces.
    pub faces: Vec<Face>,
    /// Point lights.
    pub lamps: Vec<Lamp>,
    /// Sensor points.
    pub places: Vec<SensorPlace>,
    /// Where light comes from that is hard to find: for a reference that is told, nothing else.
    pub hints: Vec<Lookout>,
    /// The shares of directions that such a reference sends there, at first and after bounces.
    pub hint_shares: [f64; 2],
}

/// A flat quadrilateral, its front where its corners run counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// The corners.
    pub corners: [DVec3; 4],
    /// What it is made of, on both sides.
    pub surface: Surface,
    /// Luminance of the front in cd/m^2; 0 where it does not shine.
    pub luminance_cd_m2: f64,
}

/// What a face is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// Diffuse with this reflectance.
    Grey(f64),
    /// A perfect mirror with this reflectance.
    Mirror(f64),
}

/// A point light.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Where it is.
    pub position: DVec3,
    /// How it shines.
    pub shine: Shine,
}

/// How a point light shines.
#[derive(Clone, Debug, PartialEq)]
pub enum Shine {
    /// So many cd in all directions.
    Everywhere(f64),
    /// The same all round an aim.
    Table {
        /// Unit direction of gamma = 0.
        aim: DVec3,
        /// Gamma in degrees, from 0 to 90, and cd; linear between.
        rows: Vec<[f64; 2]>,
    },
}

/// A sensor point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorPlace {
    /// Where it is.
    pub position: DVec3,
    /// Unit normal.
    pub normal: DVec3,
}

/// A parallelogram with edges from a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallelogram {
    /// The corner.
    pub corner: DVec3,
    /// One edge.
    pub u: DVec3,
    /// The other edge.
    pub v: DVec3,
}

/// Where to look, and from where it helps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lookout {
    /// What to look at.
    pub shape: Parallelogram,
    /// The low corner of the box that it is for.
    pub low: DVec3,
    /// The high one.
    pub high: DVec3,
}

impl Room {
    /// A room with nothing in it.
    pub(super) fn empty() -> Self {
        Self {
            number: 0,
            family: "",
            parameters: Vec::new(),
            faces: Vec::new(),
            lamps: Vec::new(),
            places: Vec::new(),
            hints: Vec::new(),
            hint_shares: [0.5, 0.1],
        }
    }

    /// A hash of all that decides over the illuminances: FNV-1a over the bits of all numbers. Hints
    /// are no part of it.
    #[must_use]
    pub fn digest(&self) -> String {
        let mut hash = Fnv(0xcbf2_9ce4_8422_2325);
        for face in &self.faces {
            face.corners.iter().for_each(|&corner| hash.vector(corner));
            let [kind, reflectance] = match face.surface {
                Surface::Grey(reflectance) => [0.0, reflectance],
                Surface::Mirror(reflectance) => [1.0, reflectance],
            };
            hash.numbers(&[kind, reflectance, face.luminance_cd_m2]);
        }
        for lamp in &self.lamps {
            hash.vector(lamp.position);
            match &lamp.shine {
                Shine::Everywhere(intensity_cd) => hash.numbers(&[2.0, *intensity_cd]),
                Shine::Table { aim, rows } => {
                    hash.vector(*aim);
                    rows.iter().for_each(|row| hash.numbers(row));
                }
            }
        }
        for place in &self.places {
            hash.vector(place.position);
            hash.vector(place.normal);
        }
        format!("{:016x}", hash.0)
    }

    pub(super) fn add_place(&mut self, position: DVec3, normal: DVec3) {
        self.places.push(SensorPlace { position, normal });
    }

    /// Adds sensor points in the air of a box, and one of three on its floor.
    pub(super) fn scatter(&mut self, dice: &mut Dice, low: DVec3, high: DVec3, count: u32) {
        for number in 0..count {
            let mut position = dice.within(low, high);
            let mut normal = dice.normal();
            if number.is_multiple_of(3) {
                (position.z, normal) = (low.z.min(0.0), DVec3::Z);
            }
            self.add_place(position, normal);
        }
    }

    pub(super) fn add_lamp(&mut self, position: DVec3, intensity_cd: f64) {
        self.lamps.push(Lamp { position, shine: Shine::Everywhere(intensity_cd) });
    }

    /// A lamp with the intensity of a flat panel, in steps of 10 degrees.
    pub(super) fn add_downlight(&mut self, position: DVec3, intensity_cd: f64) {
        let row = |step: u32| {
            let gamma_deg = 10.0 * f64::from(step);
            let cos = if step == 9 { 0.0 } else { libm::cos(gamma_deg.to_radians()) };
            [gamma_deg, intensity_cd * cos]
        };
        let rows = (0..10).map(row).collect();
        self.lamps.push(Lamp { position, shine: Shine::Table { aim: DVec3::NEG_Z, rows } });
    }

    /// Adds a panel with edges `u` and `v` that shines along `u x v`.
    pub(super) fn add_panel(&mut self, panel: Parallelogram, luminance_cd_m2: f64) {
        let corners = panel.corners();
        self.faces.push(Face { corners, surface: Surface::Grey(0.3), luminance_cd_m2 });
    }

    /// Adds a face that does not shine.
    pub(super) fn add_face(&mut self, face: Parallelogram, surface: Surface) {
        self.faces.push(Face { corners: face.corners(), surface, luminance_cd_m2: 0.0 });
    }
}

impl Parallelogram {
    pub(super) fn corners(&self) -> [DVec3; 4] {
        let Self { corner, u, v } = *self;
        [corner, corner + u, corner + u + v, corner + v]
    }

    /// Its image in a mirror through `place` with the unit normal `n`.
    pub(super) fn image(&self, place: DVec3, n: DVec3) -> Self {
        let turned = |v: DVec3| v - n * (2.0 * v.dot(n));
        Self { corner: place + turned(self.corner - place), u: turned(self.u), v: turned(self.v) }
    }
}

struct Fnv(u64);

impl Fnv {
    fn numbers(&mut self, numbers: &[f64]) {
        for byte in numbers.iter().flat_map(|number| number.to_bits().to_le_bytes()) {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    fn vector(&mut self, vector: DVec3) {
        self.numbers(&vector.to_array());
    }
}
