//! Sensors inside closed objects.

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use std::fmt::Write;

/// A closed box as OBJ; `first` is the number of its first vertex.
fn box_obj(name: &str, low: [f64; 3], high: [f64; 3], first: usize) -> String {
    let mut obj = format!("o {name}\nusemtl wood\n");
    for i in 0..8 {
        let pick = |axis: usize| {
            if i >> axis & 1 == 1 { high[axis] } else { low[axis] }
        };
        let _ = writeln!(obj, "v {} {} {}", pick(0), pick(1), pick(2));
    }
    for quad in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    {
        let [a, b, c, d] = quad.map(|v| v + first);
        let _ = writeln!(obj, "f {a} {b} {c} {d}");
    }
    obj
}

/// A closed room with the light in it, and a cupboard that covers x below 0.4 m.
fn files() -> MapFiles {
    let obj = "mtllib room.mtl\n".to_owned()
        + &box_obj("room", [-1.0; 3], [3.0; 3], 1)
        + &box_obj("cupboard", [-0.5, -0.5, -0.5], [0.4, 1.5, 1.5], 9);
    MapFiles::room().with("room.obj", obj)
}

fn probe(points: &str) -> String {
    let normals = vec!["[0, 0, 1]"; points.matches('[').count()].join(", ");
    let grid = PROJECT.find("[[sensors]]").unwrap_or(0);
    format!(
        "{}[[sensors]]\nname = \"probe\"\nkind = \"points\"\npoints = [\n  {}\n]\n\
         normals = [{normals}]\n",
        &PROJECT[..grid],
        points.replace("], ", "],\n  "),
    )
}

#[test]
fn a_point_in_a_cupboard_is_refused_at_its_line() {
    let error = load_text(&probe("[0.9, 0.5, 0.5], [0.2, 0.3, 0.4]"), &files()).unwrap_err();
    assert_eq!(
        error.to_string(),
        "room.toml:14:3: point 2 of sensor \"probe\" lies inside the closed object \"cupboard\", \
         which holds no light; move it where light can reach it"
    );
}

#[test]
fn a_point_behind_glass_is_accepted() {
    let panes = "[materials.wood]\nkind = \"pane\"\n";
    assert!(load_text(&(probe("[0.2, 0.3, 0.4]") + panes), &files()).unwrap().warnings.is_empty());
}

#[test]
fn a_closed_hall_where_nothing_absorbs_is_refused() {
    let hall = |reflectance: &str| {
        let wood = format!("[materials.wood]\nkind = \"mirror\"\nreflectance = {reflectance}\n");
        load_text(&(probe("[0.9, 0.5, 0.5]") + &wood), &files())
    };
    let error = hall("1").unwrap_err();
    assert_eq!(
        error.to_string(),
        "room.toml:16:12: nothing absorbs light in the closed object \"room\", so it would grow \
         for ever; give some surface a reflectance below 1"
    );
    assert!(hall("[0.5, 1, 0.5]").is_err() && hall("0.999").is_ok());
}

#[test]
fn glass_is_closed_and_faces_outward() {
    let glass = "[materials.wood]\nkind = \"dielectric\"\n";
    let warnings = |obj: &str| {
        let files = MapFiles::room().with("room.obj", obj);
        warnings_of(&load_text(&(PROJECT.to_owned() + glass), &files).unwrap())
    };
    let obj = box_obj("glass", [0.0; 3], [1.0; 3], 1);
    assert!(warnings(&obj).is_empty(), "{:?}", warnings(&obj));
    // Flush with a wall, whose edges are those of the glass.
    let wall = "usemtl plaster\nv 0 0 -2\nv 1 0 -2\nf 1 2 10\nf 2 10 9\n";
    let plaster = format!("{glass}[materials.plaster]\nreflectance = 0.5\n");
    let files = MapFiles::room().with("room.obj", obj.clone() + wall);
    let flush = load_text(&(PROJECT.to_owned() + &plaster), &files).unwrap();
    assert!(flush.warnings.is_empty(), "{:?}", flush.warnings);
    let open = obj.rsplit_once("f ").unwrap().0;
    assert!(
        warnings(open)[0].contains("10 triangles of kind \"dielectric\" are not part of a closed")
    );
    let inward: String = obj
        .lines()
        .map(|line| match line.strip_prefix("f ") {
            Some(face) => {
                let corners: Vec<&str> = face.split(' ').rev().collect();
                format!("f {}\n", corners.join(" "))
            }
            None => format!("{line}\n"),
        })
        .collect();
    assert!(warnings(&inward)[0].contains("12 triangles of kind \"dielectric\" face the inside"));
}

#[test]
fn points_on_and_beside_the_cupboard_are_accepted() {
    // On its top, on the floor of the room, beside it, and outside of everything.
    let project = probe("[0.2, 0.3, 1.5], [2, 2, -1], [0.41, 0.3, 0.4], [0, 0, 9]");
    assert!(load_text(&project, &files()).unwrap().warnings.is_empty());
}

#[test]
fn a_cupboard_with_a_light_is_no_wall() {
    let project = probe("[0.2, 0.3, 0.4]").replace("[0.5, 0.5, 2.0]", "[0.1, 0.1, 0.1]");
    assert!(load_text(&project, &files()).is_ok());
    let point = "kind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100";
    let furnace = probe("[0.2, 0.3, 0.4]")
        .replace(point, "kind = \"area\"\nmaterial = \"wood\"\nluminance_cd_m2 = 1");
    assert!(load_text(&furnace, &files()).is_ok());
}

