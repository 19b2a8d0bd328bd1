//! Every refusal names its file and line, and says what is wrong.

use crate::support::{LAMP_IES, MapFiles, PROJECT, ROOM_OBJ, load_text};

/// What replaces what in the small project, and the file, line and words of the refusal.
struct Case {
    from: &'static str,
    to: &'static str,
    file: &'static str,
    line: usize,
    needle: &'static str,
}

const fn case(from: &'static str, to: &'static str, line: usize, needle: &'static str) -> Case {
    Case {
        from,
        to,
        file: "room.toml",
        line,
        needle,
    }
}

const PROJECT_CASES: &[Case] = &[
    case("geometry", "geometri", 2, "did you mean \"geometry\"?"),
    case("[scene]", "[scenes]", 1, "did you mean \"scene\"?"),
    case(
        "geometry = [\"room.obj\"]",
        "geometry = \"room.obj\"",
        2,
        "is \"room.obj\"; expected [\"room.obj\"]",
    ),
    case(
        "geometry = [\"room.obj\"]",
        "geometry = []",
        2,
        "expected [\"room.obj\"]",
    ),
    case(
        "geometry = [\"room.obj\"]",
        "up = \"y\"",
        1,
        "lacks \"geometry\"",
    ),
    case(
        "[\"room.obj\"]",
        "[\"missing.obj\"]",
        2,
        "cannot read \"missing.obj\": no such file",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\", \"room.obj\"]",
        2,
        "listed twice",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.blend\"]",
        2,
        "expected a name that ends in .obj, .gltf or .glb",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\nup = \"x\"",
        3,
        "expected \"y\" or \"z\"",
    ),
    case("[\"room.obj\"]", "[\"room.obj\"", 4, "not valid TOML"),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wod]\nreflectance = 0.5",
        3,
        "did you mean \"wood\"?",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wood]\nreflectance = 1.5",
        4,
        "is 1.5; expected a number or [r, g, b] within 0 to 1",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wood]\nreflectance = [0.5, 0.5]",
        4,
        "expected a number or [r, g, b]",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wood]\nreflectance = \"70%\"",
        4,
        "\"reflectance\" is \"70%\"",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wood]\nreflektance = 1",
        4,
        "did you mean \"reflectance\"?",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wood]\nkind = \"glass\"",
        4,
        "\"glass\" is not built yet",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wood]\nkind = \"miror\"",
        4,
        "did you mean \"mirror\"?",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wood]\nbsdf = \"a.xml\"",
        4,
        "\"bsdf\" is not built yet",
    ),
    case(
        "[\"room.obj\"]",
        "[\"room.obj\"]\n[materials.wood]\nkind = \"mirror\"",
        3,
        "lacks \"reflectance\"",
    ),
    case(
        "kind = \"point\"",
        "kind = \"spot\"",
        5,
        "\"spot\" is not built yet",
    ),
    case(
        "kind = \"point\"",
        "kind = \"pont\"",
        5,
        "did you mean \"point\"?",
    ),
    case("kind = \"point\"\n", "", 4, "lacks \"kind\""),
    case(
        "position = [0.5, 0.5, 2.0]",
        "position = [0.5, 0.5]",
        6,
        "expected a position [x, y, z] in m",
    ),
    case(
        "position = [0.5, 0.5, 2.0]",
        "position = [0.5, nan, 2.0]",
        6,
        "is nan",
    ),
    case(
        "position = [0.5, 0.5, 2.0]",
        "position = [0.5, 1e300, 2.0]",
        6,
        "is 1e300",
    ),
    case("intensity_cd = 100", "intensity_cd = -100", 7, "at least 0"),
    case(
        "intensity_cd = 100",
        "intensity_cd = 0",
        4,
        "no light gives any flux",
    ),
    case(
        "intensity_cd = 100",
        "intensity_lm = 100",
        7,
        "did you mean \"intensity_cd\"?",
    ),
    case(
        "intensity_cd = 100",
        "intensity_cd = \"100 cd\"",
        7,
        "\"100 cd\"",
    ),
    case(
        "[[lights]]",
        "[lights]",
        4,
        "expected [[lights]], in double brackets",
    ),
    case(
        "[[lights]]\nkind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100\n",
        "",
        1,
        "no lights",
    ),
    case(
        "kind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100",
        "kind = \"area\"\nmaterial = \"wod\"\nflux_lm = 1",
        6,
        "did you mean \"wood\"?",
    ),
    case(
        "kind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100",
        "kind = \"area\"\nmaterial = \"wood\"",
        4,
        "lacks one of luminance_cd_m2, flux_lm",
    ),
    case(
        "kind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100",
        "kind = \"area\"\nmaterial = \"wood\"\nluminance_cd_m2 = 1\nflux_lm = 1",
        8,
        "exclude each other",
    ),
    case(
        "intensity_cd = 100",
        "intensity_cd = 100\n[[lights]]\nkind = \"area\"\nmaterial = \"wood\"\nflux_lm = 1\n[[lights]]\nkind = \"area\"\nmaterial = \"wood\"\nflux_lm = 1",
        14,
        "already emits by line 10",
    ),
    case("name = \"plane\"\n", "", 9, "lacks \"name\""),
    case("\"plane\"", "\"../plane\"", 10, "can be a file name"),
    case("\"plane\"", "\"\"", 10, "can be a file name"),
    case(
        "kind = \"grid\"",
        "kind = \"gird\"",
        11,
        "did you mean \"grid\"?",
    ),
    case("v = [0, 1, 0]", "v = [2, 0, 0]", 14, "has no area"),
    case("v = [0, 1, 0]", "v = [0, 0, 0]", 14, "has no area"),
    case("v = [0, 1, 0]", "v = [1, 1, 0]", 14, "not square"),
    case("spacing = 0.25", "spacing = 0", 15, "above 0"),
    case("spacing = 0.25", "spacing = 1e-9", 15, "at most 1e7"),
    case(
        "spacing = 0.25",
        "spacing = \"25 cm\"",
        15,
        "expected a length in m",
    ),
    case(
        "spacing = 0.25",
        "sapcing = 0.25",
        15,
        "did you mean \"spacing\"?",
    ),
    case(
        "spacing = 0.25\n",
        "",
        9,
        "lacks one of spacing, counts, rule",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\ncounts = [1, 1]",
        16,
        "exclude each other",
    ),
    case("spacing = 0.25", "counts = [0, 4]", 15, "at least 1 each"),
    case("spacing = 0.25", "counts = [4]", 15, "expected [nu, nv]"),
    case(
        "spacing = 0.25",
        "counts = [4294967295, 4294967295]",
        15,
        "at most 1e7",
    ),
    case(
        "spacing = 0.25",
        "rule = \"en12465\"",
        15,
        "did you mean \"en12464\"?",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\nnormal = [1, 0, 0]",
        16,
        "in the plane of u and v",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\nnormal = [0, 0, 0]",
        16,
        "a direction [x, y, z] with a length",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\nquantity = \"median\"",
        16,
        "\"centre\" or \"center\" or \"mean\"",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[sensors]]\nname = \"Plane\"\nkind = \"points\"\npoints = [[0, 0, 1]]\nnormals = [[0, 0, 1]]",
        17,
        "two sensors are named \"plane\", the first on line 9",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[sensors]]\nname = \"p\"\nkind = \"points\"\npoints = [[0, 0, 1], [1, 1, 1]]\nnormals = [[0, 0, 1]]",
        20,
        "2 points but 1 normals",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[sensors]]\nname = \"p\"\nkind = \"points\"\npoints = []\nnormals = []",
        19,
        "at least one position",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[cameras]]\nname = \"eye\"",
        16,
        "cameras are not built yet",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nreplicats = 4",
        17,
        "did you mean \"replicates\"?",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nreplicates = 0",
        17,
        "an integer from 1",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nreplicates = 1.5",
        17,
        "an integer from 1",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nrel_tol = \"1%\"",
        17,
        "such as 0.01",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nrel_tol = -0.1",
        17,
        "such as 0.01",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nconfidence = 95",
        17,
        "such as 0.95",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nseed = -1",
        17,
        "an integer from 0",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nmax_bounces = \"unlimitted\"",
        17,
        "did you mean \"unlimited\"?",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nmax_bounces = -1",
        17,
        "\"unlimited\" or a number",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nestimator = 3",
        17,
        "expected a name",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[simulation]\nmap_element_m = 0",
        17,
        "a length in m above 0",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\nspacing = 0.5",
        16,
        "duplicate key",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"lamp.ldt\"\nposition = [0, 0, 2]",
        17,
        "not built yet",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"lamp.xml\"\nposition = [0, 0, 2]",
        17,
        "not built yet",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"none.ies\"\nposition = [0, 0, 2]",
        17,
        "no such file",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\ndimming = -1",
        19,
        "at least 0",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, inf]",
        18,
        "is inf",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\naim = [0, 0, 0]",
        19,
        "no length",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\naim = [1, 0, 0]",
        19,
        "the default \"c0\"",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\nc0 = [0, 0, 3]",
        19,
        "parallel to \"aim\"",
    ),
    case(
        "spacing = 0.25",
        "spacing = 0.25\n[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0, 0, 2]\nrotation = 3",
        19,
        "did you mean \"rotation_deg\"?",
    ),
    case(
        "[[sensors]]\nname = \"plane\"\nkind = \"grid\"\norigin = [0, 0, 0.8]\nu = [1, 0, 0]\nv = [0, 1, 0]\nspacing = 0.25\n",
        "",
        1,
        "no sensors",
    ),
];

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
        Some(p) => assert!(
            text.starts_with(&format!("{file}:{}:{}: ", p.line, p.column)),
            "{text}"
        ),
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
    for Case {
        from,
        to,
        file,
        line,
        needle,
    } in PROJECT_CASES
    {
        assert!(PROJECT.contains(from), "{from} is not in the project");
        let project = PROJECT.replacen(from, to, 1);
        check(&project, &MapFiles::room(), file, Some(*line), needle);
    }
}

