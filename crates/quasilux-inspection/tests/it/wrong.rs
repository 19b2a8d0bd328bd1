//! Wrong scenes: what each must be told, at which section of the project file.

use crate::room::{Case, Face, body, plate, shell};
use glam::DVec3;
use quasilux_inspection::Check;

/// A wrong scene.
struct Wrong {
    name: &'static str,
    case: Case,
    check: Check,
    /// The section of the project to mend: its header, and how many such stand up to it.
    section: &'static str,
    number: usize,
    /// What the cure has to say.
    cure: &'static str,
}

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

const SECOND_LAMP: &str = "position = [4.5, 2, 2.7]";

fn lamp_at(position: &str) -> Case {
    Case::new().say(SECOND_LAMP, &format!("position = {position}"))
}

const POINT: &str = "[[lights]]\nkind = \"point\"\nintensity_cd = 200\nposition = ";
const CAMERA: &str = "[[cameras]]\nname = \"view\"\nvertical_fov_deg = 60\nresolution = [60, 40]\n";
const PANEL: &str = "[[lights]]\nkind = \"area\"\nmaterial = \"panel\"\nluminance_cd_m2 = 3000\n";

fn panel(low: DVec3, faces_up: bool) -> Face {
    plate("panel", "panel", [low, low + v(1.2, 0.6, 0.0)], faces_up)
}

/// Runs a list of cases.
fn told(cases: Vec<Wrong>) {
    let mut missed = Vec::new();
    for Wrong { name, case, check, section, number, cure } in cases {
        let findings = case.findings();
        let lines: Vec<&str> = case.project.lines().collect();
        let is_told = findings.iter().any(|finding| {
            let Some(place) = finding.place else { return false };
            let sections = lines[..place.line].iter().filter(|line| line.starts_with(section));
            finding.check == check
                && lines[place.line - 1].starts_with(section)
                && sections.count() == number
                && finding.cure.contains(cure)
        });
        if !is_told {
            let told: Vec<String> = findings.iter().map(|it| format!("    {it}")).collect();
            missed.push(format!("{name} ({check:?}):\n{}", told.join("\n")));
        }
    }
    assert!(missed.is_empty(), "not told:\n{}", missed.join("\n"));
}

fn lamp(name: &'static str, case: Case, check: Check, cure: &'static str) -> Wrong {
    Wrong { name, case, check, section: "[[luminaires]]", number: 2, cure }
}

#[test]
fn lamps_in_wrong_places() {
    let outside = |name, position, cure| lamp(name, lamp_at(position), Check::LampOutside, cure);
    let tower = shell(v(-20.0, -20.0, -10.0), v(30.0, 30.0, 40.0));
    let cabinet = body("cabinet", v(5.55, 3.55, 0.1), v(5.95, 3.95, 2.0));
    let storey = lamp_at("[4.5, 2, 3.05]").with(tower.clone());
    let slab = body("slab", v(-0.1, -0.1, 3.01), v(6.1, 4.1, 3.2));
    // Millimetres among inches.
    let inches = lamp_at("[114.3, 50.8, 68.58]")
        .positions_scaled(1.0 / 0.0254)
        .say("[scene]", "[scene]\nposition_units = \"in\"");
    told(vec![
        outside("5 cm above the ceiling", "[4.5, 2, 3.05]", "\"ceiling\" by more than 0.051 m"),
        outside("1 mm above the ceiling", "[4.5, 2, 3.001]", "\"ceiling\""),
        outside("below the floor", "[4.5, 2, -0.2]", "\"floor\""),
        outside("behind a wall", "[6.3, 2, 1.5]", "\"east\""),
        outside("far away", "[40, 2, 2.7]", "inside the room"),
        outside("in millimetres", "[4500, 2000, 2700]", "position_units = \"mm\""),
        outside("in centimetres", "[450, 200, 270]", "position_units = \"cm\""),
        outside("in inches", "[177, 79, 106]", "position_units = \"in\""),
        outside("in feet", "[14.7, 6.6, 8.9]", "position_units = \"ft\""),
        lamp("one of another unit", inches, Check::LampOutside, "\"mm\" in [scene] if all"),
        lamp(
            "above the ceiling, in a hall",
            storey,
            Check::LampBehindSurface,
            "by more than 0.051",
        ),
        lamp(
            "above a ceiling slab",
            lamp_at("[4.5, 2, 3.25]").with(slab).with(tower),
            Check::LampBehindSurface,
            "where it lights the room",
        ),
        lamp(
            "in a cabinet",
            lamp_at("[5.7, 3.7, 1]").with(cabinet),
            Check::LampInBody,
            "opening or glass",
        ),
        lamp(
            "in a wall",
            lamp_at("[4.5, 4, 1.5]\naim = [0, 0, -1]"),
            Check::LampInSurface,
            "in front of the surface",
        ),
    ]);
}

