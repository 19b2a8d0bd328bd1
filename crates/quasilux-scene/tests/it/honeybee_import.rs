//! Projects that are made of Honeybee models: the text, and the scene that it loads to.

use crate::honeybee::{model, room, upright, window};
use crate::support::{LAMP_IES, MapFiles, warnings_of};
use quasilux_scene::{
    Bsdf, DVec3, ImportTerms, Imported, Light, Loaded, SensorShape, import_honeybee, load,
};
use serde_json::{Value, json};

fn import(model: &Value, weather: Option<&str>) -> Result<Imported, String> {
    let terms = ImportTerms { model: "m.hbjson", geometry: "m.hbjson", weather, stem: "m" };
    import_honeybee(model.to_string().as_bytes(), &terms).map_err(|error| error.to_string())
}

/// Loads what a model becomes.
fn loaded(model: &Value, weather: Option<&str>) -> Loaded {
    let imported = import(model, weather).unwrap();
    let mut files = MapFiles::default().with("m.hbjson", model.to_string());
    if let Some(weather) = weather {
        files = files.with(weather, crate::blinds::WEA);
    }
    for file in imported.files {
        files = files.with(&file.name, file.bytes);
    }
    load("m.toml", imported.text.as_bytes(), &files)
        .unwrap_or_else(|error| panic!("{error}\n{}", imported.text))
}

fn findings(model: &Value, weather: Option<&str>) -> Vec<String> {
    import(model, weather).unwrap().findings.iter().map(ToString::to_string).collect()
}

/// Warnings of a loaded scene that are about the model.
fn told_of_model(loaded: &Loaded) -> Vec<String> {
    warnings_of(loaded).into_iter().filter(|it| it.starts_with("m.hbjson")).collect()
}

fn add(list: &mut Value, item: Value) {
    list.as_array_mut().expect("a list").push(item);
}

/// A room with two sensor points, in feet if need be.
fn office() -> Value {
    let mut room = room("a", [0.0; 3], [4.0, 3.0, 2.5]);
    room["faces"][2]["apertures"] = json!([window("pane", upright(0.0, [1.0, 1.0], [2.0, 2.0]))]);
    let mut model = model(&[room]);
    model["properties"]["radiance"]["sensor_grids"] = json!([{
        "type": "SensorGrid", "identifier": "desk",
        "sensors": [{"pos": [1, 1, 0.8], "dir": [0, 0, 1]},
            {"pos": [2.5, 1, 0.8], "dir": [0, 0, 2]}],
    }]);
    model
}

#[test]
fn grids_become_sensors_in_metres() {
    let mut model = office();
    model["units"] = json!("Feet");
    let grids = &mut model["properties"]["radiance"]["sensor_grids"];
    let sensor = json!({"pos": [1, 2, 0.8], "dir": [1, 0, 0]});
    add(grids, json!({"identifier": "DESK", "sensors": [sensor]}));
    add(grids, json!({"identifier": "empty", "sensors": []}));
    let found = loaded(&model, None);
    let names: Vec<&str> = found.scene.sensors.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["desk", "DESK-2"]);
    let SensorShape::Points(points) = &found.scene.sensors[0].shape else { panic!("points") };
    assert_eq!(points[1].position, DVec3::new(2.5, 1.0, 0.8) * 0.3048);
    assert_eq!(points[1].normal, DVec3::Z);
    let mesh = &found.scene.mesh;
    assert_eq!(mesh.bounds().unwrap()[1], DVec3::new(4.0, 3.0, 2.5) * 0.3048);
    let told = findings(&model, None);
    assert!(told[0].contains("\"DESK\": its name is taken") && told[1].contains("without sensors"));
}

