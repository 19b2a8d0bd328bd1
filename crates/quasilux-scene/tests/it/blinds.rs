//! `[blinds]` and `[electric_light]`: what changes over a year.

use crate::support::{MapFiles, PROJECT, load_text};
use quasilux_scene::{BlindsControl, Bsdf, ElectricLight, LoadError, Loaded};

const WEA: &str = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\n\
    site_elevation 2\nweather_data_file_units 1\n3 20 11.5 700 90\n3 20 12.5 650 120\n";
const SLATS: &str = "usemtl slat\nv 0.2 0.2 0.5\nv 0.8 0.2 0.5\nv 0.8 0.4 0.5\nf 1 2 3\n";

fn load_with(rest: &str) -> Result<Loaded, LoadError> {
    let sky = "[weather]\nfile = \"site.wea\"\n[sky]\nmodel = \"weather\"\n";
    let files = MapFiles::room()
        .with("site.wea", WEA)
        .with("slats.obj", SLATS)
        .with("hours.csv", "hour,south\n1,0\n2,1\n");
    load_text(&format!("{PROJECT}{sky}{rest}"), &files)
}

/// Closed, a room has other materials and more triangles; open, it is as if there were none.
#[test]
fn closed_blinds_are_another_scene() {
    let open = load_with("").unwrap();
    assert!(open.blinds.is_none() && open.electric_light.is_none());
    let name = open.scene.materials[0].name.clone();
    let loaded = load_with(&format!(
        "[blinds]\ngeometry = [\"slats.obj\"]\nmaterials.slat = {{ reflectance = 0.8 }}\n\
         materials.{name} = {{ kind = \"mirror\", reflectance = 0.9 }}\n"
    ));
    let loaded = loaded.unwrap();
    assert_eq!(loaded.scene.mesh, open.scene.mesh);
    assert_eq!(loaded.scene.materials, open.scene.materials);
    let blinds = loaded.blinds.unwrap();
    assert_eq!(blinds.control, BlindsControl::Sunlight { sensor: None });
    let added = blinds.closed.mesh.triangles.len() - open.scene.mesh.triangles.len();
    assert_eq!(added, 1);
    assert_eq!(blinds.closed.sensors, open.scene.sensors);
    let bsdf_of = |name: &str| {
        let mut materials = blinds.closed.materials.iter();
        materials.find(|material| material.name == name).map(|material| material.bsdf.clone())
    };
    assert!(matches!(bsdf_of(&name), Some(Bsdf::Mirror(_))));
    assert!(matches!(bsdf_of("slat"), Some(Bsdf::Diffuse(_))));
}

#[test]
fn schedules_and_sensors_are_found() {
    let blinds = "[blinds]\ngeometry = [\"slats.obj\"]\nmaterials.slat.reflectance = 0.5\n";
    let scheduled = "control = \"schedule\"\nschedule = \"hours.csv\"\ncolumn = \"south\"\n";
    let control = |text: &str| load_with(text).unwrap().blinds.unwrap().control;
    let is_closed = vec![false, true];
    assert_eq!(control(&format!("{blinds}{scheduled}")), BlindsControl::Schedule { is_closed });
    let sensor = load_with("").unwrap().scene.sensors[0].name.clone();
    let by_sensor = format!("{blinds}control = \"lm83\"\nsensor = \"{sensor}\"\n");
    assert_eq!(control(&by_sensor), BlindsControl::Sunlight { sensor: Some(0) });
    let light = format!("[electric_light]\npower_w = 90\ntarget_lx = 500\nsensor = \"{sensor}\"\n");
    let expected = ElectricLight { sensor: 0, target_lx: 500.0, power_w: 90.0, min_power_w: 0.0 };
    assert_eq!(load_with(&light).unwrap().electric_light, Some(expected));
}

#[test]
fn blinds_that_make_no_sense_are_refused() {
    let blinds = "[blinds]\ngeometry = [\"slats.obj\"]\nmaterials.slat.reflectance = 0.5\n";
    for (text, words) in [
        ("[blinds]\n".to_owned(), "closed blinds are the same as open ones"),
        (format!("{blinds}schedule = \"hours.csv\"\n"), "goes with control = \"schedule\""),
        (format!("{blinds}control = \"schedule\"\n"), "schedule"),
        (format!("{blinds}control = \"sun\"\n"), "\"lm83\" or \"schedule\""),
        (format!("{blinds}sensor = \"nobody\"\n"), "no sensor is called \"nobody\""),
        (
            format!(
                "{blinds}control = \"schedule\"\nschedule = \"hours.csv\"\ncolumn = \"north\"\n"
            ),
            "a line of names with \"north\"",
        ),
        ("[blinds]\nmaterials.nothing = { reflectance = 0.5 }\n".to_owned(), "no geometry uses"),
        ("[blinds]\ngeometry = [\"room.obj\"]\n".to_owned(), "a file of [scene] is listed again"),
        ("[electric_light]\npower_w = 0\n".to_owned(), "the power of all lamps in W, above 0"),
        (
            "[electric_light]\npower_w = 9\nmin_power_w = 10\ntarget_lx = 1\nsensor = \"a\"\n"
                .to_owned(),
            "from 0 to power_w",
        ),
    ] {
        let message = load_with(&text).unwrap_err().to_string();
        assert!(message.contains(words), "{text}: {message}");
    }
    let without_weather = load_text(&format!("{PROJECT}{blinds}"), &MapFiles::room());
    let message = without_weather.unwrap_err().to_string();
    assert!(message.contains("[blinds] goes with [sky] model = \"weather\""), "{message}");
}
