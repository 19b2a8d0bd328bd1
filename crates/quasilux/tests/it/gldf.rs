//! GLDF containers and lengths on the command line.

use crate::container::{
    Zip, fixed, ies, ldt, packed, photometries, product, simple_product, variant,
};
use crate::support::{Folder, Run, number, parsed};

fn container() -> Vec<u8> {
    let mounting = "<Mountings><Ceiling><SurfaceMounted/></Ceiling></Mountings><Geometry>";
    let definitions = photometries(&["a.ldt", "b.ies"])
        + &format!(
            "<Emitters><Emitter id=\"down\">{}</Emitter><Emitter id=\"up\">{}</Emitter></Emitters>",
            fixed("a.ldt", "<RatedLuminousFlux>3000</RatedLuminousFlux>", ""),
            fixed("b.ies", "", ""),
        );
    let variants = variant("v", "down").replace("<Geometry>", mounting) + &variant("w", "up");
    Zip::default()
        .file("product.xml", product(&definitions, &variants).as_bytes())
        .file("ldc/a.ldt", ldt(1, 1000.0).as_bytes())
        .file("ldc/b.ies", ies(2, 500.0).as_bytes())
        .finish()
}

fn quasilux(folder: &Folder, arguments: &[&str], code: i32) -> Run {
    let run = folder.quasilux(arguments);
    assert_eq!(run.code, Some(code), "{arguments:?}: {}{}", run.stdout, run.stderr);
    run
}

#[test]
fn a_container_is_reported_and_converted_as_what_is_chosen() {
    let folder = Folder::new("gldf-photometry");
    folder.write("p.gldf", container());
    let several = quasilux(&folder, &["photometry", "p.gldf"], 2).stderr;
    assert!(several.contains("error: p.gldf/product.xml:"), "{several}");
    assert!(several.contains("\"v\" (\"Name of v\"), \"w\""), "{several}");
    let chosen = ["photometry", "p.gldf", "--variant", "v", "--convert", "out.ldt"];
    let text = quasilux(&folder, &chosen, 0).stdout;
    for words in [
        "3000 lm integrated",
        "container       GLDF, ldc/a.ldt",
        "mounting        ceiling surface mounted",
        "luminaire       Name of v",
        "warning: p.gldf/product.xml:",
        "[ContainerFlux]",
    ] {
        assert!(text.contains(words), "{words:?} in {text}");
    }
    quasilux(&folder, &["photometry", "p.gldf", "--variant", "v", "--strict"], 1);
    let back = quasilux(&folder, &["photometry", "out.ldt", "--json"], 0).stdout;
    let back = parsed(&back);
    assert!((number(&back, "/files/0/luminaire/flux_lm") - 3000.0).abs() < 1e-3);
    assert!(back.pointer("/files/0/luminaire/container").is_none());
    let json =
        parsed(&quasilux(&folder, &["photometry", "p.gldf", "--variant", "v", "--json"], 0).stdout);
    let part = json.pointer("/files/0/luminaire/container/photometric_file");
    assert_eq!(part.and_then(|part| part.as_str()), Some("ldc/a.ldt"));
    let part = json.pointer("/files/0/warnings/0/part");
    assert_eq!(part.and_then(|part| part.as_str()), Some("product.xml"));
}

/// A container whose light, brighter along C0 of the file than along C90, is turned.
fn turned(rotation: &str) -> Vec<u8> {
    let rotation = format!("<Rotation>{rotation}</Rotation>");
    packed(&simple_product("b.ies", &rotation), "b.ies", &ies(1, 1000.0))
}

