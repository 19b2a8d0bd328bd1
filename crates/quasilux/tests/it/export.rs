//! Projects as files of another program: all of them, or none.

use crate::support::Folder;
use std::collections::BTreeSet;
use std::path::Path;

/// A floor under a lamp, with one point and a sky.
fn folder(name: &str, sky: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("floor.obj", "o floor\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    let project = format!(
        "[scene]\ngeometry = [\"floor.obj\"]\n{sky}[[lights]]\nkind = \"point\"\n\
         position = [0.5, 0.5, 2]\nintensity_cd = 100\n[[sensors]]\nname = \"desk\"\n\
         kind = \"points\"\npoints = [[0.5, 0.5, 1]]\nnormals = [[0, 0, 1]]\n"
    );
    folder.write("a.toml", project);
    folder
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("an entry").file_name().into_string().unwrap()).collect()
}

#[test]
fn a_project_becomes_a_scene_of_radiance() {
    let folder = folder("export_scene", "");
    let export = ["export", "a.toml", "--radiance", "rad"];
    let done = folder.quasilux(&export);
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    let expected = ["commands.txt", "desk.pts", "quasilux.cal", "scene.rad"];
    assert_eq!(names(&folder.path("rad")), expected.map(str::to_owned).into());
    // Files that are there stay, and nothing comes to them.
    std::fs::remove_file(folder.path("rad/desk.pts")).expect("removed");
    folder.write("rad/scene.rad", "mine");
    let refused = folder.quasilux(&export);
    assert!(refused.code == Some(2) && refused.stderr.contains("is there already"));
    assert_eq!(folder.read("rad/scene.rad"), "mine");
    assert!(!folder.path("rad/desk.pts").exists());
}

/// Links that lead nowhere are somebody's, too.
#[cfg(unix)]
#[test]
fn links_are_left_alone() {
    let folder = folder("export_link", "");
    std::fs::create_dir(folder.path("rad")).expect("a folder");
    std::os::unix::fs::symlink("nowhere", folder.path("rad/scene.rad")).expect("a link");
    let refused = folder.quasilux(&["export", "a.toml", "--radiance", "rad"]);
    assert!(refused.code == Some(2) && refused.stderr.contains("scene.rad: is there already"));
    assert_eq!(names(&folder.path("rad")), ["scene.rad".to_owned()].into());
}

#[test]
fn a_year_has_no_sky_to_export() {
    let folder = folder("export_year", "[sky]\nmodel = \"weather\"\n[weather]\nfile = \"w.wea\"\n");
    let weather = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\n\
        site_elevation 2\nweather_data_file_units 3\n3 20 10.5 30000 9000\n3 20 11.5 0 9000\n";
    folder.write("w.wea", weather);
    let refused = folder.quasilux(&["export", "a.toml", "--radiance", "rad"]);
    assert!(refused.code == Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("no time says which interval"), "{}", refused.stderr);
    assert!(!folder.path("rad").exists());
}
