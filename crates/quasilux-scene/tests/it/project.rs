//! What a project file means.

use crate::support::{LAMP_IES, LAMP_TM33, MapFiles, PROJECT, lamp_ldt, load_text, warnings_of};
use glam::DVec3;
use quasilux_scene::{Light, Loaded, Quantity, SensorShape};
use std::f64::consts::PI;

fn grid_of(project: &str) -> quasilux_scene::Grid {
    match load_text(project, &MapFiles::room()).unwrap().scene.sensors.remove(0).shape {
        SensorShape::Grid(grid) => grid,
        SensorShape::Points(_) => panic!("a grid was asked for"),
    }
}

#[test]
fn grids_by_spacing_counts_and_rule() {
    let grid = grid_of(PROJECT);
    assert_eq!((grid.counts, grid.normal, grid.quantity), ([4, 4], DVec3::Z, Quantity::Centre));
    let grid = grid_of(&PROJECT.replace("spacing = 0.25", "counts = [2, 3]\nquantity = \"mean\""));
    assert_eq!((grid.counts, grid.quantity), ([2, 3], Quantity::Mean));
    let grid = grid_of(&PROJECT.replace("spacing = 0.25", "spacing = 0.3\nnormal = [0, 0, -2]"));
    assert_eq!((grid.counts, grid.normal), ([4, 4], DVec3::NEG_Z));
    // EN 12464-1: d = 10 m, p = 1 m.
    let rule = PROJECT
        .replace("spacing = 0.25", "rule = \"en12464\"")
        .replace("u = [1, 0, 0]", "u = [10, 0, 0]")
        .replace("v = [0, 1, 0]", "v = [0, 7.5, 0]");
    assert_eq!(grid_of(&rule).counts, [10, 8]);
}

#[test]
fn grids_may_have_a_target() {
    assert_eq!(grid_of(PROJECT).target_lx, None);
    for (given, target_lx) in [("500", 500.0), ("0.5", 0.5), ("1e3", 1000.0)] {
        let with = format!("spacing = 0.25\ntarget_lx = {given}");
        assert_eq!(grid_of(&PROJECT.replace("spacing = 0.25", &with)).target_lx, Some(target_lx));
    }
}

#[test]
fn area_lights_by_luminance_and_flux() {
    let point = "kind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100";
    for (amount, luminance) in [("luminance_cd_m2 = 300", 300.0), ("flux_lm = 300", 300.0 / PI)] {
        let area = format!("kind = \"area\"\nmaterial = \"wood\"\n{amount}");
        let scene = load_text(&PROJECT.replace(point, &area), &MapFiles::room()).unwrap().scene;
        let Light::Area(light) = &scene.lights[0] else { panic!("an area light was asked for") };
        assert_eq!((light.material, light.triangles.as_slice()), (0, &[0, 1][..]));
        assert!((light.area_m2 - 1.0).abs() < 1e-15);
        assert!((light.luminance_cd_m2 - luminance).abs() < 1e-12 * luminance);
    }
}

/// Every kind of light has it, and nothing else has.
#[test]
fn a_maintenance_factor_dims_all_lights() {
    let lamp = "[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\ndimming = 0.5\n";
    let area = "[[lights]]\nkind = \"area\"\nmaterial = \"wood\"\nflux_lm = 300\n";
    let new = format!("{PROJECT}{lamp}{area}");
    let old = new.replace("[\"room.obj\"]", "[\"room.obj\"]\nmaintenance_factor = 0.75");
    let [new, old] = [new, old].map(|text| load_text(&text, &MapFiles::room()).unwrap());
    assert_eq!((new.maintenance_factor, old.maintenance_factor), (1.0, 0.75));
    let fluxes =
        |loaded: &Loaded| -> Vec<f64> { loaded.scene.lights.iter().map(Light::flux_lm).collect() };
    assert_eq!(fluxes(&new).len(), 3);
    for (new, old) in fluxes(&new).into_iter().zip(fluxes(&old)) {
        assert!(new > 0.0 && (old - 0.75 * new).abs() < 1e-12 * new, "{old} of {new}");
    }
}

