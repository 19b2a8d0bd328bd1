//! `[simulation]`: what the project file asks of the engine.
//!
//! Values keep their places: the crates above know which estimators and sequences exist, and
//! refuse a name with the line that gives it.

use super::document::{Section, Value};
use super::keys::{Key, optional};
use super::renamed::REFUSED_KEYS;
use crate::{LoadError, Spanned};
use std::ops::RangeInclusive;

const SWITCH: &str = "`\"auto\"`, `\"on\"` or `\"off\"`";
const TOLERANCE: &str = "share, above 0, at most 0.5, or per cent as text";
pub(super) const KEYS: [Key; 22] = [
    optional(
        "estimator",
        "`\"auto\"`, `\"bidirectional\"`, `\"path\"`, `\"photon\"` or `\"bidirectional-map\"`",
        "`\"auto\"`",
        "How light is traced; `\"auto\"` is `\"bidirectional\"`, the others are for research",
    ),
    optional(
        "sequence",
        "`\"sobol\"`, `\"halton\"`, `\"hammersley\"`, `\"faure4\"` or `\"random\"`",
        "`\"sobol\"`",
        "The points that drive the simulation",
    ),
    optional(
        "randomization",
        "`\"owen\"`, `\"shift\"`, `\"rotation\"` or `\"none\"`",
        "`\"owen\"`",
        "How replicates are made independent; without, there are no intervals",
    ),
    optional(
        "rel_tol",
        TOLERANCE,
        "`0.01`",
        "Half-width of the interval over the value, for each sensor point",
    ),
    optional("abs_tol", "lx, above 0", "none", "A half-width that is enough, whatever the value"),
    optional(
        "unseen_tol",
        "share, above 0, at most 0.5, per cent as text, or `\"off\"`",
        "`0.05`",
        "The bound on light that no sample met, over the value; at least `rel_tol`",
    ),
    optional(
        "tolerance_on",
        "`\"points\"` or `\"summary\"`",
        "`\"points\"`",
        "What has to reach the tolerance: every sensor point, or the average of every sensor",
    ),
    optional(
        "interval",
        "`\"student-t\"` or `\"certified\"`",
        "`\"student-t\"`",
        "With `\"certified\"` there are also limits that hold for any number of samples",
    ),
    optional("confidence", "share, between 0 and 1", "`0.95`", "Of all intervals"),
    optional(
        "replicates",
        "1 to 65536",
        "`16`",
        "Repetitions of the whole simulation, from whose spread intervals come",
    ),
    optional("seed", "integer, 0 to 2^64 - 1", "`1`", "Other seeds give other samples"),
    optional(
        "max_bounces",
        "`\"unlimited\"`, or integer",
        "`\"unlimited\"`",
        "Bounces after which light is cut; 0 leaves the direct light",
    ),
    optional(
        "list_terms",
        "1 to 16",
        "none",
        "Tells light of 0, 1, 2, .. bounces apart, so many terms beside the rest",
    ),
    optional(
        "first_shot",
        SWITCH,
        "`\"auto\"`",
        "Whether photons for maps leave lit places instead of point-like lights",
    ),
    optional(
        "map_element_m",
        "m, above 0",
        "from the size of the scene",
        "Longest edge of an element of the illumination map before any is split",
    ),
    optional("map_elements", "1 to 2^31 - 1", "`4194304`", "Most elements of the illumination map"),
    optional(
        "map_adaptive",
        "`true` or `false`",
        "`true`",
        "Whether elements are split where the illumination varies",
    ),
    optional(
        "map_reconstruction",
        "`\"linear\"` or `\"constant\"`",
        "`\"linear\"`",
        "What is made of the photons in an element",
    ),
    optional(
        "map_photons",
        "1 to 2^20",
        "`1`",
        "Photons of a map for every path of a sensor point",
    ),
    optional(
        "map_dimensions",
        "1 to 2^32 - 1",
        "none",
        "Coordinates that a photon on a map may have used; later ones are left out, with their \
         light",
    ),
    optional(
        "image_depth",
        "0 to 1000",
        "as many as matter",
        "Mirrors in a row through which images of point-like lights are followed",
    ),
    optional(
        "importance",
        SWITCH,
        "`\"auto\"`",
        "Whether photons are split where they matter to the sensors, and paths led to openings",
    ),
];

/// Larger tolerances are written with a percent sign.
const MAX_BARE_TOLERANCE: f64 = 0.5;
/// Most replicates that a project file may ask for.
const MAX_REPLICATES: u64 = 65_536;
/// Most terms that can be listed.
const MAX_TERMS: u64 = 16;
/// Most photons of a map for every path of a sensor point.
const MAX_MAP_PHOTONS: u64 = 1 << 20;
/// Most elements that an illumination map can have.
const MAX_MAP_ELEMENTS: u64 = (1 << 31) - 1;

