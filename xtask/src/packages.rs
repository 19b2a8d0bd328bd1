//! What the crates that others may take still lack: `cargo package` accepts them without.

use crate::modules::targets;
use std::path::Path;
use toml::{Table, Value};

/// Files that each of them holds, since a package holds nothing from the folder above.
const FILES: [&str; 3] = ["README.md", "LICENSE-MIT", "LICENSE-APACHE"];

/// Keys of its section `[package]` that help to find it.
const KEYS: [&str; 3] = ["description", "keywords", "categories"];

/// A crate that may be published.
pub struct Package {
    /// Its name.
    pub name: String,
    /// What it lacks: files and keys.
    pub missing: Vec<String>,
}

/// The members of a workspace with `publish = true`, by the paths of their folders.
///
/// # Errors
/// When a manifest is missing or malformed.
pub fn of_workspace(root: &Path) -> Result<Vec<Package>, String> {
    let mut packages = Vec::new();
    for folder in targets::members(root)? {
        let manifest = targets::manifest(&root.join(&folder).join("Cargo.toml"))?;
        let exists = |file: &str| root.join(&folder).join(file).is_file();
        packages.extend(package(&manifest, &exists));
    }
    Ok(packages)
}

fn package(manifest: &Table, exists: &dyn Fn(&str) -> bool) -> Option<Package> {
    let section = manifest.get("package")?.as_table()?;
    if section.get("publish").and_then(Value::as_bool) != Some(true) {
        return None;
    }
    let name = section.get("name")?.as_str()?.to_owned();
    let files = FILES.iter().filter(|file| !exists(file));
    let keys = KEYS.iter().filter(|key| !section.contains_key(**key));
    Some(Package {
        name,
        missing: files.chain(keys).map(|missing| (*missing).to_owned()).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_files_and_keys_are_told_of_crates_to_publish() {
        let manifest = |publish: &str| -> Table {
            format!("[package]\nname = 'light'\nkeywords = []\n{publish}").parse().unwrap()
        };
        let found = package(&manifest("publish = true"), &|file| file == "README.md").unwrap();
        assert_eq!(found.name, "light");
        assert_eq!(found.missing, ["LICENSE-MIT", "LICENSE-APACHE", "description", "categories"]);
        for publish in ["", "publish = false", "publish.workspace = true"] {
            assert!(package(&manifest(publish), &|_| false).is_none(), "{publish}");
        }
    }
}