/// The file's distribution with another flux, whatever the file gives; maintenance comes on top.
#[test]
fn a_luminaire_has_the_flux_that_the_project_says() {
    let scene = "[\"room.obj\"]\nmaintenance_factor = 0.75";
    let lamp = |more: &str| {
        let lamp = "[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\n";
        let text = format!("{}{lamp}{more}", PROJECT.replace("[\"room.obj\"]", scene));
        load_text(&text, &MapFiles::room())
    };
    for flux_lm in [0.0, 1.0, 3210.0] {
        let loaded = lamp(&format!("flux_lm = {flux_lm}\n")).unwrap();
        let found = loaded.scene.lights[0].flux_lm();
        assert!((found - 0.75 * flux_lm).abs() <= 1e-9 * flux_lm, "{found} of {flux_lm}");
    }
    let refusal = |more: &str| lamp(more).unwrap_err().to_string();
    let both = refusal("flux_lm = 5\ndimming = 1\n");
    assert!(both.contains("exclude each other"), "{both}");
    assert!(refusal("flux_lm = -1\n").contains("in lm, at least 0"));
}

#[test]
fn tolerances_above_one_half_are_written_in_percent() {
    let rel_tol = |text: &str| {
        let project = format!("{PROJECT}[simulation]\nrel_tol = {text}\n");
        let loaded = load_text(&project, &MapFiles::room()).unwrap();
        loaded.simulation.rel_tol.unwrap().value
    };
    for (text, share) in [("0.5", 0.5), ("\"1%\"", 0.01), ("\"0.5 %\"", 0.005), ("\"100%\"", 1.0)] {
        assert_eq!(rel_tol(text), share, "{text}");
    }
}

#[test]
fn luminaires_share_their_photometry() {
    let one =
        "[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\nrotation_deg = 90\n";
    let two = "[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [1, 0, 2]\ndimming = 0.5\n";
    let scene = load_text(&format!("{PROJECT}{one}{two}"), &MapFiles::room()).unwrap().scene;
    let [Light::Luminaire(first), Light::Luminaire(second), Light::Point(_)] =
        scene.lights.as_slice()
    else {
        panic!("luminaires come first: {:?}", scene.lights)
    };
    assert!(std::sync::Arc::ptr_eq(&first.photometry, &second.photometry));
    assert!((first.world_from_luminaire * DVec3::X - DVec3::Y).length() < 1e-12);
    // 1000 cd over the lower half: 2 pi times 1000 lm.
    assert!((first.flux_lm() - 2000.0 * PI).abs() < 1e-6 * first.flux_lm());
    assert!((second.flux_lm() - 0.5 * first.flux_lm()).abs() < 1e-9);
}

#[test]
fn eulumdat_is_known_by_its_extension_in_any_case() {
    for name in ["lamp.ldt", "LAMP.LDT", "lamp.v2.Ldt"] {
        let luminaire = format!("[[luminaires]]\nphotometry = \"{name}\"\nposition = [0, 0, 2]\n");
        let files = MapFiles::room().with(name, lamp_ldt());
        let loaded = load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap();
        assert!(warnings_of(&loaded).is_empty(), "{:?}", warnings_of(&loaded));
        let Light::Luminaire(light) = &loaded.scene.lights[0] else { panic!("a luminaire") };
        assert!((light.flux_lm() / (2000.0 * PI) - 1.0).abs() < 1e-12, "{name}");
    }
    let tilted = lamp_ldt().replacen("314.159\n1\n0\n", "314.159\n1\n15\n", 1);
    let luminaire = "[[luminaires]]\nphotometry = \"lamp.ldt\"\nposition = [0, 0, 2]\n";
    let files = MapFiles::room().with("lamp.ldt", tilted);
    let warnings = warnings_of(&load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap());
    assert!(warnings[0].contains("lamp.ldt:25:1: found a tilt of 15 degrees"), "{warnings:?}");
}

#[test]
fn the_content_of_a_luminaire_file_counts_more_than_its_name() {
    let luminaire = "[[luminaires]]\nphotometry = \"lamp.xml\"\nposition = [0, 0, 2]\n";
    let files = MapFiles::room().with("lamp.xml", lamp_ldt());
    let loaded = load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap();
    let warnings = warnings_of(&loaded);
    let expected = "lamp.xml: found a file in the format EULUMDAT; expected TM-33";
    assert!(warnings.len() == 1 && warnings[0].starts_with(expected), "{warnings:?}");
    let Light::Luminaire(light) = &loaded.scene.lights[0] else { panic!("a luminaire") };
    assert!((light.flux_lm() / (2000.0 * PI) - 1.0).abs() < 1e-12);
}