#[test]
fn lights_in_wrong_places() {
    let light = |name, position: &str, cure| Wrong {
        name,
        case: Case::new().add(POINT).add(position),
        check: Check::LampOutside,
        section: "[[lights]]",
        number: 1,
        cure,
    };
    told(vec![
        light("a point above the ceiling", "[3, 2, 3.1]\n", "\"ceiling\""),
        light("a point in millimetres", "[3000, 2000, 2500]\n", "\"mm\""),
    ]);
}

#[test]
fn lamps_that_cannot_be() {
    let dear = "318.3 318.3 32 32";
    let mut bright = Case::new();
    bright.lamp = bright.lamp.replace(dear, "3183 3183 320 320");
    let mut dim = Case::new();
    dim.lamp = dim.lamp.replace(dear, "3.18 3.18 0.3 0.3");
    let mut long = Case::new();
    long.lamp = long.lamp.replace("0.1 1.2 0\n", "100 1200 0\n");
    let mut efficient = Case::new();
    efficient.lamp = efficient.lamp.replace("\n1 1 20\n", "\n1 1 2.2\n");
    let of_file = |name, case, check, cure| Wrong {
        name,
        case,
        check,
        section: "[[luminaires]]",
        number: 1,
        cure,
    };
    let twice = Case::new().say(SECOND_LAMP, "position = [1.5, 2, 2.7]");
    let points = format!("{POINT}[3, 2, 2]\n{POINT}[3, 2, 2]\n");
    told(vec![
        of_file("ten times its lamps", bright, Check::LampFlux, "multiplier"),
        of_file("a hundredth of its lamps", dim, Check::LampFlux, "multiplier"),
        of_file("an opening in millimetres", long, Check::LampTooBig, "unit"),
        lamp("listed twice", twice, Check::LampTwice, "move it"),
        of_file(
            "dimmed to a hundred times",
            lamp_at("[4.5, 2, 2.7]")
                .say("position = [1.5, 2, 2.7]", "position = [1.5, 2, 2.7]\ndimming = 100"),
            Check::LampBright,
            "0.8",
        ),
        of_file("1000 lm/W", efficient, Check::LampBright, "watts"),
        lamp(
            "the second of one file dimmed to a hundred times",
            Case::new().say(SECOND_LAMP, "position = [4.5, 2, 2.7]\ndimming = 100"),
            Check::LampBright,
            "0.8",
        ),
        Wrong {
            name: "two points at one place",
            case: Case::new().add(&points),
            check: Check::LampTwice,
            section: "[[lights]]",
            number: 2,
            cure: "move it",
        },
    ]);
}

fn scene(name: &'static str, case: Case, check: Check, cure: &'static str) -> Wrong {
    Wrong { name, case, check, section: "[scene]", number: 1, cure }
}

#[test]
fn wrong_units() {
    let geometry = |factor: f64| Case::new().moved(|p| p * factor);
    let all = |factor: f64| geometry(factor).positions_scaled(factor);
    let positions = |factor: f64| Case::new().positions_scaled(factor);
    let (both, away) = ("position_units", Check::GeometryElsewhere);
    told(vec![
        scene("OBJ in millimetres", geometry(1000.0), Check::Units, "units = \"mm\""),
        scene("OBJ in centimetres", geometry(100.0), Check::Units, "units = \"cm\""),
        scene("OBJ in inches", geometry(1.0 / 0.0254), Check::Units, "units = \"in\""),
        scene("OBJ in feet", geometry(1.0 / 0.3048), Check::Units, "units = \"ft\""),
        scene("OBJ in metres read as millimetres", geometry(0.001), Check::Units, "units"),
        scene("a kilometre away", Case::new().moved(|p| p + v(1000.0, 0.0, 0.0)), away, "origin"),
        scene("metres read as feet", geometry(0.3048), away, "units"),
        scene("positions in feet", positions(1.0 / 0.3048), away, "position_units = \"ft\""),
        scene("positions in inches", positions(1.0 / 0.0254), away, "position_units = \"in\""),
        scene("positions in millimetres", positions(1000.0), away, "position_units = \"mm\""),
        scene("all in millimetres", all(1000.0), Check::Units, both),
        scene("all in centimetres", all(100.0), Check::Units, both),
        scene("all in inches", all(1.0 / 0.0254), Check::Units, both),
    ]);
}

