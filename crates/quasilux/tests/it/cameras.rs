//! What cameras leave behind, and that it is the same on more threads.

use crate::scenes::{Look, write_room};
use crate::support::{Folder, number, parsed, without_seconds_and_threads};

const CAMERA: &str = "
[[cameras]]
name = \"door\"
position = [0.3, 0.4, 1.2]
target = [1.5, 1.5, 0.8]
vertical_fov_deg = 60
resolution = [12, 9]
";

const FILES: [&str; 3] = ["door.exr", "door.png", "door-falsecolour.png"];

/// A small room with a camera, and a project that has nothing but the camera.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_room(&folder, "room", &Look::GREY);
    let room = folder.read("room.toml");
    let first = room.find("[[sensors]]").expect("a sensor");
    let last = room.find("[simulation]").expect("a simulation");
    let alone = format!("{}{}{CAMERA}", &room[..first], &room[last..]);
    folder.write("alone.toml", alone);
    folder.write("room.toml", format!("{room}{CAMERA}"));
    folder
}

fn bytes(folder: &Folder, name: &str) -> Vec<u8> {
    std::fs::read(folder.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn three_files_a_camera() {
    let folder = folder("cameras_files");
    let run = folder.quasilux(&["run", "room.toml", "--out", "out"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for word in ["probes", "camera", "door", "12 x 9", "cd/m²"] {
        assert!(run.stdout.contains(word), "no {word} in {}", run.stdout);
    }
    assert!(bytes(&folder, "out/door.exr").starts_with(&[0x76, 0x2f, 0x31, 0x01]));
    for name in ["out/door.png", "out/door-falsecolour.png"] {
        assert!(bytes(&folder, name).starts_with(b"\x89PNG\r\n\x1a\n"), "{name}");
    }
    let document = parsed(&folder.read("out/result.json"));
    let camera = &document["cameras"][0];
    assert_eq!(camera["files"], serde_json::json!(FILES));
    assert_eq!(camera["resolution"], serde_json::json!([12, 9]));
    assert_eq!((&camera["rel_tol"], &camera["tolerance_reached"]), (&0.05.into(), &true.into()));
    assert!(number(camera, "/relative_half_width") <= 0.05);
    let mean = number(camera, "/mean_luminance_cd_m2/value");
    assert!(mean > 0.0 && mean < number(camera, "/maximum_luminance_cd_m2"));
    assert!(number(camera, "/mean_luminance_cd_m2/half_width") < 0.1 * mean);
    assert!(number(camera, "/mean_half_width_cd_m2") > 0.0);
}

#[test]
fn cameras_alone_need_no_tolerance() {
    let folder = folder("cameras_alone");
    let run = folder.quasilux(&["run", "alone.toml", "--out", "16"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.contains("pictures known to 5 %"), "{}", run.stdout);
    for word in ["sensor", "point", "half-widths"] {
        assert!(!run.stdout.contains(word), "{word} in {}", run.stdout);
    }
    let document = parsed(&folder.document("alone.toml", "3", &["--samples", "3"], 0));
    assert_eq!(document["cameras"][0]["samples"], 3);
    assert_eq!(document["run"]["samples"], 3);
    assert_eq!(document["sensors"], serde_json::json!([]));
}

#[test]
fn pictures_are_the_same_on_any_number_of_threads() {
    let folder = folder("cameras_threads");
    for threads in ["1", "2", "7"] {
        folder.document("room.toml", threads, &["--threads", threads], 0);
        for name in FILES {
            let of = |out: &str| bytes(&folder, &format!("{out}/{name}"));
            assert!(of("1") == of(threads), "{name} differs on {threads} threads");
        }
        let of =
            |out: &str| without_seconds_and_threads(&folder.read(&format!("{out}/result.json")));
        assert_eq!(of("1"), of(threads));
    }
}
