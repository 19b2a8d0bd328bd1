//! Honeybee models of our own: what geometry and materials come of them, and what is refused where.

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::bsdf::Pane;
use quasilux_scene::{Bsdf, Loaded, Scene};
use serde_json::{Value, json};

/// A box from the origin, its faces named after their sides, normals outward.
pub(crate) fn room(name: &str, [x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3]) -> Value {
    let corners = |face: [[f64; 3]; 4]| json!({"type": "Face3D", "boundary": face});
    let faces = [
        ("floor", "Floor", [[x0, y0, z0], [x0, y1, z0], [x1, y1, z0], [x1, y0, z0]]),
        ("ceiling", "RoofCeiling", [[x0, y0, z1], [x1, y0, z1], [x1, y1, z1], [x0, y1, z1]]),
        ("south", "Wall", [[x0, y0, z0], [x1, y0, z0], [x1, y0, z1], [x0, y0, z1]]),
        ("north", "Wall", [[x1, y1, z0], [x0, y1, z0], [x0, y1, z1], [x1, y1, z1]]),
        ("west", "Wall", [[x0, y1, z0], [x0, y0, z0], [x0, y0, z1], [x0, y1, z1]]),
        ("east", "Wall", [[x1, y0, z0], [x1, y1, z0], [x1, y1, z1], [x1, y0, z1]]),
    ];
    let face = |(side, kind, face): (&str, &str, [[f64; 3]; 4])| {
        json!({
            "identifier": format!("{name}_{side}"), "face_type": kind, "geometry": corners(face),
            "boundary_condition": {"type": "Outdoors"},
            "properties": {"radiance": {}},
        })
    };
    json!({"identifier": name, "faces": faces.map(face), "properties": {}})
}

/// A rectangle in a wall along x, at this y.
pub(crate) fn upright(y: f64, [x0, z0]: [f64; 2], [x1, z1]: [f64; 2]) -> Value {
    json!({"boundary": [[x0, y, z0], [x1, y, z0], [x1, y, z1], [x0, y, z1]]})
}

pub(crate) fn window(name: &str, geometry: Value) -> Value {
    json!({"identifier": name, "geometry": geometry, "boundary_condition": {"type": "Outdoors"}})
}

pub(crate) fn model(rooms: &[Value]) -> Value {
    json!({"type": "Model", "units": "Meters", "rooms": rooms, "properties": {"radiance": {}}})
}

fn try_load(model: &Value, more: &str) -> Result<Loaded, String> {
    let project = PROJECT.replace("room.obj", "model.hbjson") + more;
    let files = MapFiles::default().with("model.hbjson", model.to_string());
    load_text(&project, &files).map_err(|error| error.to_string())
}

fn loaded(model: &Value) -> Loaded {
    try_load(model, "").unwrap()
}

fn area(scene: &Scene, wanted: impl Fn(&str) -> bool) -> f64 {
    let mesh = &scene.mesh;
    let triangles = (0..mesh.triangles.len() as u32)
        .filter(|&t| wanted(&mesh.objects[mesh.object_of[t as usize] as usize]));
    triangles.map(|t| mesh.area_m2(t)).sum()
}

fn material_of<'l>(loaded: &'l Loaded, object: &str) -> &'l quasilux_scene::Material {
    let mesh = &loaded.scene.mesh;
    let is_of = |t: &u32| &*mesh.objects[mesh.object_of[*t as usize] as usize] == object;
    let triangle = (0..mesh.triangles.len() as u32).find(is_of).expect(object);
    loaded.scene.material(triangle)
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0), "{found} is not {expected}");
}

/// The volume by the divergence theorem: outward faces make it positive.
fn volume(scene: &Scene) -> f64 {
    let mesh = &scene.mesh;
    let of = |t: u32| {
        let [a, b, c] = mesh.corners(t);
        a.dot(b.cross(c)) / 6.0
    };
    (0..mesh.triangles.len() as u32).map(of).sum()
}

