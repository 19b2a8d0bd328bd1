//! Runs that are spread: plans, shards and what merges them, or refuses to.

use crate::scenes::{Look, remove_probes, write_room};
use crate::support::{Folder, Numbers, damaged, forged, without_seconds_and_threads};

const CAMERA: &str = "[[cameras]]\nname = \"view\"\nposition = [0.3, 0.3, 1]\n\
    target = [1.5, 1.5, 1]\n\
    vertical_fov_deg = 60\nresolution = [4, 3]\n[simulation]";

/// The room with a camera and fewer replicates.
fn room(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_room(&folder, "room", &Look::GREY);
    let project = folder.read("room.toml");
    let project =
        project.replace("[simulation]", CAMERA).replace("replicates = 8", "replicates = 4");
    folder.write("room.toml", project.replace("rel_tol = 0.1", "rel_tol = 1e-6"));
    folder
}

/// Runs the program, which must end with `code`; what it said on stderr.
fn must(folder: &Folder, arguments: &[&str], code: i32) -> String {
    let run = folder.quasilux(arguments);
    assert_eq!(run.code, Some(code), "{arguments:?}: {}", run.stderr);
    run.stderr
}

/// All files of a folder of results, by name, without seconds and threads.
fn results(folder: &Folder, out: &str) -> Vec<(String, Vec<u8>)> {
    let entries = std::fs::read_dir(folder.path(out)).expect("a folder of results");
    let mut files: Vec<(String, Vec<u8>)> = entries
        .map(|entry| {
            let name = entry.expect("an entry").file_name().into_string().expect("a plain name");
            let path = format!("{out}/{name}");
            let bytes = if name == "result.json" {
                without_seconds_and_threads(&folder.read(&path)).into_bytes()
            } else {
                std::fs::read(folder.path(&path)).expect("a file")
            };
            (name, bytes)
        })
        .collect();
    files.sort();
    files
}

/// Shards k/n of a plan, each on another number of threads; their names.
fn shards(folder: &Folder, plan: &str, of: usize) -> Vec<String> {
    (0..of)
        .map(|number| {
            let (slice, name) = (format!("{number}/{of}"), format!("{plan}-{of}-{number}.part"));
            let threads = ["1", "2", "7"][number % 3];
            let files = ["shard", "room.toml", "--plan", plan, "--shard", &slice, "--out", &name];
            must(folder, &[&files[..], &["--quiet", "--threads", threads]].concat(), 0);
            name
        })
        .collect()
}

fn merge(folder: &Folder, parts: &[String], out: &str, code: i32) -> String {
    let names: Vec<&str> = parts.iter().map(String::as_str).collect();
    must(folder, &[&["merge"], &names[..], &["--out", out, "--quiet"]].concat(), code)
}

/// Three and sixteen parts in random order, and one; pictures and spreadsheets too.
#[test]
fn merged_parts_are_the_single_run() {
    let cases = [("photon", 3), ("path", 16), ("auto", 3), ("bidirectional-map", 3)];
    let mut numbers = Numbers(1);
    for (estimator, count) in cases {
        let folder = room(&format!("spread_{estimator}"));
        if estimator == "photon" {
            remove_probes(&folder, "room");
        }
        let options = ["--samples", "40", "--estimator", estimator];
        must(&folder, &[&["plan", "room.toml", "--out", "p"][..], &options].concat(), 0);
        let single = ["run", "room.toml", "--plan", "p", "--out", "single", "--quiet"];
        must(&folder, &[&single[..], &["--threads", "2"]].concat(), 3);
        let single = results(&folder, "single");
        let pictures = single.iter().filter(|(name, _)| name.starts_with("view")).count();
        assert_eq!(pictures, if estimator == "photon" { 0 } else { 3 }, "{estimator}");
        for count in [1, count] {
            let mut parts = shards(&folder, "p", count);
            numbers.shuffle(&mut parts);
            merge(&folder, &parts, "merged", 3);
            assert!(results(&folder, "merged") == single, "{estimator}: {count} parts");
        }
    }
}