#[test]
fn tm33_is_known_by_its_extension_in_any_case() {
    for name in ["lamp.xml", "LAMP.XML"] {
        let luminaire = format!("[[luminaires]]\nphotometry = \"{name}\"\nposition = [0, 0, 2]\n");
        let files = MapFiles::room().with(name, LAMP_TM33);
        let loaded = load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap();
        assert!(warnings_of(&loaded).is_empty(), "{:?}", warnings_of(&loaded));
        let Light::Luminaire(light) = &loaded.scene.lights[0] else { panic!("a luminaire") };
        assert!((light.flux_lm() / (200.0 * PI) - 1.0).abs() < 1e-12, "{name}");
    }
    let luminaire = "[[luminaires]]\nphotometry = \"lamp.xml\"\nposition = [0, 0, 2]\n";
    let spaced = LAMP_TM33.replacen("Symm_Full", "Symm _ Full", 1);
    let files = MapFiles::room().with("lamp.xml", spaced);
    let warnings = warnings_of(&load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap());
    assert!(warnings[0].contains("lamp.xml:8:42: found \"Symm _ Full\""), "{warnings:?}");
}

#[test]
fn simulation_values_keep_their_places() {
    let project = PROJECT.to_owned()
        + "[simulation]\nestimator = \"pat\"\nrel_tol = 0.02\nconfidence = 0.9\nreplicates = 8\n\
           seed = 0xff\nmax_bounces = \"unlimited\"\nlist_terms = 4\nmap_element_m = 1\n\
           map_elements = 5\nmap_adaptive = false\nmap_reconstruction = \"linear\"\n\
           map_photons = 9\nmap_dimensions = 7\nimage_depth = 3\n\
           importance = \"on\"\nfirst_shot = \"off\"\n\
           abs_tol = 0.5\nunseen_tol = 0.1\ntolerance_on = \"summary\"\n\
           interval = \"certified\"\n";
    let simulation = load_text(&project, &MapFiles::room()).unwrap().simulation;
    assert_eq!(simulation.rel_tol.as_ref().map(|v| (v.value, v.place.line)), Some((0.02, 18)));
    assert_eq!(simulation.confidence.as_ref().map(|v| v.value), Some(0.9));
    assert_eq!(simulation.replicates.as_ref().map(|v| v.value), Some(8));
    assert_eq!(simulation.seed.as_ref().map(|v| v.value), Some(255));
    assert_eq!(simulation.max_bounces.as_ref().map(|v| v.value), Some(None));
    assert_eq!(simulation.list_terms.as_ref().map(|v| v.value), Some(4));
    assert_eq!(simulation.map_element_m.as_ref().map(|v| v.value), Some(1.0));
    assert_eq!(simulation.map_elements.as_ref().map(|v| v.value), Some(5));
    assert_eq!(simulation.map_adaptive.as_ref().map(|v| v.value), Some(false));
    assert_eq!(simulation.map_reconstruction.as_ref().map(|v| &*v.value), Some("linear"));
    assert_eq!(simulation.map_photons.as_ref().map(|v| v.value), Some(9));
    assert_eq!(simulation.map_dimensions.as_ref().map(|v| v.value), Some(7));
    assert_eq!(simulation.image_depth.as_ref().map(|v| v.value), Some(3));
    assert_eq!(simulation.importance.as_ref().map(|v| &*v.value), Some("on"));
    assert_eq!(simulation.abs_tol_lx.as_ref().map(|v| v.value), Some(0.5));
    assert_eq!(simulation.unseen_tol.as_ref().map(|v| v.value), Some(Some(0.1)));
    assert_eq!(simulation.tolerance_on.as_ref().map(|v| &*v.value), Some("summary"));
    assert_eq!(simulation.interval.as_ref().map(|v| &*v.value), Some("certified"));
    assert_eq!(simulation.first_shot.as_ref().map(|v| &*v.value), Some("off"));
    assert_eq!(simulation.sequence, None);
    let estimator = simulation.estimator.as_ref().unwrap();
    let error = simulation.unknown_name(estimator, "estimator", &["photon", "path"]);
    assert_eq!(
        error.to_string(),
        "room.toml:17:13: unknown estimator \"pat\"; expected one of photon, path; did you mean \
         \"path\"?"
    );
    let error = simulation.error_at(estimator, "not today");
    assert_eq!(error.to_string(), "room.toml:17:13: not today");
    let project = project.replace("\"unlimited\"", "3");
    let simulation = load_text(&project, &MapFiles::room()).unwrap().simulation;
    assert_eq!(simulation.max_bounces.map(|v| v.value), Some(Some(3)));
    let unseen = |text: &str| {
        load_text(
            &project.replace("unseen_tol = 0.1", &format!("unseen_tol = {text}")),
            &MapFiles::room(),
        )
    };
    for (text, read) in [("\"off\"", None), ("\"5%\"", Some(0.05))] {
        let simulation = unseen(text).unwrap().simulation;
        assert_eq!(simulation.unseen_tol.map(|v| v.value), Some(read));
    }
    for (text, told) in [("\"no\"", "or \"off\""), ("5", "\"unseen_tol\": 5 stands for 500 %")] {
        let error = unseen(text).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
    }
}

