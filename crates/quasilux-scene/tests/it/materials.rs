//! `[materials.NAME]`: every kind, its defaults, and what is refused.

use crate::support::{MapFiles, PROJECT, load_text};
use quasilux_scene::bsdf::{Conductor, Dielectric, Diffuse, Mirror, Pane, Plastic, Translucent};
use quasilux_scene::{Bsdf, LoadError, Rgb};

fn material(lines: &str) -> Result<Bsdf, LoadError> {
    let project = format!("{PROJECT}[materials.wood]\n{lines}\n");
    load_text(&project, &MapFiles::room()).map(|loaded| loaded.scene.materials[0].bsdf.clone())
}

#[test]
fn every_kind_is_read() {
    let rgb = Rgb([0.5, 0.25, 0.125]);
    for (lines, wanted) in [
        ("reflectance = 0.5", Bsdf::Diffuse(Diffuse { reflectance: Rgb::grey(0.5) })),
        (
            "reflectance = 0.25\ntransmittance = [0.5, 0.25, 0.125]",
            Bsdf::Translucent(Translucent { reflectance: Rgb::grey(0.25), transmittance: rgb }),
        ),
        (
            "kind = \"mirror\"\nreflectance = [0.5, 0.25, 0.125]",
            Bsdf::Mirror(Mirror { reflectance: rgb }),
        ),
        ("kind = \"dielectric\"", Bsdf::Dielectric(Dielectric { eta: 1.5 })),
        ("kind = \"dielectric\"\neta = 0.75", Bsdf::Dielectric(Dielectric { eta: 0.75 })),
        ("kind = \"pane\"", Bsdf::Pane(Pane::Clear { eta: 1.5 })),
        (
            "kind = \"pane\"\neta = 1.52\ntransmittance = 0.5",
            Bsdf::Pane(Pane::Tinted { eta: 1.52, transmittance: Rgb::grey(0.5) }),
        ),
        (
            "kind = \"pane\"\ntransmittance = [0.5, 0.25, 0.125]",
            Bsdf::Pane(Pane::Tinted { eta: 1.5, transmittance: rgb }),
        ),
        (
            "kind = \"conductor\"\nreflectance = 0.5\nroughness = 0.5",
            Bsdf::Conductor(Conductor { reflectance: Rgb::grey(0.5), alpha: 0.25 }),
        ),
        (
            "kind = \"plastic\"\nreflectance = 0.5\nalpha = 0.5",
            Bsdf::Plastic(Plastic { reflectance: Rgb::grey(0.5), eta: 1.5, alpha: 0.5 }),
        ),
    ] {
        let found = material(lines).unwrap_or_else(|error| panic!("{lines}: {error}"));
        assert_eq!(found, wanted, "{lines}");
        let colours = lines.contains("[0.5, 0.25, 0.125]");
        assert_eq!(found.is_grey(), !colours, "{lines}");
    }
}

#[test]
fn measured_panes_are_straight_between_their_lines() {
    let tables = "kind = \"pane\"\ntransmittance = [[0, 0.88], [40, 0.86], [90, 0.0]]\n\
                  reflectance = [[0, 0.08], [40, 0.12], [90, 1.0]]";
    let Ok(Bsdf::Pane(pane)) = material(tables) else {
        panic!("a measured pane is one");
    };
    let Pane::Measured { transmittance, front_reflectance: reflectance, back_reflectance } = pane
    else {
        panic!("a measured pane is one");
    };
    assert_eq!(reflectance, back_reflectance);
    for (degrees, t, r) in [(0.0_f64, 0.88, 0.08), (20.0, 0.87, 0.1), (90.0, 0.0, 1.0)] {
        let cos = libm::cos(degrees.to_radians());
        assert!((transmittance.at(cos) - t).abs() < 1e-12, "{degrees}");
        assert!((reflectance.at(cos) - r).abs() < 1e-12, "{degrees}");
    }
    let alone = "kind = \"pane\"\ntransmittance = [[0, 0.88], [90, 0]]";
    let Ok(Bsdf::Pane(Pane::Measured { back_reflectance, .. })) = material(alone) else {
        panic!("a measured pane is one");
    };
    assert_eq!(back_reflectance.at(0.3), 0.0);
}

