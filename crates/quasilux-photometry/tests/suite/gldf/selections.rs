//! Variants, emitters and light sources that are chosen, and choices that are missing.

use super::{close, container, ies_flux_lm, kinds, only, read, refused};
use crate::container::{fixed, variant};
use quasilux_photometry::WarningKind;

/// Emitters that each have one light, of which `exit` shines in an emergency only.
fn emitters() -> String {
    format!(
        "<Emitters><Emitter id=\"down\">{}</Emitter><Emitter id=\"up\">{}</Emitter><Emitter \
         id=\"exit\">{}</Emitter><Emitter id=\"eye\"><SensorEmitter/></Emitter></Emitters>",
        fixed("a.ldt", "", ""),
        fixed("b.ies", "<Name>Indirect</Name>", "emergencyBehaviour=\"None\""),
        fixed("a.ldt", "", "emergencyBehaviour=\"EmergencyOnly\""),
    )
}

fn model(ids: &[(&str, &str)]) -> String {
    let references: String = ids
        .iter()
        .map(|(id, object)| {
            format!(
                "<EmitterReference emitterId=\"{id}\"><EmitterObjectExternalName>{object}\
                 </EmitterObjectExternalName></EmitterReference>"
            )
        })
        .collect();
    format!(
        "<Variant id=\"v\"><Name>V</Name><Geometry><ModelGeometryReference geometryId=\"g\">\
         {references}</ModelGeometryReference></Geometry></Variant>"
    )
}

#[test]
fn several_variants_need_a_name() {
    let bytes = container(&emitters(), &(variant("x", "down") + &variant("y", "up")));
    let message = refused(&bytes, &[]);
    assert!(message.contains("found 2 variants; expected \"variant\" with one of"), "{message}");
    assert!(message.contains("\"x\" (\"Name of x\"), \"y\" (\"Name of y\")"), "{message}");
    close(read(&bytes, &["variant=x"]).photometry.flux_lm(), 1000.0);
    close(read(&bytes, &["variant=Name of y"]).photometry.flux_lm(), ies_flux_lm(2, 500.0));
    let message = refused(&bytes, &["variant=z"]);
    assert!(message.contains("the variant \"z\"; expected one of \"x\""), "{message}");
    // The same name twice is no choice.
    let twice = variant("x", "down").replace("Name of x", "N")
        + &variant("y", "up").replace("Name of y", "N");
    refused(&container(&emitters(), &twice), &["variant=N"]);
    assert!(refused(&container(&emitters(), ""), &[]).contains("a product without variants"));
}

#[test]
fn several_lights_of_a_variant_need_a_name() {
    let bytes =
        container(&emitters(), &model(&[("down", "LEO 1"), ("up", "LEO 2"), ("exit", "X")]));
    let message = refused(&bytes, &[]);
    assert!(message.contains("2 emitters that shine"), "{message}");
    assert!(message.contains("\"down\" (at \"LEO 1\" of the 3D model)"), "{message}");
    assert!(!message.contains("\"exit\""), "{message}");
    for name in ["up", "LEO 2", "Indirect"] {
        let luminaire = read(&bytes, &[&format!("emitter={name}")]);
        close(luminaire.photometry.flux_lm(), ies_flux_lm(2, 500.0));
        assert_eq!(kinds(&luminaire), [WarningKind::EmergencyEmitter]);
    }
    let message = refused(&bytes, &["emitter=left"]);
    assert!(
        message.contains("\"exit\" (at \"X\" of the 3D model, in an emergency only)"),
        "{message}"
    );
}

#[test]
fn what_shines_in_emergencies_and_sensors_are_not_chosen() {
    let variants = model(&[("exit", "X"), ("eye", "S"), ("down", "D")]);
    let bytes = container(&emitters(), &variants);
    let luminaire = read(&bytes, &[]);
    let told = only(&luminaire.warnings, WarningKind::EmergencyEmitter);
    assert!(
        told.contains("emergencies only: \"exit\"") && told.contains("not in this light"),
        "{told}"
    );
    let fact = |name: &str| luminaire.facts.iter().find(|fact| fact.name == name).unwrap();
    assert_eq!(fact("emitter").value, "down");
    assert_eq!(fact("sensors").value, "\"eye\"");
    let emergency = read(&bytes, &["emergency"]);
    assert_eq!(emergency.facts.iter().find(|it| it.name == "emitter").unwrap().value, "exit");
    let message = refused(&bytes, &["emitter=eye"]);
    assert!(message.contains("the emitter \"eye\", a sensor"), "{message}");
    let sensor = container(&emitters(), &variant("v", "eye"));
    assert!(refused(&sensor, &[]).contains("a variant without light"));
    assert!(refused(&sensor, &["emergency"]).contains("no emitter with light in an emergency"));
}

