//! `--sequence`: by name, and refused before any work where something is missing.

use std::path::Path;
use std::process::Command;

/// Exit code and error text of a run of the Cornell box with these arguments.
fn run(arguments: &[&str]) -> (Option<i32>, String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let output = Command::new(env!("CARGO_BIN_EXE_quasilux"))
        .args(["run", "examples/cornell/cornell.toml", "--quiet", "--out"])
        .arg(Path::new(env!("CARGO_TARGET_TMPDIR")).join("sequences"))
        .args(arguments)
        .current_dir(root)
        .output()
        .expect("the program starts");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn hammersley_needs_all_its_samples() {
    let (code, errors) = run(&["--sequence", "hammersley"]);
    assert_eq!(code, Some(2), "{errors}");
    assert!(errors.contains("--samples"), "{errors}");
    let timed = ["--sequence", "hammersley", "--samples", "16", "--time", "1s"];
    let (code, errors) = run(&timed);
    assert_eq!(code, Some(2), "{errors}");
    assert!(errors.contains("--time"), "{errors}");
}

#[test]
fn an_unknown_sequence_is_refused_with_the_known() {
    let (code, errors) = run(&["--sequence", "haltom", "--samples", "16"]);
    assert_eq!(code, Some(2), "{errors}");
    assert!(errors.contains("did you mean \"halton\""), "{errors}");
}
