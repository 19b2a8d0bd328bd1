//! Geometry that asks for more than its size: instances, names, faces and files without number.

use crate::gltf::{SQUARE, square_bytes};
use crate::support::{MapFiles, PROJECT, load_geometry, load_text, warnings_of};
use quasilux_scene::{FileKind, Files, load};
use std::cell::Cell;
use std::sync::Arc;

/// Many nodes with the mesh of the square, one behind the other.
fn instances(count: usize, mesh: &str) -> String {
    let square = SQUARE.replace("\"name\": \"square\"", &format!("\"name\": \"{mesh}\""));
    let node = |x: usize| format!("{{\"mesh\": 0, \"translation\": [0, {}, 0]}}", x % 50_000);
    let nodes: Vec<String> = (0..count).map(node).collect();
    let roots: Vec<String> = (0..count).map(|node| node.to_string()).collect();
    let start = square.find("\"nodes\": [\n").expect("nodes");
    let end = square.find("\"meshes\"").expect("meshes");
    let nodes = format!("\"nodes\": [{}],\n", nodes.join(","));
    let text = format!("{}{nodes}{}", &square[..start], &square[end..]);
    text.replace("{\"nodes\": [0]}", &format!("{{\"nodes\": [{}]}}", roots.join(",")))
}

/// Each instance had a name of its own: 9 GB.
#[test]
fn a_long_name_is_kept_once_for_all_instances() {
    let name = "n".repeat(90_000);
    let files = MapFiles::room()
        .with("a.gltf", instances(100_000, &name))
        .with("square mesh.bin", square_bytes());
    let scene = load_geometry("a.gltf", &files).unwrap().scene;
    let objects = &scene.mesh.objects;
    assert_eq!((objects.len(), objects[0].len()), (100_000, 90_000));
    assert!(objects.iter().all(|object| Arc::ptr_eq(object, &objects[0])));
    assert_eq!(scene.mesh.triangles.len(), 200_000);
}

/// Files that count how often they are read.
struct Recording {
    files: MapFiles,
    buffers: Cell<u32>,
}

impl Files for Recording {
    fn read(&self, path: &str, kind: FileKind) -> std::io::Result<Vec<u8>> {
        self.buffers.set(self.buffers.get() + u32::from(kind == FileKind::Buffer));
        self.files.read(path, kind)
    }
}

#[test]
fn a_buffer_that_is_named_a_hundred_times_is_read_once() {
    let buffer = "{\"byteLength\": 60, \"uri\": \"square%20mesh.bin\"}";
    let text = SQUARE.replace(buffer, &vec![buffer; 100].join(", "));
    assert_eq!(text.matches(buffer).count(), 100);
    let files = MapFiles::room().with("a.gltf", text).with("square mesh.bin", square_bytes());
    let files = Recording { files, buffers: Cell::new(0) };
    let project = PROJECT.replace("room.obj", "a.gltf");
    load("room.toml", project.as_bytes(), &files).unwrap();
    assert_eq!(files.buffers.get(), 1);
}

/// Whatever gives more bytes than a kind can have is refused.
#[test]
fn files_beyond_the_size_of_their_kind_are_refused() {
    let lamp = vec![b' '; FileKind::Photometry.max_bytes() as usize + 1];
    let luminaire = "\n[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [0.5, 0.5, 2]\n";
    let files = MapFiles::room().with("lamp.ies", lamp);
    let error = load_text(&format!("{PROJECT}{luminaire}"), &files).unwrap_err();
    assert!(error.to_string().contains("larger than 64 MiB"), "{error}");
}

/// Every ray met all of them.
#[test]
fn triangles_listed_over_and_over_are_dropped_with_a_warning() {
    let face = "f 1 2 3\n".repeat(100_000);
    let text = format!("usemtl wood\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{face}");
    let loaded = load_geometry("a.obj", &MapFiles::room().with("a.obj", text)).unwrap();
    assert_eq!(loaded.scene.mesh.triangles.len(), 8);
    let warnings = warnings_of(&loaded);
    assert!(
        warnings.iter().any(|it| it.contains("99992 triangles have the corners")),
        "{warnings:?}"
    );
}

/// Each was compared with all the others, or read for each of its names.
#[test]
fn materials_libraries_and_points_without_number_are_read() {
    let count = 50_000;
    let numbered = |line: &dyn Fn(usize) -> String| (0..count).map(line).collect::<String>();
    let faces = numbered(&|i| format!("usemtl m{i}\nf 1 2 3\n"));
    let library = numbered(&|i| format!("newmtl m{i}\nKd 0.2 0.2 0.2\n"));
    let names = "mtllib a.mtl\n".repeat(count);
    let text = format!("{names}v 0 0 0\nv 1 0 0\nv 0 1 0\n{faces}");
    let files = MapFiles::room().with("a.obj", text).with("a.mtl", library);
    let materials = numbered(&|i| format!("[materials.m{i}]\nreflectance = 0.3\n"));
    let points = ["[0.5, 0.5, 1]"; 50_000].join(",");
    let normals = ["[0, 0, 1]"; 50_000].join(",");
    let project = format!(
        "[scene]\ngeometry = [\"a.obj\"]\n{materials}\
         [[lights]]\nkind = \"point\"\nposition = [0.2, 0.2, 2]\nintensity_cd = 1\n\
         [[sensors]]\nname = \"p\"\nkind = \"points\"\npoints = [{points}]\nnormals = [{normals}]\n"
    );
    let scene = load_text(&project, &files).unwrap().scene;
    assert_eq!((scene.materials.len(), scene.sensors[0].len()), (count, 50_000));
}

/// A project of little else than marks takes no memory to speak of.
#[test]
fn a_project_of_more_parts_than_any_is_refused() {
    let text = format!("a = [{}]", "1,".repeat(9_000_000));
    let error = load_text(&text, &MapFiles::room()).unwrap_err();
    assert!(error.to_string().contains("parts; expected at most 8388608"), "{error}");
}

/// The same of the JSON of a glTF file.
#[test]
fn a_gltf_file_of_more_parts_than_any_is_refused() {
    let text =
        SQUARE.replace("\"nodes\": [\n", &format!("\"nodes\": [{}", "{},".repeat(2_200_000)));
    let error = load_geometry("a.gltf", &MapFiles::room().with("a.gltf", text)).unwrap_err();
    assert!(error.to_string().contains("objects and lists of JSON"), "{error}");
}