#[test]
fn a_box_is_closed_in_any_unit() {
    for (unit, metres) in [
        ("Meters", 1.0),
        ("Millimeters", 0.001),
        ("Feet", 0.3048),
        ("Inches", 0.0254),
        ("Centimeters", 0.01),
    ] {
        let mut model = model(&[room("a", [0.0; 3], [4.0, 3.0, 2.5])]);
        model["units"] = json!(unit);
        let scene = loaded(&model).scene;
        let close = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() < 1e-12, "{unit}: {found} is not {expected}");
        };
        close(volume(&scene), 30.0 * metres * metres * metres);
        close(area(&scene, |_| true), 59.0 * metres * metres);
        assert_eq!((scene.mesh.positions.len(), scene.mesh.triangles.len()), (8, 12));
    }
    let mut model = model(&[room("a", [0.0; 3], [1.0; 3])]);
    model["units"] = json!("Miles");
    let error = try_load(&model, "").unwrap_err();
    assert!(error.contains("units: unknown variant `Miles`, expected one of `Meters`"), "{error}");
}

/// The unit is that of the model, whatever the project says of other files.
#[test]
fn units_of_the_project_are_those_of_other_files() {
    let model = model(&[room("a", [0.0; 3], [4.0, 3.0, 2.5])]);
    let project =
        PROJECT.replace("[\"room.obj\"]", "[\"model.hbjson\"]\nunits = \"mm\"\nup = \"y\"");
    let files = MapFiles::default().with("model.hbjson", model.to_string());
    close(volume(&load_text(&project, &files).unwrap().scene), 30.0);
}

#[test]
fn honeybees_own_modifiers_stand_behind_all_others() {
    let mut room = room("a", [0.0; 3], [4.0, 3.0, 2.5]);
    room["faces"][2]["apertures"] = json!([window("pane", upright(0.0, [1.0, 1.0], [2.0, 2.0]))]);
    let door = window("door", upright(3.0, [1.0, 0.0], [2.0, 2.0]));
    let mut glass_door = window("glass door", upright(3.0, [2.5, 0.0], [3.5, 2.0]));
    glass_door["is_glass"] = json!(true);
    room["faces"][3]["doors"] = json!([door, glass_door]);
    let shade =
        |name| json!({"identifier": name, "geometry": upright(9.0, [0.0, 0.0], [1.0, 1.0])});
    room["indoor_shades"] = json!([shade("inside")]);
    room["faces"][2]["apertures"][0]["outdoor_shades"] = json!([shade("outside")]);
    let mut model = model(&[room]);
    model["orphaned_shades"] = json!([shade("tree")]);
    model["shade_meshes"] = json!([{"identifier": "mesh", "geometry": {
        "vertices": [[9, 9, 0], [10, 9, 0], [10, 10, 0], [9, 10, 0]],
        "faces": [[0, 1, 2, 3], [0, 1, 2]],
    }}]);
    let mut attached = model["shade_meshes"][0].clone();
    attached["identifier"] = json!("attached");
    attached["is_detached"] = json!(false);
    model["shade_meshes"].as_array_mut().unwrap().push(attached);
    let loaded = loaded(&model);
    for (object, reflectance) in [
        ("a_floor", 0.2),
        ("a_ceiling", 0.8),
        ("a_west", 0.5),
        ("door", 0.5),
        ("inside", 0.5),
        ("outside", 0.35),
        ("tree", 0.2),
        ("mesh", 0.2),
        ("attached", 0.35),
    ] {
        let found = material_of(&loaded, object).bsdf.reflectance().map(|it| it.luminance());
        assert_eq!(found, Some(reflectance), "{object}");
    }
    for object in ["pane", "glass door"] {
        let Bsdf::Pane(Pane::Measured { transmittance, .. }) = &material_of(&loaded, object).bsdf
        else {
            panic!("{object} is no pane")
        };
        assert!((transmittance.at_angle(0.0) - 0.64).abs() < 1e-4, "{object}");
    }
    close(area(&loaded.scene, |name| name == "mesh"), 1.5);
    close(area(&loaded.scene, |name| name == "a_south"), 9.0);
    close(area(&loaded.scene, |name| name == "a_north"), 6.0);
    // What is cut out is filled: the box is closed as before.
    let of_box = |name: &str| name.starts_with("a_") || name == "pane" || name.ends_with("door");
    close(area(&loaded.scene, of_box), 59.0);
    assert_eq!(warnings_of(&loaded), Vec::<String>::new());
}

