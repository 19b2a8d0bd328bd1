//! Honeybee models: imported, and given to commands as they are.

use crate::support::{Folder, illuminances, number, parsed};
use serde_json::{Value, json};

/// Type C, absolute: 1000 cd in all directions of the lower half.
const LAMP: &str = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] none\nTILT=NONE\n\
    1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n1000 1000\n";

/// Some hours of two days: illuminances of sun and sky.
const WEATHER: &str = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\n\
    site_elevation 2\nweather_data_file_units 3\n3 20 10.5 30000 9000\n3 20 11.5 0 9000\n\
    3 20 12.5 60000 12000\n3 21 11.5 0 8000\n3 21 12.5 0 10000\n";

/// A room of 13 ft x 10 ft x 8 ft with black surfaces, a window and a table of two points.
fn model() -> Value {
    let [x, y, z] = [13, 10, 8];
    let face = |name: &str, kind: &str, corners: [[i32; 3]; 4]| {
        json!({"identifier": name, "face_type": kind, "geometry": {"boundary": corners},
               "boundary_condition": {"type": "Outdoors"}, "apertures": []})
    };
    let mut south = face("south", "Wall", [[0, 0, 0], [x, 0, 0], [x, 0, z], [0, 0, z]]);
    south["apertures"] = json!([{"identifier": "window", "geometry":
        {"boundary": [[2, 0, 3], [11, 0, 3], [11, 0, z], [2, 0, z]]}}]);
    let faces = [
        face("floor", "Floor", [[0, 0, 0], [0, y, 0], [x, y, 0], [x, 0, 0]]),
        face("ceiling", "RoofCeiling", [[0, 0, z], [x, 0, z], [x, y, z], [0, y, z]]),
        south,
        face("north", "Wall", [[x, y, 0], [0, y, 0], [0, y, z], [x, y, z]]),
        face("west", "Wall", [[0, y, 0], [0, 0, 0], [0, 0, z], [0, y, z]]),
        face("east", "Wall", [[x, 0, 0], [x, y, 0], [x, y, z], [x, 0, z]]),
    ];
    let black = json!({"exterior_modifier": "black"});
    json!({"type": "Model", "units": "Feet", "rooms": [{"identifier": "room", "faces": faces}],
    "properties": {"radiance": {
        "global_modifier_set": {"type": "GlobalModifierSet",
            "modifiers": [{"type": "Plastic", "identifier": "black"}],
            "wall_set": black, "floor_set": black, "roof_ceiling_set": black},
        "sensor_grids": [{"identifier": "table", "sensors": [
            {"pos": [6, 5, 2.5], "dir": [0, 0, 1]}, {"pos": [9, 4, 2.5], "dir": [0, 0, 1]}]}],
    }}})
}

fn with_lamp() -> Value {
    let mut model = model();
    model["properties"]["radiance"]["luminaires"] = json!([{
        "type": "Luminaire", "identifier": "lamp", "ies_content": LAMP, "light_loss_factor": 0.8,
        "luminaire_zone": {"instances": [
            {"point": {"x": 6, "y": 5, "z": 7.5}, "spin": 10, "tilt": 0, "rotation": 20}]}}]);
    model["rooms"][0]["faces"][2]["apertures"] = json!([]);
    model
}

fn folder(name: &str, model: &Value) -> Folder {
    let folder = Folder::new(name);
    folder.write("model.hbjson", model.to_string());
    folder.write("site.wea", WEATHER);
    folder
}

/// I cos / d^2 of one lamp in a black room, in feet that become metres.
#[test]
fn a_lamp_in_a_black_room_gives_the_closed_form() {
    let folder = folder("honeybee_lamp", &with_lamp());
    let document = parsed(&folder.document("model.hbjson", "direct", &[], 0));
    let found = illuminances(&document);
    let expected = [[0.0, 0.0, 5.0], [3.0, 1.0, 5.0]].map(|way| {
        let squared: f64 = way.iter().map(|edge| edge * edge).sum::<f64>() * 0.3048 * 0.3048;
        let cosine = way[2] * 0.3048 / squared.sqrt();
        800.0 * cosine / squared
    });
    for ((lx, half_width), expected) in found.iter().zip(expected) {
        let error = (lx - expected).abs();
        assert!(error <= half_width + 1e-7 * expected, "{lx} +- {half_width}, not {expected}");
    }
    // The project that is written gives the same.
    let written = folder.quasilux(&["import", "model.hbjson", "--out", "of/project.toml"]);
    assert_eq!((written.code, written.stderr.as_str()), (Some(0), ""), "{}", written.stderr);
    assert!(folder.read("of/project.toml").contains("geometry = [\"../model.hbjson\"]"));
    assert_eq!(folder.read("of/project-lamp.ies"), LAMP);
    let again = parsed(&folder.document("of/project.toml", "again", &[], 0));
    assert_eq!(illuminances(&again), found);
}