#[test]
fn light_sources_that_can_be_exchanged_need_a_name() {
    let light = |source: &str, name: &str, attributes: &str| {
        let more =
            format!("<Name>{name}</Name><LightSourceReference fixedLightSourceId=\"{source}\"/>");
        fixed("a.ldt", &format!("{more}<RatedLuminousFlux>500</RatedLuminousFlux>"), attributes)
    };
    let sources = "<LightSources><FixedLightSource id=\"led\"/><FixedLightSource id=\"cold\"/>\
        </LightSources>";
    let lights = light("led", "Warm", "")
        + &light("cold", "Cold", "")
        + &light("led", "Exit", "emergencyBehaviour=\"EmergencyOnly\"");
    let definitions = format!("{sources}<Emitters><Emitter id=\"e\">{lights}</Emitter></Emitters>");
    let bytes = container(&definitions, &variant("v", "e"));
    let message = refused(&bytes, &[]);
    // `led` is a source of two, of which one shines in normal operation.
    assert!(message.contains("\"led\" (\"Warm\"), \"cold\" (\"Cold\")"), "{message}");
    for name in ["Warm", "led", "cold", "Cold", "1", "2"] {
        close(read(&bytes, &[&format!("light_source={name}")]).photometry.flux_lm(), 500.0);
    }
    let luminaire = read(&bytes, &["light_source=3"]);
    assert!(kinds(&luminaire).contains(&WarningKind::EmergencyEmitter));
    for name in ["0", "4", "none"] {
        let message = refused(&bytes, &[&format!("light_source={name}")]);
        assert!(message.contains("\"Warm\", \"cold\" (\"Cold\"), \"Exit\" (in an em"), "{message}");
    }
    // In an emergency there is but one, whose source is that of another light.
    for words in [&["emergency"][..], &["emergency", "light_source=led"]] {
        let luminaire = read(&bytes, words);
        close(luminaire.photometry.flux_lm(), 500.0);
        let emitter = luminaire.facts.iter().find(|fact| fact.name == "emitter").unwrap();
        assert_eq!(emitter.value, "e, Exit");
    }
    // Others are dark in one.
    for name in ["cold", "1"] {
        let message = refused(&bytes, &["emergency", &format!("light_source={name}")]);
        assert!(message.contains("dark in emergencies; expected one of \"led\""), "{message}");
    }
}

#[test]
fn a_variant_without_emitters_has_those_of_the_product() {
    let none = "<Variant id=\"v\"><Name>V</Name><Geometry/></Variant>";
    let one =
        format!("<Emitters><Emitter id=\"e\">{}</Emitter></Emitters>", fixed("a.ldt", "", ""));
    let luminaire = read(&container(&one, none), &[]);
    assert_eq!(kinds(&luminaire), [WarningKind::VariantWithoutEmitter]);
    assert!(refused(&container(&emitters(), none), &[]).contains("2 emitters that shine"));
    assert!(refused(&container("", none), &[]).contains("a variant without emitters"));
}

#[test]
fn places_of_a_model_that_share_an_emitter_are_counted() {
    let luminaire = read(&container(&emitters(), &model(&[("down", "1"), ("down", "2")])), &[]);
    let told = only(&luminaire.warnings, WarningKind::ModelPlaces);
    assert!(told.contains("2 places of the 3D model"), "{told}");
    // A model in two formats shows the same places twice.
    let both = model(&[("down", "1"), ("down", "2")])
        .replacen("emitterId", "targetModelType=\"l3d\" emitterId", 1)
        .replace(
            "<EmitterReference emitterId",
            "<EmitterReference targetModelType=\"r3d\" emitterId",
        );
    assert_eq!(kinds(&read(&container(&emitters(), &both), &[])), []);
}

#[test]
fn format_0_9_has_references_in_attributes() {
    let definitions = "<Equipments><Equipment id=\"q\"><RatedInputPower>16</RatedInputPower>\
        <RatedLuminousFlux>700</RatedLuminousFlux></Equipment></Equipments><Emitters><Emitter \
        id=\"e\"><LightEmitter photometryId=\"a.ldt\" equipmentId=\"q\" \
        emergencyBehaviour=\"None\"/></Emitter></Emitters>";
    let variants = "<Variant id=\"v\"><Name>V</Name><EmitterReference emitterId=\"e\"/></Variant>";
    let luminaire = read(&container(definitions, variants), &[]);
    close(luminaire.photometry.flux_lm(), 700.0);
    assert_eq!(luminaire.photometry.facts().input_watts, 16.0);
}

#[test]
fn every_object_of_a_model_names_its_emitter_and_ids_count_first() {
    let places = [("down", "LEO 1"), ("down", "LEO 2"), ("up", "LEO 3"), ("up", "down")];
    let bytes = container(&emitters(), &model(&places));
    for (name, flux_lm) in [
        ("LEO 1", 1000.0),
        ("LEO 2", 1000.0),
        ("LEO 3", ies_flux_lm(2, 500.0)),
        // An emitter and an object: the identifier is meant.
        ("down", 1000.0),
    ] {
        let luminaire = read(&bytes, &[&format!("emitter={name}")]);
        close(luminaire.photometry.flux_lm(), flux_lm);
    }
    let message = refused(&bytes, &[]);
    assert!(message.contains("\"down\" (at \"LEO 1\", \"LEO 2\" of the 3D model)"), "{message}");
    let both = [("down", "LEO"), ("up", "LEO")];
    refused(&container(&emitters(), &model(&both)), &["emitter=LEO"]);
}

#[test]
fn the_first_translations_of_a_name_count() {
    let locales: String = (0..70).map(|i| format!("<Locale>n{i}</Locale>")).collect();
    let light = |name: &str| {
        let name = format!("<Name><Locale>{name}</Locale>{locales}</Name>");
        fixed("a.ldt", &name, "")
    };
    let lights = light("x") + &light("y").replace("n62<", "early<").replace("n63<", "late<");
    let definitions = format!("<Emitters><Emitter id=\"e\">{lights}</Emitter></Emitters>");
    let bytes = container(&definitions, &variant("v", "e"));
    for name in ["y", "early", "2"] {
        close(read(&bytes, &[&format!("light_source={name}")]).photometry.flux_lm(), 1000.0);
    }
    let message = refused(&bytes, &["light_source=late"]);
    assert!(message.contains("expected one of \"x\", \"y\""), "{message}");
}