#[test]
fn wrong_axes() {
    let z_as_y = Case::new().say("[\"room.obj\"]", "[\"room.obj\"]\nup = \"y\"");
    let y_up = |p: DVec3| v(p.x, p.z, -p.y);
    let y_as_z = Case::new().moved(y_up);
    // Mirrored, so that all positions are inside: what a program writes that swaps two columns.
    let swapped = |p: DVec3| v(p.x, p.z, p.y);
    let plain = |mut case: Case| {
        for face in &mut case.faces {
            face.object = "room";
            face.material = "wall";
        }
        let floor = "[materials.floor]\nreflectance = 0.3\n";
        case.say(floor, "").say("[materials.ceiling]\nreflectance = 0.8\n", "")
    };
    let inside = |case: Case| {
        case.say("v = [0, 3, 0]", "v = [0, 2, 0]").say("[1.5, 2, 2.7]", "[1.5, 1.5, 2.7]")
    };
    told(vec![
        scene("z up read as y up", z_as_y, Check::UpAxis, "up = \"z\""),
        scene("y up read as z up", y_as_z.clone(), Check::UpAxis, "up = \"y\""),
        scene("y up without names", plain(y_as_z), Check::UpAxis, "up = \"y\""),
        scene(
            "swapped axes, floor by name",
            inside(Case::new().moved(swapped)),
            Check::UpAxis,
            "up = \"y\"",
        ),
        scene(
            "swapped axes, floor by area",
            plain(inside(Case::new().moved(swapped))),
            Check::UpAxis,
            "up = \"y\"",
        ),
    ]);
}

#[test]
fn holes_in_rooms() {
    let missing = |object: &str| Case::new().without(object);
    let bare = |object: &str, reflectance: &str| {
        missing(object).say(&format!("[materials.{object}]\nreflectance = {reflectance}\n"), "")
    };
    let low_wall = Case::new().without("north").with([Face {
        object: "north",
        material: "wall",
        corners: vec![v(0.0, 4.0, 0.0), v(6.0, 4.0, 0.0), v(6.0, 4.0, 2.95), v(0.0, 4.0, 2.95)],
    }]);
    let cure = "add the missing surface";
    told(vec![
        scene("a long wall missing", missing("south"), Check::Hole, cure),
        scene("a short wall missing", missing("east"), Check::Hole, cure),
        scene("the ceiling missing", bare("ceiling", "0.8"), Check::Hole, cure),
        scene("the floor missing", bare("floor", "0.3"), Check::Hole, cure),
        scene("a gap of 5 cm below the ceiling", low_wall, Check::Hole, cure),
    ]);
}

#[test]
fn the_hole_is_where_the_wall_was() {
    let findings = Case::new().without("east").findings();
    let hole = findings.iter().find(|finding| finding.check == Check::Hole).expect("a hole");
    assert!(hole.message.contains("12.00 m²"), "{hole}");
    let middle = hole.position_m.expect("a place");
    assert!((middle - v(6.0, 2.0, 1.5)).length() < 1e-9, "{middle}");
}

#[test]
fn emitters_that_look_away() {
    let dark = "[materials.panel]\nreflectance = 0\n";
    let with = |panels: Vec<Face>| {
        let case = Case::new().say("[[luminaires]]", &format!("{dark}[[luminaires]]"));
        case.add(PANEL).with(panels)
    };
    let row = |turned: usize| -> Vec<Face> {
        (0..4).map(|k| panel(v(0.3 + 1.4 * k as f64, 1.0, 2.9), k == turned)).collect()
    };
    let wrong = |name, case, cure| Wrong {
        name,
        case,
        check: Check::EmitterLooksAway,
        section: "material = ",
        number: 1,
        cure,
    };
    let cure = "turn them over";
    told(vec![
        wrong("a panel 5 cm below the ceiling", with(vec![panel(v(2.0, 1.0, 2.95), true)]), cure),
        wrong("a panel in the ceiling", with(vec![panel(v(2.0, 1.0, 3.0), true)]), cure),
        wrong("one of four panels", with(row(2)), cure),
    ]);
}

