//! Runs that are kept on disk: killed, interrupted, gone on with; and checkpoints that are refused.

use crate::scenes::{Look, write_room};
use crate::support::{Folder, Numbers, Run, damaged, forged, without_seconds_and_threads};
use std::process::Child;
use std::thread::sleep;
use std::time::Duration;

const KEEPING: [&str; 4] = ["--checkpoint", "run.ck", "--checkpoint-every", "0.02s"];
/// At its beginning, and when it is stopped or over.
const ONCE: [&str; 4] = ["--checkpoint", "run.ck", "--checkpoint-every", "1h"];

fn room(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_room(&folder, "room", &Look::GREY);
    folder
}

fn start(folder: &Folder, arguments: &[&str]) -> Child {
    folder.command(arguments).spawn().expect("the program starts")
}

fn result(folder: &Folder, out: &str) -> String {
    without_seconds_and_threads(&folder.read(&format!("{out}/result.json")))
}

fn go_on(folder: &Folder, more: &[&str]) -> Run {
    folder.quasilux(&[&["resume", "run.ck", "--out", "kept"][..], more].concat())
}

/// Kill -9 at 20 random moments of three runs in turn, some of them while they are starting or
/// writing.
#[test]
fn runs_that_are_killed_again_and_again_end_with_the_same_bits() {
    let runs = [("path", "8192"), ("bidirectional", "2048"), ("photon", "131072")];
    let setups = runs.map(|(estimator, samples)| {
        let folder = room(&format!("kept_killed_{estimator}"));
        if estimator == "photon" {
            crate::scenes::remove_probes(&folder, "room");
        }
        (folder, ["--estimator", estimator, "--rel-tol", "1e-9", "--samples", samples])
    });
    let on = ["resume", "run.ck", "--out", "kept", "--quiet", "--checkpoint-every", "0.02s"];
    let mut numbers = Numbers(3);
    let mut killed = 0;
    for moment in 0..20 {
        let (folder, settings) = &setups[moment % setups.len()];
        let begin = [&["run", "room.toml", "--out", "kept", "--quiet"][..], settings, &KEEPING];
        let is_first = moment < setups.len();
        let mut child = if is_first { start(folder, &begin.concat()) } else { start(folder, &on) };
        // The first kill waits for a checkpoint.
        while is_first && !folder.path("run.ck").exists() {
            assert!(
                child.try_wait().expect("it is ours").is_none(),
                "it ended without a checkpoint"
            );
            sleep(Duration::from_millis(2));
        }
        sleep(Duration::from_millis((4 * moment + numbers.below(120)) as u64));
        killed += u32::from(child.try_wait().expect("it is ours").is_none());
        // SIGKILL, wherever that is.
        child.kill().expect("the program can be killed");
        child.wait().expect("the program is gone");
    }
    assert!(killed >= 12, "only {killed} of 20 were at work");
    for (folder, settings) in &setups {
        let run = go_on(folder, &["--threads", "7"]);
        assert_eq!(run.code, Some(3), "{settings:?}: {}", run.stderr);
        let whole = folder.document("room.toml", "whole", settings, 3);
        assert_eq!(result(folder, "kept"), without_seconds_and_threads(&whole), "{settings:?}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_the_run() {
    use crate::support::interrupt;

    for estimator in ["photon", "bidirectional"] {
        let folder = room(&format!("kept_interrupted_{estimator}"));
        if estimator == "photon" {
            crate::scenes::remove_probes(&folder, "room");
        }
        let more = ["--estimator", estimator, "--samples", "1000000000", "--rel-tol", "1e-9"];
        let arguments = [&["run", "room.toml", "--out", "kept"][..], &more, &ONCE].concat();
        let child = start(&folder, &arguments);
        // Written once before the first sample.
        while !folder.path("run.ck").exists() {
            sleep(Duration::from_millis(5));
        }
        let before = std::fs::read(folder.path("run.ck")).expect("a checkpoint");
        sleep(Duration::from_millis(300));
        interrupt(&child);
        let run = Run::new(child.wait_with_output().expect("the program ends"));
        assert_eq!(run.code, Some(130), "{estimator}: {}", run.stderr);
        assert_ne!(std::fs::read(folder.path("run.ck")).expect("a checkpoint"), before);
        // As far as it came in no time at all: the same checkpoint again.
        let run = go_on(&folder, &["--time", "0.001s"]);
        assert_eq!(run.code, Some(3), "{estimator}: {}", run.stderr);
        let document = crate::support::parsed(&folder.read("kept/result.json"));
        let samples = document["run"]["samples"].to_string();
        let more = ["--estimator", estimator, "--samples", &samples, "--rel-tol", "1e-9"];
        let plain = folder.document("room.toml", "whole", &more, 3);
        assert_eq!(result(&folder, "kept"), without_seconds_and_threads(&plain), "{estimator}");
    }
}

/// A finished run has its last checkpoint on disk, and writes its results again.
#[test]
fn keeping_a_run_changes_nothing() {
    let folder = room("kept_to_the_end");
    let short = ["--rel-tol", "1e-9", "--samples", "100", "--threads", "1"];
    let plain = folder.document("room.toml", "plain", &short, 3);
    let kept = folder.document("room.toml", "kept", &[&short[..], &KEEPING].concat(), 3);
    assert_eq!(without_seconds_and_threads(&plain), without_seconds_and_threads(&kept));
    assert_eq!(go_on(&folder, &["--threads", "2"]).code, Some(3));
    assert_eq!(result(&folder, "kept"), without_seconds_and_threads(&plain));
}

#[test]
fn checkpoints_of_other_scenes_and_versions_are_refused_by_name() {
    let folder = room("kept_refusals");
    let short = ["--rel-tol", "1e-9", "--samples", "64"];
    folder.document("room.toml", "kept", &[&short[..], &ONCE].concat(), 3);
    let refused = |needles: &[&str]| {
        let run = go_on(&folder, &[]);
        assert_eq!(run.code, Some(2), "{needles:?}: {}", run.stderr);
        for needle in needles {
            assert!(run.stderr.contains(needle), "{needle}: {}", run.stderr);
        }
        assert_eq!(run.stderr.lines().count(), 1, "{}", run.stderr);
    };
    let (geometry, project) = (folder.read("room.obj"), folder.read("room.toml"));
    folder.write("room.obj", geometry.replace("v 0 0 0", "v 0 0 0.0"));
    refused(&["run.ck", "another scene", "room.obj has changed"]);
    folder.write("room.obj", geometry);
    folder.write("room.toml", project.replace("dimming = 1", "dimming = 2"));
    refused(&["another scene", "room.toml has changed"]);
    folder.write("room.toml", "[scene]");
    refused(&["room.toml"]);
    folder.write("room.toml", project);
    let bytes = std::fs::read(folder.path("run.ck")).expect("a checkpoint");
    std::fs::remove_file(folder.path("run.ck.previous")).expect("it was kept at its beginning");
    folder.write("run.ck", forged(&bytes, "\"version\": \"0.", "\"version\": \"9."));
    refused(&["run.ck", "version 9."]);
    folder.write("run.ck", forged(&bytes, &build(&bytes), "\"build\": \"0123456789abcdef\""));
    refused(&["run.ck", "another build", "0123456789abcdef"]);
    folder.write("run.ck", forged(&bytes, "\"replicates\": 8,", "\"replicates\": 7,"));
    refused(&["run.ck"]);
    folder.write("run.ck", forged(&bytes, "quasilux-checkpoint/1", "quasilux-checkpoint/2"));
    refused(&["quasilux-checkpoint/2", "reads quasilux-checkpoint/1"]);
    folder.write("run.ck", forged(&bytes, "\"estimator\": \"auto\"", "\"estimator\": \"outo\""));
    refused(&["run.ck", "outo"]);
    folder.write("run.ck", forged(&bytes, "\"seed\": 1,", "\"seed\": 2,"));
    refused(&["run.ck", "decide otherwise"]);
    std::fs::remove_file(folder.path("run.ck")).expect("it was written");
    refused(&["run.ck"]);
}

/// What a header says of the build.
fn build(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let start = text.find("\"build\": ").expect("a build");
    text[start..start + "\"build\": \"0123456789abcdef\"".len()].to_owned()
}

/// Hours of work are not lost by giving the same command again.
#[test]
fn a_run_that_is_not_over_is_not_begun_again_in_its_place() {
    let folder = room("kept_again");
    let run = |more: &[&str]| {
        let arguments = ["run", "room.toml", "--out", "kept", "--rel-tol", "1e-9", "--quiet"];
        let run = folder.quasilux(&[&arguments[..], &ONCE, more].concat());
        (run.code, run.stderr)
    };
    let (code, said) = run(&["--time", "0.05s"]);
    assert_eq!(code, Some(3), "{said}");
    let before = std::fs::read(folder.path("run.ck")).expect("a checkpoint");
    for more in [&["--time", "0.05s"][..], &["--samples", "64"], &["--seed", "2"]] {
        let (code, said) = run(more);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains("`quasilux resume run.ck`") && said.contains("room.toml"), "{said}");
    }
    assert!(std::fs::read(folder.path("run.ck")).expect("a checkpoint") == before);
    assert_eq!(go_on(&folder, &["--time", "0.001s"]).code, Some(3));
    for name in ["run.ck", "run.ck.previous"] {
        std::fs::remove_file(folder.path(name)).expect("it was written");
    }
    // What is over may make way for another.
    for _ in 0..2 {
        let (code, said) = run(&["--samples", "64"]);
        assert_eq!(code, Some(3), "{said}");
    }
    folder.write("run.ck", "notes of mine");
    let (code, said) = run(&["--samples", "64"]);
    assert!(code == Some(2) && said.contains("remove it"), "{said}");
    assert_eq!(folder.read("run.ck"), "notes of mine");
}

#[test]
fn a_run_that_cannot_be_kept_is_not_begun() {
    let folder = room("kept_nowhere");
    folder.write("run.ck.unfinished/file", "in the way");
    let begin = ["run", "room.toml", "--samples", "64", "--out", "kept", "--quiet"];
    let run = folder.quasilux(&[&begin[..], &ONCE].concat());
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("run.ck: cannot keep the run"), "{}", run.stderr);
    assert!(!folder.path("kept/result.json").exists());
}