#[test]
fn empty_and_binary_project_files() {
    let files = MapFiles::room();
    check("", &files, "room.toml", Some(1), "no [scene] section");
    check(
        "\u{feff}",
        &files,
        "room.toml",
        Some(1),
        "no [scene] section",
    );
    check(
        "\0\u{1}\u{2}",
        &files,
        "room.toml",
        Some(1),
        "not valid TOML",
    );
    let error = quasilux_scene::load("a.toml", b"[scene]\nup = \"\xff\"", &files).unwrap_err();
    assert!(
        error.to_string().starts_with("a.toml:2:7: not UTF-8"),
        "{error}"
    );
    let deep = "a = ".to_owned() + &"[".repeat(100_000);
    check(&deep, &files, "room.toml", Some(1), "not valid TOML");
}

#[test]
fn geometry_files_are_refused_at_their_line() {
    for (obj, line, needle) in [
        (
            ROOM_OBJ.replace("v 1 1 0", "v 1 nan 0"),
            Some(6),
            "y of the vertex is \"nan\"",
        ),
        (ROOM_OBJ.replace("v 1 1 0", "v 1 inf 0"), Some(6), "\"inf\""),
        (ROOM_OBJ.replace("v 1 1 0", "v 1 1"), Some(6), "has no z"),
        (
            ROOM_OBJ.replace("f 1 2 3 4", "f 1 2 5"),
            Some(8),
            "vertex 5; expected 1 to 4",
        ),
        (ROOM_OBJ.replace("f 1 2 3 4", "f 1 2 -5"), Some(8), "\"-5\""),
        (
            ROOM_OBJ.replace("f 1 2 3 4", "f 1 2 1000000000"),
            Some(8),
            "1 to 4",
        ),
        (
            ROOM_OBJ.replace("v 1 1 0", "v 1 1e10 0"),
            Some(8),
            "beyond 1e9 m",
        ),
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