#[test]
fn sensors_in_wrong_places() {
    let origin = "origin = [0.5, 0.5, 0.8]";
    let sensor = |name, case, check, cure| Wrong {
        name,
        case,
        check,
        section: "[[sensors]]",
        number: 1,
        cure,
    };
    let moved = |to: &str| Case::new().say(origin, &format!("origin = {to}"));
    let desk = plate("desk", "wall", [v(0.2, 0.2, 0.801), v(3.0, 3.8, 0.801)], true);
    let thick = plate("desk", "wall", [v(0.2, 0.2, 0.82), v(3.0, 3.8, 0.82)], false);
    let points = "[[sensors]]\nname = \"p\"\nkind = \"points\"\npoints = [[3, 2, 1], [3, 2, 3.2]]\n\
        normals = [[0, 0, 1], [0, 0, 1]]\n";
    told(vec![
        sensor(
            "beyond a wall",
            moved("[2.5, 0.5, 0.8]"),
            Check::SensorOutside,
            "keep its points within the walls",
        ),
        sensor(
            "beyond a wall, under the sky",
            moved("[2.5, 0.5, 0.8]")
                .add("[sky]\nmodel = \"cie\"\ntype = 1\nhorizontal_illuminance_lx = 10000\n"),
            Check::SensorOutside,
            "keep its points within the walls",
        ),
        sensor("outside", moved("[7.5, 0.5, 0.8]"), Check::SensorOutside, "into the room"),
        sensor(
            "above the ceiling",
            moved("[0.5, 0.5, 3.2]"),
            Check::SensorOutside,
            "into the room",
        ),
        sensor(
            "in millimetres",
            Case::new()
                .say(origin, "origin = [500, 500, 800]")
                .say("u = [5, 0, 0]", "u = [5000, 0, 0]")
                .say("v = [0, 3, 0]", "v = [0, 3000, 0]")
                .say("spacing = 0.5", "spacing = 500"),
            Check::SensorOutside,
            "\"mm\"",
        ),
        sensor("2 cm below a desk", Case::new().with([thick]), Check::SensorCovered, "other side"),
        sensor(
            "looking down",
            moved("[0.5, 0.5, 0.8]").add("normal = [0, 0, -1]\n"),
            Check::GridLooksDown,
            "normal = [0, 0, 1]",
        ),
        sensor("1 mm below a desk", Case::new().with([desk]), Check::SensorCovered, "other side"),
        sensor(
            "looking into the floor",
            moved("[0.5, 0.5, 0.001]").add("normal = [0, 0, -1]\n"),
            Check::SensorCovered,
            "turn its normal",
        ),
        sensor(
            "very many points",
            Case::new().say("spacing = 0.5", "spacing = 0.01"),
            Check::GridSize,
            "widen its spacing",
        ),
        sensor(
            "one point",
            Case::new().say("spacing = 0.5", "spacing = 8"),
            Check::GridSize,
            "points",
        ),
        Wrong {
            name: "a point above the ceiling",
            case: Case::new().add(points),
            check: Check::SensorOutside,
            section: "[[sensors]]",
            number: 2,
            cure: "walls",
        },
    ]);
}

#[test]
fn cameras_in_wrong_places() {
    let camera = |name, places: &str, cure| Wrong {
        name,
        case: Case::new().add(CAMERA).add(places),
        check: Check::CameraOutside,
        section: "[[cameras]]",
        number: 1,
        cure,
    };
    told(vec![
        camera("behind a wall", "position = [3, -2, 1.5]\ntarget = [3, 2, 1]\n", "into the room"),
        camera(
            "in millimetres",
            "position = [500, 500, 1500]\ntarget = [3000, 2000, 1000]\n",
            "mm",
        ),
        camera("looking away", "position = [3, -2, 1.5]\ntarget = [3, -5, 1]\n", "into the room"),
    ]);
}

#[test]
fn surfaces_that_cannot_be() {
    let bare = "[materials.floor]\nreflectance = 0.3\n[materials.ceiling]\nreflectance = 0.8\n\
        [materials.wall]\nreflectance = 0.6\n";
    let twin = plate("carpet", "wall", [v(0.0, 0.0, 0.0), v(6.0, 4.0, 0.0)], true);
    told(vec![
        Wrong {
            name: "brighter than paint",
            case: Case::new().say("reflectance = 0.8", "reflectance = 0.98"),
            check: Check::HighReflectance,
            section: "[materials.ceiling]",
            number: 1,
            cure: "0.9",
        },
        scene(
            "none described",
            Case::new().say(bare, ""),
            Check::DefaultReflectance,
            "reflectance",
        ),
        scene("a floor twice", Case::new().with([twin]), Check::CoincidentFaces, "one of them"),
    ]);
}
