//! Linear luminaires by length: flux and luminous opening follow, the distribution stays.

use crate::container::{ies, ldt, simple};
use crate::support::{LAMP_TM33, MapFiles, PROJECT, load_text};
use glam::DVec3;
use quasilux_scene::light::Luminaire;
use quasilux_scene::{Light, Loaded};
use quasilux_stats::SplitMix64;

fn files() -> MapFiles {
    let areas = "<EmissionAreas><BottomFace><BottomArea><Length>0.5</Length><Width>0.05</Width>\
        </BottomArea></BottomFace></EmissionAreas><LuminousData>";
    MapFiles::room()
        .with("p.ies", ies(1, 1000.0))
        .with("p.ldt", ldt(1, 1000.0))
        .with("p.xml", LAMP_TM33.replace("<LuminousData>", areas))
        .with("p.gldf", simple("a.ldt", &ldt(1, 1000.0), ""))
        .with("round.ies", ies(1, 1000.0).replace("0.1 1.2 0", "-0.6 -0.6 0"))
        .with("square.ies", ies(1, 1000.0).replace("0.1 1.2 0", "0.6 0.6 0"))
}

fn project(file: &str, keys: &str) -> String {
    format!(
        "{PROJECT}[[luminaires]]\nphotometry = \"{file}\"\nposition = [0, 0, 2]\nas = \"area\"\n\
         {keys}\n"
    )
}

fn light(loaded: &Loaded) -> &Luminaire {
    match &loaded.scene.lights[0] {
        Light::Luminaire(light) => light,
        other => panic!("{other:?}"),
    }
}

/// Of a light as long as two, what leaves an element is what leaves that of one of two lights end
/// to end: I(w) p(w, x) of the long one is that of its half around x, for all w and x. Light that
/// lands anywhere is an integral of it, so this is equality of all illuminances.
#[test]
fn twice_the_length_is_two_luminaires_end_to_end() {
    let mut random = SplitMix64::new(5);
    for (file, axis, length_m) in [
        ("p.ies", DVec3::X, 1.2),
        ("p.ldt", DVec3::Y, 1.2),
        ("p.xml", DVec3::Y, 0.5),
        ("p.gldf", DVec3::Y, 1.2),
    ] {
        let keys = format!("length_m = {}", 2.0 * length_m);
        let [one, two] = ["", &keys].map(|keys| {
            load_text(&project(file, keys), &files()).unwrap_or_else(|e| panic!("{e}"))
        });
        let (one, two) = (light(&one), light(&two));
        let ratio = two.flux_lm() / one.flux_lm();
        assert!((ratio - 2.0).abs() < 1e-12, "{file}: {ratio}");
        assert!((two.shape.size_m() - one.shape.size_m() - length_m * axis).length() < 1e-12);
        for _ in 0..200 {
            let z = -random.uniform();
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * random.uniform());
            let toward = DVec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + z * DVec3::Z;
            let point = two.shape.sample_silhouette(toward, [random.uniform(), random.uniform()]);
            let centre = 0.5 * length_m * axis * point.position_m.dot(axis).signum();
            let mut of_half = point;
            of_half.position_m -= centre;
            let reach = 0.5 * one.shape.size_m() + DVec3::splat(1e-9);
            assert!(of_half.position_m.abs().cmple(reach).all(), "{}", of_half.position_m);
            let long = two.intensity_cd(toward) * two.shape.pdf_silhouette(toward, &point);
            let half = one.intensity_cd(toward) * one.shape.pdf_silhouette(toward, &of_half);
            assert!((long - half).abs() <= 1e-9 * half.max(1.0), "{file}: {long}, not {half}");
        }
    }
}

#[test]
fn a_length_goes_with_dimming_and_flux_and_is_noted() {
    let loaded = load_text(&project("p.ldt", "length_m = 3\ndimming = 0.5"), &files()).unwrap();
    assert!((light(&loaded).flux_lm() - 1250.0).abs() < 1e-9);
    assert_eq!(light(&loaded).photometry.name(), "p.ldt (3 m)");
    let note = "p.ldt (3 m): length: 1.2000 m of the file along C90-C270 became 3 m, 1000.0 lm \
                became 2500.0 lm";
    assert_eq!(loaded.luminaire_notes, [note]);
    assert!(loaded.warnings.is_empty());
    let loaded = load_text(&project("p.ies", "length_m = 3\nflux_lm = 700"), &files()).unwrap();
    assert!((light(&loaded).flux_lm() - 700.0).abs() < 1e-9);
    assert!((light(&loaded).shape.size_m().x - 3.0).abs() < 1e-12);
    // In the unit of the project's other lengths.
    let in_mm = project("p.ies", "length_m = 3000")
        .replace("[scene]\n", "[scene]\nposition_units = \"mm\"\n");
    let loaded = load_text(&in_mm, &files());
    assert!(loaded.is_ok_and(|loaded| light(&loaded).shape.size_m().x > 2.9));
}

#[test]
fn openings_without_a_length_are_refused_at_the_key() {
    for (file, reason) in [
        ("lamp.ies", "a luminous opening without a length"),
        ("round.ies", "a round luminous opening (disk)"),
        ("square.ies", "a luminous opening whose sides are both 0.6 m"),
    ] {
        let error = load_text(&project(file, "length_m = 2"), &files()).unwrap_err().to_string();
        assert!(error.starts_with("room.toml:20:12: found ") && error.contains(reason), "{error}");
    }
    for wrong in ["0", "-1", "1e4", "\"long\"", "nan"] {
        let keys = format!("length_m = {wrong}");
        let error = load_text(&project("p.ies", &keys), &files()).unwrap_err().to_string();
        assert!(error.contains("a length in m, above 0 and no more than 1000"), "{error}");
    }
}
