//! Geometry of public bug reports of other readers, made small (`docs/public-reports.md`).

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::{Bsdf, Loaded};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// A project of one OBJ file, which another lies beside.
fn loaded(obj: impl AsRef<[u8]>, beside: [&str; 2]) -> Loaded {
    let files = MapFiles::room().with("room.obj", obj.as_ref()).with(beside[0], beside[1]);
    load_text(PROJECT, &files).unwrap_or_else(|error| panic!("{error}"))
}

fn area_m2(loaded: &Loaded) -> f64 {
    let mesh = &loaded.scene.mesh;
    (0..mesh.triangles.len() as u32).map(|triangle| mesh.area_m2(triangle)).sum()
}

#[test]
fn faces_have_the_area_of_their_polygons() {
    // An I in a plane that lies aslant: 200 wide, 290 high, 14 and 10 thick.
    let i_beam = [
        [-1, -131],
        [-1, 131],
        [-20, 131],
        [-20, 145],
        [20, 145],
        [20, 131],
        [1, 131],
        [1, -131],
        [20, -131],
        [20, -145],
        [-20, -145],
        [-20, -131],
    ];
    let i_beam = i_beam.map(|[k, y]| [7197 + 3 * k, y, 4 * k - 6003]);
    let beam: String = i_beam.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n")).collect();
    let beam = format!("{beam}f {}\n", (1..13).map(|i| format!("{i} ")).collect::<String>());
    let cases = [
        // trimesh 2556: negative numbers count from where the face stands.
        (
            "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\n\
             v 5 0 0\nv 7 0 0\nv 7 2 0\nf -3//-9 -2//-9 -1//-9\n"
                .to_owned(),
            2.5,
        ),
        // tinyobjloader 181: normals that are not there.
        (format!("{SQUARE}f 1//1 2//2 3//3 4//4\n"), 1.0),
        // tinyobjloader 130: a last line that nothing ends.
        (format!("{SQUARE}f 1/1/1 2/2/2 3/4/3 4/3/3"), 1.0),
        // cinder 1121, helix-toolkit 152, ComfyUI 15919: statements over several lines.
        (format!("{SQUARE}f 1 2 \\\n 3 4\nf 1\\\n 2 3\n"), 1.5),
        // trimesh 2519, obj2gltf 79, Open3D 2632, earclipper 4: polygons with notches.
        ("v 0 0 0\nv 0 2 0\nv 1 1 0\nv 2 2 0\nv 2 0 0\nf 1 2 3 4 5\n".to_owned(), 3.0),
        (beam, 2.0 * 14.0 * 200.0 + 10.0 * 262.0),
        // AssetStudio 73, NMSMV 11: decimal commas. osrscachereader 16: commas behind numbers.
        ("v 0,5 0,25 0\nv 1,5 0,25 0\nv 1,5 1,25 0\nf 1 2 3\n".to_owned(), 0.5),
        ("v 0, 0, 0\nv 1, 0, 0\nv 1, 1, 0\nf 1 2 3\n".to_owned(), 0.5),
        // UABE 69: numbers of textures beyond any float.
        (format!("{SQUARE}vt 0 -{}.0\nf 1/1 2/1 3/1 4/1\n", "9".repeat(60)), 1.0),
        (format!("{SQUARE}f 1 2 2 3 4 1\nf 1 2\nf\n"), 1.0),
    ];
    for (obj, expected) in cases {
        let found = area_m2(&loaded(&obj, ["a.mtl", ""]));
        assert!((found / expected - 1.0).abs() < 1e-6, "{found}, not {expected}: {obj}");
    }
    let old_mac = format!("\u{FEFF}{SQUARE}f 1 2 3 4\n").replace('\n', "\r");
    assert!((area_m2(&loaded(old_mac, ["a.mtl", ""])) - 1.0).abs() < 1e-12);
}

#[test]
fn names_of_materials_are_those_of_their_files() {
    let reflectance = |obj: &str, mtl: [&str; 2]| {
        let loaded = loaded(format!("{SQUARE}{obj}f 1 2 3 4\n"), mtl);
        let Bsdf::Diffuse(_) = &loaded.scene.material(0).bsdf else { panic!("not diffuse") };
        loaded.scene.material(0).bsdf.reflectance().map(|it| it.0[1])
    };
    // assimp 545, assimp 2186, assimp 2355, vengi 203.
    let name = "Anodized Rough Grey #1";
    let obj = format!("mtllib a.mtl\nusemtl {name}\n");
    let mtl = format!("newmtl {name} # of the door\nKd 0.3 0.3 0.3\n");
    assert_eq!(reflectance(&obj, ["a.mtl", &mtl]), Some(0.3));
    let obj = "mtllib foo materials/my foo.mtl\nusemtl BMC\\Solid_\\Matte\n";
    let mtl = "newmtl BMC\\Solid_\\Matte\nmap_Kd \nKd 0.46 0.44 0.48\n";
    assert_eq!(reflectance(obj, ["foo materials/my foo.mtl", mtl]), Some(0.44));
}

/// three.js 12861, vcglib 213, openMVS 1285: what is transparent is told, and `Tr 1` says nothing.
#[test]
fn transparent_materials_are_told() {
    let obj = format!("mtllib a.mtl\n{SQUARE}usemtl pane\nf 1 2 3 4\ncurv 0 1 1 2\n");
    for (line, is_told) in [("d 0.3", true), ("Tr 0.7", true), ("Tr 1.0", false), ("d 1", false)] {
        let mtl = format!("newmtl pane\nKd 0.5 0.5 0.5\n{line}\nillum 2\n");
        let warnings = warnings_of(&loaded(&obj, ["a.mtl", &mtl])).join("\n");
        assert_eq!(warnings.contains("\"pane\" lets light through"), is_told, "{line}: {warnings}");
        assert!(warnings.contains("1 curves and surfaces of free form are not read"), "{warnings}");
    }
}