/// Own, of the room, of the model.
#[test]
fn the_nearest_modifier_counts() {
    let grey = |name: &str, share: f64| {
        json!({"type": "Plastic", "identifier": name, "r_reflectance": share,
               "g_reflectance": share, "b_reflectance": share})
    };
    let mut first = room("a", [0.0; 3], [4.0, 3.0, 2.5]);
    first["faces"][2]["properties"]["radiance"]["modifier"] = json!("own");
    first["properties"] = json!({"radiance": {"modifier_set": "rooms"}});
    let second = room("b", [5.0, 0.0, 0.0], [9.0, 3.0, 2.5]);
    let mut model = model(&[first, second]);
    model["properties"]["radiance"] = json!({
        "modifiers": [grey("own", 0.11), grey("wall of rooms", 0.12)],
        "modifier_sets": [{"type": "ModifierSetAbridged", "identifier": "rooms",
            "wall_set": {"exterior_modifier": "wall of rooms", "interior_modifier": null}}],
        "global_modifier_set": {"type": "GlobalModifierSet",
            "modifiers": [grey("wall of all", 0.13), grey("floor of all", 0.14)],
            "wall_set": {"exterior_modifier": "wall of all"},
            "floor_set": {"exterior_modifier": "floor of all"}},
    });
    let found = loaded(&model);
    for (object, reflectance) in [
        ("a_south", 0.11),
        ("a_north", 0.12),
        ("a_floor", 0.14),
        ("b_south", 0.13),
        ("b_ceiling", 0.8),
    ] {
        let material = material_of(&found, object);
        assert_eq!(material.bsdf.reflectance().unwrap().luminance(), reflectance, "{object}");
    }
    // The project file goes before all of them.
    let more = "[materials.own]\nreflectance = 0.9\n";
    let found = try_load(&model, more).unwrap();
    assert_eq!(material_of(&found, "a_south").bsdf.reflectance().unwrap().luminance(), 0.9);
    model["rooms"][0]["properties"]["radiance"]["modifier_set"] = json!("room");
    let error = try_load(&model, "").unwrap_err();
    assert!(
        error.contains("model.hbjson: rooms[0].properties.radiance.modifier_set: no set is called")
            && error.ends_with("did you mean \"rooms\"?"),
        "{error}"
    );
    model["rooms"][0]["properties"] = json!({});
    model["rooms"][0]["faces"][2]["properties"]["radiance"]["modifier"] = json!("owm");
    let error = try_load(&model, "").unwrap_err();
    assert!(
        error.contains("model.hbjson: rooms[0].faces[2]: no modifier is called \"owm\"")
            && error.ends_with("did you mean \"own\"?"),
        "{error}"
    );
}

