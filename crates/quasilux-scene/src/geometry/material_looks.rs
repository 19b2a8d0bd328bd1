//! Looks of Radiance's materials as materials of a geometry file.

use super::FileScattering;
use super::builder::{Look as FileLook, MeshBuilder};
use crate::radiance::{Look, Unusable};
use crate::{Rgb, Warning};

/// Notes what a material is made of.
pub(super) fn describe(
    number: u32,
    name: &str,
    look: Look,
    builder: &mut MeshBuilder,
    warnings: &mut Vec<Warning>,
) {
    let scattering = match look {
        Look::Surface(bsdf) => FileScattering::Described(bsdf),
        Look::Sheet { name, xml, up } => FileScattering::Sheet { name, xml, up },
        Look::Unknown(Unusable { message, place }) => {
            let message = format!("{message}, or [materials.{name:?}] in the project file");
            FileScattering::Unknown(Unusable { message, place })
        }
        Look::Light(_) => {
            let look = FileLook { reflectance: Rgb::BLACK, emits: true, is_clear: false };
            return builder.describe(number, look, warnings);
        }
        // There is nothing of it.
        Look::Open => return,
    };
    builder.describe_scattering(number, scattering, warnings);
}