/// Any cut and any changed bit is refused; then the checkpoint before is used, with a warning.
#[test]
fn a_damaged_checkpoint_is_refused_or_its_predecessor_used() {
    let folder = room("kept_damaged");
    let short = ["--rel-tol", "1e-9", "--samples", "64"];
    let plain = folder.document("room.toml", "plain", &short, 3);
    folder.document("room.toml", "kept", &[&short[..], &ONCE].concat(), 3);
    assert_eq!(go_on(&folder, &[]).code, Some(3));
    let bytes = std::fs::read(folder.path("run.ck")).expect("a checkpoint");
    folder.write("run.ck", damaged(&bytes, &mut Numbers(1)));
    let run = go_on(&folder, &[]);
    assert_eq!(run.code, Some(3), "{}", run.stderr);
    assert!(run.stderr.contains("continuing from run.ck.previous"), "{}", run.stderr);
    assert_eq!(result(&folder, "kept"), without_seconds_and_threads(&plain));
    let mut numbers = Numbers(5);
    for name in ["run.ck.previous", "run.ck"] {
        std::fs::remove_file(folder.path(name)).expect("it was written");
    }
    for number in 0..500 {
        folder.write("run.ck", damaged(&bytes, &mut numbers));
        let run = go_on(&folder, &[]);
        assert_eq!(run.code, Some(2), "{number}: {}", run.stderr);
        assert!(run.stderr.starts_with("error: run.ck: "), "{number}: {}", run.stderr);
    }
}