#[test]
fn emission_in_a_geometry_file_needs_a_light() {
    let files = MapFiles::room().with("room.mtl", "newmtl wood\nKd 0.4\nKe 1 1 1\n");
    let warnings = load_text(PROJECT, &files).unwrap().warnings;
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].message.contains("\"wood\" emits"), "{}", warnings[0]);
    let light = "[[lights]]\nkind = \"area\"\nmaterial = \"wood\"\nflux_lm = 1\n";
    let loaded = load_text(&format!("{PROJECT}{light}"), &files).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
}

#[test]
fn luminaires_are_points_unless_their_area_is_asked_for() {
    let luminaire = |form: &str| {
        format!(
            "{PROJECT}[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\n{form}\n"
        )
    };
    let with_disk = LAMP_IES.replace("1 1 2 0 0 0", "1 1 2 -0.3 -0.3 0");
    let shape_of = |form: &str, lamp: &str| {
        let files = MapFiles::room().with("lamp.ies", lamp);
        let loaded = load_text(&luminaire(form), &files).unwrap();
        let Light::Luminaire(light) = &loaded.scene.lights[0] else { panic!("a luminaire") };
        (light.shape.name(), light.is_area(), warnings_of(&loaded))
    };
    assert_eq!(shape_of("", &with_disk), ("point", false, vec![]));
    assert_eq!(shape_of("as = \"point\"", &with_disk), ("point", false, vec![]));
    assert_eq!(shape_of("as = \"area\"", &with_disk), ("disk", true, vec![]));
    let (name, is_area, warnings) = shape_of("as = \"area\"", LAMP_IES);
    assert_eq!((name, is_area, warnings.len()), ("point", false, 1));
    let expected = "room.toml:19:6: \"as\" is \"area\", but the luminous opening of \"lamp.ies\"";
    assert!(warnings[0].starts_with(expected), "{warnings:?}");
    let unknown = load_text(&luminaire("as = \"disk\""), &MapFiles::room()).unwrap_err();
    assert!(unknown.to_string().contains("expected \"point\" or \"area\""), "{unknown}");
}

/// 6283 lm of bare lamps that give 7000 lm are what luminaires do; of 5000 lm, and of 70,000, no
/// luminaire does it.
#[test]
fn losses_of_luminaires_are_told_where_they_are_odd() {
    for (lamps_lm, is_told) in [("7000", false), ("20000", false), ("5000", true), ("70000", true)]
    {
        let ies = LAMP_IES.replace("\n1 -1 1", &format!("\n1 {lamps_lm} 1"));
        let luminaire = "[[luminaires]]\nphotometry = \"own.ies\"\nposition = [0, 0, 2]\n";
        let files = MapFiles::room().with("own.ies", &ies);
        let loaded = load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap();
        let told = warnings_of(&loaded);
        assert_eq!(told.iter().any(|it| it.contains("integrated flux")), is_told, "{told:?}");
    }
}