#[test]
fn a_model_with_windows_has_a_daylight_factor_and_a_year() {
    let folder = folder("honeybee_year", &model());
    let checked = folder.quasilux(&["check", "model.hbjson"]);
    assert_eq!(checked.code, Some(0), "{}{}", checked.stdout, checked.stderr);
    let more = ["--rel-tol", "10%"];
    let document = parsed(&folder.document("model.hbjson", "factor", &more, 0));
    assert!(illuminances(&document).iter().all(|(lx, _)| (50.0..4000.0).contains(lx)));
    let year = ["annual", "model.hbjson", "--weather", "site.wea", "--out", "year", "--rel-tol"];
    let done = folder.quasilux(&[&year[..], &["10%"]].concat());
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    assert!(done.stdout.contains("table"), "{}", done.stdout);
    let import = ["import", "model.hbjson", "--out", "p.toml", "--weather", "site.wea"];
    assert_eq!(folder.quasilux(&import).code, Some(0));
    let done = folder.quasilux(&["annual", "p.toml", "--out", "again", "--rel-tol", "10%"]);
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    assert_eq!(folder.read("again/hours.csv"), folder.read("year/hours.csv"));
}

/// The numbers of an .npy file of 32-bit floats in two dimensions, row by row.
fn rows(folder: &Folder, path: &str) -> Vec<Vec<f32>> {
    let bytes = std::fs::read(folder.path(path)).expect("an array");
    let begin = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = std::str::from_utf8(&bytes[10..begin]).expect("text");
    let shape = header.split(['(', ')']).nth(1).expect("a shape");
    let shape: Vec<usize> = shape.split(',').filter_map(|n| n.trim().parse().ok()).collect();
    let numbers = bytes[begin..].chunks_exact(4);
    let numbers: Vec<f32> =
        numbers.map(|it| f32::from_le_bytes(it.try_into().expect("4 bytes"))).collect();
    assert_eq!(numbers.len(), shape[0] * shape[1]);
    numbers.chunks(shape[1]).map(<[f32]>::to_vec).collect()
}

/// Weather of two days as far as Honeybee's folder is asked for it.
const YEAR: [&str; 6] = ["annual", "model.hbjson", "--weather", "site.wea", "--rel-tol", "10%"];

/// Without groups the folder has the hours of the year as it is.
#[test]
fn a_year_is_written_as_the_recipe_writes_it() {
    let folder = folder("honeybee_out", &model());
    let out = ["--out", "year", "--honeybee", "out"];
    let done = folder.quasilux(&[&YEAR[..], &out].concat());
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    assert_eq!(
        folder.read("out/results/sun-up-hours.txt"),
        "1882.5\n1883.5\n1884.5\n1907.5\n1908.5\n"
    );
    let info = parsed(&folder.read("out/results/grids_info.json"));
    assert_eq!(info[0]["full_id"], "table");
    assert_eq!(
        (&info[0]["count"], &info[0]["light_path"]),
        (&json!(2), &json!([["__static_apertures__"]]))
    );
    let array = |kind: &str| {
        rows(&folder, &format!("out/results/__static_apertures__/default/{kind}/table.npy"))
    };
    let [total, direct, half_width] = ["total", "direct", "half_width"].map(array);
    let year = parsed(&folder.read("year/annual.json"));
    for (point, (total, half_width)) in total.iter().zip(&half_width).enumerate() {
        // The light exposure of an hour an interval is the sum of its illuminances.
        let exposure = number(&year, &format!("/sensors/0/points/{point}/exposure_lx_h"));
        let sum: f64 = total.iter().map(|lx| f64::from(*lx)).sum();
        assert!((sum - exposure).abs() < 1e-5 * exposure, "{sum} lx h of {exposure}");
        assert!(half_width.iter().zip(total).all(|(width, lx)| 0.0 < *width && width < lx));
    }
    assert!(direct.iter().flatten().zip(total.iter().flatten()).all(|(sun, all)| sun <= all));
    assert!(direct.iter().all(|hours| hours[1] == 0.0), "no sun in the second hour");
    let metric = folder.read("out/metrics/da/table.da");
    let shares = metric.lines().map(|line| line.parse::<f64>().expect("percent") / 100.0);
    for (point, share) in shares.enumerate() {
        let own = number(&year, &format!("/sensors/0/points/{point}/daylight_autonomy"));
        assert!((share - own).abs() < 1e-4, "{share} of {own}");
    }
    assert_eq!(folder.read("out/model.hbjson"), folder.read("model.hbjson"));
    // Results that are there stay.
    let again = folder.quasilux(&[&YEAR[..], &out].concat());
    assert!(again.code == Some(2) && again.stderr.contains("is there already"), "{}", again.stderr);
}

