//! What is in the folder, for programs.

use super::clock::Clock;
use super::light_paths::{LightPath, STATIC};
use crate::exit::CliError;
use crate::results::write_atomic;
use quasilux_scene::Sensor;
use serde_json::{Map, Value, json};
use std::path::Path;

/// Writes all documents of the results.
pub(super) fn write(
    folder: &Path,
    sensors: &[Sensor],
    paths: &[LightPath],
    clock: &Clock,
) -> Result<(), CliError> {
    let hours = clock.sun_up_h.iter().map(|hour| format!("{hour}\n")).collect::<String>();
    let study = json!({"timestep": clock.timestep, "study_hours": clock.study_h});
    for (name, text) in [
        ("grids_info.json", format!("{:#}\n", grids(sensors, paths))),
        ("grid_states.json", format!("{:#}\n", states(sensors, paths))),
        ("study_info.json", format!("{study}\n")),
        ("sun-up-hours.txt", hours),
    ] {
        write_atomic(&folder.join(name), text.as_bytes())?;
    }
    Ok(())
}

/// Grids, each of which all light paths reach.
pub(super) fn grids(sensors: &[Sensor], paths: &[LightPath]) -> Value {
    let names = [STATIC].into_iter().chain(paths.iter().map(|path| path.name.as_str()));
    let light_path: Vec<[&str; 1]> = names.map(|name| [name]).collect();
    let grid = |sensor: &Sensor| {
        let name = &sensor.name;
        json!({"name": name, "identifier": name, "full_id": name, "group": "",
               "count": sensor.len(), "light_path": light_path})
    };
    sensors.iter().map(grid).collect()
}

/// The folders of the states of each light path, by grid.
fn states(sensors: &[Sensor], paths: &[LightPath]) -> Value {
    if paths.is_empty() {
        return json!({});
    }
    let names = |path: &LightPath| -> Value {
        path.states.iter().map(|state| Value::from(state.as_str())).collect()
    };
    let of_grid: Map<String, Value> =
        paths.iter().map(|path| (path.name.clone(), names(path))).collect();
    let grids = sensors.iter().map(|sensor| (sensor.name.clone(), Value::from(of_grid.clone())));
    Value::Object(grids.collect())
}