/// Most mirrors in a chain that a project file may ask for.
const MAX_IMAGE_DEPTH: u64 = 1000;

/// The `[simulation]` table; what the file does not give is `None`. Numbers are in range, names
/// are unchecked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SimulationSection {
    file: String,
    /// Name of the estimator.
    pub estimator: Option<Spanned<String>>,
    /// Name of the sequence.
    pub sequence: Option<Spanned<String>>,
    /// Name of the randomisation.
    pub randomization: Option<Spanned<String>>,
    /// Wanted half-width over value, in (0, 1]; above one half only where the file writes it with a
    /// percent sign.
    pub rel_tol: Option<Spanned<f64>>,
    /// Half-width in lx that is enough, above 0.
    pub abs_tol_lx: Option<Spanned<f64>>,
    /// Wanted bound on unseen light over value, as `rel_tol`; the inner `None` is `"off"`.
    pub unseen_tol: Option<Spanned<Option<f64>>>,
    /// Name of what has to reach the tolerance.
    pub tolerance_on: Option<Spanned<String>>,
    /// Name of the intervals that are reported.
    pub interval: Option<Spanned<String>>,
    /// Confidence level in (0, 1).
    pub confidence: Option<Spanned<f64>>,
    /// Number of independent randomisations, at least 1.
    pub replicates: Option<Spanned<u32>>,
    /// Seed of all randomisations.
    pub seed: Option<Spanned<u64>>,
    /// Bounces after which light is cut; the inner `None` is `"unlimited"`.
    pub max_bounces: Option<Spanned<Option<u32>>>,
    /// Terms of the Neumann series to list beside the rest, 1 to 16.
    pub list_terms: Option<Spanned<u32>>,
    /// Name of when the direct light of photons is computed.
    pub first_shot: Option<Spanned<String>>,
    /// Longest edge of an illumination map element in m, above 0.
    pub map_element_m: Option<Spanned<f64>>,
    /// Most elements of the illumination map, at least 1.
    pub map_elements: Option<Spanned<u64>>,
    /// Whether elements are split where the illumination varies.
    pub map_adaptive: Option<Spanned<bool>>,
    /// Name of what is made of the photons in an element.
    pub map_reconstruction: Option<Spanned<String>>,
    /// Photons of a map that grows for every path of a sensor point, at least 1.
    pub map_photons: Option<Spanned<u32>>,
    /// Coordinates that a photon on a map may have used, at least 1.
    pub map_dimensions: Option<Spanned<u32>>,
    /// Mirrors, one after the other, that images of point-like lights are followed through.
    pub image_depth: Option<Spanned<u32>>,
    /// Name of when photons follow the importance of the sensors.
    pub importance: Option<Spanned<String>>,
}

impl SimulationSection {
    /// The error that `message` describes, at the place of `at`.
    #[must_use]
    pub fn error_at<T>(&self, at: &Spanned<T>, message: impl Into<String>) -> LoadError {
        LoadError::new(&self.file, Some(at.place), message)
    }

    /// The error that refuses the name at `at`, which is not one of `known`: `what` says what it
    /// names, such as "estimator". Offers the nearest known name.
    #[must_use]
    pub fn unknown_name(&self, at: &Spanned<String>, what: &str, known: &[&str]) -> LoadError {
        let list = known.join(", ");
        self.error_at(at, format!("unknown {what} \"{}\"; expected one of {list}", at.value))
            .offer(&at.value, known.iter().copied())
    }
}

