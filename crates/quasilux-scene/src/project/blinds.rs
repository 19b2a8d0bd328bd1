//! `[blinds]`, or `[[blinds]]` for several groups: what is before the windows while they are
//! closed, and when that is.

use super::document::Section;
use super::keys::{Key, optional};
use super::materials::{self, MaterialEntry};
use super::names::zone_name;
use super::{
    geometry_files,
    outside::{OutsideEntry, OutsideLight},
};
use crate::{LoadError, Spanned};

const GEOMETRY: Key = optional(
    "geometry",
    "list of file names",
    "none",
    "OBJ, glTF or GLB files that are there beside those of `[scene]` while they are closed",
);
const MATERIALS: Key = optional(
    "materials",
    "tables, as `[materials.NAME]`",
    "none",
    "What materials of the geometry are while they are closed",
);
pub(super) const KEYS: [Key; 8] = [
    optional("name", "text", "`\"blinds\"` if there is but one group", "The name of the group"),
    GEOMETRY,
    MATERIALS,
    optional(
        "states",
        "tables `[[blinds.states]]`",
        "one, `closed`",
        "Positions of the group beside open, at most 16, from open to closed; then `geometry` \
         and `materials` stand in each of them",
    ),
    optional(
        "control",
        "`\"lm83\"` or `\"schedule\"`",
        "`\"lm83\"`",
        "Closed while more than 2 % of the points get over 1000 lx straight from the sun, or by \
         a schedule",
    ),
    optional("sensor", "name of a sensor", "all sensors", "Whose points count, with `\"lm83\"`"),
    optional(
        "schedule",
        "file name",
        "none",
        "With `\"schedule\"`: a CSV file with a row for each interval of the weather file",
    ),
    optional(
        "column",
        "text",
        "none",
        "The column of `schedule`: 0 while they are open, 1 while they are closed; or numbers or \
         names of states",
    ),
];
pub(super) const STATE_KEYS: [Key; 3] = [
    optional("name", "text", "`\"closed\"` if there is but one", "The name of the state"),
    GEOMETRY,
    MATERIALS,
];
const EXPECTED_GEOMETRY: &str = "[\"slats.obj\"]: files that are there while they are closed";
/// Most groups, and positions of a group beside open.
const MAX_GROUPS: usize = 64;
const MAX_POSITIONS: usize = 16;

/// A group of blinds, as far as the project file says it.
#[derive(Clone, Debug)]
pub(crate) struct BlindsEntry {
    pub(crate) name: String,
    /// All but open.
    pub(crate) positions: Vec<PositionEntry>,
    pub(crate) rule: BlindsRule,
}

/// Where blinds may be.
#[derive(Clone, Debug)]
pub(crate) struct PositionEntry {
    pub(crate) name: String,
    /// Geometry that is there beside that of the scene.
    pub(crate) geometry: Vec<Spanned<String>>,
    /// Materials of the geometry while blinds are there.
    pub(crate) materials: Vec<MaterialEntry>,
}

/// When they are where.
#[derive(Clone, Debug)]
pub(crate) enum BlindsRule {
    Sunlight { sensor: Option<Spanned<String>> },
    Schedule { file: Spanned<String>, column: Spanned<String> },
}

/// The groups: none where there is no `[blinds]`, one of `[blinds]`, some of `[[blinds]]`.
pub(super) fn read(
    root: &Section<'_>,
    outside: Option<&OutsideEntry>,
    open: &[Spanned<String>],
) -> Result<Vec<BlindsEntry>, LoadError> {
    let sections = root.table_or_tables("blinds", MAX_GROUPS)?;
    let Some(first) = sections.first() else { return Ok(Vec::new()) };
    if !matches!(outside, Some(OutsideEntry { light: OutsideLight::Weather(_), .. })) {
        let message = "[blinds] goes with [sky] model = \"weather\": they move over a year";
        return Err(first.error(message));
    }
    let mut groups: Vec<BlindsEntry> = Vec::new();
    for section in &sections {
        let taken = groups.iter().map(|group| group.name.as_str());
        let name = zone_name(section, "blinds", sections.len(), taken)?;
        let group = group(section, name, open)?;
        expect_apart(section, &groups, &group)?;
        groups.push(group);
    }
    Ok(groups)
}

fn group(
    section: &Section<'_>,
    name: String,
    open: &[Spanned<String>],
) -> Result<BlindsEntry, LoadError> {
    section.only(&KEYS, &[])?;
    let states = section.tables("states")?;
    if states.is_empty() {
        let positions = vec![position(section, "closed".to_owned(), open)?];
        return Ok(BlindsEntry { name, positions, rule: rule(section)? });
    }
    let alone = ["geometry", "materials"].iter().find_map(|key| section.get(key));
    if let Some(value) = alone {
        let message =
            format!("\"{}\" stands in each of the states where there are some", value.key);
        return Err(value.error(message));
    }
    if let Some(state) = states.get(MAX_POSITIONS) {
        return Err(state.error(format!("more than {MAX_POSITIONS} states of one group")));
    }
    let mut positions: Vec<PositionEntry> = Vec::new();
    for state in &states {
        state.only(&STATE_KEYS, &[])?;
        let names = positions.iter().map(|position| position.name.as_str());
        let name = zone_name(state, "closed", states.len(), names.chain(["open"]))?;
        positions.push(position(state, name, open)?);
    }
    Ok(BlindsEntry { name, positions, rule: rule(section)? })
}

fn position(
    section: &Section<'_>,
    name: String,
    open: &[Spanned<String>],
) -> Result<PositionEntry, LoadError> {
    let list = section.get("geometry").map(|list| geometry_files(&list, EXPECTED_GEOMETRY));
    let geometry = list.transpose()?.unwrap_or_default();
    if let (Some(list), true) = (section.get("geometry"), geometry.iter().any(|it| is_in(open, it)))
    {
        let message = "a file of [scene] is listed again; list only what is there beside it";
        return Err(list.error(message));
    }
    let materials = section.table("materials")?;
    let materials = materials.map(|materials| materials::entries(&materials)).transpose()?;
    let materials = materials.unwrap_or_default();
    if geometry.is_empty() && materials.is_empty() {
        let message = "closed blinds are the same as open ones; add geometry that is there while \
                       they are closed, or [blinds.materials.NAME], what a material is then";
        return Err(section.error(message));
    }
    Ok(PositionEntry { name, geometry, materials })
}

/// Refuses a group that has files or changes materials which an earlier one has.
fn expect_apart(
    section: &Section<'_>,
    groups: &[BlindsEntry],
    group: &BlindsEntry,
) -> Result<(), LoadError> {
    for other in groups {
        for theirs in &other.positions {
            for own in &group.positions {
                let file = own.geometry.iter().find(|file| is_in(&theirs.geometry, file));
                let has = |name: &str| theirs.materials.iter().any(|it| it.name.value == name);
                let material = own.materials.iter().find(|it| has(&it.name.value));
                let shared = file.or(material.map(|it| &it.name));
                if let Some(shared) = shared {
                    return Err(section.error(format!(
                        "\"{}\" is of the blinds \"{}\", too; give each group files and materials \
                         of its own",
                        shared.value, other.name
                    )));
                }
            }
        }
    }
    Ok(())
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
