//! Results that cannot be written: exit code 2 and a message, and devices stay what they are.

use super::{assert_refused, redirected, room};
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