/// A face or a vertex of the mesh for each sensor.
#[test]
fn meshes_of_grids_weigh_their_points() {
    let mut model = office();
    let grid = |model: &mut Value, mesh: Value| {
        model["properties"]["radiance"]["sensor_grids"][0]["mesh"] = mesh;
    };
    let vertices = json!([[0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 2, 0], [4, 0, 0], [4, 2, 0]]);
    let faces = json!([[0, 1, 2, 3], [1, 4, 5, 2]]);
    grid(&mut model, json!({"vertices": vertices, "faces": faces}));
    let found = loaded(&model, Some("a.wea"));
    assert_eq!(found.annual.areas, [[2.0, 6.0]]);
    // Two vertices of the three of one triangle cannot be told from two faces by any rule but
    // their number.
    let triangle = json!([[0, 0, 0], [3, 0, 0], [0, 2, 0]]);
    let sensor = model["properties"]["radiance"]["sensor_grids"][0]["sensors"][0].clone();
    add(&mut model["properties"]["radiance"]["sensor_grids"][0]["sensors"], sensor);
    grid(&mut model, json!({"vertices": triangle, "faces": [[0, 1, 2]]}));
    assert_eq!(loaded(&model, Some("a.wea")).annual.areas, [[0.0; 0]]);
    assert!(findings(&model, None).is_empty());
    grid(&mut model, json!({"vertices": triangle, "faces": [[0, 1, 7]]}));
    assert!(findings(&model, None)[0].contains("all sensors count alike"));
    let project = crate::support::PROJECT.to_owned()
        + "[[sensors]]\nname = \"s\"\nkind = \"points\"\npoints = [[0, 0, 1]]\n\
           normals = [[0, 0, 1]]\nareas = ";
    for (areas, refusal) in [("[1, 2]", "1 points but 2 areas"), ("[0]", "areas above 0")] {
        let error = crate::support::load_text(&format!("{project}{areas}\n"), &MapFiles::room());
        assert!(error.unwrap_err().to_string().contains(refusal));
    }
}

#[test]
fn models_without_sensors_say_so() {
    let imported = import(&model(&[room("a", [0.0; 3], [1.0; 3])]), None).unwrap();
    assert!(!imported.measures);
    assert!(imported.findings[0].to_string().contains("add [[sensors]] or [[cameras]]"));
    let error = load("m.toml", imported.text.as_bytes(), &MapFiles::default()).unwrap_err();
    assert!(error.to_string().contains("no sensors and no cameras"), "{error}");
}

#[test]
fn luminaires_hang_where_they_are_with_their_factors() {
    let mut model = office();
    model["units"] = json!("Feet");
    model["properties"]["radiance"]["luminaires"] = json!([{
        "type": "Luminaire", "identifier": "lamp", "ies_path": null, "ies_content": LAMP_IES,
        "light_loss_factor": 0.8, "candela_multiplier": 0.5,
        "luminaire_zone": {"type": "LuminaireZone", "instances": [
            {"point": {"type": "Point3D", "x": 1.0, "y": 2.0, "z": 2.4}, "spin": 0, "tilt": 0,
             "rotation": 0},
            {"point": {"x": 3.0, "y": 2.0, "z": 2.4}, "spin": 30.0, "tilt": 90.0, "rotation": 0.0},
        ]},
    }, {"ies_content": LAMP_IES}]);
    let found = loaded(&model, None);
    // No sky is made up beside luminaires.
    assert!(found.scene.environment.is_none() && found.scene.lights.len() == 2);
    let lamp = |number: usize| match &found.scene.lights[number] {
        Light::Luminaire(luminaire) => luminaire,
        other => panic!("{other:?}"),
    };
    assert_eq!(lamp(0).position, DVec3::new(1.0, 2.0, 2.4) * 0.3048);
    assert!((lamp(0).intensity_cd(DVec3::NEG_Z) - 400.0).abs() < 1e-9);
    // Tilted by a quarter turn about y, what pointed down points to -x.
    let aim = lamp(1).world_from_luminaire * DVec3::NEG_Z;
    assert!((aim - DVec3::NEG_X).length() < 1e-12, "{aim}");
    let told = findings(&model, None);
    assert!(told[0].contains("luminaires[1]: a luminaire that hangs nowhere"), "{told:?}");
    model["properties"]["radiance"]["luminaires"][0]["light_loss_factor"] = json!(0);
    let error = import(&model, None).unwrap_err();
    assert!(error.contains("luminaires[0]: light_loss_factor is 0; expected a factor"), "{error}");
    model["properties"]["radiance"]["luminaires"][0]["ies_content"] = json!(null);
    let error = import(&model, None).unwrap_err();
    assert!(error.contains("luminaires[0]: no ies_content"), "{error}");
}