#[test]
fn what_makes_no_sense_is_refused_at_its_line() {
    for (lines, line, needle) in [
        (
            "reflectance = 0.6\ntransmittance = 0.5",
            3,
            "add up to 1.1; expected at most 1 in each channel",
        ),
        ("reflectance = 0.6\ntransmittance = 1.5", 3, "\"transmittance\" is 1.5"),
        ("reflectance = 0.6\neta = 1.5", 3, "goes with kind = \"dielectric\" or \"pane\" or"),
        ("kind = \"mirror\"\nreflectance = 1\nroughness = 0.1", 4, "not with \"mirror\""),
        (
            "kind = \"dielectric\"\nreflectance = 0.1",
            3,
            "not with \"dielectric\"; expected kind, eta",
        ),
        ("kind = \"dielectric\"\neta = 1", 3, "within 0.2 to 5, not 1"),
        ("kind = \"dielectric\"\neta = 0.1", 3, "\"eta\" is 0.1"),
        ("kind = \"dielectric\"\neta = \"glass\"", 3, "a refractive index"),
        ("kind = \"conductor\"\nreflectance = 0.9", 1, "lacks one of roughness, alpha"),
        (
            "kind = \"conductor\"\nreflectance = 0.9\nroughness = 0",
            4,
            "within 0.02 to 1; kind = \"mirror\" is smooth",
        ),
        ("kind = \"conductor\"\nreflectance = 0.9\nalpha = 0.0001", 4, "within 0.0004 to 1"),
        (
            "kind = \"conductor\"\nreflectance = 0.9\nalpha = 0.1\nroughness = 0.1",
            4,
            "exclude each other",
        ),
        ("kind = \"plastic\"\nroughness = 0.2", 1, "lacks \"reflectance\""),
        ("kind = \"plastic\"\nreflectance = 0.5\nroughness = 0.2\neta = 0.9", 5, "index above 1"),
        ("kind = \"pane\"\nreflectance = 0.1", 3, "goes with a table of \"transmittance\""),
        ("kind = \"pane\"\ntransmittance = 0.95", 3, "at most 0.9231, which a clear pane"),
        (
            "kind = \"pane\"\ntransmittance = 0.5\nreflectance = 0.1",
            4,
            "without, it follows from eta",
        ),
        ("kind = \"pane\"\neta = 1.5\ntransmittance = [[0, 1], [90, 0]]", 3, "exclude each other"),
        ("kind = \"pane\"\ntransmittance = [[0, 1], [80, 0]]", 3, "rising degrees"),
        (
            "kind = \"pane\"\ntransmittance = [[0, 1], [50, 0], [40, 0], [90, 0]]",
            3,
            "rising degrees",
        ),
        ("kind = \"pane\"\ntransmittance = [[0, 1], [91, 0]]", 3, "rising degrees"),
        ("kind = \"pane\"\ntransmittance = [[0, 1], [90]]", 3, "rising degrees"),
        ("kind = \"pane\"\ntransmittance = [[]]", 3, "rising degrees"),
        ("kind = \"pane\"\ntransmittance = []", 3, "a number or [r, g, b]"),
        (
            "kind = \"pane\"\ntransmittance = [[0, 0.5], [60, 0.5], [90, 0]]\n\
             reflectance = [[0, 0.5], [30, 0.6], [90, 0.9]]",
            4,
            "at 30.0 degrees; expected at most 1",
        ),
        ("kind = \"glass\"", 2, "\"dielectric\" or \"pane\""),
    ] {
        let error = material(lines).expect_err(lines);
        let text = error.to_string();
        let start = PROJECT.lines().count();
        assert_eq!(error.place().map(|place| place.line - start), Some(line), "{text}");
        assert!(text.contains(needle), "no {needle:?} in: {text}");
        assert!(!text.contains('\n'), "several lines: {text}");
    }
}

#[test]
fn a_default_of_another_kind_is_named() {
    let geometry = MapFiles::room().with("room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let project = format!("{PROJECT}[materials.default]\nkind = \"pane\"\n");
    let loaded = load_text(&project, &geometry).unwrap();
    let warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(loaded.scene.materials[0].bsdf, Bsdf::Pane(Pane::Clear { eta: 1.5 }));
    assert!(
        warnings.is_empty() || warnings[0].contains("the default pane is used"),
        "{warnings:?}"
    );
}
