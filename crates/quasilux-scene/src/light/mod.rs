//! What emits light: a closed set, one file a kind.

mod area;
mod luminaire;
mod point;

pub use area::AreaLight;
pub use luminaire::{Luminaire, Placement, PlacementError};
pub use point::PointLight;

/// A light of a scene; all lights emit white light.
#[derive(Clone, Debug)]
pub enum Light {
    /// An isotropic point.
    Point(PointLight),
    /// A placed luminaire: a measured intensity distribution, from a point or a luminous shape.
    Luminaire(Luminaire),
    /// Emitting triangles.
    Area(AreaLight),
}

impl Light {
    /// Total emitted flux in lm.
    #[must_use]
    pub fn flux_lm(&self) -> f64 {
        match self {
            Self::Point(light) => light.flux_lm(),
            Self::Luminaire(light) => light.flux_lm(),
            Self::Area(light) => light.flux_lm(),
        }
    }
}
