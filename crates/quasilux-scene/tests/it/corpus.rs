//! Geometry of other programs, where a collection of it is at hand.

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::{FileKind, Files};
use std::path::{Path, PathBuf};

/// Files below one folder.
struct Folder(PathBuf);

impl Files for Folder {
    fn read(&self, path: &str, _kind: FileKind) -> std::io::Result<Vec<u8>> {
        std::fs::read(self.0.join(path))
    }
}

fn geometry_below(folder: &Path, found: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return;
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            geometry_below(&path, found);
        } else if path.to_str().is_some_and(|name| {
            [".obj", ".gltf", ".glb"].iter().any(|end| name.to_lowercase().ends_with(end))
        }) {
            found.push(path);
        }
    }
}

#[test]
fn all_scenes_load_or_are_refused_in_one_line() {
    let Some(folder) = quasilux_corpus::find("scenes") else { return };
    let mut paths = Vec::new();
    geometry_below(&folder, &mut paths);
    paths.sort();
    assert!(!paths.is_empty(), "no geometry at {}", folder.display());
    for path in paths {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let files = Folder(path.parent().unwrap_or(&folder).to_owned());
        let project = PROJECT
            .replace("[\"room.obj\"]", &format!("[{name:?}]\nup = \"y\""))
            .replace("origin = [0, 0, 0.8]", "origin = [0, 0, 1e6]");
        match quasilux_scene::load("a.toml", project.as_bytes(), &files) {
            Ok(loaded) => {
                let mesh = &loaded.scene.mesh;
                assert!(!mesh.triangles.is_empty());
                assert!((0..mesh.triangles.len() as u32).all(|t| mesh.area_m2(t) > 0.0));
                println!("{}: {} triangles", path.display(), mesh.triangles.len());
                loaded.warnings.iter().for_each(|warning| println!("    {warning}"));
            }
            Err(error) => {
                let text = error.to_string();
                println!("{}: refused: {text}", path.display());
                assert!(text.starts_with(name) && !text.contains('\n'), "{text}");
            }
        }
    }
}

/// Light that goes straight on through glass is a peak of one patch in its table: 7.401 / sr in one
/// of 5 degrees around the normal, `pi sin^2 5`, is 17.7 %.
#[test]
fn tables_that_blur_the_sun_are_told() {
    let Some(folder) = quasilux_corpus::find("bsdf") else { return };
    let table = std::fs::read(folder.join("klems-frads-ec60.xml")).unwrap();
    let files = MapFiles::room().with("glass.xml", table);
    let told = |direct: bool| {
        let outside = format!(
            "[sky]\nmodel = \"cie\"\ntype = 12\nhorizontal_illuminance_lx = 12000\n[sun]\n\
             altitude_deg = 40\nazimuth_deg = 180\ndirect = {direct}\n\
             normal_illuminance_lx = 60000\n"
        );
        let glass = "[materials.wood]\nkind = \"bsdf\"\nfile = \"glass.xml\"\nup = [0, 1, 0]\n";
        let more = format!("{glass}{outside}[[lights]]");
        let loaded = load_text(&PROJECT.replacen("[[lights]]", &more, 1), &files).unwrap();
        warnings_of(&loaded).into_iter().find(|it| it.contains("patches of sun behind it"))
    };
    let warning = told(true).unwrap();
    assert!(warning.contains("\"wood\" sends 18 %") && warning.contains("5.0\u{b0}"), "{warning}");
    assert_eq!(told(false), None);
}