#[test]
fn a_rotation_shows_in_figures_and_converted_files_or_is_said_not_to() {
    let folder = Folder::new("gldf-turned");
    folder.write("b.ies", ies(1, 1000.0));
    folder.write("g0.gldf", turned("<G0>90</G0>"));
    folder.write("x.gldf", turned("<X>180</X>"));
    folder.write("z.gldf", turned("<Z>30</Z>"));
    let document = |arguments: &[&str]| {
        parsed(&quasilux(&folder, &[arguments, &["--json"]].concat(), 0).stdout)
    };
    let plane = |document: &serde_json::Value, plane: usize| {
        let key = format!("/files/0/luminaire/principal_planes/{plane}/beam/angle_deg");
        number(document, &key)
    };
    let file = document(&["photometry", "b.ies"]);
    let along = document(&["photometry", "g0.gldf", "--convert", "out.ies"]);
    let back = document(&["photometry", "out.ies"]);
    assert!((plane(&file, 0) - plane(&file, 1)).abs() > 1.0, "{file}");
    for turned in [&along, &back] {
        assert!((plane(turned, 0) - plane(&file, 1)).abs() < 1e-6, "{turned}");
        assert!((plane(turned, 1) - plane(&file, 0)).abs() < 1e-6, "{turned}");
    }
    let rotation = "/files/0/luminaire/container/rotation";
    let is_applied =
        |document: &serde_json::Value| document.pointer(rotation).unwrap()["is_applied"] == true;
    assert!(is_applied(&along));
    let rows = along.pointer(rotation).unwrap()["luminaire_from_photometry"].clone();
    assert_eq!(rows, serde_json::json!([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]));
    let text = quasilux(&folder, &["photometry", "g0.gldf"], 0).stdout;
    assert!(text.contains("rotated         yes"), "{text}");
    // Upside down, or with an oblong opening aslant: no file holds that.
    for name in ["x.gldf", "z.gldf"] {
        let text = quasilux(&folder, &["photometry", name], 0).stdout;
        assert!(text.contains("rotated         not here"), "{text}");
        let document = document(&["photometry", name]);
        assert!(!is_applied(&document));
        assert_eq!(plane(&document, 0), plane(&file, 0));
        let run = quasilux(&folder, &["photometry", name, "--convert", "no.ldt"], 2);
        assert!(run.stderr.contains(name) && run.stderr.contains("a rotation in the container"));
        assert!(!folder.path("no.ldt").exists());
    }
}

#[test]
fn formats_of_other_programs_and_misplaced_choices_are_refused() {
    let folder = Folder::new("gldf-refused");
    folder.write("a.uld", "x");
    folder.write("a.ldt", ldt(1, 1000.0));
    folder.write("a.gldf", packed("<Root/>", "a.ldt", &ldt(1, 1000.0)));
    let run = quasilux(&folder, &["photometry", "a.uld"], 2);
    assert!(run.stderr.contains("a.uld: found a ULD file, DIALux's own format"), "{}", run.stderr);
    let run = quasilux(&folder, &["photometry", "a.ldt", "--emitter", "e"], 2);
    assert!(run.stderr.contains("expected a GLDF container"), "{}", run.stderr);
    let run = quasilux(&folder, &["photometry", "a.gldf"], 2);
    assert!(run.stderr.contains("a product without variants"), "{}", run.stderr);
}

const PROJECT: &str = "[scene]\ngeometry = [\"floor.obj\"]\n[materials.black]\nreflectance = 0\n\
    LIGHTS[[sensors]]\nname = \"floor\"\nkind = \"points\"\n\
    points = [[0, 0, 0], [0.7, 0.2, 0], [0.1, 1.1, 0]]\n\
    normals = [[0, 0, 1], [0, 0, 1], [0, 0, 1]]\n[simulation]\nrel_tol = 0.002\n";
const FLOOR: &str = "o floor\nusemtl black\nv -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n";

/// Direct light of a luminaire twice as long as its file says, and of two of them end to end.
#[test]
fn twice_the_length_lights_as_two_luminaires_do() {
    let luminaire = |y: f64, more: &str| {
        format!(
            "[[luminaires]]\nphotometry = \"a.ldt\"\nas = \"area\"\n\
             position = [0, {y}, 0.9]\n{more}"
        )
    };
    let folder = Folder::new("lengths-two");
    folder.write("floor.obj", FLOOR);
    folder.write("a.ldt", ldt(1, 1000.0));
    let two = luminaire(-0.6, "") + &luminaire(0.6, "");
    folder.write("two.toml", PROJECT.replace("LIGHTS", &two));
    folder.write("one.toml", PROJECT.replace("LIGHTS", &luminaire(0.0, "length_m = 2.4\n")));
    let [one, two] =
        ["one", "two"].map(|name| parsed(&folder.document(&format!("{name}.toml"), name, &[], 0)));
    for point in 0..3 {
        let at = |document, key| number(document, &format!("/sensors/0/points/{point}/{key}"));
        let (a, b) = (at(&one, "illuminance_lx"), at(&two, "illuminance_lx"));
        let half = libm::hypot(at(&one, "half_width_lx"), at(&two, "half_width_lx"));
        assert!((a - b).abs() <= 1.5 * half + 1e-6 * b, "{a}, not {b} +- {half} lx");
        assert!(half < 0.01 * b, "{half} of {b} lx");
    }
    let text = quasilux(&folder, &["check", "one.toml"], 0).stdout;
    assert!(text.contains("1.2000 m of the file along C90-C270 became 2.4 m"), "{text}");
}