pub(super) fn read(file: &str, root: &Section<'_>) -> Result<SimulationSection, LoadError> {
    let file = file.to_owned();
    let Some(section) = root.table("simulation")? else {
        return Ok(SimulationSection { file, ..SimulationSection::default() });
    };
    section.refuse(&REFUSED_KEYS)?;
    section.only(&KEYS, &[])?;
    let name = |key| spanned(&section, key, |value| Ok(value.string("a name")?.to_owned()));
    let number = |key, expected: &str, accept: fn(f64) -> bool| {
        spanned(&section, key, |value| value.number(expected, accept))
    };
    let up_to = |key, range| integer(&section, key, range);
    Ok(SimulationSection {
        file,
        estimator: name("estimator")?,
        sequence: name("sequence")?,
        randomization: name("randomization")?,
        rel_tol: spanned(&section, "rel_tol", |value| tolerance(&value))?,
        abs_tol_lx: number("abs_tol", "an illuminance in lx above 0", |x| x > 0.0)?,
        unseen_tol: spanned(&section, "unseen_tol", |value| unseen_tolerance(&value))?,
        tolerance_on: name("tolerance_on")?,
        interval: name("interval")?,
        confidence: number("confidence", "a share between 0 and 1, such as 0.95", |x| {
            x > 0.0 && x < 1.0
        })?,
        replicates: up_to("replicates", 1..=MAX_REPLICATES)?,
        seed: spanned(&section, "seed", |value| {
            value.integer("an integer from 0 to 18446744073709551615", 0..=u64::MAX)
        })?,
        max_bounces: spanned(&section, "max_bounces", |value| bounces(&value))?,
        list_terms: up_to("list_terms", 1..=MAX_TERMS)?,
        first_shot: name("first_shot")?,
        map_element_m: number("map_element_m", "a length in m above 0", |x| x > 0.0)?,
        map_elements: spanned(&section, "map_elements", |value| {
            let expected = format!("an integer from 1 to {MAX_MAP_ELEMENTS}");
            value.integer(&expected, 1..=MAX_MAP_ELEMENTS)
        })?,
        map_adaptive: spanned(&section, "map_adaptive", |value| value.boolean())?,
        map_reconstruction: name("map_reconstruction")?,
        map_photons: up_to("map_photons", 1..=MAX_MAP_PHOTONS)?,
        map_dimensions: up_to("map_dimensions", 1..=u64::from(u32::MAX))?,
        image_depth: up_to("image_depth", 0..=MAX_IMAGE_DEPTH)?,
        importance: name("importance")?,
    })
}

/// An integer in a range that ends within `u32`.
fn integer<'a>(
    section: &Section<'a>,
    key: &'a str,
    range: RangeInclusive<u64>,
) -> Result<Option<Spanned<u32>>, LoadError> {
    spanned(section, key, |value| {
        let expected = format!("an integer from {} to {}", range.start(), range.end());
        value.integer(&expected, range.clone()).map(|n| n as u32)
    })
}

/// A share as a number, or with a percent sign as text.
pub(super) fn tolerance(value: &Value<'_>) -> Result<f64, LoadError> {
    let expected = "a share above 0, at most 0.5, such as 0.01, or percent, such as \"1%\"";
    share(value, "rel_tol", expected)
}

/// A share as a number, or with a percent sign as text; `None` where it is off.
fn unseen_tolerance(value: &Value<'_>) -> Result<Option<f64>, LoadError> {
    let expected =
        "a share above 0, at most 0.5, such as 0.05, or percent, such as \"5%\", or \"off\"";
    if value.is_string() && value.string(expected)? == "off" {
        return Ok(None);
    }
    share(value, "unseen_tol", expected).map(Some)
}

fn share(value: &Value<'_>, key: &str, expected: &str) -> Result<f64, LoadError> {
    if value.is_string() {
        let percent = value.string(expected)?.strip_suffix('%');
        return percent
            .and_then(|number| number.trim().parse::<f64>().ok())
            .map(|percent| percent / 100.0)
            .filter(|share| *share > 0.0 && *share <= 1.0)
            .ok_or_else(|| value.unexpected(expected));
    }
    let share = value.number(expected, |x| x > 0.0 && x <= 100.0)?;
    match doubt_of_tolerance(share) {
        None => Ok(share),
        Some(doubt) => Err(value.error(format!("\"{key}\": {doubt}"))),
    }
}

/// Question to ask where a tolerance is given as a bare number above one half: 1 stands for 100 %,
/// and whoever writes it mostly means 1 %.
#[must_use]
pub fn doubt_of_tolerance(share: f64) -> Option<String> {
    if share <= MAX_BARE_TOLERANCE {
        return None;
    }
    // Without the last digits, which are those of binary fractions.
    let short = |number: f64| (1e9 * number).round() / 1e9;
    let [percent, less] = [short(100.0 * share), short(share / 100.0)];
    let as_it_is = if share <= 1.0 { format!(", or {percent}% if not") } else { String::new() };
    Some(format!(
        "{share} stands for {percent} %: was {share} % meant? expected {less} or {share}%{as_it_is}"
    ))
}

fn bounces(value: &Value<'_>) -> Result<Option<u32>, LoadError> {
    if value.is_string() {
        return value.name(&["unlimited"], &[]).map(|_| None);
    }
    let expected = "\"unlimited\" or a number of bounces";
    value.integer(expected, 0..=u64::from(u32::MAX)).map(|n| Some(n as u32))
}

fn spanned<'a, T>(
    section: &Section<'a>,
    key: &'a str,
    read: impl Fn(Value<'a>) -> Result<T, LoadError>,
) -> Result<Option<Spanned<T>>, LoadError> {
    section.get(key).map(|value| Ok(value.spanned(read(value)?))).transpose()
}
