//! `[blinds]`: what is before the windows while they are closed, and when that is.

use super::document::Section;
use super::materials::{self, MaterialEntry};
use super::{
    geometry_files,
    outside::{OutsideEntry, OutsideLight},
};
use crate::{LoadError, Spanned};

const KEYS: [&str; 6] = ["geometry", "materials", "control", "sensor", "schedule", "column"];
const EXPECTED_GEOMETRY: &str = "[\"slats.obj\"]: files that are there while they are closed";

/// Blinds, as far as the project file says it.
#[derive(Clone, Debug)]
pub(crate) struct BlindsEntry {
    /// What is there beside the geometry of the scene.
    pub(crate) geometry: Vec<Spanned<String>>,
    /// What materials of the geometry are while blinds are closed.
    pub(crate) materials: Vec<MaterialEntry>,
    pub(crate) rule: BlindsRule,
}

/// When they are closed.
#[derive(Clone, Debug)]
pub(crate) enum BlindsRule {
    Sunlight { sensor: Option<Spanned<String>> },
    Schedule { file: Spanned<String>, column: Spanned<String> },
}

/// `None` where there is no `[blinds]`.
pub(super) fn read(
    root: &Section<'_>,
    outside: Option<&OutsideEntry>,
    open: &[Spanned<String>],
) -> Result<Option<BlindsEntry>, LoadError> {
    let Some(section) = root.table("blinds")? else { return Ok(None) };
    if !matches!(outside, Some(OutsideEntry { light: OutsideLight::Weather(_), .. })) {
        let message = "[blinds] goes with [sky] model = \"weather\": they move over a year";
        return Err(section.error(message));
    }
    section.only(&KEYS, &[])?;
    let list = section.get("geometry").map(|list| geometry_files(&list, EXPECTED_GEOMETRY));
    let geometry = list.transpose()?.unwrap_or_default();
    if let (Some(list), true) = (section.get("geometry"), geometry.iter().any(|it| is_in(open, it)))
    {
        let message = "a file of [scene] is listed again; expected what is there beside it";
        return Err(list.error(message));
    }
    let materials = section.table("materials")?;
    let materials = materials.map(|materials| materials::entries(&materials)).transpose()?;
    let materials = materials.unwrap_or_default();
    if geometry.is_empty() && materials.is_empty() {
        let message = "closed blinds are the same as open ones; expected geometry that is there \
                       while they are closed, or [blinds.materials.NAME], what a material is then";
        return Err(section.error(message));
    }
    Ok(Some(BlindsEntry { geometry, materials, rule: rule(&section)? }))
}

fn rule(section: &Section<'_>) -> Result<BlindsRule, LoadError> {
    let control = section.get("control").map(|it| it.name(&["lm83", "schedule"], &[]));
    let control = control.transpose()?.unwrap_or("lm83");
    let goes_with =
        |keys: &[&'static str], other: &str| match keys.iter().find_map(|key| section.get(key)) {
            Some(value) => {
                let message = format!("\"{}\" goes with control = \"{other}\"", value.key);
                Err(value.error(message))
            }
            None => Ok(()),
        };
    let text = |key, expected: &str| {
        let value = section.require(key, expected)?;
        Ok::<_, LoadError>(value.spanned(value.string(expected)?.to_owned()))
    };
    if control == "lm83" {
        goes_with(&["schedule", "column"], "schedule")?;
        let sensor = section.get("sensor").map(|_| text("sensor", "the name of a sensor"));
        return Ok(BlindsRule::Sunlight { sensor: sensor.transpose()? });
    }
    goes_with(&["sensor"], "lm83")?;
    let file = text("schedule", "the name of a CSV file with a row for each interval")?;
    let column = text("column", "the name of its column: 1 while they are closed, 0 while open")?;
    Ok(BlindsRule::Schedule { file, column })
}

fn is_in(all: &[Spanned<String>], file: &Spanned<String>) -> bool {
    all.iter().any(|other| other.value == file.value)
}
