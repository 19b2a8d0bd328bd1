//! Scenes of Radiance that others made, where they are at hand: areas by the numbers of the file.

use crate::support::{MapFiles, PROJECT, load_text};
use glam::DVec3;
use std::fs;
use std::path::{Path, PathBuf};

/// All files of a folder, by their names from it.
fn read_folder(root: &Path, folder: &Path, files: &mut MapFiles) {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            read_folder(root, &path, files);
        } else {
            let name = path.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
            let bytes = fs::read(&path).expect("a file");
            if bytes.len() < 4 << 20 {
                *files = std::mem::take(files).with(&name, bytes);
            }
        }
    }
}

/// Loads files of a folder as one scene; what it has, or why it is refused.
fn outcome(files: &MapFiles, names: &[&str]) -> Result<usize, String> {
    let list = names.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    let project = PROJECT.replace("\"room.obj\"", &list).replace("[0, 0, 0.8]", "[0, 0, 1e6]");
    match load_text(&project, files) {
        Ok(loaded) => Ok(loaded.scene.mesh.triangles.len()),
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn rooms_load_or_are_refused_with_advice() {
    let Some(folder) = quasilux_corpus::find("scenes") else { return };
    let cases: [(&str, &[&str], &str); 13] = [
        ("cbox-radiance", &["cornell.rad"], ""),
        ("cbox-radiance", &["cornell_window.rad"], ""),
        ("pyradiance-room", &["materials.rad", "room.rad"], ""),
        ("pyradiance-room2", &["materials.rad", "room.rad"], ""),
        ("pyradiance-room3", &["materials.rad", "room.rad"], ""),
        ("frads-office", &["materials.mat", "walls.rad", "lower_glass.rad", "desks.rad"], ""),
        ("radiance-test-renders", &["basic.mat", "closed_end.rad", "diorama_walls.rad"], ""),
        ("radiance-test-renders", &["rect_fixture.rad"], "no triangles"),
        ("radiance-test-renders", &["combined_scene.rad"], "\"genprism\" is not run"),
        ("radiance-test-renders", &["blinds.rad"], "\"pkgBSDF\" is not run"),
        ("radiance-test-renders", &["vase.rad"], "a compiled mesh"),
        ("radiance-test-renders", &["porsches.rad"], "an octree"),
        ("radiance-test-renders", &["torus.rad"], "\"genrev\" is not run"),
    ];
    for (name, scene, expected) in cases {
        let root = folder.join(name);
        let mut files = MapFiles::default();
        read_folder(&root, &root, &mut files);
        match outcome(&files, scene) {
            Ok(triangles) => assert!(expected.is_empty() && triangles > 0, "{name} {scene:?}"),
            Err(error) => {
                assert!(!expected.is_empty() && error.contains(expected), "{scene:?}: {error}");
            }
        }
    }
}

/// Polygons of one file, by the sum of cross products round each outline, without the reader.
#[test]
fn areas_are_those_of_the_outlines() {
    let Some(folder) = quasilux_corpus::find("scenes") else { return };
    for (file, material) in [
        ("pyradiance-room2/objects/ExteriorWalls.rad", "ExteriorWalls"),
        ("frads-office/walls.rad", "Walls"),
        ("frads-office/windowframe.rad", "windowframe"),
    ] {
        let bytes = fs::read(folder.join(file)).expect("a file");
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let lines = text.lines().filter(|line| !line.trim_start().starts_with('#'));
        let mut words = lines.flat_map(str::split_whitespace);
        let mut expected = 0.0;
        while let Some(word) = words.next() {
            if word != "polygon" {
                continue;
            }
            let count: usize = words.nth(3).unwrap().parse().unwrap();
            let reals: Vec<f64> =
                (0..count).map(|_| words.next().unwrap().parse().unwrap()).collect();
            let corners: Vec<DVec3> =
                reals.chunks(3).map(|it| DVec3::new(it[0], it[1], it[2])).collect();
            let next = corners.iter().cycle().skip(1);
            let doubled: DVec3 = corners.iter().zip(next).map(|(a, b)| a.cross(*b)).sum();
            expected += 0.5 * doubled.length();
        }
        let files = MapFiles::default().with("a.rad", &bytes);
        let project = PROJECT.replace("room.obj", "a.rad").replace("[0, 0, 0.8]", "[0, 0, 1e6]")
            + &format!("[materials.{material}]\nreflectance = 0.5\n");
        let mesh =
            load_text(&project, &files).unwrap_or_else(|it| panic!("{file}: {it}")).scene.mesh;
        let found: f64 = (0..mesh.triangles.len() as u32).map(|t| mesh.area_m2(t)).sum();
        assert!((found / expected - 1.0).abs() < 1e-6, "{file}: {found} m2 is not {expected}");
    }
}
