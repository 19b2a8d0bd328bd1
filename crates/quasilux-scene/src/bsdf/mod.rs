//! How a surface scatters light: a closed set, one file a kind.

mod angular_table;
mod conductor;
mod dielectric;
mod diffuse;
mod measured;
mod mirror;
mod pane;
mod plastic;
mod translucent;

pub use angular_table::{AngularNode, AngularTable};
pub use conductor::Conductor;
pub use dielectric::Dielectric;
pub use diffuse::Diffuse;
pub use measured::Measured;
pub use mirror::Mirror;
pub use pane::Pane;
pub use plastic::Plastic;
pub use translucent::Translucent;

use crate::Rgb;

/// How a surface scatters light. Both sides scatter alike, but for the inside of a
/// [`Bsdf::Dielectric`], those of a [`Bsdf::Measured`] and of a [`Pane::Measured`].
#[derive(Clone, Debug, PartialEq)]
pub enum Bsdf {
    /// Lambertian reflection.
    Diffuse(Diffuse),
    /// Perfect specular reflection.
    Mirror(Mirror),
    /// Lambertian reflection and transmission.
    Translucent(Translucent),
    /// The smooth surface of a clear body.
    Dielectric(Dielectric),
    /// A flat pane drawn as a single sheet.
    Pane(Pane),
    /// Rough metal.
    Conductor(Conductor),
    /// A diffuse base under a rough clear coat.
    Plastic(Plastic),
    /// A sheet of which tables were measured.
    Measured(Measured),
}

impl Bsdf {
    /// The name of the kind in a project file.
    #[must_use]
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Diffuse(_) | Self::Translucent(_) => "diffuse",
            Self::Mirror(_) => "mirror",
            Self::Dielectric(_) => "dielectric",
            Self::Pane(_) => "pane",
            Self::Conductor(_) => "conductor",
            Self::Plastic(_) => "plastic",
            Self::Measured(_) => "bsdf",
        }
    }

    /// Reflected over incident flux, where that is the same for all incident directions.
    #[must_use]
    pub const fn reflectance(&self) -> Option<Rgb> {
        match self {
            Self::Diffuse(diffuse) => Some(diffuse.reflectance),
            Self::Mirror(mirror) => Some(mirror.reflectance),
            Self::Translucent(translucent) => Some(translucent.reflectance),
            Self::Dielectric(_)
            | Self::Pane(_)
            | Self::Conductor(_)
            | Self::Plastic(_)
            | Self::Measured(_) => None,
        }
    }

    /// Whether it treats all channels alike.
    #[must_use]
    pub fn is_grey(&self) -> bool {
        match self {
            Self::Diffuse(diffuse) => diffuse.reflectance.is_grey(),
            Self::Mirror(mirror) => mirror.reflectance.is_grey(),
            Self::Translucent(translucent) => {
                translucent.reflectance.is_grey() && translucent.transmittance.is_grey()
            }
            Self::Dielectric(_) | Self::Pane(Pane::Clear { .. } | Pane::Measured { .. }) => true,
            Self::Pane(Pane::Tinted { transmittance, .. }) => transmittance.is_grey(),
            Self::Conductor(conductor) => conductor.reflectance.is_grey(),
            Self::Plastic(plastic) => plastic.reflectance.is_grey(),
            Self::Measured(measured) => measured.is_grey(),
        }
    }

    /// Whether light passes through to the other side.
    #[must_use]
    pub fn transmits(&self) -> bool {
        match self {
            Self::Translucent(_) | Self::Dielectric(_) | Self::Pane(_) => true,
            Self::Diffuse(_) | Self::Mirror(_) | Self::Conductor(_) | Self::Plastic(_) => false,
            Self::Measured(measured) => measured.transmits(),
        }
    }

    /// Of the light that meets it, the most that is not absorbed, for whatever direction but
    /// grazing ones: less than 1 where light ends.
    #[must_use]
    pub fn most_kept(&self) -> Rgb {
        match self {
            Self::Diffuse(diffuse) => diffuse.reflectance,
            Self::Mirror(mirror) => mirror.reflectance,
            Self::Translucent(translucent) => translucent.reflectance + translucent.transmittance,
            Self::Dielectric(_) => Rgb::WHITE,
            Self::Pane(pane) => pane.most_kept(),
            Self::Conductor(conductor) => conductor.reflectance,
            Self::Plastic(plastic) => plastic.reflectance,
            Self::Measured(measured) => Rgb::grey(measured.most_kept()),
        }
    }

    /// Whether it scatters light into single directions only.
    #[must_use]
    pub const fn is_specular(&self) -> bool {
        matches!(self, Self::Mirror(_) | Self::Dielectric(_) | Self::Pane(_))
    }
}