/// Candela by C and gamma, of no symmetry: a file, and the same by arithmetic.
const ASYMMETRIC: [[f64; 3]; 4] =
    [[900.0, 500.0, 100.0], [900.0, 800.0, 300.0], [900.0, 200.0, 50.0], [900.0, 50.0, 10.0]];

fn asymmetric_ies() -> String {
    let rows = ASYMMETRIC.iter().chain(&ASYMMETRIC[..1]);
    let rows: Vec<String> = rows.map(|[a, b, c]| format!("{a} {b} {c}")).collect();
    format!(
        "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] none\nTILT=NONE\n1 -1 1 3 5 1 2 0 0 0\n1 1 10\n\
         0 45 90\n0 90 180 270 360\n{}\n",
        rows.join("\n")
    )
}

/// Candela at angles in degrees, by straight lines between the rows.
fn candela(c_deg: f64, gamma_deg: f64) -> f64 {
    let (c, gamma) = (c_deg.rem_euclid(360.0) / 90.0, (gamma_deg / 45.0).clamp(0.0, 2.0));
    let (row, column) = (c.floor().min(3.0), gamma.floor().min(1.0));
    let at = |row: usize, column: usize| ASYMMETRIC[row % 4][column];
    let (i, j) = (row as usize, column as usize);
    let (u, v) = (c - row, gamma - column);
    (1.0 - u) * ((1.0 - v) * at(i, j) + v * at(i, j + 1))
        + u * ((1.0 - v) * at(i + 1, j) + v * at(i + 1, j + 1))
}

/// The luminaire is turned as Radiance's xform turns it: a place in the world is turned back step
/// by step, and its angles are looked up in the file's own frame, 0 degrees along +x, nadir -z.
#[test]
fn an_asymmetric_luminaire_shines_where_radiance_lets_it() {
    for [spin, tilt, rotation] in [
        [0.0, 0.0, 0.0],
        [90.0, 0.0, 0.0],
        [30.0, 0.0, 45.0],
        [20.0, 35.0, 110.0],
        [0.0, 90.0, 250.0],
    ] {
        let mut model = office();
        model["properties"]["radiance"]["luminaires"] = json!([{
            "identifier": "lamp", "ies_content": asymmetric_ies(), "candela_multiplier": 1.5,
            "luminaire_zone": {"instances": [{"point": {"x": 2.0, "y": 1.5, "z": 2.3},
                "spin": spin, "tilt": tilt, "rotation": rotation}]},
        }]);
        let found = loaded(&model, None);
        let Light::Luminaire(lamp) = &found.scene.lights[0] else { panic!("a luminaire") };
        for target in
            [[0.1, 0.2, 0.0], [3.9, 0.4, 0.0], [3.0, 2.9, 1.0], [0.0, 1.0, 2.0], [2.0, 1.5, 0.0]]
        {
            let to = DVec3::from_array(target) - DVec3::new(2.0, 1.5, 2.3);
            let back = |v: [f64; 2], degrees: f64| {
                let (sin, cos) = libm::sincos((-degrees).to_radians());
                [v[0] * cos - v[1] * sin, v[0] * sin + v[1] * cos]
            };
            let [x, y] = back([to.x, to.y], rotation);
            // About y, z turns toward x.
            let [z, x] = back([to.z, x], tilt);
            let [x, y] = back([x, y], spin);
            let c_deg = libm::atan2(y, x).to_degrees();
            let gamma_deg = libm::acos(-z / to.length()).to_degrees();
            let expected = 1.5 * candela(c_deg, gamma_deg);
            let expected = if gamma_deg > 90.0 { 0.0 } else { expected };
            let found = lamp.intensity_cd(to.normalize());
            assert!(
                (found - expected).abs() < 1e-6 * expected.max(1.0),
                "{spin} {tilt} {rotation} to {target:?}: {found} is not {expected}"
            );
        }
    }
}

