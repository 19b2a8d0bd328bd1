//! Build script: puts the fingerprint of the code that decides results into `QUASILUX_BUILD`, and
//! the commit into `QUASILUX_COMMIT`.
//!
//! Debug and release builds of the same sources, wherever they are made, have the same one.

#![allow(clippy::disallowed_methods, reason = "cargo talks to build scripts by the environment")]

mod commit;
mod fingerprint;

use std::env;
use std::error::Error;
use std::path::PathBuf;
use std::process::Command;

fn main() -> Result<(), Box<dyn Error>> {
    let own = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?);
    let rustc = Command::new(env::var("RUSTC")?).arg("--version").arg("--verbose").output()?;
    let rustc = String::from_utf8(rustc.stdout)?;
    let release = rustc.lines().find(|line| line.starts_with("release: ")).unwrap_or_default();
    let build = fingerprint::fingerprint(&own, release)?;
    let commit = commit::commit(&own);
    for path in build.read.iter().chain(&commit.read) {
        println!("cargo::rerun-if-changed={}", path.display());
    }
    println!("cargo::rustc-env=QUASILUX_BUILD={}", &build.sha256[..16]);
    println!("cargo::rustc-env=QUASILUX_COMMIT={}", commit.name);
    Ok(())
}
