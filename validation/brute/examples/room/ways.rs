//! How the light of a room is found.
//!
//! ```toml
//! hint_share = 0.5                # of paths from the sensors
//! late_hint_share = 0.2
//! aim_share = 0.5                 # of walks from the lights
//! disc_radius_m = 0.1             # of each point, for light that only photons bring
//! hints = [{ corner = [0, 0, 0], u = [1, 0, 0], v = [0, 1, 0] }, { sun = 0.4 }]
//! aims = []
//! openings = []
//! depths = [[[0, 0, 0], [1, 1, 1]]]    # boxes where walks are copied
//! copies = 4.0
//! [[parts]]
//! sources = ["0", "1", "emitters", "sky", "sun"]    # or "lights", all of them
//! mode = "paths"                  # or "joins", "beams", "keyholes", "photons"
//! ```
//!
//! A lookout is a parallelogram, with `low` and `high` for the box that looks there, or the sun
//! with a half angle in degrees.

use super::project::{as_vector, vector};
use quasilux_brute::{Extent, Lookout, Mode, Part, Scene, Source};
use toml::{Table, Value};

/// What shines, by which mode.
pub(super) struct Ways {
    pub(super) parts: Vec<Part>,
}

impl Ways {
    /// Reads the text, and tells the scene where to look.
    pub(super) fn read(text: &str, scene: &mut Scene) -> Result<Self, String> {
        let table: Table = text.parse().map_err(|error| format!("{error}"))?;
        let share = |key: &str| table.get(key).and_then(Value::as_float).unwrap_or(0.0);
        scene.hint_share = share("hint_share");
        scene.late_hint_share = share("late_hint_share");
        scene.aim_share = share("aim_share");
        scene.hints = lookouts(&table, "hints", scene)?;
        scene.aims = lookouts(&table, "aims", scene)?;
        scene.openings = lookouts(&table, "openings", scene)?;
        scene.copies = share("copies") as u32;
        let boxes = table.get("depths").and_then(Value::as_array);
        for depth in boxes.into_iter().flatten() {
            let corner = |number| depth.get(number).and_then(as_vector);
            let corners = corner(0).zip(corner(1)).ok_or("a depth is a box by two corners")?;
            scene.depths.push([corners.0, corners.1]);
        }
        let disc_radius_m = share("disc_radius_m");
        for sensor in &mut scene.sensors {
            if !matches!(sensor.extent, Extent::Cell { .. }) {
                sensor.extent = Extent::Point { disc_radius_m };
            }
        }
        let parts = table.get("parts").and_then(Value::as_array).ok_or("expected [[parts]]")?;
        Ok(Self { parts: parts.iter().map(|it| part(it, scene)).collect::<Result<_, _>>()? })
    }
}

fn lookouts(table: &Table, key: &str, scene: &Scene) -> Result<Vec<Lookout>, String> {
    let lookouts = table.get(key).and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    lookouts.iter().map(|it| lookout(it, scene)).collect()
}

fn lookout(value: &Value, scene: &Scene) -> Result<Lookout, String> {
    if let Some(half_angle_deg) = value.get("sun").and_then(Value::as_float) {
        let sun = scene.sun.ok_or("there is no sun")?;
        return Ok(Lookout::around(sun.direction, half_angle_deg.to_radians()));
    }
    let whole = Lookout::new(vector(value, "corner")?, vector(value, "u")?, vector(value, "v")?);
    let edge = |key: &str| value.get(key).and_then(as_vector);
    Ok(match (edge("low"), edge("high")) {
        (Some(low), Some(high)) => whole.from_within(low, high),
        _ => whole,
    })
}

fn part(part: &Value, scene: &Scene) -> Result<Part, String> {
    let mode = match part.get("mode").and_then(Value::as_str) {
        Some("paths") => Mode::Paths,
        Some("joins") => Mode::Joins,
        Some("beams") => Mode::BeamsAndJoins,
        Some("keyholes") => Mode::KeyholesAndJoins,
        Some("photons") => Mode::Photons,
        _ => return Err("mode is paths, joins, beams, keyholes or photons".to_owned()),
    };
    let mut sources = Vec::new();
    for name in part.get("sources").and_then(Value::as_array).into_iter().flatten() {
        match name.as_str().unwrap_or_default() {
            "lights" => sources.extend((0..scene.lights.len()).map(Source::Light)),
            "emitters" => sources.push(Source::Emitters),
            "sky" => sources.push(Source::Sky),
            "sun" => sources.push(Source::Sun),
            number => sources.push(Source::Light(
                number.parse().map_err(|_| format!("no source is named {number}"))?,
            )),
        }
    }
    Ok(Part { sources, mode })
}
