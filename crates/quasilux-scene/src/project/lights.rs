//! `[[lights]]`: isotropic points and emitting materials.

use super::document::Section;
use super::keys::{Key, POSITION, optional, required};
use crate::light::PointLight;
use crate::{LoadError, Spanned};
use quasilux_text::Position;

const KIND: Key = required("kind", "`\"point\"` or `\"area\"`", "Which of the two it is");
pub(super) const POINT_KEYS: [Key; 3] = [
    KIND,
    required("position", POSITION, "Where it is"),
    required("intensity_cd", "cd, 0 to 1e60", "Its luminous intensity, the same in all directions"),
];
pub(super) const AREA_KEYS: [Key; 4] = [
    KIND,
    required(
        "material",
        "name of a material",
        "Every triangle of this material in the geometry shines from its front side",
    ),
    optional(
        "luminance_cd_m2",
        "cd/m2, 0 to 1e60",
        "from `flux_lm`",
        "Its luminance, the same in all directions; this or `flux_lm`",
    ),
    optional(
        "flux_lm",
        "lm, 0 to 1e60",
        "from `luminance_cd_m2`",
        "The luminous flux of all its triangles together",
    ),
];

/// Largest intensity, luminance or flux that a project file may give; far from overflow.
const MAX_LIGHT: f64 = 1e60;

/// One light.
#[derive(Clone, Debug)]
pub(crate) enum LightEntry {
    Point { place: Position, light: PointLight },
    Area { material: Spanned<String>, emission: Emission },
}

/// How the project file gives the light of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Emission {
    /// Luminance of each front side in cd/m^2.
    LuminanceCdM2(f64),
    /// Flux of all triangles together in lm.
    FluxLm(f64),
}

impl LightEntry {
    pub(crate) fn place(&self) -> Position {
        match self {
            Self::Point { place, .. } => *place,
            Self::Area { material, .. } => material.place,
        }
    }
}

pub(super) fn read(root: &Section<'_>) -> Result<Vec<LightEntry>, LoadError> {
    root.tables("lights")?.iter().map(light).collect()
}

fn light(section: &Section<'_>) -> Result<LightEntry, LoadError> {
    let kind = section.require("kind", "\"point\" or \"area\"")?;
    let planned = ["directional", "distant", "environment", "sky", "spot", "sun"];
    match kind.name(&["point", "area"], &planned)? {
        "point" => point(section),
        _ => area(section),
    }
}

fn point(section: &Section<'_>) -> Result<LightEntry, LoadError> {
    section.only(&POINT_KEYS, &[])?;
    let position = "a position [x, y, z] in m";
    let position = section.require("position", position)?.position_m(position)?;
    let intensity = "a luminous intensity in cd, at least 0";
    let intensity_cd = section
        .require("intensity_cd", intensity)?
        .number(intensity, |x| (0.0..=MAX_LIGHT).contains(&x))?;
    Ok(LightEntry::Point { place: section.place(), light: PointLight { position, intensity_cd } })
}

fn area(section: &Section<'_>) -> Result<LightEntry, LoadError> {
    section.only(&AREA_KEYS, &[])?;
    let name = "the name of a material in the geometry";
    let material = section.require("material", name)?;
    let material = material.spanned(material.string(name)?.to_owned());
    let amount = section.exactly_one(&["luminance_cd_m2", "flux_lm"])?;
    let number = |what: &str| amount.number(what, |x| (0.0..=MAX_LIGHT).contains(&x));
    let emission = match amount.key {
        "flux_lm" => Emission::FluxLm(number("a luminous flux in lm, at least 0")?),
        _ => Emission::LuminanceCdM2(number("a luminance in cd/m^2, at least 0")?),
    };
    Ok(LightEntry::Area { material, emission })
}
