//! How a surface scatters light: a closed set, one file a kind.

mod diffuse;
mod mirror;

pub use diffuse::Diffuse;
pub use mirror::Mirror;

use crate::Rgb;

/// How a surface scatters light. Surfaces are two-sided: both sides scatter alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bsdf {
    /// Lambertian reflection.
    Diffuse(Diffuse),
    /// Perfect specular reflection.
    Mirror(Mirror),
}

impl Bsdf {
    /// The reflectance, channel by channel, the same for all incident directions.
    #[must_use]
    pub fn reflectance(&self) -> Rgb {
        match self {
            Self::Diffuse(diffuse) => diffuse.reflectance,
            Self::Mirror(mirror) => mirror.reflectance,
        }
    }
}