#[test]
fn views_become_cameras() {
    let mut model = office();
    let view = |name: &str, kind: &str, more: Value| {
        let mut view = json!({"identifier": name, "position": [2, 0.5, 1.5],
            "direction": [0, 1, 0], "up_vector": [0, 0, 1], "view_type": kind,
            "h_size": 90, "v_size": 60, "shift": null, "lift": null});
        view.as_object_mut().unwrap().extend(more.as_object().unwrap().clone());
        view
    };
    model["properties"]["radiance"]["views"] = json!([
        view("desk", "v", json!({})),
        view("fish", "h", json!({})),
        view("moved", "v", json!({"shift": 0.5})),
        view("down", "v", json!({"direction": [0, 0, -1]})),
        view("wide", "v", json!({"h_size": 180})),
        view("clipped", "v", json!({"fore_clip": 1})),
    ]);
    let found = loaded(&model, None);
    let names: Vec<&str> = found.scene.cameras.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["desk-2", "clipped"]);
    let camera = &found.scene.cameras[0];
    assert_eq!(camera.target - camera.position, DVec3::Y);
    // 90 degrees across, 60 upright: tangents of 1 and of 0.577.
    assert_eq!(
        (camera.vertical_fov_rad.to_degrees().round(), camera.resolution),
        (60.0, [800, 462])
    );
    assert_eq!(findings(&model, None).len(), 6);
}

/// One aperture that darkens, with a shade outside from state 1 on, and a shade that goes.
fn changing() -> Value {
    let mut model = office();
    let glass = |name: &str, share: f64| {
        json!({"type": "Glass", "identifier": name, "r_transmissivity": share,
               "g_transmissivity": share, "b_transmissivity": share})
    };
    let shade = |name: &str, y: f64| {
        let geometry = upright(y, [1.0, 1.0], [2.0, 2.0]);
        json!({"identifier": name, "geometry": geometry})
    };
    let mut pane = window("pane", upright(0.0, [1.0, 1.0], [2.0, 2.0]));
    pane["properties"] = json!({"radiance": {"dynamic_group_identifier": "south \"1\"", "states": [
        {"modifier": "bright", "shades": [shade("first", -0.2)]},
        {"modifier": "dark"},
        {"modifier": null, "shades": [shade("awning", -0.3), shade("slat", -0.4)]},
    ]}});
    model["rooms"][0]["faces"][2]["apertures"] = json!([pane]);
    let states = json!([{"modifier": "grass"}, {"modifier": "snow"}]);
    model["orphaned_shades"] = json!([{"identifier": "ground",
        "geometry": {"boundary": [[-9, -9, -1], [9, -9, -1], [9, 9, -1], [-9, 9, -1]]},
        "properties": {"radiance": {"dynamic_group_identifier": "ground", "states": states}}}]);
    let grey = |name: &str, share: f64| {
        json!({"type": "Plastic", "identifier": name, "r_reflectance": share,
               "g_reflectance": share, "b_reflectance": share})
    };
    model["properties"]["radiance"]["modifiers"] =
        json!([glass("bright", 0.9), glass("dark", 0.1), grey("grass", 0.25), grey("snow", 0.75)]);
    model
}