/// A shard that makes the plan itself writes what one does that reads it, and so does a range.
#[test]
fn a_part_is_a_function_of_plan_and_range() {
    let folder = room("spread_function");
    let plan = folder.quasilux(&["plan", "room.toml", "--samples", "32", "--seed", "5"]);
    folder.write("p", &plan.stdout);
    let common = ["--quiet", "--out"];
    let shard = |arguments: &[&str], out: &str| {
        must(&folder, &[&["shard", "room.toml"], arguments, &common, &[out]].concat(), 0);
        std::fs::read(folder.path(out)).expect("a part")
    };
    let read = shard(&["--plan", "p", "--shard", "1/4"], "read.part");
    let made = shard(&["--samples", "32", "--seed", "5", "--shard", "1/4"], "made.part");
    let ranged = shard(&["--plan", "p", "--index-range", "8..16"], "ranged.part");
    assert!(read == made && read == ranged);
    let said = must(&folder, &["shard", "room.toml", "--plan", "p", "--shard", "0/4"], 0);
    assert!(said.contains("pictures") && said.contains("room-0-8.part"), "{said}");
}

#[test]
fn what_is_no_run_is_refused_by_name() {
    let folder = room("spread_refusals");
    let plan = |name: &str, more: &[&str]| {
        must(&folder, &[&["plan", "room.toml", "--out", name], more].concat(), 0);
    };
    plan("p", &["--samples", "32"]);
    let parts = shards(&folder, "p", 4);
    let [a, b, c, d] = &parts[..] else { panic!("four parts") };
    let refused = |parts: &[&String], needles: &[&str]| {
        let parts: Vec<String> = parts.iter().map(|name| (*name).clone()).collect();
        let said = merge(&folder, &parts, "merged", 2);
        for needle in needles {
            assert!(said.contains(needle), "{needle}: {said}");
        }
        assert!(!folder.path("merged").exists());
    };
    refused(&[a, b, d], &[b, d, "16 to 23 are missing"]);
    refused(&[b, c, d], &["before", b, "0 to 7 are missing"]);
    refused(&[a, b, c], &["after", c, "24 to 31 are missing"]);
    refused(&[a, b, b, c, d], &[b, "overlap: 8 to 15"]);
    plan("seed", &["--samples", "32", "--seed", "2"]);
    let of_seed = shards(&folder, "seed", 4);
    refused(&[a, b, c, &of_seed[3]], &[a, &of_seed[3], "different runs", "a setting"]);
    plan("longer", &["--samples", "64"]);
    let longer = shards(&folder, "longer", 4);
    refused(&[&longer[3], a, b], &[&longer[3], "the number of samples"]);
    let bytes = std::fs::read(folder.path(d)).expect("a part");
    let forge = |name: &str, old: &str, new: &str| {
        folder.write(name, forged(&bytes, old, new));
        name.to_owned()
    };
    let version = forge("version.part", "\"version\": \"0.", "\"version\": \"9.");
    refused(&[a, b, c, &version], &["version.part", "version 9."]);
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let start = text.find("\"build\": ").expect("a build");
    let own = &text[start..start + "\"build\": \"0123456789abcdef\"".len()];
    let build = forge("build.part", own, "\"build\": \"0123456789abcdef\"");
    refused(&[a, b, c, &build], &["build.part", "another build", "0123456789abcdef"]);
    let edited = forge("edited.part", "\"seed\": 1,", "\"seed\": 2,");
    refused(&[a, b, c, &edited], &["edited.part", "changed after it was made"]);
    let format = forge("format.part", "quasilux-part/1", "quasilux-part/7");
    refused(&[a, b, c, &format], &["format.part", "quasilux-part/7"]);
    refused(&[a, b, &"p".to_owned()], &["p: is no file of the format quasilux-part/1"]);
    refused(&[a, &"none.part".to_owned()], &["none.part"]);
    let geometry = folder.read("room.obj");
    folder.write("room.obj", geometry.replace("v 0 0 0", "v 0 0 0.0"));
    refused(&[a, b, c, d], &["another scene", "room.obj has changed"]);
    for arguments in [["run", "room.toml", "--plan", "p"], ["shard", "room.toml", "--plan", "p"]] {
        let more: &[&str] = if arguments[0] == "shard" { &["--shard", "0/2"] } else { &[] };
        let said = must(&folder, &[&arguments[..], more].concat(), 2);
        assert!(said.contains("p: ") && said.contains("room.obj has changed"), "{said}");
    }
    plan("other", &["--samples", "32"]);
    let other = shards(&folder, "other", 4);
    refused(&[a, b, c, &other[3]], &["different runs", "the scene"]);
    folder.write("room.obj", geometry);
    folder.write("edited", folder.read("p").replace("\"samples\": 32", "\"samples\": 64"));
    let said = must(&folder, &["run", "room.toml", "--plan", "edited"], 2);
    assert!(said.contains("edited: was changed after it was made"), "{said}");
    folder.write("cut", &folder.read("p")[..40]);
    let said = must(&folder, &["run", "room.toml", "--plan", "cut"], 2);
    let place = said.strip_prefix("error: cut:").and_then(|rest| rest.split(':').next());
    assert!(place.is_some_and(|line| line.parse::<usize>().is_ok()), "{said}");
    folder.write("old", folder.read("p").replace("\"importance\":", "\"steering\":"));
    let said = must(&folder, &["run", "room.toml", "--plan", "old"], 2);
    assert!(said.starts_with("error: old:"), "{said}");
    assert!(said.contains(": the setting \"steering\" is \"importance\" now"), "{said}");
    merge(&folder, &parts, "merged", 3);
}

