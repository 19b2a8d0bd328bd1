//! Names of sensors and cameras: they become names of result files, so they are unique together.
//! Names of groups of blinds and of zones of electric light.

use super::document::Section;
use crate::{Camera, LoadError};
use std::collections::HashMap;

/// Longest name in bytes.
const MAX_BYTES: usize = 100;

/// The names that are taken, in lower case: some file systems do not tell cases apart.
#[derive(Default)]
pub(super) struct Names {
    takers: HashMap<String, Taker>,
}

/// Owner of a name: `sensor "desk" on line 9`.
struct Taker {
    kind: &'static str,
    name: String,
    line: usize,
}

impl Names {
    /// The name of a sensor.
    pub(super) fn of_sensor(&mut self, section: &Section<'_>) -> Result<String, LoadError> {
        self.take(section, "sensor", &[""])
    }

    /// The name of a camera, which takes that of its second picture too.
    pub(super) fn of_camera(&mut self, section: &Section<'_>) -> Result<String, LoadError> {
        self.take(section, "camera", &["", Camera::FALSE_COLOUR_ENDING])
    }

    fn take(
        &mut self,
        section: &Section<'_>,
        kind: &'static str,
        endings: &[&str],
    ) -> Result<String, LoadError> {
        let expected = format!("a name for the {kind} and its result files");
        let value = section.require("name", &expected)?;
        let name = value.string(&expected)?;
        if !is_file_name(name) {
            return Err(value.unexpected(
                "a name that can be a file name: up to 100 bytes without / \\ : * ? \" < > |",
            ));
        }
        for ending in endings {
            let file = format!("{name}{ending}").to_lowercase();
            if let Some(taker) = self.takers.get(&file) {
                return Err(value.error(format!(
                    "the {kind} would write files of the same name as the {} \"{}\" on line {}; \
                     expected names that are unique among sensors and cameras, whatever their case",
                    taker.kind, taker.name, taker.line
                )));
            }
            let line = section.place().line;
            self.takers.insert(file, Taker { kind, name: name.to_owned(), line });
        }
        Ok(name.to_owned())
    }
}

/// Whether a name can be the name of a file on every system.
#[must_use]
pub fn is_file_name(name: &str) -> bool {
    let forbidden = |c: char| c.is_control() || "/\\:*?\"<>|".contains(c);
    let reserved = ["con", "prn", "aux", "nul"].iter().any(|word| name.eq_ignore_ascii_case(word));
    let edges = name.starts_with(['.', ' ', '-']) || name.ends_with(['.', ' ']);
    !(name.is_empty() || name.len() > MAX_BYTES || name.contains(forbidden) || edges || reserved)
}

/// The name of one of several groups or zones, which others have not taken; one alone may do
/// without.
pub(super) fn zone_name<'t>(
    section: &Section<'_>,
    usual: &str,
    count: usize,
    mut taken: impl Iterator<Item = &'t str>,
) -> Result<String, LoadError> {
    let expected = "a name for each of them";
    let value = match section.get("name") {
        Some(value) => value,
        None if count == 1 => return Ok(usual.to_owned()),
        None => section.require("name", expected)?,
    };
    let name = value.string(expected)?;
    if name.is_empty() || taken.any(|other| other == name) {
        return Err(value.unexpected("a name that is not empty and that no other has"));
    }
    Ok(name.to_owned())
}
