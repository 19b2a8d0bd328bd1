//! Plans and parts of a run that is spread over machines.
//!
//! A plan is a readable file that says all about a run of a fixed number of samples: scene,
//! settings, and what surveys and pilots decided. A part has the plan within it, and the sums of a
//! range of indices.

use crate::build::{self, BUILD, VERSION};
use crate::container::{self, Contents};
use crate::digest::{BYTES, SceneIdentity, hex, sha256_hex};
use crate::exit::CliError;
use crate::input;
use crate::project::{Project, kept_settings};
use quasilux_report::json;
use quasilux_scene::Position;
use quasilux_scene::project::{REFUSED_KEYS, RefusedKey};
use quasilux_transport::{Decisions, Settings};
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Name and version of the format of plans.
const PLAN_FORMAT: &str = "quasilux-plan/1";
/// Name and version of the format of parts.
pub(crate) const PART_FORMAT: &str = "quasilux-part/1";

/// All about a run of a fixed number of samples.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Plan {
    format: String,
    version: String,
    build: String,
    /// As it was given where the plan was made.
    pub(crate) project: PathBuf,
    scene: SceneIdentity,
    /// Indices per replicate.
    pub(crate) samples: u64,
    settings: Settings,
    decisions: DecisionsRecord,
    /// Of all the above but for the project's path.
    pub(crate) sha256: String,
}

/// What surveys and pilots decided.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct DecisionsRecord {
    connected_photons: Option<u64>,
    importance: bool,
    first_shot: bool,
    map_elements: Option<u64>,
    caustic_photons: Option<u64>,
    sha256: String,
}

/// A part that was read.
#[derive(Debug)]
pub(crate) struct Part {
    /// What messages call its file.
    pub(crate) name: String,
    pub(crate) plan: Plan,
    pub(crate) range: Range<u64>,
    pub(crate) sums: Vec<u8>,
}

/// What a part says of itself.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct PartHeading {
    plan: Plan,
    index_range: [u64; 2],
}

impl Plan {
    /// Of a project and settings with a number of samples.
    pub(crate) fn new(
        path: &Path,
        project: &Project,
        settings: &Settings,
        samples: u64,
        decisions: &Decisions,
    ) -> Self {
        let Decisions {
            connected_photons,
            uses_importance,
            first_shot,
            map_elements,
            caustic_photons,
            digest,
        } = decisions;
        let decisions = DecisionsRecord {
            connected_photons: *connected_photons,
            importance: *uses_importance,
            first_shot: *first_shot,
            map_elements: *map_elements,
            caustic_photons: *caustic_photons,
            sha256: hex(digest),
        };
        let plan = Self {
            format: PLAN_FORMAT.to_owned(),
            version: VERSION.to_owned(),
            build: BUILD.to_owned(),
            project: path.to_owned(),
            scene: project.identity.clone(),
            samples,
            settings: settings.clone(),
            decisions,
            sha256: String::new(),
        };
        Self { sha256: plan.digest(), ..plan }
    }

    /// Reads a plan; `path` is what messages call it.
    pub(crate) fn read(path: &Path) -> Result<Self, CliError> {
        let name = path.display();
        let bytes = input::read(path, input::MAX_PLAN_BYTES)
            .map_err(|error| CliError::in_file(&name, None, error))?;
        let plan: Self = serde_json::from_slice(&bytes).map_err(|error| {
            CliError::in_file(&name, place_of(&error), why_no_plan(&bytes, &error))
        })?;
        plan.check().map_err(|what| CliError::in_file(&name, None, what))?;
        Ok(plan)
    }

    /// The plan as a file.
    pub(crate) fn text(&self) -> String {
        json::text(self)
    }

    /// The settings of the run; refuses projects that have changed since. `name` is what messages
    /// call the file that the plan stands in.
    pub(crate) fn settings(&self, name: &str, project: &Project) -> Result<Settings, CliError> {
        if let Some(change) = project.identity.difference(&self.scene) {
            return Err(CliError::new(format!(
                "{name}: was made for another scene than {}: {change}",
                project.name
            )));
        }
        kept_settings(&self.settings, name, project)
    }

    /// Refuses sums that come from other decisions of surveys and pilots, which stand at their
    /// front.
    pub(crate) fn expect_decisions(&self, sums: &[u8], name: &str) -> Result<(), CliError> {
        let decided = sums.first_chunk::<BYTES>().map(|digest| hex(digest));
        if decided.as_ref() == Some(&self.decisions.sha256) {
            return Ok(());
        }
        Err(CliError::new(format!(
            "{name}: this build decides otherwise than the plan recorded; make the plan again with \
             this version"
        )))
    }

    /// What is wrong with it by itself.
    fn check(&self) -> Result<(), String> {
        if self.format != PLAN_FORMAT {
            return Err(format!("has the format {}, expected {PLAN_FORMAT}", self.format));
        }
        build::expect(&self.version, &self.build)?;
        if self.digest() != self.sha256 {
            return Err("was changed after it was made: its sha256 differs".to_owned());
        }
        Ok(())
    }

