//! Tells builds apart by what they are made of: the SHA-256 of a list of all sources, of the
//! versions of all dependencies and of what builds them, in `QUASILUX_BUILD`. Debug and release
//! builds of the same sources, wherever they are made, have the same one.

#![allow(clippy::disallowed_methods, reason = "cargo talks to build scripts by the environment")]

use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::io;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> io::Result<()> {
    let own = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("cargo says where the crate is"));
    let root = own.ancestors().nth(2).expect("the crate lies in crates/");
    let mut sources = BTreeMap::new();
    for entry in fs::read_dir(root.join("crates"))? {
        let folder = entry?.path();
        for part in ["src", "data", "build.rs", "Cargo.toml"] {
            collect(root, &folder.join(part), &mut sources)?;
        }
    }
    // Versions of dependencies, profiles and the compiler.
    for part in ["Cargo.lock", "Cargo.toml", "rust-toolchain.toml"] {
        collect(root, &root.join(part), &mut sources)?;
    }
    let mut list = String::new();
    for (name, bytes) in &sources {
        writeln!(list, "{}  {name}", hex(bytes)).expect("text takes everything");
    }
    println!("cargo::rustc-env=QUASILUX_BUILD={}", &hex(list.as_bytes())[..16]);
    Ok(())
}

/// Adds a file, or all files of a folder, by their names from the root.
fn collect(root: &Path, path: &Path, sources: &mut BTreeMap<String, Vec<u8>>) -> io::Result<()> {
    if path.is_dir() {
        println!("cargo::rerun-if-changed={}", path.display());
        for entry in fs::read_dir(path)? {
            collect(root, &entry?.path(), sources)?;
        }
    } else if path.is_file() {
        println!("cargo::rerun-if-changed={}", path.display());
        let name = path.strip_prefix(root).unwrap_or(path).to_string_lossy().replace('\\', "/");
        // Some checkouts end lines with two characters.
        let bytes = fs::read(path)?.into_iter().filter(|byte| *byte != b'\r').collect();
        sources.insert(name, bytes);
    }
    Ok(())
}

fn hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        write!(text, "{byte:02x}").expect("text takes everything");
        text
    })
}
