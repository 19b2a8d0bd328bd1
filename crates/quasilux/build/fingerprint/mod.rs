//! Fingerprint of a build: the SHA-256 of everything that decides the bits of a result.
//!
//! These are the crate of the light transport and the crates that it depends on. A crate of the
//! workspace enters with the tokens of its sources (`tokens`), its data files and its dependencies
//! with their features; one from a registry with its version and checksum (`lock`). The release of
//! the compiler enters, too, since the standard library's unstable sorting decides orders.
//! Instruction sets and profiles do not: results have the same bits in all of them.
//!
//! A packaged copy has its `Cargo.lock` beside its manifest, and there all crates are external.
//! `cargo install` without `--locked` may resolve dependencies to later versions than that file
//! says, which the fingerprint does not see.

mod lock;
mod tokens;

use lock::{Lock, Locked};
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// The crate that computes results from a scene and settings.
const ROOT: &str = "quasilux-transport";

/// The fingerprint, and what it depends on.
#[derive(Debug)]
pub(crate) struct Fingerprint {
    /// SHA-256 in hexadecimal digits.
    pub(crate) sha256: String,
    /// The files and folders that were read.
    pub(crate) read: BTreeSet<PathBuf>,
}

/// What has been found so far: digests by a name that does not depend on where the workspace is.
#[derive(Default)]
struct Parts {
    digests: BTreeMap<String, String>,
    read: BTreeSet<PathBuf>,
}

/// The fingerprint of the crate whose manifest is in the folder `own`, compiled by `compiler`.
///
/// # Errors
/// When a file is missing or cannot be parsed; the message names it.
pub(crate) fn fingerprint(own: &Path, compiler: &str) -> Result<Fingerprint, Box<dyn Error>> {
    let mut parts = Parts::default();
    parts.add("compiler", compiler.as_bytes());
    let packaged = own.join("Cargo.lock");
    let (lock, root) = if packaged.is_file() {
        (packaged, None)
    } else {
        let root = own.ancestors().nth(2).ok_or("no Cargo.lock, and no workspace above")?;
        (root.join("Cargo.lock"), Some(root))
    };
    let lock = Lock::parse(&parts.text(&lock)?)?;
    let mut open: Vec<&Locked> = lock.named(ROOT).collect();
    if open.is_empty() {
        return Err(format!("Cargo.lock has no {ROOT}").into());
    }
    let mut seen = BTreeSet::new();
    while let Some(package) = open.pop() {
        if !seen.insert((&package.name, &package.version)) {
            continue;
        }
        let mut dependencies = lock.dependencies(package);
        match (&package.checksum, root) {
            (None, Some(root)) => {
                let used = parts.add_member(root, &package.name)?;
                dependencies.retain(|dependency| used.contains(&dependency.name));
            }
            (checksum, _) => {
                let checksum = checksum.as_deref().unwrap_or_default();
                parts.add(&format!("{} {}", package.name, package.version), checksum.as_bytes());
            }
        }
        open.extend(dependencies);
    }
    let list = parts.digests.iter().fold(String::new(), |mut list, (name, digest)| {
        let _ = writeln!(list, "{digest}  {name}");
        list
    });
    Ok(Fingerprint { sha256: hex(list.as_bytes()), read: parts.read })
}

impl Parts {
    fn add(&mut self, name: &str, bytes: &[u8]) {
        self.digests.insert(name.to_owned(), hex(bytes));
    }

    /// A text file, with lines that end in one character.
    fn text(&mut self, path: &Path) -> Result<String, Box<dyn Error>> {
        self.read.insert(path.to_owned());
        let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()));
        Ok(text?.replace('\r', ""))
    }

    fn table(&mut self, path: &Path) -> Result<Table, Box<dyn Error>> {
        let table = self.text(path)?.parse();
        Ok(table.map_err(|error| format!("{}: {error}", path.display()))?)
    }

    /// Adds a crate of the workspace; returns the names of the packages that its library depends on
    /// (the lock file has those of its tests, too).
    fn add_member(&mut self, root: &Path, name: &str) -> Result<BTreeSet<String>, Box<dyn Error>> {
        let folder = root.join("crates").join(name);
        for file in tokens::modules(&folder.join("src").join("lib.rs"))? {
            let inside = file.path.strip_prefix(&folder).unwrap_or(&file.path);
            self.add(&portable(name, inside), file.tokens.as_bytes());
            self.read.insert(file.path);
        }
        self.add_data(name, &folder, "data", |_| true)?;
        self.add_data(name, &folder, "src", |path| path.extension().is_none_or(|end| end != "rs"))?;
        let manifest = self.table(&folder.join("Cargo.toml"))?;
        let shared = self.table(&root.join("Cargo.toml"))?;
        let shared = table_in(shared.get("workspace"), "dependencies");
        let mut tables = vec![table_in(Some(&Value::Table(manifest.clone())), "dependencies")];
        for (_, target) in table_in(Some(&Value::Table(manifest.clone())), "target") {
            tables.push(table_in(Some(&target), "dependencies"));
        }
        let mut used = BTreeSet::new();
        for (key, value) in tables.into_iter().flatten() {
            let inherited = shared.get(&key).filter(|_| value.get("workspace").is_some());
            let package = inherited.unwrap_or(&value).get("package").and_then(Value::as_str);
            used.insert(package.unwrap_or(&key).to_owned());
            let text = format!("{value} {}", inherited.map(Value::to_string).unwrap_or_default());
            self.add(&format!("{name} uses {key}"), text.as_bytes());
        }
        let features = manifest.get("features").map(Value::to_string).unwrap_or_default();
        self.add(&format!("{name} has features"), features.as_bytes());
        Ok(used)
    }

    /// Adds the files of a folder of the crate `name` and of the folders in it.
    fn add_data(
        &mut self,
        name: &str,
        folder: &Path,
        inside: &str,
        wanted: fn(&Path) -> bool,
    ) -> Result<(), Box<dyn Error>> {
        let mut open = vec![folder.join(inside)];
        while let Some(path) = open.pop() {
            if path.is_dir() {
                self.read.insert(path.clone());
                for entry in fs::read_dir(&path)? {
                    open.push(entry?.path());
                }
            } else if path.is_file() && wanted(&path) {
                // Some checkouts end lines with two characters.
                let bytes: Vec<u8> =
                    fs::read(&path)?.into_iter().filter(|byte| *byte != b'\r').collect();
                let inside = path.strip_prefix(folder).unwrap_or(&path);
                self.add(&portable(name, inside), &bytes);
                self.read.insert(path);
            }
        }
        Ok(())
    }
}

/// The table at a key, empty where there is none.
fn table_in(value: Option<&Value>, key: &str) -> Table {
    value.and_then(|value| value.get(key)).and_then(Value::as_table).cloned().unwrap_or_default()
}

/// The name of a file of the crate `name`, the same on all systems.
fn portable(name: &str, inside: &Path) -> String {
    format!("{name}/{}", inside.to_string_lossy().replace('\\', "/"))
}

fn hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}
