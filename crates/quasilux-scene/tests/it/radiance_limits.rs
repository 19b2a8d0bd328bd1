//! Radiance scenes that ask for much time or memory, or for files elsewhere: all end soon.

use crate::radiance::{FLOOR, try_load};
use crate::support::{MapFiles, PROJECT, load_text};

fn refusal(scene: &str, others: &[(&str, &str)]) -> String {
    try_load(scene, others).err().unwrap_or_else(|| "it is read".to_owned())
}

#[test]
fn pipelines_and_copies_are_bounded() {
    let pipeline = format!("{FLOOR}!genbox grey b 1 1 1{}\n", "|xform".repeat(100_000));
    let error = refusal(&pipeline, &[]);
    assert!(error.contains("room.rad:3:1: a pipeline of more than 64 programs"), "{error}");
    let arrays = format!("{FLOOR}!genbox grey b 1 1 1|xform -a 2000|xform -a 2000\n");
    assert!(refusal(&arrays, &[]).contains("make more than 1000000 copies"));
    // Each copy goes through all arrays.
    let arrays = "-a 1 ".repeat(60);
    let nothing = ("nothing.rad", "# nothing\n");
    let steps = format!("{FLOOR}!xform {arrays} -a 1000000 nothing.rad\n");
    assert!(refusal(&steps, &[nothing]).contains("take more than 20000000 steps"));
}

#[test]
fn long_names_in_copies_are_bounded() {
    let part = format!("grey sphere {} 0 0 4 0 0 0 1\n", "n".repeat(1_000_000));
    let scene = format!("{FLOOR}!xform -n a -a 100000 part.rad\n");
    let error = refusal(&scene, &[("part.rad", &part)]);
    assert!(error.contains("numbers and words in them"), "{error}");
    let words = format!("void brighttext t 4000 {} 0 0\n", "word ".repeat(4000));
    let scene = format!("{FLOOR}!xform -a 100000 part.rad\n");
    let error = refusal(&scene, &[("part.rad", &words)]);
    assert!(error.contains("numbers and words in them"), "{error}");
}

/// A million surfaces of a material with long arguments look at these once.
#[test]
fn looks_are_found_once_for_each_modifier() {
    let words = "word ".repeat(50_000);
    let mut scene = format!("void brighttext t 50000 {words} 0 0\n");
    scene += "t plastic m 0 0 5 .5 .5 .5 0 0\n";
    scene += "!genbox m b 1 1 1 | xform -a 3000 -t 2 0 0\n";
    let loaded = try_load(&scene, &[]).unwrap();
    assert_eq!(loaded.scene.materials.len(), 1);
}

/// Every file of the scene may have others beside it, and the project may have them, too.
#[test]
fn files_lie_beside_each_scene_or_the_project() {
    let files = MapFiles::default()
        .with("a/a.rad", "!xform mat.rad\n!xform shared/s.rad\n")
        .with("a/mat.rad", "void plastic grey 0 0 5 .5 .5 .5 0 0\n")
        .with("b/b.rad", "!xform part.rad\n")
        .with("b/part.rad", "grey polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n")
        .with("shared/s.rad", "grey polygon q 0 0 9 0 0 1 1 0 1 0 1 1\n")
        .with("../secret.rad", "grey polygon x 0 0 9 0 0 1 1 0 1 0 1 1\n");
    let project = PROJECT.replace("[\"room.obj\"]", "[\"a/a.rad\", \"b/b.rad\"]");
    let loaded = load_text(&project, &files).unwrap();
    assert_eq!(loaded.scene.mesh.objects.len(), 2);
    let project = PROJECT.replace("[\"room.obj\"]", "[\"a/../c.rad\"]");
    let files = files.with("a/../c.rad", "!xform ../secret.rad\n");
    let error = load_text(&project, &files).unwrap_err().to_string();
    assert!(error.contains("is outside of the folders"), "{error}");
}