/// Two rooms side by side, with a window between them, then with air.
#[test]
fn faces_between_rooms_come_once_and_air_boundaries_not_at_all() {
    let mut rooms =
        [room("a", [0.0; 3], [4.0, 3.0, 2.5]), room("b", [0.0, 3.0, 0.0], [4.0, 6.0, 2.5])];
    let mut join = |room: usize, face: usize, own: &str, [other, other_room]: [&str; 2]| {
        let face = &mut rooms[room]["faces"][face];
        face["boundary_condition"] =
            json!({"type": "Surface", "boundary_condition_objects": [other, other_room]});
        let mut pane = window(own, upright(3.0, [1.0, 1.0], [2.0, 2.0]));
        let other_pane = if own == "pane of a" { "pane of b" } else { "pane of a" };
        pane["boundary_condition"] = json!({"type": "Surface",
            "boundary_condition_objects": [other_pane, other, other_room]});
        face["apertures"] = json!([pane]);
    };
    join(0, 3, "pane of a", ["b_south", "b"]);
    join(1, 2, "pane of b", ["a_north", "a"]);
    let model_of = |rooms: &[Value]| loaded(&model(rooms));
    let found = model_of(&rooms);
    close(area(&found.scene, |_| true), 59.0 + 59.0 - 10.0);
    close(area(&found.scene, |name| name == "a_north"), 9.0);
    close(area(&found.scene, |name| name == "b_south" || name == "pane of b"), 0.0);
    let Bsdf::Pane(Pane::Measured { transmittance, .. }) = &material_of(&found, "pane of a").bsdf
    else {
        panic!("no pane")
    };
    assert!((transmittance.at_angle(0.0) - 0.88).abs() < 1e-4);
    for (room, face) in [(0, 3), (1, 2)] {
        rooms[room]["faces"][face]["face_type"] = json!("AirBoundary");
        rooms[room]["faces"][face]["apertures"] = json!([]);
    }
    let found = model_of(&rooms);
    close(area(&found.scene, |_| true), 59.0 + 59.0 - 20.0);
    assert!(warnings_of(&found).is_empty(), "{:?}", warnings_of(&found));
    // Both rooms are one.
    close(volume(&found.scene), 60.0);
    // One side alone, the other room not in the model.
    close(area(&loaded(&model(&rooms[..1])).scene, |_| true), 49.0);
    rooms[0]["faces"][3]["face_type"] = json!("Wall");
    close(area(&loaded(&model(&rooms[..1])).scene, |_| true), 59.0);
}

/// Facts of the side that comes second are told where they are not those of the first one.
#[test]
fn states_of_the_second_side_are_told() {
    let mut rooms =
        [room("a", [0.0; 3], [4.0, 3.0, 2.5]), room("b", [0.0, 3.0, 0.0], [4.0, 6.0, 2.5])];
    let pane = |own: &str, other: &str| {
        let mut pane = window(own, upright(3.0, [1.0, 1.0], [2.0, 2.0]));
        pane["boundary_condition"] =
            json!({"type": "Surface", "boundary_condition_objects": [other]});
        json!([pane])
    };
    rooms[0]["faces"][3]["apertures"] = pane("a", "b");
    rooms[1]["faces"][2]["apertures"] = pane("b", "a");
    let states = json!({"radiance": {"dynamic_group_identifier": "g", "states": [{}, {}]}});
    rooms[1]["faces"][2]["apertures"][0]["properties"] = states.clone();
    let told = |rooms: &[Value]| {
        let told = warnings_of(&loaded(&model(rooms)));
        told.into_iter().filter(|it| it.contains("its states are left out")).count()
    };
    assert_eq!(told(&rooms), 1);
    rooms[0]["faces"][3]["apertures"][0]["properties"] = states;
    assert_eq!(told(&rooms), 0);
}

/// Two of one name that say different things are two materials; that say the same, one.
#[test]
fn modifiers_in_place_are_told_apart() {
    let grey = |share: f64| {
        json!({"type": "Plastic", "identifier": "m", "r_reflectance": share,
               "g_reflectance": share, "b_reflectance": share})
    };
    let mut room = room("a", [0.0; 3], [4.0, 3.0, 2.5]);
    for (face, share) in [(2, 0.3), (3, 0.6), (4, 0.3)] {
        room["faces"][face]["properties"]["radiance"]["modifier"] = grey(share);
    }
    let loaded = loaded(&model(&[room]));
    for (object, name, reflectance) in
        [("a_south", "m", 0.3), ("a_north", "m 2", 0.6), ("a_west", "m", 0.3)]
    {
        let material = material_of(&loaded, object);
        let found = material.bsdf.reflectance().map(|it| it.luminance());
        assert_eq!((material.name.as_str(), found), (name, Some(reflectance)), "{object}");
    }
}