/// A model with something of each kind.
pub(crate) fn everything() -> Value {
    let mut model = changing();
    model["units"] = json!("Feet");
    let radiance = &mut model["properties"]["radiance"];
    radiance["luminaires"] = json!([{
        "type": "Luminaire", "identifier": "lamp", "ies_path": null, "ies_content": LAMP_IES,
        "light_loss_factor": 0.8, "candela_multiplier": 0.5, "custom_lamp": {"name": "led"},
        "luminaire_zone": {"instances": [{"point": {"x": 1.0, "y": 2.0, "z": 2.4}, "spin": 30,
            "tilt": 90, "rotation": 1.5}]},
    }]);
    radiance["views"] = json!([{"identifier": "eye", "position": [2, 0.5, 1.5],
        "direction": [0, 1, 0], "up_vector": [0, 0, 1], "view_type": "v", "h_size": 9,
        "v_size": 6}]);
    radiance["sensor_grids"][0]["mesh"] = json!({
        "vertices": [[0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 2, 0]],
               "faces": [[0, 1, 2, 3], [0, 1, 2]]});
    let shiny = json!({"type": "Plastic", "identifier": "shiny", "r_reflectance": 0.4,
        "specularity": 0.1, "roughness": 0.1, "modifier": {"type": "Void"}});
    add(&mut radiance["modifiers"], shiny);
    let lit = json!({"type": "Light", "identifier": "lit", "r_emittance": 5});
    add(&mut radiance["modifiers"], lit);
    radiance["global_modifier_set"] = json!({"type": "GlobalModifierSet", "wall_set":
        {"exterior_modifier": "shiny"}, "door_set": {"overhead_modifier": null}});
    radiance["modifier_sets"] = json!([{"identifier": "set", "aperture_set":
        {"window_modifier": "bright"}}]);
    model["rooms"][0]["properties"] = json!({"radiance": {"modifier_set": "set"}});
    model["rooms"][0]["faces"][3]["doors"] =
        json!([window("door", upright(3.0, [1.0, 0.0], [2.0, 2.0]))]);
    model["shade_meshes"] = json!([{"identifier": "mesh", "geometry": {
        "vertices": [[9, 9, 0], [10, 9, 0], [10, 10, 0], [9, 10, 0]], "faces": [[0, 1, 2, 3]]},
        "properties": {"radiance": {"modifier": "lit"}}}]);
    let mut second = room("b", [0.0, 3.0, 0.0], [4.0, 6.0, 2.5]);
    second["faces"][2]["boundary_condition"] =
        json!({"type": "Surface", "boundary_condition_objects": ["a_north", "a"]});
    second["indoor_shades"] = json!([{"identifier": "shelf",
        "geometry": upright(4.0, [1.0, 1.0], [2.0, 2.0])}]);
    add(&mut model["rooms"], second);
    model
}

#[test]
fn groups_become_blinds_state_by_state() {
    let found = loaded(&changing(), Some("a.wea"));
    assert_eq!(told_of_model(&found), Vec::<String>::new());
    let blinds = found.blinds.expect("groups");
    let names: Vec<(&str, usize)> =
        blinds.groups.iter().map(|it| (it.name.as_str(), it.positions.len())).collect();
    assert_eq!(names, [("south \"1\"", 2), ("ground", 1)]);
    let objects = |scene: &quasilux_scene::Scene| {
        scene.mesh.objects.iter().map(ToString::to_string).collect::<Vec<String>>()
    };
    assert!(objects(&found.scene).contains(&"first".to_owned()));
    assert!(!objects(&found.scene).contains(&"awning".to_owned()));
    let bsdf = |scene: &quasilux_scene::Scene, object: &str| {
        let mesh = &scene.mesh;
        let is_of = |t: &u32| &*mesh.objects[mesh.object_of[*t as usize] as usize] == object;
        let triangle = (0..mesh.triangles.len() as u32).find(is_of).expect(object);
        scene.material(triangle).bsdf.clone()
    };
    let straight = |bsdf: Bsdf| match bsdf {
        Bsdf::Pane(quasilux_scene::bsdf::Pane::Measured { transmittance, .. }) => {
            transmittance.at_angle(0.0)
        }
        other => panic!("{other:?}"),
    };
    assert!((straight(bsdf(&found.scene, "pane")) - 0.826).abs() < 1e-3);
    let [first, second] = [0, 1].map(|state| &blinds.groups[0].positions[state].room);
    assert!((straight(bsdf(first, "pane")) - 0.0917).abs() < 1e-3);
    // Its own modifier, where a state has none.
    assert!((straight(bsdf(second, "pane")) - 0.64).abs() < 1e-3);
    // A shade of state 0 alone lets all light through in the others.
    assert_eq!(bsdf(&found.scene, "first").reflectance().unwrap().luminance(), 0.35);
    assert_eq!(straight(bsdf(second, "first")), 1.0);
    assert_eq!(bsdf(second, "awning").reflectance().unwrap().luminance(), 0.35);
    assert_eq!(bsdf(second, "slat").reflectance().unwrap().luminance(), 0.35);
    assert_eq!(second.mesh.triangles.len(), first.mesh.triangles.len() + 4);
    let snow = bsdf(&blinds.groups[1].positions[0].room, "ground");
    assert_eq!(snow.reflectance().unwrap().luminance(), 0.75);
    assert_eq!(bsdf(second, "ground").reflectance().unwrap().luminance(), 0.25);
}

