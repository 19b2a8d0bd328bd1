//! Results that cannot be written: exit code 2 and a message, and devices stay what they are.

use super::{assert_refused, redirected, room};
use crate::support::Run;
use std::fs;
use std::os::unix::fs::{FileTypeExt, symlink};

const POINTS: [&str; 4] = ["points", "sobol", "-n", "8"];

/// A rename put a file in the place of the device, where the user may.
#[test]
fn results_go_into_a_device_and_not_over_it() {
    let folder = room("outputs_device");
    for name in ["full.csv", "full.svg"] {
        symlink("/dev/full", folder.path(name)).expect("links can be made");
    }
    for name in ["full.csv", "full.svg"] {
        let option = if name == "full.csv" { "--csv" } else { "--svg" };
        let run = redirected(&folder, &[&POINTS[..], &[option, name]].concat(), "");
        assert_refused(option, &run, &[name, "No space left"]);
        let there = fs::metadata(folder.path(name)).expect("it is there");
        assert!(there.file_type().is_char_device(), "{option}");
        assert!(fs::symlink_metadata(folder.path(name)).is_ok_and(|link| link.is_symlink()));
    }
    symlink("/dev/null", folder.path("null.csv")).expect("links can be made");
    let run = redirected(&folder, &[&POINTS[..], &["--csv", "null.csv"]].concat(), "");
    assert_eq!(run.code, Some(0), "{}", run.stderr);
}

/// A pipe that nobody reads would wait for ever.
#[test]
fn a_pipe_without_a_reader_is_refused() {
    let folder = room("outputs_pipe");
    let made = std::process::Command::new("mkfifo").arg(folder.path("pipe.csv")).status();
    assert!(made.is_ok_and(|status| status.success()), "pipes can be made");
    let run = redirected(&folder, &[&POINTS[..], &["--csv", "pipe.csv"]].concat(), "");
    assert_refused("a pipe", &run, &["pipe.csv", "cannot write"]);
}

/// Printing panicked.
#[test]
fn streams_that_take_nothing_are_no_panic() {
    let folder = room("outputs_streams");
    let all = [&POINTS[..], &["--help"], &["--version"], &["plan", "room.toml", "--samples", "4"]];
    let drawn = [&POINTS[..], &["--svg", "points.svg"]].concat();
    for arguments in all.into_iter().chain([&drawn[..]]) {
        let run = redirected(&folder, arguments, ">/dev/full");
        assert_refused(&format!("{arguments:?}"), &run, &["cannot write to stdout"]);
        let run = redirected(&folder, arguments, ">&-");
        assert!(matches!(run.code, Some(0 | 2)), "{arguments:?}: {:?} {}", run.code, run.stderr);
    }
    for arguments in [&["run", "none.toml"][..], &["--nonsense"], &["photometry", "none.ies"]] {
        for streams in ["2>/dev/full", "2>&-"] {
            let run = redirected(&folder, arguments, streams);
            assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{arguments:?} {streams}");
        }
    }
}

/// The limit of a file's size is a full disk, and no end of the process.
#[test]
fn a_limit_of_sizes_is_an_error_of_the_file() {
    let folder = room("outputs_limit");
    let script = "ulimit -f 1; exec \"$@\"";
    let mut command = std::process::Command::new("sh");
    command.args(["-c", script, "sh", env!("CARGO_BIN_EXE_quasilux")]).current_dir(folder.path(""));
    command.args(["run", "room.toml", "--samples", "64", "--quiet", "--out", "out"]);
    let run = Run::new(command.output().expect("the shell starts"));
    assert_refused("a limit", &run, &["out/result.json: cannot write results: File too large"]);
}

/// Where results cannot be written they are elsewhere, and the message says where.
#[test]
fn results_that_cannot_be_written_are_rescued() {
    let folder = room("outputs_rescued");
    fs::create_dir_all(folder.path("out/result.json/in the way")).expect("folders are made");
    fs::create_dir(folder.path("temporary")).expect("folders are made");
    let mut command = folder.command(&["run", "room.toml", "--samples", "64", "--out", "out"]);
    command.env("TMPDIR", folder.path("temporary"));
    let run = Run::new(command.output().expect("the program starts"));
    assert_refused("a folder in the way", &run, &["cannot write results", "; all of them are in "]);
    let (_, place) = run.stderr.trim_end().rsplit_once("; all of them are in ").expect("a place");
    let rescued = fs::read_to_string(std::path::Path::new(place).join("result.json"));
    assert!(rescued.is_ok_and(|document| document.contains("\"quasilux-result/1\"")));
}

/// The folder of a run goes while it computes: it is made again.
#[test]
fn a_folder_that_is_removed_is_made_again() {
    let folder = room("outputs_removed");
    let arguments = ["run", "room.toml", "--rel-tol", "1e-9", "--time", "3s", "--out", "out"];
    let mut child = folder.command(&arguments).spawn().expect("the program starts");
    while !folder.path("out").exists() {
        assert!(child.try_wait().is_ok_and(|ended| ended.is_none()), "it ended");
        std::thread::yield_now();
    }
    fs::remove_dir_all(folder.path("out")).expect("an empty folder");
    let run = Run::new(child.wait_with_output().expect("the program ends"));
    assert_eq!(run.code, Some(3), "{}", run.stderr);
    assert!(folder.read("out/result.json").contains("\"tolerance_reached\": false"));
}