    fn digest(&self) -> String {
        let Self {
            format,
            version,
            build,
            project: _,
            scene,
            samples,
            settings,
            decisions,
            sha256: _,
        } = self;
        let content = (format, version, build, &scene.sha256, samples, settings, decisions);
        sha256_hex(json::text(&content).as_bytes())
    }
}

/// Why bytes are not a plan: a setting that has another name now, or what the parser found.
fn why_no_plan(bytes: &[u8], error: &serde_json::Error) -> String {
    let document: serde_json::Value = serde_json::from_slice(bytes).unwrap_or_default();
    let refused = REFUSED_KEYS.iter().find(|key| document["settings"].get(key.old).is_some());
    match refused {
        Some(RefusedKey { old, now }) => format!("the setting \"{old}\" {now}"),
        None => {
            let text = error.to_string();
            let end = format!(" at line {} column {}", error.line(), error.column());
            format!("is no plan: {}", text.strip_suffix(&end).unwrap_or(&text))
        }
    }
}

/// Where the parser stopped, if it knows.
fn place_of(error: &serde_json::Error) -> Option<Position> {
    (error.line() > 0).then(|| Position { line: error.line(), column: error.column().max(1) })
}

/// The bytes of a part.
pub(crate) fn part(plan: &Plan, range: &Range<u64>, sums: &[u8]) -> Vec<u8> {
    let heading = PartHeading { plan: plan.clone(), index_range: [range.start, range.end] };
    container::encode(PART_FORMAT, &json::text(&heading), sums)
}

impl Part {
    /// Reads a part.
    pub(crate) fn read(path: &Path) -> Result<Self, CliError> {
        let name = path.display().to_string();
        let bytes =
            container::read(path).map_err(|error| CliError::new(format!("{name}: {error}")))?;
        Self::parse(&name, &bytes).map_err(|what| CliError::new(format!("{name}: {what}")))
    }

    /// A part from the bytes of its file.
    fn parse(name: &str, bytes: &[u8]) -> Result<Self, String> {
        let Contents { header, body } = container::decode(PART_FORMAT, bytes)?;
        let heading: PartHeading =
            serde_json::from_str(header).map_err(|error| format!("its header: {error}"))?;
        let PartHeading { plan, index_range: [start, end] } = heading;
        plan.check()?;
        if start >= end || end > plan.samples {
            return Err(format!("says indices {start}..{end}, of {} in all", plan.samples));
        }
        Ok(Self { name: name.to_owned(), plan, range: start..end, sums: body.to_vec() })
    }
}

/// Sorts parts by their indices, and refuses what does not make a run: parts of other plans, gaps
/// and overlaps.
pub(crate) fn in_order(mut parts: Vec<Part>) -> Result<Vec<Part>, CliError> {
    parts.sort_by_key(|part| (part.range.start, part.range.end));
    let Some(first) = parts.first() else { return Err(CliError::new("no parts")) };
    let samples = first.plan.samples;
    if let Some(other) = parts.iter().find(|part| part.plan.sha256 != first.plan.sha256) {
        let what = other.plan.differs_in(&first.plan);
        return Err(CliError::new(format!(
            "{} and {} belong to different runs: {what} differs",
            first.name, other.name
        )));
    }
    if first.range.start > 0 {
        return Err(gap(0..first.range.start, &format!("before {}", first.name)));
    }
    for pair in parts.windows(2) {
        let [before, after] = pair else { continue };
        if after.range.start < before.range.end {
            return Err(CliError::new(format!(
                "{} and {} overlap: {} to {}, and {} to {}",
                before.name,
                after.name,
                before.range.start,
                before.range.end - 1,
                after.range.start,
                after.range.end - 1
            )));
        }
        if after.range.start > before.range.end {
            let place = format!("between {} and {}", before.name, after.name);
            return Err(gap(before.range.end..after.range.start, &place));
        }
    }
    match parts.last() {
        Some(last) if last.range.end < samples => {
            Err(gap(last.range.end..samples, &format!("after {}", last.name)))
        }
        _ => Ok(parts),
    }
}

fn gap(range: Range<u64>, place: &str) -> CliError {
    CliError::new(format!("{place}, the indices {} to {} are missing", range.start, range.end - 1))
}

impl Plan {
    /// The first thing in which two plans differ, in words.
    fn differs_in(&self, other: &Self) -> &'static str {
        if self.version != other.version {
            "the version of the program"
        } else if self.build != other.build {
            "the build of the program"
        } else if self.scene.sha256 != other.scene.sha256 {
            "the scene"
        } else if self.samples != other.samples {
            "the number of samples"
        } else if self.settings != other.settings {
            "a setting"
        } else {
            "what pilots decided"
        }
    }
}
