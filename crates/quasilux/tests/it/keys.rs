//! `quasilux keys`, and the page that it makes.

use crate::support::{Folder, parsed};
use quasilux_sampling::{Randomization, Sequence};
use quasilux_scene::project::{Key, reference};
use quasilux_transport::{EstimatorKind, IntervalKind, Reconstruction, Switch, ToleranceOn};

/// The line before the tables of the page.
const MARK: &str = "<!-- From here on: cargo xtask reference -->\n";

fn printed(arguments: &[&str]) -> String {
    let run = Folder::new(&arguments.join("_")).quasilux(arguments);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{arguments:?}");
    run.stdout
}

#[test]
fn the_page_of_the_keys_is_what_the_program_prints() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/project-reference.md");
    let page = std::fs::read_to_string(path).expect("a page");
    let (_, tables) = page.split_once(MARK).expect("a mark before the tables");
    let printed = printed(&["keys", "--markdown"]);
    assert!(tables == printed, "the page is old: run `cargo xtask reference`");
    for key in reference().iter().flat_map(|table| table.keys) {
        assert!(printed.contains(&format!("\n| `{}` | ", key.name)), "{}", key.name);
    }
}

#[test]
fn one_section_is_printed_alone() {
    let text = printed(&["keys", "lights"]);
    for words in ["[[lights]]  kind = \"area\"", "intensity_cd  cd, 0 to 1e60 [required]"] {
        assert!(text.contains(words), "{text}");
    }
    assert!(!text.contains("[[sensors]]") && !text.contains('`'), "{text}");
    let run = Folder::new("keys_none").quasilux(&["keys", "lamps"]);
    assert!(run.code == Some(2) && run.stderr.contains("luminaires"), "{}", run.stderr);
}

fn simulation_key(name: &str) -> &'static Key {
    let table = reference().into_iter().find(|table| table.name() == "simulation");
    let keys = table.expect("a section").keys;
    keys.iter().find(|key| key.name == name).unwrap_or_else(|| panic!("no key {name}"))
}

/// The crates above the reader know the names, and the reference has all of them.
#[test]
fn the_reference_has_all_names_of_a_simulation() {
    let names: [(&str, Vec<&str>); 7] = [
        ("estimator", EstimatorKind::ALL.map(EstimatorKind::name).to_vec()),
        ("sequence", Sequence::all_for(64).map(Sequence::name).to_vec()),
        ("randomization", Randomization::ALL.map(Randomization::name).to_vec()),
        ("tolerance_on", ToleranceOn::ALL.map(ToleranceOn::name).to_vec()),
        ("interval", IntervalKind::ALL.map(IntervalKind::name).to_vec()),
        ("map_reconstruction", Reconstruction::ALL.map(Reconstruction::name).to_vec()),
        ("importance", Switch::ALL.map(Switch::name).to_vec()),
    ];
    for (key, mut names) in names {
        let takes = simulation_key(key).takes;
        let mut told: Vec<&str> = takes.split('"').skip(1).step_by(2).collect();
        told.sort_unstable();
        names.sort_unstable();
        assert_eq!(told, names, "{key}");
    }
}

/// Defaults that are values of TOML are those that hold: a project that gives them all has the
/// results and the settings of one that gives none.
#[test]
fn defaults_are_those_that_hold() {
    let folder = Folder::new("keys_defaults");
    folder.write("room.obj", crate::support::box_obj("room", [0.0; 3], [4.0, 3.0, 2.5], 1));
    folder.write("lamp.ies", crate::scenes::LAMP_IES);
    let values = |section: &str, kind: &str| -> String {
        let tables = reference();
        let of = tables.iter().find(|table| table.section == section && table.kind == kind);
        let keys = of.unwrap_or_else(|| panic!("{section} {kind}")).keys.iter();
        keys.filter_map(|key| Some((key, value(key.default?)?)))
            .map(|(key, value)| format!("{} = {value}\n", key.name))
            .collect()
    };
    let project = |with: &dyn Fn(&str, &str) -> String| {
        format!(
            "[scene]\ngeometry = [\"room.obj\"]\n{}[materials.default]\nreflectance = 0.5\n{}\
             [[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [1, 1, 2]\n{}\
             [[sensors]]\nname = \"own\"\nkind = \"grid\"\norigin = [1, 1, 0.8]\n\
             u = [1, 0, 0]\nv = [0, 1, 0]\ncounts = [2, 2]\n{}[simulation]\n{}",
            with("[scene]", ""),
            with("[materials.NAME]", "kind = \"diffuse\""),
            with("[[luminaires]]", ""),
            with("[[sensors]]", "kind = \"grid\""),
            with("[simulation]", ""),
        )
    };
    folder.write("given.toml", project(&values));
    folder.write("none.toml", project(&|_, _| String::new()));
    let [given, none] = ["given", "none"].map(|name| {
        let (file, plan) = (format!("{name}.toml"), format!("{name}.json"));
        let document = parsed(&folder.document(&file, name, &["--samples", "32"], 3));
        let planned = folder.quasilux(&["plan", &file, "--samples", "32", "--out", &plan]);
        assert_eq!(planned.code, Some(0), "{}", planned.stderr);
        (document["sensors"].clone(), parsed(&folder.read(&plan))["settings"].clone())
    });
    let text = folder.read("given.toml");
    assert!(text.matches(" = ").count() > 30, "{text}");
    assert_eq!(given, none);
}

/// A default that is a value, without its marks.
fn value(default: &str) -> Option<&str> {
    default.strip_prefix('`')?.strip_suffix('`').filter(|value| !value.contains('`'))
}
