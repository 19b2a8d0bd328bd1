//! What a scene cannot have of a Honeybee model is told, and what a model leaves out is no matter.

use crate::honeybee::{model, room, upright, window};
use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::{ImportTerms, import_honeybee};
use serde_json::{Value, json};

fn load(model: &Value) -> Result<Vec<String>, String> {
    let project = PROJECT.replace("room.obj", "m.hbjson");
    let files = MapFiles::default().with("m.hbjson", model.to_string());
    let loaded = load_text(&project, &files).map_err(|error| error.to_string())?;
    Ok(warnings_of(&loaded))
}

fn a_box() -> Value {
    model(&[room("a", [0.0; 3], [4.0, 3.0, 2.5])])
}

/// A model with modifiers, the first of which the south wall has.
fn with_modifiers(modifiers: Value) -> Value {
    let mut model = a_box();
    model["rooms"][0]["faces"][2]["properties"]["radiance"]["modifier"] =
        modifiers[0]["identifier"].clone();
    model["properties"]["radiance"]["modifiers"] = modifiers;
    model
}

fn expect(model: &Value, text: &str) {
    let told = load(model).unwrap();
    assert!(told.iter().any(|it| it.contains(text)), "{text}: {told:?}");
}

#[test]
fn modifiers_say_what_they_lose() {
    let grey = |kind: &str, specularity: f64, transmitted: f64| {
        json!({"type": kind, "identifier": "m", "r_reflectance": 0.5, "g_reflectance": 0.5,
               "b_reflectance": 0.5, "specularity": specularity, "roughness": 0.1,
               "transmitted_diff": transmitted, "transmitted_spec": transmitted})
    };
    expect(&with_modifiers(json!([grey("Plastic", 0.5, 0.0)])), "above 0.44");
    expect(&with_modifiers(json!([grey("Trans", 0.0, 0.5)])), "its roughness is left out");
    let twins = with_modifiers(json!([grey("Plastic", 0.0, 0.0), grey("Plastic", 0.1, 0.0)]));
    expect(&twins, "modifier \"m\": the model has different modifiers of this name");
    let twins = with_modifiers(json!([grey("Plastic", 0.0, 0.0), grey("Plastic", 0.0, 0.0)]));
    assert_eq!(load(&twins), Ok(vec![]));
}

#[test]
fn measured_sheets_say_what_they_lose() {
    let mut model =
        with_modifiers(json!([{"type": "BSDF", "identifier": "m", "bsdf_data": "<a/>"}]));
    let told = |model: &Value, key: &str, value: Value| {
        let mut model = model.clone();
        model["properties"]["radiance"]["modifiers"][0][key] = value;
        let bytes = model.to_string();
        let terms = ImportTerms { model: "m", geometry: "m", weather: None, stem: "m" };
        // The text of the sheet is wrong, which is none of the import's concern.
        let told = import_honeybee(bytes.as_bytes(), &terms).unwrap().findings;
        told.iter().map(ToString::to_string).collect::<Vec<String>>().join("; ")
    };
    model["properties"]["radiance"]["sensor_grids"] = json!([]);
    for key in ["front_diffuse_reflectance", "back_diffuse_reflectance", "diffuse_transmittance"] {
        assert!(told(&model, key, json!([0.1, 0.1, 0.1])).contains("diffuse light beside"));
        assert!(!told(&model, key, json!([0, 0, 0])).contains("diffuse light beside"));
    }
    assert!(told(&model, "function_file", json!("a.cal")).contains("its function_file"));
    assert!(told(&model, "dependencies", json!([{}])).contains("its function_file"));
    assert!(!told(&model, "function_file", json!(".")).contains("its function_file"));
}

#[test]
fn holes_of_windows_are_told() {
    let mut model = a_box();
    let mut pane = window("pane", upright(0.0, [1.0, 1.0], [3.0, 2.0]));
    pane["geometry"]["holes"] = json!([upright(0.0, [1.5, 1.2], [2.0, 1.8])["boundary"].clone()]);
    model["rooms"][0]["faces"][2]["apertures"] = json!([pane]);
    expect(&model, "rooms[0].faces[2]: holes of its apertures and doors are open");
}

/// Parts that `quasilux import` would leave out are not said to be in its files.
#[test]
fn only_what_can_be_had_is_missed() {
    let mut model = a_box();
    let view = json!({"identifier": "v", "position": [1, 1, 1], "direction": [1, 0, 0],
                      "view_type": "h"});
    model["properties"]["radiance"] = json!({
        "luminaires": [{"identifier": "l"}, {"luminaire_zone": {"instances": []}}],
        "sensor_grids": [{"identifier": "g", "sensors": []}],
        "views": [view],
    });
    assert_eq!(load(&model), Ok(vec![]));
    model["properties"]["radiance"]["views"][0]["view_type"] = json!("v");
    expect(&model, "views (1) are not in the project");
}

#[test]
fn lists_and_sets_are_refused_by_their_place() {
    let mut model = a_box();
    model["properties"]["radiance"]["modifiers"] = json!(vec![json!({}); 100_001]);
    let error = load(&model).unwrap_err();
    assert!(
        error.contains("properties.radiance.modifiers: invalid length 100001, expected a list of"),
        "{error}"
    );
    let mut model = a_box();
    model["properties"]["radiance"]["global_modifier_set"] = json!("mine");
    let error = load(&model).unwrap_err();
    assert!(error.contains("global_modifier_set: no set is called \"mine\""), "{error}");
    model["properties"]["radiance"]["global_modifier_set"] =
        json!("Generic_Interior_Visible_Modifier_Set");
    assert_eq!(load(&model), Ok(vec![]));
}

#[test]
fn null_is_as_good_as_nothing() {
    let mut model = a_box();
    model["rooms"][0]["properties"] = json!(null);
    model["rooms"][0]["faces"][0]["boundary_condition"] = json!(null);
    model["rooms"][0]["faces"][1]["properties"] = json!(null);
    assert_eq!(load(&model), Ok(vec![]));
    model["properties"] = json!(null);
    assert_eq!(load(&model), Ok(vec![]));
}
