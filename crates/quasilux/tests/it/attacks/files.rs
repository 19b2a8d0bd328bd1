//! Files that never end, wait for ever, or are larger than any of their kind: refused unread.

use super::{assert_refused, fault_of, limited, room};
use crate::support::Folder;
use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::process::Command;

/// Bytes of a file with nothing but holes.
const SPARSE_BYTES: u64 = 9 << 30;

/// Puts something in the place of a file.
fn replace(folder: &Folder, name: &str, by: &str) {
    let path = folder.path(name);
    _ = fs::remove_file(&path);
    match by {
        "a device" => symlink("/dev/zero", path).expect("links can be made"),
        "a pipe" => {
            let made = Command::new("mkfifo").arg(path).status();
            assert!(made.is_ok_and(|status| status.success()), "pipes can be made");
        }
        _ => {
            let file = File::create(path).expect("files can be made");
            file.set_len(SPARSE_BYTES).expect("files may have holes");
        }
    }
}

const EVILS: [&str; 3] = ["a device", "a pipe", "a sparse file"];

/// Runs of the program that read one file each.
fn check(name: &str, cases: &[(&str, &[&str])]) {
    for evil in EVILS {
        for (file, arguments) in cases {
            let folder = room(&format!("files_{name}"));
            let measured = "[materials.panel]\nkind = \"bsdf\"\nfile = \"sheet.xml\"";
            let text = folder.read("room.toml");
            if *file == "sheet.xml" {
                let text = text.replacen("[materials.panel]\nreflectance = 0", measured, 1);
                folder.write("room.toml", text);
            }
            replace(&folder, file, evil);
            let run = limited(&folder, arguments);
            assert_refused(&format!("{evil} as {file} of {arguments:?}"), &run, &[file]);
        }
    }
}

#[test]
fn no_file_of_a_project_has_to_end() {
    let run: &[&str] = &["run", "room.toml", "--threads", "2"];
    check(
        "project",
        &[
            ("room.toml", run),
            ("room.obj", run),
            ("lamp.ies", run),
            ("sheet.xml", run),
            ("plan.json", &["run", "room.toml", "--plan", "plan.json"]),
            ("room.toml", &["plan", "room.toml", "--samples", "4"]),
        ],
    );
}

#[test]
fn no_file_of_other_commands_has_to_end() {
    check(
        "others",
        &[
            ("run.ck", &["resume", "run.ck"]),
            ("run.ck", &["run", "room.toml", "--checkpoint", "run.ck"]),
            ("a.part", &["merge", "a.part"]),
            ("plan.json", &["shard", "room.toml", "--plan", "plan.json", "--shard", "0/2"]),
            ("lamp.ies", &["photometry", "lamp.ies"]),
            ("sheet.xml", &["bsdf", "sheet.xml"]),
        ],
    );
}

/// A project does without its material and tilt files: they are warned of.
#[test]
fn files_that_a_scene_can_do_without_have_to_end_no_more() {
    for evil in EVILS {
        let folder = room("files_warned");
        let obj = folder.read("room.obj");
        folder.write("room.obj", format!("mtllib room.mtl\n{obj}"));
        folder.write("lamp.ies", folder.read("lamp.ies").replacen("NONE", "lamp.tlt", 1));
        replace(&folder, "room.mtl", evil);
        replace(&folder, "lamp.tlt", evil);
        let run = limited(&folder, &["run", "room.toml", "--threads", "2", "--samples", "1"]);
        assert_eq!(fault_of(&run), None, "{evil}");
        assert_eq!(run.code, Some(3), "{evil}: {}", run.stderr);
        for file in ["room.mtl", "lamp.tlt"] {
            let said = run.stdout.contains(file) || run.stderr.contains(file);
            assert!(said, "{evil}: {}{}", run.stdout, run.stderr);
        }
    }
}

/// What a user asks for by `-` is read as far as its kind goes.
#[test]
fn an_endless_standard_input_is_cut() {
    let folder = room("files_stdin");
    let run = super::redirected(&folder, &["photometry", "-"], "</dev/zero");
    assert_refused("photometry -", &run, &["stdin: the file is larger than 64 MiB"]);
}
