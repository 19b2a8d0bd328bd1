//! The crates that others may take: what they still lack, which `cargo package` does not ask for,
//! and the copies that it has left unpacked.

use crate::modules::targets;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
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

impl Package {
    /// Whether a folder of this name, the name and the version of a crate, is for this one.
    fn is_named_by(&self, folder: &str) -> bool {
        let version = folder.strip_prefix(&self.name).and_then(|rest| rest.strip_prefix('-'));
        version.is_some_and(|version| version.starts_with(|c: char| c.is_ascii_digit()))
    }
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

/// The names of the members with `publish = true`, each behind those that it needs: a registry
/// takes them in this order.
///
/// # Errors
/// When one needs a member that is not published, or a manifest is missing or malformed.
pub fn in_order(root: &Path) -> Result<Vec<String>, String> {
    let mut manifests = Vec::new();
    for folder in targets::members(root)? {
        manifests.push(targets::manifest(&root.join(&folder).join("Cargo.toml"))?);
    }
    ordered(&manifests)
}

fn ordered(manifests: &[Table]) -> Result<Vec<String>, String> {
    let name = |manifest: &Table| manifest["package"]["name"].as_str().map(str::to_owned);
    let is_published = |manifest: &&Table| package(manifest, &|_| true).is_some();
    let members: BTreeSet<String> = manifests.iter().filter_map(name).collect();
    let mut waiting: Vec<(String, BTreeSet<String>)> = manifests
        .iter()
        .filter(is_published)
        .filter_map(|manifest| Some((name(manifest)?, needs(manifest, &members))))
        .collect();
    let mut ordered: Vec<String> = Vec::new();
    while !waiting.is_empty() {
        let is_ready =
            |(_, needs): &(String, BTreeSet<String>)| needs.iter().all(|it| ordered.contains(it));
        let Some(next) = waiting.iter().position(is_ready) else {
            return Err(format!("not published, or in a circle: what {waiting:?} need"));
        };
        ordered.push(waiting.remove(next).0);
    }
    Ok(ordered)
}

/// The members that a package cannot be built without; its tests may need more.
fn needs(manifest: &Table, members: &BTreeSet<String>) -> BTreeSet<String> {
    let sections = ["dependencies", "build-dependencies"].into_iter();
    let tables = sections.filter_map(|section| manifest.get(section)?.as_table());
    tables.flat_map(Table::keys).filter(|name| members.contains(*name)).cloned().collect()
}

/// Removes the unpacked copies of the packages from the folder of cargo. It builds packages from a
/// temporary registry, unpacks them below its own folder by name and version, and takes what lies
/// there from an earlier time for the same, whatever has changed since.
///
/// # Errors
/// When a copy cannot be removed.
pub fn remove_unpacked(packages: &[Package], cargo_home: &Path) -> std::io::Result<()> {
    let sources = cargo_home.join("registry/src");
    // Registries on a server are named after it, those in a folder have no name before the hash.
    let registries = entries(&sources).filter(|registry| name_of(registry).starts_with('-'));
    for unpacked in registries.flat_map(|registry| entries(&registry)) {
        if packages.iter().any(|package| package.is_named_by(name_of(&unpacked))) {
            std::fs::remove_dir_all(unpacked)?;
        }
    }
    Ok(())
}

/// What lies in a folder, and nothing if there is none.
fn entries(folder: &Path) -> impl Iterator<Item = PathBuf> + use<> {
    std::fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path())
}

/// The last part of a path, empty where it is not of letters.
fn name_of(path: &Path) -> &str {
    path.file_name().and_then(|name| name.to_str()).unwrap_or_default()
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

    #[test]
    fn crates_stand_behind_those_that_they_need() {
        let manifest = |name: &str, needs: &str, publish: bool| -> Table {
            let package = format!("[package]\nname = '{name}'\npublish = {publish}\n");
            format!("{package}[dependencies]\nserde = '1'\n{needs}").parse().unwrap()
        };
        let (top, low) = (manifest("a", "b.workspace = true", true), manifest("b", "", true));
        assert_eq!(ordered(&[top.clone(), low]).unwrap(), ["b", "a"]);
        let own = manifest("b", "", false);
        assert!(ordered(&[top, own]).unwrap_err().contains("\"b\""));
        let order = in_order(&crate::workspace::root()).unwrap();
        let place = |name: &str| order.iter().position(|it| it == name);
        assert!(place("quasilux-text") < place("quasilux-scene"));
        assert_eq!(order.last().map(String::as_str), Some("quasilux"));
    }

    #[test]
    fn unpacked_copies_of_packages_are_removed_and_nothing_else() {
        let home = std::env::temp_dir().join(format!("quasilux-packages-{}", std::process::id()));
        let copies = ["-1a/light-0.1.0", "-2b/light-2.0.0-rc1"];
        let others = ["-1a/light-ray-0.1.0", "-1a/lights-0.1.0", "index.org-3c/light-0.1.0"];
        let folder = |copy: &&str| home.join("registry/src").join(copy);
        for copy in copies.iter().chain(&others) {
            std::fs::create_dir_all(folder(copy).join("src")).unwrap();
        }
        let light = Package { name: "light".to_owned(), missing: Vec::new() };
        remove_unpacked(&[light], &home).unwrap();
        assert!(!copies.iter().any(|copy| folder(copy).exists()));
        assert!(others.iter().all(|other| folder(other).exists()));
        std::fs::remove_dir_all(home).unwrap();
    }
}
