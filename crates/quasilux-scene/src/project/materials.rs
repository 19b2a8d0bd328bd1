//! `[materials.NAME]`: what the project file says about the materials of the geometry.

use super::document::{Section, Value};
use crate::bsdf::{Diffuse, Mirror};
use crate::{Bsdf, LoadError, Placed, Rgb};

const PLANNED_KINDS: [&str; 8] =
    ["bsdf", "conductor", "dielectric", "glass", "glossy", "phong", "plastic", "translucent"];
const PLANNED_KEYS: [&str; 6] =
    ["bsdf", "eta", "roughness", "specular", "transmittance", "texture"];

/// One material.
#[derive(Clone, Debug)]
pub(crate) struct MaterialEntry {
    pub(crate) name: Placed<String>,
    pub(crate) bsdf: Bsdf,
}

pub(super) fn read(root: &Section<'_>) -> Result<Vec<MaterialEntry>, LoadError> {
    let Some(materials) = root.table("materials")? else {
        return Ok(Vec::new());
    };
    let entries = materials.entries().into_iter();
    entries
        .map(|(name, value)| {
            let section = value.section(format!("[materials.{}]", name.value))?;
            let name = Placed { value: name.value.to_owned(), place: name.place };
            Ok(MaterialEntry { name, bsdf: bsdf(&section)? })
        })
        .collect()
}

fn bsdf(section: &Section<'_>) -> Result<Bsdf, LoadError> {
    section.only(&["kind", "reflectance"], &PLANNED_KEYS)?;
    let kind = section.get("kind").map(|kind| kind.name(&["diffuse", "mirror"], &PLANNED_KINDS));
    let kind = kind.transpose()?.unwrap_or("diffuse");
    let reflectance =
        reflectance(section.require("reflectance", "a number or [r, g, b] within 0 to 1")?)?;
    Ok(match kind {
        "mirror" => Bsdf::Mirror(Mirror { reflectance }),
        _ => Bsdf::Diffuse(Diffuse { reflectance }),
    })
}

fn reflectance(value: Value<'_>) -> Result<Rgb, LoadError> {
    let expected = "a number or [r, g, b] within 0 to 1";
    let share = |value: &Value<'_>| value.number(expected, |x| (0.0..=1.0).contains(&x));
    match value.array(expected) {
        Err(_) => Ok(Rgb::grey(share(&value)?)),
        Ok(channels) => match channels.as_slice() {
            [r, g, b] => Ok(Rgb([share(r)?, share(g)?, share(b)?])),
            _ => Err(value.unexpected(expected)),
        },
    }
}