#[test]
fn arguments_of_shards_are_checked() {
    let folder = room("spread_arguments");
    for (arguments, needle) in [
        (&["plan", "room.toml"][..], "--samples"),
        (&["shard", "room.toml", "--samples", "8"], "--shard"),
        (&["shard", "room.toml", "--shard", "0/2"], "--plan"),
        (&["shard", "room.toml", "--samples", "8", "--shard", "2/2"], "from 0 to n - 1"),
        (&["shard", "room.toml", "--samples", "8", "--shard", "0/9"], "more parts than the 8"),
        (&["shard", "room.toml", "--samples", "8", "--index-range", "4..9"], "0 to 7"),
        (&["shard", "room.toml", "--samples", "8", "--index-range", "4..4"], "A below B"),
        (&["run", "room.toml", "--plan", "p", "--samples", "8"], "--samples"),
        (&["run", "room.toml", "--plan", "p", "--checkpoint", "c"], "--checkpoint"),
        (&["run", "room.toml", "--plan", "none"], "none"),
        (&["run", "room.toml", "--checkpoint", "room.toml"], "is read by this command"),
        (
            &["plan", "room.toml", "--samples", "8", "--out", "./room.toml"],
            "is read by this command",
        ),
        (
            &["shard", "room.toml", "--samples", "8", "--shard", "0/1", "--out", "room.toml"],
            "is read by this command",
        ),
        (&["run", "room.toml", "--plan", "room.toml"], "is no plan"),
        (&["merge"], "PART"),
    ] {
        let said = must(&folder, arguments, 2);
        assert!(said.contains(needle), "{arguments:?}: {said}");
    }
}

#[test]
fn a_damaged_part_is_refused() {
    let folder = room("spread_damaged");
    must(
        &folder,
        &["shard", "room.toml", "--samples", "4", "--shard", "0/1", "--out", "p.part"],
        0,
    );
    let bytes = std::fs::read(folder.path("p.part")).expect("a part");
    let mut numbers = Numbers(9);
    for number in 0..500 {
        folder.write("damaged.part", damaged(&bytes, &mut numbers));
        let said = must(&folder, &["merge", "damaged.part", "--out", "merged"], 2);
        assert!(said.starts_with("error: damaged.part: "), "{number}: {said}");
    }
    assert!(!folder.path("merged").exists());
}

/// A part that waits for its merge is none of what another command leaves on its way.
#[test]
fn other_commands_leave_parts_alone() {
    let folder = room("spread_beside");
    folder.write("m.part", "a part of another run");
    folder.write("c.part", "a part of another run");
    must(&folder, &["plan", "room.toml", "--samples", "8", "--out", "m"], 0);
    must(&folder, &["run", "room.toml", "--samples", "8", "--checkpoint", "c", "--quiet"], 3);
    for part in ["m.part", "c.part"] {
        assert_eq!(folder.read(part), "a part of another run");
    }
}

/// Plans and checkpoints name their project in text.
#[cfg(unix)]
#[test]
fn a_name_that_is_no_text_is_refused() {
    use std::os::unix::ffi::OsStrExt;
    let folder = room("spread_name");
    let name = std::ffi::OsStr::from_bytes(b"r\xffm.toml");
    let copied = std::fs::copy(folder.path("room.toml"), folder.path("").join(name));
    // Some file systems have no such names.
    if copied.is_err() {
        return;
    }
    for arguments in [&["plan", "--samples", "8"][..], &["run", "--checkpoint", "c"]] {
        let output = folder.command(arguments).arg(name).output().expect("the program starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(2) && said.contains("expected UTF-8"), "{said}");
    }
}