/// Something with fewer states than its group keeps the last one, with its shades.
#[test]
fn members_of_fewer_states_keep_their_last_one() {
    let mut model = changing();
    let pane = |name: &str, x: f64, states: Value| {
        let mut pane = window(name, upright(0.0, [x, 1.0], [x + 0.5, 2.0]));
        pane["properties"] =
            json!({"radiance": {"dynamic_group_identifier": "g", "states": states}});
        pane
    };
    let awning =
        json!([{"identifier": "awning", "geometry": upright(-0.3, [1.0, 1.0], [2.0, 2.0])}]);
    model["rooms"][0]["faces"][2]["apertures"] = json!([
        pane("a", 1.0, json!([{"modifier": "bright"}, {"modifier": "dark", "shades": awning}])),
        pane("b", 2.0, json!([{"modifier": "bright"}, {"modifier": "dark"}, {}])),
    ]);
    let found = loaded(&model, Some("a.wea"));
    let positions = &found.blinds.expect("groups").groups[0].positions;
    let has_awning = |scene: &quasilux_scene::Scene| {
        scene.mesh.objects.iter().any(|object| &**object == "awning")
    };
    let there: Vec<bool> = positions.iter().map(|it| has_awning(&it.room)).collect();
    assert_eq!(there, [true, true]);
    assert!(!has_awning(&found.scene));
}

/// Shades of one modifier share a material in each state; those without area are left out.
#[test]
fn shades_of_states_share_materials() {
    let mut model = changing();
    let states = "/rooms/0/faces/2/apertures/0/properties/radiance/states";
    let slat = |number: i32| {
        let geometry = upright(f64::from(-number), [1.0, 1.0], [2.0, 2.0]);
        json!({"identifier": "slat", "geometry": geometry})
    };
    let shades: Vec<Value> = (0..50).map(slat).collect();
    *model.pointer_mut(&format!("{states}/2/shades")).unwrap() = json!(shades);
    let imported = import(&model, Some("a.wea")).unwrap();
    assert_eq!(imported.text.matches("group_south__1__state_2").count(), 1, "{}", imported.text);
    for flat in [json!([[0, 0, 0], [1, 1, 1]]), json!([[0, 0, 0], [1, 1, 1], [2, 2, 2]])] {
        let shades = json!([{"identifier": "flat", "geometry": {"boundary": flat}}]);
        *model.pointer_mut(&format!("{states}/2/shades")).unwrap() = shades;
        assert_eq!(loaded(&model, Some("a.wea")).blinds.unwrap().groups.len(), 2);
        let told = findings(&model, Some("a.wea"));
        assert!(told[0].contains("states[2].shades[0]: a polygon without area"), "{told:?}");
    }
    *model.pointer_mut(&format!("{states}/2/shades")).unwrap() =
        json!(vec![json!({"identifier": "s", "geometry": {"boundary": []}}); 100_001]);
    let error = import(&model, Some("a.wea")).unwrap_err();
    assert!(error.contains("more than 100000 shades of states"), "{error}");
}

