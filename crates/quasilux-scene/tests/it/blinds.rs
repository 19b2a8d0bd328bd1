//! `[blinds]` and `[electric_light]`: what changes over a year.

use crate::support::{MapFiles, PROJECT, load_text};
use quasilux_scene::{BlindsControl, BlindsGroup, Bsdf, ElectricLight, LoadError, Loaded, Scene};

pub(crate) const WEA: &str = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\n\
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
    assert!(open.blinds.is_none() && open.electric_light.is_empty());
    let name = open.scene.materials[0].name.clone();
    let loaded = load_with(&format!(
        "[blinds]\ngeometry = [\"slats.obj\"]\nmaterials.slat = {{ reflectance = 0.8 }}\n\
         materials.{name} = {{ kind = \"mirror\", reflectance = 0.9 }}\n"
    ));
    let loaded = loaded.unwrap();
    assert_eq!(loaded.scene.mesh, open.scene.mesh);
    assert_eq!(loaded.scene.materials, open.scene.materials);
    let blinds = loaded.blinds.unwrap();
    let [BlindsGroup { name: group, positions, control }] = &blinds.groups[..] else {
        panic!("one group")
    };
    assert_eq!((group.as_str(), positions.len()), ("blinds", 1));
    assert_eq!(*control, BlindsControl::Sunlight { sensor: None });
    let closed = &positions[0].room;
    let added = closed.mesh.triangles.len() - open.scene.mesh.triangles.len();
    assert_eq!(added, 1);
    assert_eq!(closed.sensors, open.scene.sensors);
    let bsdf_of = |name: &str| {
        let mut materials = closed.materials.iter();
        materials.find(|material| material.name == name).map(|material| material.bsdf.clone())
    };
    assert!(matches!(bsdf_of(&name), Some(Bsdf::Mirror(_))));
    assert!(matches!(bsdf_of("slat"), Some(Bsdf::Diffuse(_))));
}

#[test]
fn schedules_and_sensors_are_found() {
    let blinds = "[blinds]\ngeometry = [\"slats.obj\"]\nmaterials.slat.reflectance = 0.5\n";
    let scheduled = "control = \"schedule\"\nschedule = \"hours.csv\"\ncolumn = \"south\"\n";
    let control = |text: &str| load_with(text).unwrap().blinds.unwrap().groups.remove(0).control;
    let positions = vec![0, 1];
    assert_eq!(control(&format!("{blinds}{scheduled}")), BlindsControl::Schedule { positions });
    let sensor = load_with("").unwrap().scene.sensors[0].name.clone();
    let by_sensor = format!("{blinds}control = \"lm83\"\nsensor = \"{sensor}\"\n");
    assert_eq!(control(&by_sensor), BlindsControl::Sunlight { sensor: Some(0) });
    let light = format!("[electric_light]\npower_w = 90\ntarget_lx = 500\nsensor = \"{sensor}\"\n");
    let zone = |name: &str| ElectricLight {
        name: name.to_owned(),
        sensor: 0,
        target_lx: 500.0,
        power_w: 90.0,
        min_power_w: 0.0,
    };
    assert_eq!(load_with(&light).unwrap().electric_light, [zone("electric_light")]);
    let zones = ["desks", "door"].map(|name| {
        light.replace("[electric_light]", &format!("[[electric_light]]\nname = \"{name}\""))
    });
    assert_eq!(load_with(&zones.concat()).unwrap().electric_light, [zone("desks"), zone("door")]);
}

/// Groups of blinds, one of them with two states: each room of theirs is the open one with what the
/// groups put before the windows, whichever come together.
#[test]
fn groups_of_blinds_make_rooms() {
    let open = load_with("").unwrap().scene;
    let name = open.materials[0].name.clone();
    let half = "v 0.1 0.2 0.4\nv 0.8 0.2 0.4\nv 0.8 0.4 0.4\nf 1 2 3\n";
    let groups = format!(
        "[[blinds]]\nname = \"south\"\n[[blinds.states]]\nname = \"half\"\n\
         geometry = [\"half.obj\"]\n[[blinds.states]]\nname = \"shut\"\n\
         geometry = [\"slats.obj\"]\nmaterials.slat.reflectance = 0.5\n\
         [[blinds]]\nname = \"west\"\nmaterials.{name} = {{ kind = \"mirror\", \
         reflectance = 0.9 }}\n\
         control = \"schedule\"\nschedule = \"hours.csv\"\ncolumn = \"south\"\n"
    );
    let files = |text: &str| {
        let sky = "[weather]\nfile = \"site.wea\"\n[sky]\nmodel = \"weather\"\n";
        let files = MapFiles::room()
            .with("site.wea", WEA)
            .with("half.obj", half)
            .with("slats.obj", SLATS)
            .with("hours.csv", "hour,south\n1,open\n2,closed\n");
        load_text(&format!("{PROJECT}{sky}{text}"), &files)
    };
    let blinds = files(&groups).unwrap().blinds.unwrap();
    let control = BlindsControl::Schedule { positions: vec![0, 1] };
    assert_eq!((blinds.groups.len(), &blinds.groups[1].control), (2, &control));
    for (positions, triangles, is_mirror) in
        [([0, 0], 0, false), ([1, 0], 1, false), ([2, 0], 1, false), ([2, 1], 1, true)]
    {
        let room = blinds.room(&open, &positions);
        let before = open.mesh.triangles.len();
        assert_eq!(room.mesh.triangles.len(), before + triangles, "{positions:?}");
        assert_eq!(room.mesh.triangles[..before], open.mesh.triangles);
        assert_eq!(matches!(room.materials[0].bsdf, Bsdf::Mirror(_)), is_mirror);
        if let Some(own) = positions[0].checked_sub(1) {
            let alone = &blinds.groups[0].positions[own].room;
            let last = before as u32;
            assert_eq!(room.mesh.corners(last), alone.mesh.corners(last));
            assert_eq!(room.material(last), alone.material(last));
            let object =
                |scene: &Scene| scene.mesh.objects[scene.mesh.object_of[before] as usize].clone();
            assert_eq!(object(&room), object(alone));
        }
    }
    for (from, to, words) in [
        ("\"half.obj\"", "\"half.obj\", \"slats.obj\"", ""),
        ("\"west\"", "\"south\"", "a name that is not empty and that no other has"),
        ("\"shut\"", "\"open\"", "a name that is not empty and that no other has"),
        ("[[blinds]]\nname = \"west\"\n", "[[blinds]]\n", "a name for each of them"),
        (
            "name = \"west\"\n",
            "name = \"west\"\ngeometry = [\"half.obj\"]\n",
            "is of the blinds \"south\"",
        ),
        (
            "name = \"south\"\n",
            "name = \"south\"\ngeometry = [\"half.obj\"]\n",
            "in each of the states",
        ),
    ] {
        let found = files(&groups.replacen(from, to, 1));
        let message = found.map_or_else(|error| error.to_string(), |_| String::new());
        assert!(message.contains(words) && message.is_empty() == words.is_empty(), "{message}");
    }
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
