//! The step `package`: the crates that may be published are packed, and what is in their packages
//! compiles without the workspace around it.
//!
//! All packages are unpacked into one workspace of their own and checked together there, as lints
//! and documentation check the same crates: what these have compiled of others serves it. The step
//! `deep` builds each package alone, as a registry gets it.

use crate::documents::commands::target_folder;
use crate::release::version;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use toml::{Table, Value};
use xtask::packages::{self, Package};
use xtask::workspace::Failure;

/// Packs the crates and checks what they hold, without the registry.
pub(crate) fn check(root: &Path) -> Result<(), Failure> {
    let packages = packages::of_workspace(root)?;
    pack(root, &packages, &["--no-verify"])?;
    let target = target_folder(root)?;
    let folder = unpack(root, &target, &packages)?;
    let mut check = Command::new("cargo");
    check.args(["check", "--quiet", "--offline", "--workspace"]);
    run(check.current_dir(folder).env("CARGO_TARGET_DIR", target))
}

/// Packs the crates and builds each from its package, without the registry, the command line among
/// them: what `cargo install` would do.
pub(crate) fn build(root: &Path) -> Result<(), Failure> {
    let packages = packages::of_workspace(root)?;
    packages::remove_unpacked(&packages, &cargo_home()?)
        .map_err(|error| format!("copies of an earlier run cannot be removed: {error}"))?;
    pack(root, &packages, &[])
}

fn pack(root: &Path, packages: &[Package], more: &[&str]) -> Result<(), Failure> {
    let mut command = Command::new("cargo");
    command.args(["package", "--quiet", "--offline", "--allow-dirty"]).args(more);
    command.args(packages.iter().flat_map(|package| ["--package", &package.name]));
    run(command.current_dir(root).env("CARGO_PROFILE_DEV_DEBUG", "0"))
}

/// Unpacks all packages into a workspace in a fresh folder, in which each is taken from there, and
/// returns that.
fn unpack(root: &Path, target: &Path, packages: &[Package]) -> Result<PathBuf, Failure> {
    let folder = target.join("packages");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let version = version(root)?;
    for Package { name, .. } in packages {
        let archive = target.join(format!("package/{name}-{version}.crate"));
        run(Command::new("tar").arg("-xzf").arg(archive).current_dir(&folder))?;
    }
    let path = root.join("Cargo.toml");
    let own = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let own: Table = own.parse().map_err(|error| format!("{}: {error}", path.display()))?;
    let write = |name: &str, text: &str| {
        fs::write(folder.join(name), text).map_err(|error| format!("{name}: {error}"))
    };
    write("Cargo.toml", &manifest(packages, &version, &own).to_string())?;
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock"))
        .map_err(|error| format!("Cargo.lock: {error}"))?;
    Ok(folder)
}

/// The manifest of a workspace of these crates in the folders of their packages, with the profile
/// by which others are compiled in the own one.
fn manifest(packages: &[Package], version: &str, own: &Table) -> Table {
    let folder = |package: &Package| Value::from(format!("{}-{version}", package.name));
    let folders: Vec<Value> = packages.iter().map(folder).collect();
    let workspace =
        Table::from_iter([("members".into(), folders.into()), ("resolver".into(), "3".into())]);
    let source = |package| Table::from_iter([("path".to_owned(), folder(package))]);
    let sources = packages.iter().map(|it| (it.name.clone(), source(it).into()));
    let patch = Table::from_iter([("crates-io".into(), Table::from_iter(sources).into())]);
    let mut profile = own["profile"]["dev"].as_table().cloned().unwrap_or_default();
    // Of crates that may be missing here.
    profile.remove("package");
    let profile = Table::from_iter([("dev".into(), profile.into())]);
    Table::from_iter([
        ("workspace".into(), workspace.into()),
        ("patch".into(), patch.into()),
        ("profile".into(), profile.into()),
    ])
}

/// The folder where cargo keeps what it has fetched.
fn cargo_home() -> Result<PathBuf, Failure> {
    let named = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let in_home = || std::env::home_dir().map(|home| home.join(".cargo"));
    named.or_else(in_home).ok_or_else(|| "neither CARGO_HOME nor HOME is set".into())
}

fn run(command: &mut Command) -> Result<(), Failure> {
    let status =
        command.status().map_err(|error| format!("{command:?} does not start: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} ended with {status}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packages_are_taken_from_their_folders() {
        let own = "[profile.dev]\nopt-level = 2\n[profile.dev.package.light]\nopt-level = 0\n";
        let light = Package { name: "light".to_owned(), missing: Vec::new() };
        let made = manifest(&[light], "0.1.0", &own.parse().unwrap());
        let expected = "[workspace]\nmembers = ['light-0.1.0']\nresolver = '3'\n\
            [patch.crates-io.light]\npath = 'light-0.1.0'\n[profile.dev]\nopt-level = 2\n";
        assert_eq!(made, expected.parse().unwrap());
    }
}