/// A group of an empty name has one that is free.
#[test]
fn groups_without_a_name_have_one_of_their_own() {
    let mut model = changing();
    let radiance = "/properties/radiance/dynamic_group_identifier";
    *model["rooms"][0]["faces"][2]["apertures"][0].pointer_mut(radiance).unwrap() = json!("");
    *model["orphaned_shades"][0].pointer_mut(radiance).unwrap() = json!("group");
    let blinds = loaded(&model, Some("a.wea")).blinds.expect("groups");
    let names: Vec<&str> = blinds.groups.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["group 2", "group"]);
}

#[test]
fn light_paths_are_told() {
    let mut model = office();
    model["properties"]["radiance"]["sensor_grids"][0]["light_path"] = json!([["south"]]);
    assert!(findings(&model, None)[0].contains("its light_path is left out"));
}

#[test]
fn groups_stay_in_their_first_state_without_a_year() {
    let found = loaded(&changing(), None);
    assert!(found.blinds.is_none());
    let told = warnings_of(&found);
    assert!(told[0].contains("dynamic groups (2) stay in their first state"), "{told:?}");
}

/// A state is written as a project writes materials, and read back bit by bit.
#[test]
fn materials_of_states_are_those_of_the_model() {
    let modifiers = [
        json!({"type": "Plastic", "r_reflectance": 0.1, "g_reflectance": 0.2,
               "b_reflectance": 0.3}),
        json!({"type": "Plastic", "r_reflectance": 0.1, "specularity": 0.05, "roughness": 0.1}),
        json!({"type": "Metal", "r_reflectance": 0.7, "specularity": 0.9, "roughness": 0.1}),
        json!({"type": "Mirror", "r_reflectance": 0.7, "g_reflectance": 0.7, "b_reflectance": 0.7}),
        json!({"type": "Trans", "r_reflectance": 0.7, "transmitted_diff": 0.3}),
        json!({"type": "Glass", "r_transmissivity": 0.3, "g_transmissivity": 0.31}),
        json!({"type": "Glass", "r_transmissivity": 0.37, "g_transmissivity": 0.37,
               "b_transmissivity": 0.37}),
    ];
    for modifier in modifiers {
        let mut model = changing();
        let mut modifier = modifier;
        modifier["identifier"] = json!("dark");
        model["properties"]["radiance"]["modifiers"][1] = modifier;
        model["rooms"][0]["faces"][0]["properties"]["radiance"]["modifier"] = json!("dark");
        let found = loaded(&model, Some("a.wea"));
        let of = |scene: &quasilux_scene::Scene, name: &str| {
            scene.materials.iter().find(|it| it.name == name).expect(name).bsdf.clone()
        };
        let state = &found.blinds.as_ref().unwrap().groups[0].positions[0].room;
        assert_eq!(of(state, "group south \"1\""), of(&found.scene, "dark"));
    }
}

/// The model of the documentation: two rooms that are open to one another, in feet.
#[test]
fn the_model_of_the_documentation_is_whole() {
    let text = include_str!("../../../../validation/scenes/two-rooms.hbjson");
    let model: Value = serde_json::from_str(text).unwrap();
    let found = loaded(&model, Some("a.wea"));
    let scene = &found.scene;
    assert_eq!((scene.lights.len(), scene.sensors.len(), scene.cameras.len()), (3, 1, 1));
    assert_eq!(found.annual.areas[0].iter().sum::<f64>(), 120.0);
    assert_eq!(found.blinds.as_ref().map(|it| it.groups.len()), Some(1));
    assert_eq!(told_of_model(&found), Vec::<String>::new());
    let mesh = &scene.mesh;
    let area = |t: u32| mesh.area_m2(t) / (0.3048 * 0.3048);
    // Both rooms without what is between them, and the canopy.
    let outside = 2.0 * (16.0 * 20.0 + 16.0 * 9.0 + 20.0 * 9.0) + 12.0 * 2.0;
    let total: f64 = (0..mesh.triangles.len() as u32).map(area).sum();
    assert!((total / outside - 1.0).abs() < 1e-12, "{total} is not {outside}");
}
