//! GLDF containers as luminaires of a project.

use crate::container::{Zip, fixed, ies, ldt, photometries, product, variant};
use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use glam::DVec3;
use quasilux_scene::light::Luminaire;
use quasilux_scene::{Light, Loaded};

fn product_bytes() -> Vec<u8> {
    let turned = fixed("b.ies", "<Rotation><X>0</X><Y>0</Y><Z>0</Z><G0>90</G0></Rotation>", "");
    let exit = fixed("a.ldt", "", "emergencyBehaviour=\"EmergencyOnly\"");
    let down = fixed("a.ldt", "<RatedLuminousFlux>3000</RatedLuminousFlux>", "");
    let definitions = photometries(&["a.ldt", "b.ies"])
        + &format!(
            "<Emitters><Emitter id=\"down\">{down}</Emitter><Emitter id=\"turned\">{turned}\
             </Emitter><Emitter id=\"exit\">{exit}</Emitter></Emitters>"
        );
    let variants = variant("v", "down") + &variant("w", "turned") + &variant("x", "exit");
    Zip::default()
        .file("product.xml", product(&definitions, &variants).as_bytes())
        .file("ldc/a.ldt", ldt(1, 1000.0).as_bytes())
        .file("ldc/b.ies", ies(2, 500.0).as_bytes())
        .finish()
}

fn files() -> MapFiles {
    MapFiles::room().with("lamps/p.gldf", product_bytes())
}

fn luminaire(keys: &str) -> String {
    format!("[[luminaires]]\nphotometry = \"lamps/p.gldf\"\nposition = [0, 0, 2]\n{keys}\n")
}

fn lit(luminaires: &str) -> Loaded {
    load_text(&format!("{PROJECT}{luminaires}"), &files()).unwrap_or_else(|error| panic!("{error}"))
}

fn light(loaded: &Loaded, index: usize) -> &Luminaire {
    match &loaded.scene.lights[index] {
        Light::Luminaire(light) => light,
        other => panic!("{other:?}"),
    }
}

#[test]
fn keys_choose_a_light_of_the_container() {
    let loaded =
        lit(&(luminaire("variant = \"v\"") + &luminaire("variant = \"x\"\nemergency = true")));
    assert!((light(&loaded, 0).flux_lm() - 3000.0).abs() < 1e-9);
    assert!((light(&loaded, 1).flux_lm() - 1000.0).abs() < 1e-9);
    assert_eq!(light(&loaded, 0).photometry.name(), "lamps/p.gldf (v)");
    let note = "lamps/p.gldf (x, emergency): emitter: exit".to_owned();
    assert!(loaded.luminaire_notes.contains(&note), "{:?}", loaded.luminaire_notes);
    let [flux] = &warnings_of(&loaded)[..] else { panic!("{:?}", loaded.warnings) };
    assert!(flux.starts_with("lamps/p.gldf/product.xml:"), "{flux}");
    // Other keys of a luminaire hold as before.
    let loaded = lit(&luminaire("variant = \"v\"\nflux_lm = 500\nas = \"area\""));
    assert!((light(&loaded, 0).flux_lm() - 500.0).abs() < 1e-9);
    assert!((light(&loaded, 0).shape.size_m() - DVec3::new(0.1, 1.2, 0.0)).length() < 1e-12);
}

#[test]
fn a_file_is_read_once_for_each_choice() {
    let loaded = lit(&(luminaire("variant = \"v\"") + &luminaire("variant = \"v\"")));
    assert!(std::sync::Arc::ptr_eq(&light(&loaded, 0).photometry, &light(&loaded, 1).photometry));
    assert_eq!(loaded.warnings.len(), 1);
}

#[test]
fn lights_of_one_container_tell_the_same_once() {
    let bytes = |emitters: &str| {
        let light = fixed("a.ldt", "", "");
        let exit = fixed("a.ldt", "", "emergencyBehaviour=\"EmergencyOnly\"");
        let definitions = photometries(&["a.ldt"])
            + &format!(
                "<Emitters><Emitter id=\"down\">{light}</Emitter><Emitter id=\"up\">{light}\
                 </Emitter><Emitter id=\"exit\">{exit}</Emitter></Emitters>"
            );
        let variants = format!("<Variant id=\"v\"><Geometry>{emitters}</Geometry></Variant>");
        Zip::default()
            .file("product.xml", product(&definitions, &variants).as_bytes())
            .file("ldc/a.ldt", ldt(1, 1000.0).as_bytes())
            .finish()
    };
    let all = ["down", "up", "exit"].map(|id| format!("<EmitterReference emitterId=\"{id}\"/>"));
    let files = MapFiles::room().with("lamps/p.gldf", bytes(&all.concat()));
    let luminaires = luminaire("emitter = \"down\"") + &luminaire("emitter = \"up\"");
    let loaded = load_text(&format!("{PROJECT}{luminaires}"), &files).unwrap();
    let [told] = &warnings_of(&loaded)[..] else { panic!("{:?}", loaded.warnings) };
    assert!(told.contains("emergencies only: \"exit\""), "{told}");
}

#[test]
fn the_container_turns_its_photometry_in_the_luminaire() {
    let keys = "variant = \"w\"\nrotation_deg = 30";
    let loaded = lit(&luminaire(keys));
    let turned = light(&loaded, 0);
    // C0 of the file is C90 of the luminaire: 30 + 90 degrees from +x.
    let (sin, cos) = libm::sincos(120_f64.to_radians());
    assert!((turned.world_from_luminaire * DVec3::X - DVec3::new(cos, sin, 0.0)).length() < 1e-12);
    let toward = DVec3::new(0.6 * cos, 0.6 * sin, -0.8);
    let in_file = DVec3::new(0.6, 0.0, -0.8);
    let expected_cd = turned.photometry.intensity_cd(in_file);
    assert!((turned.intensity_cd(toward) - expected_cd).abs() < 1e-9);
}

#[test]
fn missing_and_wrong_choices_are_refused_with_their_place() {
    let refused = |luminaires: &str| {
        load_text(&format!("{PROJECT}{luminaires}"), &files()).unwrap_err().to_string()
    };
    let several = refused(&luminaire(""));
    assert!(several.starts_with("lamps/p.gldf/product.xml:"), "{several}");
    assert!(several.contains("\"variant\" with one of \"v\" (\"Name of v\")"), "{several}");
    let unknown = refused(&luminaire("variant = \"z\""));
    assert!(unknown.contains("the variant \"z\""), "{unknown}");
    let keys = "[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\nvariant = \"v\"\n";
    let none = refused(keys);
    assert!(none.contains("\"variant\" chooses from a GLDF container"), "{none}");
    assert!(none.starts_with("room.toml:19:11:"), "{none}");
    let kind = refused(&luminaire("emergency = \"yes\""));
    assert!(kind.contains("true or false"), "{kind}");
    for (name, program) in [("a.uld", "DIALux"), ("a.rolf", "Relux")] {
        let error = refused(&luminaire("").replace("lamps/p.gldf", name));
        assert!(error.contains(program) && error.starts_with("room.toml:17:14:"), "{error}");
    }
}
