//! The crates of the workspace: libraries and binaries, one root file each.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use toml::{Table, Value};

/// One crate in the compiler's sense.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Target {
    /// The package's name; for a binary beside others `package/binary`.
    pub name: String,
    /// The root's file, from the workspace's root, with slashes.
    pub root: String,
}

/// The libraries and binaries of all members of the workspace, sorted by name.
///
/// # Errors
/// When a manifest is missing or malformed.
pub fn of_workspace(root: &Path) -> Result<Vec<Target>, String> {
    let mut targets = Vec::new();
    for folder in members(root)? {
        targets.extend(of_package(root, &folder)?);
    }
    targets.sort();
    Ok(targets)
}

/// The folders of the members, from the workspace's root.
///
/// # Errors
/// When the workspace's manifest is malformed.
pub fn members(root: &Path) -> Result<BTreeSet<String>, String> {
    let manifest = manifest(&root.join("Cargo.toml"))?;
    let listed = manifest.get("workspace").and_then(|workspace| workspace.get("members"));
    let listed = listed.and_then(Value::as_array).ok_or("the workspace lists no members")?;
    let mut folders = BTreeSet::new();
    for pattern in listed.iter().filter_map(Value::as_str) {
        let Some(parent) = pattern.strip_suffix("/*") else {
            folders.insert(pattern.to_owned());
            continue;
        };
        let entries = fs::read_dir(root.join(parent)).map_err(|e| format!("{parent}: {e}"))?;
        for entry in entries.filter_map(Result::ok) {
            if entry.path().join("Cargo.toml").is_file() {
                folders.insert(format!("{parent}/{}", entry.file_name().to_string_lossy()));
            }
        }
    }
    Ok(folders)
}

fn of_package(root: &Path, folder: &str) -> Result<Vec<Target>, String> {
    let manifest = manifest(&root.join(folder).join("Cargo.toml"))?;
    let package = manifest.get("package").and_then(|package| package.get("name"));
    let package = package.and_then(Value::as_str).ok_or(format!("{folder}: no package name"))?;
    let exists = |file: &String| root.join(file).is_file();
    let mut libraries: Vec<String> = Vec::new();
    let lib = manifest.get("lib").and_then(|lib| lib.get("path")).and_then(Value::as_str);
    libraries.push(format!("{folder}/{}", lib.unwrap_or("src/lib.rs")));
    libraries.retain(exists);
    let mut binaries: Vec<String> = vec![format!("{folder}/src/main.rs")];
    let listed = manifest.get("bin").and_then(Value::as_array);
    for path in listed.into_iter().flatten().filter_map(|bin| bin.get("path")) {
        binaries.extend(path.as_str().map(|path| format!("{folder}/{path}")));
    }
    binaries.retain(exists);
    binaries.sort();
    binaries.dedup();
    let alone = libraries.is_empty() && binaries.len() == 1;
    let named = |root: String| {
        let stem = root.trim_end_matches("/main.rs").trim_end_matches(".rs");
        let stem = if stem.ends_with("/src") { "bin" } else { stem.rsplit('/').next().unwrap() };
        let name = if alone { package.to_owned() } else { format!("{package}/{stem}") };
        Target { name, root }
    };
    let library = |root| Target { name: package.to_owned(), root };
    Ok(libraries.into_iter().map(library).chain(binaries.into_iter().map(named)).collect())
}

/// A manifest.
///
/// # Errors
/// When it is missing or malformed.
pub(crate) fn manifest(path: &Path) -> Result<Table, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    text.parse().map_err(|error| format!("{}: {error}", path.display()))
}
