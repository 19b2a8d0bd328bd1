//! Every refusal names its file and line, and says what is wrong.

use crate::project_cases::{Case, PROJECT_CASES};
use crate::support::{LAMP_IES, MapFiles, PROJECT, ROOM_OBJ, load_text};

fn check(project: &str, files: &MapFiles, file: &str, line: Option<usize>, needle: &str) {
    let error = match load_text(project, files) {
        Err(error) => error,
        Ok(_) => panic!("accepted; expected a refusal with {needle:?}:\n{project}"),
    };
    let text = error.to_string();
    assert_eq!(error.file(), file, "{text}");
    assert_eq!(error.place().map(|place| place.line), line, "{text}");
    assert!(text.contains(needle), "no {needle:?} in: {text}");
    assert!(!text.contains('\n'), "several lines: {text}");
    match error.place() {
        Some(p) => {
            assert!(text.starts_with(&format!("{file}:{}:{}: ", p.line, p.column)), "{text}")
        }
        None => assert!(text.starts_with(&format!("{file}: ")), "{text}"),
    }
}

#[test]
fn the_project_itself_loads() {
    let loaded = load_text(PROJECT, &MapFiles::room()).unwrap();
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
}

#[test]
fn project_files_are_refused_at_their_line() {
    for Case { from, to, file, line, needle } in PROJECT_CASES {
        assert!(PROJECT.contains(from), "{from} is not in the project");
        let project = PROJECT.replacen(from, to, 1);
        check(&project, &MapFiles::room(), file, Some(*line), needle);
    }
}

#[test]
fn empty_and_binary_project_files() {
    let files = MapFiles::room();
    check("", &files, "room.toml", Some(1), "no [scene] section");
    check("\u{feff}", &files, "room.toml", Some(1), "no [scene] section");
    check("\0\u{1}\u{2}", &files, "room.toml", Some(1), "not valid TOML");
    let error = quasilux_scene::load("a.toml", b"[scene]\nup = \"\xff\"", &files).unwrap_err();
    assert!(error.to_string().starts_with("a.toml:2:7: not UTF-8"), "{error}");
    let deep = "a = ".to_owned() + &"[".repeat(100_000);
    check(&deep, &files, "room.toml", Some(1), "not valid TOML");
}

#[test]
fn geometry_files_are_refused_at_their_line() {
    for (obj, line, needle) in [
        (ROOM_OBJ.replace("v 1 1 0", "v 1 nan 0"), Some(6), "y of the vertex is \"nan\""),
        (ROOM_OBJ.replace("v 1 1 0", "v 1 inf 0"), Some(6), "\"inf\""),
        (ROOM_OBJ.replace("v 1 1 0", "v 1 1"), Some(6), "has no z"),
        (ROOM_OBJ.replace("f 1 2 3 4", "f 1 2 5"), Some(8), "vertex 5; expected 1 to 4"),
        (ROOM_OBJ.replace("f 1 2 3 4", "f 1 2 -5"), Some(8), "\"-5\""),
        (ROOM_OBJ.replace("f 1 2 3 4", "f 1 2 1000000000"), Some(8), "1 to 4"),
        (ROOM_OBJ.replace("v 1 1 0", "v 1 1e10 0"), Some(8), "beyond 1e9 m"),
        (ROOM_OBJ.replace("f 1 2 3 4", "f 1 1 1"), None, "degenerate"),
        (ROOM_OBJ.replace("f 1 2 3 4", ""), None, "no triangles"),
        (String::new(), None, "no triangles"),
        ("ELF\u{1}\0\0\0".to_owned(), Some(1), "binary data"),
    ] {
        let files = MapFiles::room().with("room.obj", obj);
        check(PROJECT, &files, "room.obj", line, needle);
    }
}

#[test]
fn luminaire_files_are_refused_in_their_own_name() {
    let luminaire = "\n[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\n";
    let files = MapFiles::room().with("lamp.ies", LAMP_IES.replace("1000 1000", "1000"));
    let error = load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap_err();
    assert_eq!(error.file(), "lamp.ies");
    assert!(error.place().is_some(), "{error}");
}