/// Rooms and windows at random, some at edges and corners: nothing is lost, nothing is twice.
#[test]
fn random_windows_keep_the_area_of_the_room() {
    let mut stream = crate::support::Stream(7);
    let mut step = |most: usize| stream.below(most) as f64 / 8.0;
    for _ in 0..200 {
        let [x, y, z] = [2.0 + step(32), 2.0 + step(32), 2.0 + step(16)];
        let mut room = room("a", [0.0; 3], [x, y, z]);
        // Windows in columns of their own along x, which may touch one another.
        let (mut left, mut windows, mut glass) = (step(4), Vec::new(), 0.0);
        while left < x {
            let (width, low) = (0.125 + step(8), step(12));
            let right = (left + width).min(x);
            let high = (low + 0.125 + step(16)).min(z);
            windows.push(window("w", upright(0.0, [left, low], [right, high])));
            glass += (right - left) * (high - low);
            left = right + step(3);
        }
        room["faces"][2]["apertures"] = json!(windows);
        let loaded = loaded(&model(&[room]));
        close(area(&loaded.scene, |name| name == "a_south"), x * z - glass);
        close(area(&loaded.scene, |_| true), 2.0 * (x * y + y * z + z * x));
        close(volume(&loaded.scene), x * y * z);
        assert!(warnings_of(&loaded).is_empty(), "{:?}", warnings_of(&loaded));
    }
}

#[test]
fn windows_that_overlap_are_told() {
    let mut room = room("a", [0.0; 3], [4.0, 3.0, 2.5]);
    room["faces"][2]["apertures"] = json!([
        window("w", upright(0.0, [1.0, 1.0], [2.0, 2.0])),
        window("v", upright(0.0, [1.5, 1.0], [2.5, 2.0])),
    ]);
    let loaded = loaded(&model(&[room]));
    close(area(&loaded.scene, |name| name == "a_south"), 8.5);
    let warnings = warnings_of(&loaded);
    assert!(warnings[0].contains("rooms[0].faces[2]: its holes, apertures"), "{warnings:?}");
}

