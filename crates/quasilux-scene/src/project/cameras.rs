//! `[[cameras]]`: where pictures are taken from.

use super::document::{Section, Value};
use super::keys::{DIRECTION, Key, POSITION, optional, required};
use super::names::Names;
use super::simulation::tolerance;
use crate::{Camera, LoadError};
use glam::DVec3;
use quasilux_text::Position;

pub(super) const KEYS: [Key; 8] = [
    required("name", "text", "Also the name of its pictures; no other camera or sensor has it"),
    required("position", POSITION, "Where it stands"),
    required("target", POSITION, "The point in the middle of the picture"),
    optional(
        "up",
        DIRECTION,
        "`[0, 0, 1]`",
        "What points upward in the picture; not along the line of sight",
    ),
    required(
        "vertical_fov_deg",
        "degrees, between 0 and 180",
        "The angle between the upper and the lower edge of the picture",
    ),
    required(
        "resolution",
        "`[width, height]`, 1 to 16384 each",
        "Pixels, which are square; all cameras have at most 2^24",
    ),
    optional(
        "samples",
        "1 to 2^32",
        "`--samples`, or what `rel_tol` takes",
        "Paths a pixel in each replicate; beside `rel_tol`, at most",
    ),
    optional(
        "rel_tol",
        "share or per cent, as in `[simulation]`",
        "`0.05` where no number of samples is given",
        "How well the picture is to be known: half-width over luminance",
    ),
];

/// Most pixels along an edge.
const MAX_EDGE: u64 = 16_384;
/// Most pixels that all cameras of a project may have together.
const MAX_PIXELS: u64 = 1 << 24;
/// Most paths of a pixel in a replicate.
const MAX_SAMPLES: u64 = 1 << 32;
/// Sine of the smallest angle between `up` and the line of sight: a microradian.
const MIN_SINE: f64 = 1e-6;

/// One camera, and where it is.
#[derive(Clone, Debug)]
pub(crate) struct CameraEntry {
    pub(crate) place: Position,
    pub(crate) camera: Camera,
}

pub(super) fn read(root: &Section<'_>, names: &mut Names) -> Result<Vec<CameraEntry>, LoadError> {
    let mut pixels = 0;
    let read = |section: &Section<'_>| {
        section.only(&KEYS, &[])?;
        let camera = camera(section, names, &mut pixels)?;
        Ok(CameraEntry { place: section.place(), camera })
    };
    root.tables("cameras")?.iter().map(read).collect()
}

fn camera(section: &Section<'_>, names: &mut Names, pixels: &mut u64) -> Result<Camera, LoadError> {
    let name = names.of_camera(section)?;
    let position = "a position [x, y, z] in m";
    let at = |key| section.require(key, position)?.position_m(position);
    let (position, target) = (at("position")?, at("target")?);
    let Some(forward) = (target - position).try_normalize() else {
        let message = "\"target\" is \"position\"; expected another point, to look at";
        return Err(section.require("target", "a position")?.error(message));
    };
    let fov = "an angle in degrees between 0 and 180";
    let fov_deg = section
        .require("vertical_fov_deg", fov)?
        .number(fov, |fov_deg| fov_deg > 0.0 && fov_deg < 180.0)?;
    Ok(Camera {
        name,
        position,
        target,
        up: up(section, forward)?,
        vertical_fov_rad: fov_deg.to_radians(),
        resolution: resolution(section, pixels)?,
        samples: samples(section)?,
        rel_tol: rel_tol(section)?,
    })
}

fn samples(section: &Section<'_>) -> Result<Option<u64>, LoadError> {
    let expected = format!("a number of paths per pixel and replicate, 1 to {MAX_SAMPLES}");
    let samples = |value: Value<'_>| value.integer(&expected, 1..=MAX_SAMPLES);
    section.get("samples").map(samples).transpose()
}

fn rel_tol(section: &Section<'_>) -> Result<Option<f64>, LoadError> {
    section.get("rel_tol").map(|value| tolerance(&value)).transpose()
}

/// The direction that is given, or z.
fn up(section: &Section<'_>, forward: DVec3) -> Result<DVec3, LoadError> {
    let across = |up: DVec3| forward.cross(up).length() >= MIN_SINE;
    let Some(value) = section.get("up") else {
        return Some(DVec3::Z).filter(|up| across(*up)).ok_or_else(|| {
            section.error("the camera looks along the default \"up\", [0, 0, 1]; expected \"up\"")
        });
    };
    let expected = "a direction [x, y, z] with a length";
    let up = value.vector(expected)?.try_normalize().ok_or_else(|| value.unexpected(expected))?;
    Some(up).filter(|up| across(*up)).ok_or_else(|| {
        value.error(
            "\"up\" is parallel to the line from position to target; expected a direction across \
             it",
        )
    })
}

fn resolution(section: &Section<'_>, pixels: &mut u64) -> Result<[u32; 2], LoadError> {
    let expected = format!("[width, height] in pixels, 1 to {MAX_EDGE} each");
    let value = section.require("resolution", &expected)?;
    let edges = value.array(&expected)?;
    let [width, height] = edges.as_slice() else {
        return Err(value.unexpected(&expected));
    };
    let edge = |n: &Value<'_>| n.integer(&expected, 1..=MAX_EDGE);
    let [width, height] = [edge(width)?, edge(height)?];
    *pixels += width * height;
    if *pixels > MAX_PIXELS {
        return Err(value.error(format!(
            "the pictures have {pixels} pixels so far; expected at most {MAX_PIXELS} in all"
        )));
    }
    Ok([width as u32, height as u32])
}