#[test]
fn grids_may_be_partly_inside() {
    // Cell centres at x = 0.125, 0.375 (inside), 0.625, 0.875.
    let warnings = warnings_of(&load_text(PROJECT, &files()).unwrap());
    assert_eq!(
        warnings,
        ["room.toml:9:1: 8 of 16 points of sensor \"plane\" lie inside the closed object \
          \"cupboard\", which holds no light"]
    );
    let narrow = PROJECT.replace("u = [1, 0, 0]", "u = [0.3, 0, 0]");
    let error = load_text(&narrow, &files()).unwrap_err();
    assert!(
        error.to_string().starts_with("room.toml:9:1: sensor \"plane\" lies inside"),
        "{error}"
    );
}

/// A recessed luminaire lies in the plane of the ceiling, or even in a corner of the room.
#[test]
fn lights_on_the_surface_of_a_room_light_it() {
    for position in ["[0.5, 0.5, 3.0]", "[3.0, 0.5, 3.0]", "[3.0, 3.0, 3.0]"] {
        let project = probe("[1.5, 1.5, 0.5]").replace("[0.5, 0.5, 2.0]", position);
        assert!(load_text(&project, &files()).unwrap().warnings.is_empty(), "{position}");
    }
}

#[test]
fn a_camera_in_a_cupboard_is_refused() {
    let camera = |x_m: f64| {
        format!(
            "{PROJECT}[[cameras]]\nname = \"eye\"\nposition = [{x_m}, 0.5, 1]\n\
             target = [2, 0.5, 1]\n\
             vertical_fov_deg = 50\nresolution = [4, 3]\n"
        )
    };
    assert!(load_text(&camera(0.5), &files()).is_ok());
    let text = load_text(&camera(0.3), &files()).unwrap_err().to_string();
    let expected = "room.toml:16:1: camera \"eye\" lies inside the closed object \"cupboard\"";
    assert!(text.starts_with(expected), "{text}");
}

/// A store of a building that is dark, and a lamp above the ceiling, are told; what else is in the
/// scene is wanted all the same.
#[test]
fn rooms_without_light_are_told_and_not_refused() {
    let obj = "mtllib room.mtl\n".to_owned()
        + &box_obj("room", [-1.0; 3], [3.0; 3], 1)
        + &box_obj("store", [4.0, -1.0, -1.0], [5.6, 3.0, 1.5], 9);
    let files = MapFiles::room().with("room.obj", obj);
    let camera = "[[cameras]]\nname = \"eye\"\nposition = [4.2, 0.5, 0]\ntarget = [5, 0.5, 0]\n\
        vertical_fov_deg = 50\nresolution = [4, 3]\n";
    let project = probe("[0.5, 0.5, 0.5], [5, 0.5, 0.5]") + camera;
    assert_eq!(
        warnings_of(&load_text(&project, &files).unwrap()),
        [
            "room.toml:9:1: 1 of 2 points of sensor \"probe\" lie inside the closed object \
             \"store\", which holds no light",
            "room.toml:17:1: camera \"eye\" lies inside the closed object \"store\", which \
             holds no light"
        ]
    );
    let above = probe("[0.5, 0.5, 0.5]").replace("[0.5, 0.5, 2.0]", "[0.5, 0.5, 3.05]");
    let loaded = load_text(&above, &files).unwrap();
    assert!(warnings_of(&loaded)[0].contains("closed object \"room\""), "{:?}", loaded.warnings);
}

/// A dark body is furniture or a room by its width and height, however it is turned.
#[test]
fn wardrobes_that_stand_askew_are_no_rooms() {
    let turned = |edges: [f64; 3], turn_deg: f64| {
        let [x, y, z] = edges.map(|edge| 0.5 * edge);
        let (sine, cosine) = libm::sincos(turn_deg.to_radians());
        let mut obj = String::new();
        for line in box_obj("body", [-x, -y, -z], [x, y, z], 9).lines() {
            let numbers: Vec<f64> = line.split(' ').filter_map(|it| it.parse().ok()).collect();
            let _ = match numbers[..] {
                [x, y, z] if line.starts_with("v ") => {
                    let [x, y] = [x * cosine - y * sine, x * sine + y * cosine];
                    writeln!(obj, "v {} {y} {z}", x + 20.0)
                }
                _ => writeln!(obj, "{line}"),
            };
        }
        let room = "mtllib room.mtl\n".to_owned() + &box_obj("room", [-1.0; 3], [3.0; 3], 1);
        MapFiles::room().with("room.obj", room + &obj)
    };
    for step in 0..200 {
        let part = |ratio: f64| (f64::from(step) * ratio).fract();
        let edges = [0.3 + 3.2 * part(0.618), 1.55 + 2.0 * part(0.414), 1.2 + 1.8 * part(0.732)];
        let is_room = edges[0].min(edges[1]) >= 1.5 && edges[2] >= 1.8;
        if (edges[0] - 1.5).abs() < 0.05 {
            continue;
        }
        let files = turned(edges, 360.0 * part(0.303));
        let read = load_text(&probe("[0.5, 0.5, 0.5], [20, 0, 0]"), &files);
        assert_eq!(read.is_ok(), is_room, "{edges:?}");
    }
}
