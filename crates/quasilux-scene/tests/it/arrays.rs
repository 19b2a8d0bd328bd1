//! Triangles in memory beside files.

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::{FileKind, Files, LoadError, Loaded, TriangleArrays, load};

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
const HALVES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

/// Arrays under the name `floor`, and no file.
#[derive(Clone, Default)]
struct Arrays {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    material_of: Vec<u32>,
    materials: Vec<String>,
}

impl Arrays {
    fn square() -> Self {
        Self {
            positions: SQUARE.to_vec(),
            triangles: HALVES.to_vec(),
            material_of: Vec::new(),
            materials: vec!["wood".to_owned()],
        }
    }

    fn load(&self) -> Result<Loaded, LoadError> {
        let materials = "[materials.wood]\nreflectance = 0.4\n";
        let project = PROJECT.replace("room.obj", "floor") + materials;
        load("room.toml", project.as_bytes(), self)
    }

    fn refusal(&self) -> String {
        self.load().expect_err("a refusal").to_string()
    }
}

impl Files for Arrays {
    fn read(&self, _path: &str, _kind: FileKind) -> std::io::Result<Vec<u8>> {
        Err(std::io::ErrorKind::NotFound.into())
    }

    fn triangles(&self, path: &str) -> Option<TriangleArrays<'_>> {
        let Self { positions, triangles, material_of, materials } = self;
        let arrays = TriangleArrays { positions, triangles, material_of, materials, object: "" };
        (path == "floor").then_some(arrays)
    }
}

/// The reference: the same square as an OBJ file.
#[test]
fn arrays_make_the_mesh_of_a_file() {
    let obj = "o floor\nusemtl wood\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    let materials = "[materials.wood]\nreflectance = 0.4\n";
    let files = MapFiles::default().with("room.obj", obj);
    let from_file = load_text(&(PROJECT.to_owned() + materials), &files).unwrap();
    let from_arrays = Arrays::square().load().unwrap();
    assert_eq!(from_arrays.scene.mesh, from_file.scene.mesh);
    assert_eq!(from_arrays.scene.materials, from_file.scene.materials);
    assert_eq!(warnings_of(&from_arrays), [""; 0]);
}

#[test]
fn each_triangle_has_its_material_and_the_default_where_none_is_named() {
    let names = ["wood", "steel"].map(str::to_owned).to_vec();
    let two = Arrays { material_of: vec![1, 0], materials: names, ..Arrays::square() };
    let loaded = two.load().unwrap();
    assert_eq!(loaded.scene.mesh.material_of, [1, 0]);
    assert_eq!(
        warnings_of(&loaded),
        ["floor: the material \"steel\" of 1 triangles is not defined: reflectance 0.5 is used"]
    );
    let none = Arrays { materials: Vec::new(), ..Arrays::square() };
    assert!(none.refusal().contains("no geometry uses the material \"wood\""));
}

#[test]
fn indices_out_of_range_are_refused_with_their_triangle() {
    let square = Arrays::square();
    for vertex in [4, u32::MAX] {
        let bad = Arrays { triangles: vec![HALVES[0], [0, vertex, 1]], ..square.clone() };
        let wanted = format!("floor: triangle 1 has the vertices 0, {vertex}, 1; expected indices");
        assert!(bad.refusal().starts_with(&wanted), "{}", bad.refusal());
    }
    let bad = Arrays { material_of: vec![0, 1], ..square.clone() };
    assert!(bad.refusal().contains("triangle 1 has the material 1; expected an index below 1"));
    let bad = Arrays { material_of: vec![0], ..square.clone() };
    assert!(bad.refusal().contains("1 materials for 2 triangles; expected one for each"));
    let bad = Arrays { triangles: Vec::new(), ..square.clone() };
    assert!(bad.refusal().contains("floor: no triangles"));
    let mut bad = square;
    bad.positions[2][1] = f64::NAN;
    assert!(bad.refusal().contains("triangle 0 has a vertex that is not finite"));
}