/// Light by the groups of windows and light by no group is together that of the open room.
#[test]
fn light_paths_add_up() {
    let mut model = model();
    let glass = |name: &str, share: f64| {
        json!({"type": "Glass", "identifier": name, "r_transmissivity": share,
               "g_transmissivity": share, "b_transmissivity": share})
    };
    let modifiers = model["properties"]["radiance"]["global_modifier_set"]["modifiers"].take();
    let [black] = modifiers.as_array().expect("modifiers").as_slice() else { panic!() };
    let all = json!([black, glass("clear", 0.9), glass("dark", 0.2)]);
    model["properties"]["radiance"]["global_modifier_set"]["modifiers"] = all.clone();
    model["properties"]["radiance"]["modifiers"] = all;
    let windows = [("none", [2, 4]), ("west", [5, 7]), ("east", [8, 11])];
    let windows = windows.map(|(name, [from, to])| {
        let corners = [[from, 0, 3], [to, 0, 3], [to, 0, 8], [from, 0, 8]];
        let mut window = json!({"identifier": name, "geometry": {"boundary": corners}});
        if name != "none" {
            window["properties"] = json!({"radiance": {"dynamic_group_identifier": name,
                "states": [{"modifier": "clear"}, {"modifier": "dark"}]}});
        }
        window
    });
    model["rooms"][0]["faces"][2]["apertures"] = json!(windows);
    let folder = folder("honeybee_paths", &model);
    let run = |more: &[&str]| {
        let done = folder.quasilux(&[&YEAR[..4], &["--rel-tol", "3%"], more].concat());
        assert_eq!(done.code, Some(0), "{}", done.stderr);
    };
    run(&["--out", "year", "--honeybee", "out"]);
    let states = parsed(&folder.read("out/results/grid_states.json"));
    assert_eq!(
        states["table"],
        json!({"east": ["0_east", "1_east"], "west": ["0_west", "1_west"]})
    );
    // The same room, whose windows do not change.
    for window in model["rooms"][0]["faces"][2]["apertures"].as_array_mut().expect("windows") {
        if window["identifier"] != "none" {
            window["properties"] = json!({"radiance": {"modifier": "clear"}});
        }
    }
    folder.write("model.hbjson", model.to_string());
    run(&["--out", "open", "--honeybee", "whole"]);
    let array = |path: &str, kind: &str| rows(&folder, &format!("{path}/{kind}/table.npy"));
    let whole = "whole/results/__static_apertures__/default";
    let paths = ["__static_apertures__/default", "west/0_west", "east/0_east"];
    let paths = paths.map(|path| format!("out/results/{path}"));
    for point in 0..2 {
        for hour in 0..5 {
            let of = |path: &str, kind: &str| array(path, kind)[point][hour];
            let sum: f32 = paths.iter().map(|path| of(path, "total")).sum();
            let squares = paths.iter().map(|path| of(path, "half_width").powi(2));
            let width = (squares.sum::<f32>() + of(whole, "half_width").powi(2)).sqrt();
            let own = of(whole, "total");
            assert!((sum - own).abs() < 1.5 * width, "{sum} +- {width}, not {own}");
            let sun: f32 = paths.iter().map(|path| of(path, "direct")).sum();
            assert!((sun - of(whole, "direct")).abs() <= 1e-3 * sun.abs().max(1.0));
            let [open, dark] = [0, 1].map(|it| of(&format!("out/results/east/{it}_east"), "total"));
            assert!(dark < 0.3 * open, "{dark} lx of {open}");
        }
    }
}

