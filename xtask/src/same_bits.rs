//! Checked and release builds of the program give the same bits: part of the deep step, as it takes
//! a second build of everything. Each change is held to the digests that the transport crate's test
//! `bits` keeps.

use serde_json::Value;
use std::path::Path;
use std::process::Command;
use xtask::workspace::Failure;

/// What both builds run: a room with measured luminaires.
const PROJECT: &str = "examples/office/office.toml";
const ESTIMATORS: [&str; 3] = ["path", "bidirectional", "bidirectional-map"];
/// Few, as the tolerance is out of reach.
const SETTINGS: [&str; 4] = ["--samples", "64", "--rel-tol", "1e-9"];

/// Runs the project with each estimator in both builds and compares all values of all sensors.
pub(crate) fn check(root: &Path) -> Result<(), Failure> {
    for estimator in ESTIMATORS {
        println!("xtask: checked and release builds, {estimator}");
        let [checked, release] = ["ci", "release"].map(|build| values(root, build, estimator));
        if checked? != release? {
            return Err(format!("checked and release builds differ: {PROJECT}, {estimator}"));
        }
    }
    Ok(())
}

/// What the build of a profile says of the sensors.
fn values(root: &Path, profile: &str, estimator: &str) -> Result<Value, Failure> {
    let output = Command::new("cargo")
        .args(["run", "--quiet", "--package", "quasilux", "--profile", profile])
        .args(["--", "run", PROJECT, "--json", "--quiet", "--estimator", estimator])
        .args(SETTINGS)
        .arg("--out")
        .arg(std::env::temp_dir().join(format!("quasilux-bits-{}", std::process::id())))
        .current_dir(root)
        .output()
        .map_err(|error| format!("cargo does not start: {error}"))?;
    let mut document: Value = serde_json::from_slice(&output.stdout).map_err(|error| {
        let errors = String::from_utf8_lossy(&output.stderr);
        format!("{PROJECT}, {estimator}: no document: {error}; {errors}")
    })?;
    match document["sensors"].take() {
        Value::Null => Err(format!("{PROJECT}, {estimator}: a document without sensors")),
        sensors => Ok(sensors),
    }
}
