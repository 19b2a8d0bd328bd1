//! OBJ and MTL: names, materials, polygons.

use crate::support::{MapFiles, PROJECT, ROOM_OBJ, load_text, warnings_of};
use glam::DVec3;
use quasilux_scene::Rgb;

#[test]
fn names_materials_and_polygons_are_kept() {
    let obj = "mtllib room.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\n\
        o desk top\nusemtl wood\nf 1/1/1 2/2/2 3 4\nusemtl steel\nf 1 4 5 6\n\
        g leg #1\nusemtl wood\nf -6 -5 -4 -3 -2 -1\n";
    let obj = obj.replace("leg #1", "leg#1");
    let files = MapFiles::room().with("room.obj", obj);
    let project = PROJECT.to_owned() + "[materials.steel]\nkind = \"mirror\"\nreflectance = 0.6\n";
    let loaded = load_text(&project, &files).unwrap();
    let scene = &loaded.scene;
    assert_eq!(scene.mesh.objects, ["desk top".into(), "leg#1".into()]);
    assert_eq!(scene.mesh.object_of, [0, 0, 0, 0, 1, 1, 1, 1]);
    let names: Vec<_> = scene.materials.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["wood", "steel"]);
    assert_eq!(scene.mesh.material_of, [0, 0, 1, 1, 0, 0, 0, 0]);
    assert_eq!(scene.materials[0].bsdf.reflectance(), Some(Rgb::grey(0.4)));
    assert_eq!(scene.materials[1].bsdf.reflectance(), Some(Rgb::grey(0.6)));
    assert_eq!(scene.mesh.positions.len(), 6);
    // The L-shaped leg covers 3 m^2, all of it facing up.
    let up: f64 = (4..8).map(|t| scene.mesh.double_area_vector(t).z / 2.0).sum();
    let area: f64 = (4..8).map(|t| scene.mesh.area_m2(t)).sum();
    assert!((up - 3.0).abs() < 1e-12 && (area - 3.0).abs() < 1e-12, "{up} {area}");
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
}

#[test]
fn oddities_are_warned_of_once_a_file() {
    let obj = ROOM_OBJ.replace("room.mtl", "none.mtl") + "f 1 1 2\nf 1 2\nf 2 2 3\n";
    let files = MapFiles::room().with("room.obj", obj);
    let warnings = warnings_of(&load_text(PROJECT, &files).unwrap());
    assert_eq!(
        warnings,
        [
            "room.obj:1:1: cannot read \"none.mtl\": no such file; its materials are unknown",
            "room.obj: 1 faces have fewer than three corners: dropped",
            "room.obj: 2 of 4 triangles are degenerate: dropped",
            "room.obj: the material \"wood\" of 2 triangles is not defined: reflectance 0.5 is \
             used",
        ]
    );
}

#[test]
fn triangles_without_material_get_the_default() {
    let files = MapFiles::room().with("room.obj", ROOM_OBJ.replace("usemtl wood\n", ""));
    let loaded = load_text(PROJECT, &files).unwrap();
    assert_eq!(loaded.scene.materials[0].name, "default");
    assert_eq!(loaded.scene.materials[0].bsdf.reflectance(), Some(Rgb::grey(0.5)));
    assert_eq!(
        warnings_of(&loaded),
        ["room.obj: 2 triangles have no material: reflectance 0.5 is used"]
    );
    let project = PROJECT.to_owned() + "[materials.default]\nreflectance = 0.1\n";
    let loaded = load_text(&project, &files).unwrap();
    assert_eq!(loaded.scene.materials[0].bsdf.reflectance(), Some(Rgb::grey(0.1)));
    assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
}

#[test]
fn names_need_not_be_utf_8_and_y_may_point_up() {
    let mut obj =
        b"usemtl h\xF6lzern\r\nv 0 1 0 # corner\r\nv 1 1 0\r\nv 1 1 -1\r\nf 1 2 3\r\n".to_vec();
    obj.extend(b"# the end");
    let files = MapFiles::room().with("room.obj", obj);
    let project = PROJECT.replace("[\"room.obj\"]", "[\"room.obj\"]\nup = \"y\"");
    let scene = load_text(&project, &files).unwrap().scene;
    assert_eq!(scene.materials[0].name, "h\u{fffd}lzern");
    assert_eq!(scene.mesh.positions, [DVec3::Z, DVec3::new(1.0, 0.0, 1.0), DVec3::ONE]);
    assert_eq!(scene.mesh.front_normal(0), DVec3::Z);
}

#[test]
fn positions_are_read_in_double_precision() {
    let files =
        MapFiles::room().with("room.obj", ROOM_OBJ.replace("v 1 1 0", "v 1 1.0000000000000002 0"));
    let scene = load_text(PROJECT, &files).unwrap().scene;
    assert_eq!(scene.mesh.positions[2].y, 1.0 + f64::EPSILON);
}

/// Several files in a statement, names with blanks, both, and names that only look like two.
#[test]
fn statements_name_one_or_several_material_files() {
    let reflectances = |statement: &str, names: &[&str]| {
        let obj = ROOM_OBJ.replace("room.mtl", statement) + "usemtl steel\nf 1 2 3\n";
        let mut files = MapFiles::room().with("room.obj", obj);
        for (name, material) in names.iter().zip(["wood\nKd 0.1 0.1 0.1", "steel\nKd 0.2 0.2 0.2"])
        {
            files = files.with(name, format!("newmtl {material}\n"));
        }
        let loaded = load_text(PROJECT, &files).unwrap();
        let of = |index: usize| loaded.scene.materials[index].bsdf.reflectance().unwrap().0[0];
        ([of(0), of(1)], warnings_of(&loaded).len())
    };
    assert_eq!(reflectances("a.mtl b.mtl", &["a.mtl", "b.mtl"]), ([0.1, 0.2], 0));
    assert_eq!(reflectances("my a.mtl  b c.MTL", &["my a.mtl", "b c.MTL"]), ([0.1, 0.2], 0));
    assert_eq!(reflectances("\"my a.mtl\" \"b.mtl\"", &["my a.mtl", "b.mtl"]), ([0.1, 0.2], 0));
    // One file of that name comes first; the other material is unknown.
    assert_eq!(reflectances("a.mtl b.mtl", &["a.mtl b.mtl"]), ([0.1, 0.5], 1));
    assert_eq!(reflectances("a.mtl none.mtl", &["a.mtl"]), ([0.1, 0.5], 2));
}
