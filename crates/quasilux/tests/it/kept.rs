//! Runs that are kept on disk: killed, interrupted, gone on with; and checkpoints that are refused.

use crate::scenes::{Look, write_room};
use crate::support::{Folder, Numbers, Run, damaged, forged, without_seconds_and_threads};
use std::process::Child;
use std::thread::sleep;
use std::time::Duration;

/// A run that takes a second or two.
const LONG: [&str; 4] = ["--rel-tol", "1e-9", "--samples", "8192"];
const KEEPING: [&str; 4] = ["--checkpoint", "run.ck", "--checkpoint-every", "0.02s"];
/// At its beginning, and when it is stopped.
const ONCE: [&str; 4] = ["--checkpoint", "run.ck", "--checkpoint-every", "1h"];

fn room(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_room(&folder, "room", &Look::GREY);
    folder
}

fn start(folder: &Folder, arguments: &[&str]) -> Child {
    folder.command(arguments).spawn().expect("the program starts")
}

/// What an uninterrupted run that keeps nothing writes.
fn whole(folder: &Folder, more: &[&str]) -> String {
    without_seconds_and_threads(&folder.document("room.toml", "whole", &[&LONG, more].concat(), 3))
}

fn result(folder: &Folder, out: &str) -> String {
    without_seconds_and_threads(&folder.read(&format!("{out}/result.json")))
}

fn go_on(folder: &Folder, more: &[&str]) -> Run {
    folder.quasilux(&[&["resume", "run.ck", "--out", "kept"][..], more].concat())
}

/// Kill -9 at 20 random moments of one run, some of them while it is starting or writing.
#[test]
fn a_run_that_is_killed_again_and_again_ends_with_the_same_bits() {
    let folder = room("kept_killed");
    let begin = [&["run", "room.toml", "--out", "kept", "--quiet"][..], &LONG, &KEEPING].concat();
    let on = ["resume", "run.ck", "--out", "kept", "--quiet", "--checkpoint-every", "0.02s"];
    let mut numbers = Numbers(3);
    for moment in 0..20 {
        let mut child = start(&folder, if moment == 0 { &begin } else { &on });
        // The first kill waits for a checkpoint.
        while moment == 0 && !folder.path("run.ck").exists() {
            sleep(Duration::from_millis(2));
        }
        sleep(Duration::from_millis(4 * moment + numbers.below(120) as u64));
        // SIGKILL, wherever that is.
        child.kill().expect("the program can be killed");
        child.wait().expect("the program is gone");
    }
    let run = go_on(&folder, &["--threads", "7"]);
    assert_eq!(run.code, Some(3), "{}", run.stderr);
    assert_eq!(result(&folder, "kept"), whole(&folder, &[]));
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
        let run = Run::of(child.wait_with_output().expect("the program ends"));
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
    assert!(!folder.path("run.ck.previous").exists(), "it was kept once");
    folder.write("run.ck", forged(&bytes, "\"version\": \"0.", "\"version\": \"9."));
    refused(&["run.ck", "version 9."]);
    folder.write("run.ck", forged(&bytes, "quasilux-checkpoint/1", "quasilux-checkpoint/2"));
    refused(&["quasilux-checkpoint/2", "reads quasilux-checkpoint/1"]);
    folder.write("run.ck", forged(&bytes, "\"estimator\": \"path\"", "\"estimator\": \"pith\""));
    refused(&["run.ck", "pith"]);
    folder.write("run.ck", forged(&bytes, "\"seed\": 1,", "\"seed\": 2,"));
    refused(&["run.ck", "decide otherwise"]);
    std::fs::remove_file(folder.path("run.ck")).expect("it was written");
    refused(&["run.ck"]);
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
    assert!(run.stderr.contains("going on from run.ck.previous"), "{}", run.stderr);
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