/// A refusal leaves files as they are, and none of its own.
#[test]
fn import_writes_all_or_nothing() {
    let folder = folder("honeybee_files", &with_lamp());
    folder.write("p-lamp.ies", "mine");
    let import = |model: &str, out: &str| {
        let run = folder.quasilux(&["import", model, "--out", out]);
        (run.code, run.stderr)
    };
    let (code, told) = import("model.hbjson", "p.toml");
    assert!(code == Some(2) && told.contains("p-lamp.ies: is there already"), "{told}");
    assert_eq!(folder.read("p-lamp.ies"), "mine");
    assert!(!folder.path("p.toml").exists());
    // IFC models are for the Python package.
    folder.write("model.ifc", "ISO-10303-21;\n");
    for told in [import("model.ifc", "i.toml").1, folder.quasilux(&["run", "model.ifc"]).stderr] {
        assert!(told.contains("python -m quasilux.ifc"), "{told}");
    }
    let mut odd = with_lamp();
    odd["rooms"][0]["faces"][0]["properties"] =
        json!({"radiance": {"modifier": {"type": "Ashik2", "identifier": "odd"}}});
    folder.write("odd.hbjson", odd.to_string());
    let (code, told) = import("odd.hbjson", "of/q.toml");
    assert!(code == Some(2) && told.contains("Ashik2"), "{told}");
    assert!(!folder.path("of").exists());
}

/// The areas of a mesh weigh shares of the area.
#[test]
fn meshes_weigh_the_area_with_enough_light() {
    let mut model = model();
    let grid = &mut model["properties"]["radiance"]["sensor_grids"][0];
    // One point in the room and one in the open.
    grid["sensors"][1]["pos"] = json!([30, 5, 2.5]);
    grid["mesh"] = json!({"vertices": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [6, 0, 0]],
                          "faces": [[0, 1, 2], [0, 3, 2]]});
    model["rooms"][0]["faces"][2]["apertures"] = json!([]);
    let folder = folder("honeybee_areas", &model);
    let year = ["annual", "model.hbjson", "--weather", "site.wea", "--json", "--rel-tol", "10%"];
    let done = folder.quasilux(&year);
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    let share = number(&parsed(&done.stdout), "/sensors/0/summary/sda/value");
    assert!((share - 6.0 / 7.0).abs() < 1e-12, "{share}");
}

#[test]
fn what_goes_wrong_is_said() {
    let folder = folder("honeybee_wrong", &model());
    let refuses = |arguments: &[&str], text: &str| {
        let run = folder.quasilux(arguments);
        assert!(run.code == Some(2) && run.stderr.contains(text), "{arguments:?}: {}", run.stderr);
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    };
    refuses(&["annual", "model.hbjson"], "a year of a model needs its weather; add --weather FILE");
    let year = ["annual", "model.hbjson", "--weather", "site.wea", "--checkpoint", "c"];
    refuses(&year, "--checkpoint goes with a project file");
    refuses(&["annual", "a.toml", "--weather", "site.wea"], "--weather goes with a Honeybee model");
    refuses(
        &["import", "model.skp", "--out", "a.toml"],
        "expected a name that ends in .hbjson, or names that end in .rad",
    );
    refuses(&["import", "none.hbjson", "--out", "a.toml"], "none.hbjson: ");
    refuses(&["import", "model.hbjson", "--out", "site.wea"], "site.wea: is there already");
    folder.write("empty.hbjson", "{\"type\": \"Model\", \"rooms\": []}");
    refuses(&["run", "empty.hbjson"], "empty.hbjson: no triangles");
    folder.write("broken.hbjson", "{\"type\": \"Model\", \"rooms\": [{}]}");
    refuses(&["run", "broken.hbjson"], "broken.hbjson:1:30: rooms[0]: missing field `faces`");
    // A project without sensors is written, and lacks them.
    let mut bare = model();
    bare["properties"] = json!({});
    bare["orphaned_shades"] =
        json!([{"identifier": "line", "geometry": {"boundary": [[0, 0, 0], [1, 0, 0]]}}]);
    folder.write("bare.hbjson", bare.to_string());
    refuses(&["run", "bare.hbjson"], "bare.hbjson: no sensor grid, and no view");
    let written = folder.quasilux(&["import", "bare.hbjson", "--out", "bare.toml"]);
    assert_eq!(written.code, Some(0));
    assert!(written.stderr.contains("add [[sensors]] or [[cameras]]"), "{}", written.stderr);
    assert!(written.stderr.contains("a polygon of fewer than three corners"), "{}", written.stderr);
}