/// Each kind of modifier, and what it becomes.
#[test]
fn modifiers_become_materials() {
    let with = |modifier: Value| {
        let mut room = room("a", [0.0; 3], [4.0, 3.0, 2.5]);
        room["faces"][2]["properties"]["radiance"]["modifier"] = json!("m");
        let mut model = model(&[room]);
        model["properties"]["radiance"]["modifiers"] = json!([modifier]);
        model
    };
    let bsdf = |modifier: Value| {
        let loaded = loaded(&with(modifier));
        (material_of(&loaded, "a_south").bsdf.clone(), warnings_of(&loaded).len())
    };
    let grey = |kind: &str, specularity: f64, roughness: f64| {
        json!({"type": kind, "identifier": "m", "r_reflectance": 0.5, "g_reflectance": 0.5,
               "b_reflectance": 0.5, "specularity": specularity, "roughness": roughness,
               "modifier": null})
    };
    let kind = |(bsdf, warnings): (Bsdf, usize)| (bsdf.kind(), warnings);
    assert_eq!(kind(bsdf(grey("Plastic", 0.0, 0.1))), ("diffuse", 0));
    let (Bsdf::Plastic(plastic), 1) = bsdf(grey("Plastic", 0.04, 0.1)) else { panic!("plastic") };
    assert!((plastic.eta - 1.5).abs() < 1e-12 && plastic.alpha == 0.1, "{plastic:?}");
    assert_eq!(kind(bsdf(grey("Metal", 1.0, 0.0))), ("mirror", 0));
    assert_eq!(kind(bsdf(grey("Metal", 0.9, 0.2))), ("conductor", 1));
    assert_eq!(kind(bsdf(grey("Mirror", 0.0, 0.0))), ("mirror", 0));
    let mut trans = grey("Trans", 0.0, 0.0);
    trans["transmitted_diff"] = json!(0.4);
    let (Bsdf::Translucent(sheet), 0) = bsdf(trans.clone()) else { panic!("a sheet") };
    close(sheet.reflectance.luminance(), 0.3);
    close(sheet.transmittance.luminance(), 0.2);
    trans["transmitted_spec"] = json!(0.5);
    assert_eq!(kind(bsdf(trans)), ("diffuse", 1));
    let glass = json!({"type": "Glass", "identifier": "m", "r_transmissivity": 0.96,
                       "g_transmissivity": 0.9, "b_transmissivity": 0.9});
    assert!(matches!(bsdf(glass), (Bsdf::Pane(Pane::Tinted { .. }), 1)));
    let textured =
        json!({"type": "Plastic", "identifier": "m", "modifier": {"type": "brightfunc"}});
    assert_eq!(kind(bsdf(textured)), ("diffuse", 1));
    // A light shines by the project file, and is black.
    let light = json!({"type": "Light", "identifier": "m", "r_emittance": 10.0,
                       "g_emittance": 10.0, "b_emittance": 10.0});
    assert_eq!(kind(bsdf(light.clone())), ("diffuse", 1));
    let shining = "[[lights]]\nkind = \"area\"\nmaterial = \"m\"\nluminance_cd_m2 = 1790\n";
    assert!(warnings_of(&try_load(&with(light), shining).unwrap()).is_empty());
    let error = try_load(&with(json!({"type": "Ashik2", "identifier": "m"})), "").unwrap_err();
    assert!(error.contains("modifier \"m\" is of the type \"Ashik2\""), "{error}");
    let odd = with(json!({"type": "Ashik2", "identifier": "m"}));
    assert!(try_load(&odd, "[materials.m]\nreflectance = 0.3\n").is_ok());
    let error = try_load(&with(grey("Plastic", 1.5, 0.0)), "").unwrap_err();
    assert!(error.contains("modifier \"m\": specularity is 1.5; expected a share"), "{error}");
    let void = loaded(&with(json!({"type": "Void", "identifier": "m"})));
    close(area(&void.scene, |name| name == "a_south"), 0.0);
    assert!(warnings_of(&void)[0].contains("surfaces of \"m\" are left out"));
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let refusal = |change: &dyn Fn(&mut Value)| {
        let mut model = model(&[room("a", [0.0; 3], [4.0, 3.0, 2.5])]);
        change(&mut model);
        try_load(&model, "").unwrap_err()
    };
    let expect = |change: &dyn Fn(&mut Value), text: &str| {
        let error = refusal(change);
        assert!(error.starts_with("model.hbjson:") && error.contains(text), "{error}");
    };
    expect(
        &|model| model["rooms"][0]["faces"][1]["geometry"]["boundary"][2] = json!([1, 2]),
        "rooms[0].faces[1].geometry.boundary[2]: invalid length 2, expected three numbers",
    );
    expect(
        &|model| model["rooms"][0]["faces"][1]["face_type"] = json!("Roof"),
        "rooms[0].faces[1].face_type: unknown variant `Roof`, expected one of `Wall`",
    );
    expect(
        &|model| model["rooms"][0]["faces"][1]["geometry"] = json!({}),
        "rooms[0].faces[1].geometry: missing field `boundary`",
    );
    expect(
        &|model| {
            model["shade_meshes"] = json!([{"identifier": "m", "geometry":
            {"vertices": [[0, 0, 0]], "faces": [[0, 1, 2]]}}])
        },
        "shade_meshes[0].geometry.faces[0] has the vertex 1; expected numbers below 1",
    );
    expect(&|model| model["type"] = json!("Room"), "type: found \"Room\"; expected \"Model\"");
    expect(
        &|model| model["rooms"][0]["faces"][0]["geometry"]["boundary"][0] = json!([1e300, 0, 0]),
        "rooms[0].faces[0] has a vertex that is not finite or beyond",
    );
    expect(&|model| model["rooms"] = json!([]), "no triangles");
    // A polygon of two corners is no reason to refuse a building.
    let mut model = model(&[room("a", [0.0; 3], [4.0, 3.0, 2.5])]);
    model["rooms"][0]["faces"][1]["geometry"]["boundary"] = json!([[0, 0, 1], [1, 0, 1]]);
    let warnings = warnings_of(&loaded(&model));
    assert!(warnings[0].contains("fewer than three corners is left out"), "{warnings:?}");
}
