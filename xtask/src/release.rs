//! What a release is made of: the archive of a target, the notes of a version, the crates in the
//! order in which a registry takes them. `.github/workflows/release.yml` calls it, and the step
//! `release` of the test command makes all of it once, without publishing.

use crate::documents::commands;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use xtask::packages;
use xtask::workspace::Failure;

/// Files that go into an archive beside the program.
const TEXTS: [&str; 5] =
    ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE", "references.bib"];
const SHELLS: [&str; 5] = ["bash", "elvish", "fish", "powershell", "zsh"];
/// A page of the manual and a completion that each archive has.
const MADE: [&str; 3] = ["man1/quasilux.1", "man1/quasilux-run.1", "completions/quasilux.bash"];

/// Builds the program for a target, and packs it: `target/dist/quasilux-VERSION-TARGET.tar.gz`, for
/// Windows `.zip`.
pub(crate) fn pack_target(root: &Path, target: &str) -> Result<(), Failure> {
    let build = ["build", "--release", "--locked", "--package", "quasilux", "--target", target];
    run(Command::new("cargo").args(build).current_dir(root))?;
    let folder = commands::target_folder(root)?.join(target).join("release");
    let archive = pack(root, &folder.join(program_name(target)), target)?;
    println!("xtask: wrote {}", archive.display());
    Ok(())
}

/// Makes what a release is made of, of the program that tests are run with, and checks it.
pub(crate) fn rehearse(root: &Path) -> Result<(), Failure> {
    print_crates(root)?;
    let version = version(root)?;
    notes(root, "Unreleased").or_else(|_| notes(root, &version))?;
    let archive = pack(root, &commands::build(root)?, "rehearsal")?;
    let listed = Command::new("tar").arg("-tf").arg(&archive).output();
    let listed = listed.map_err(|error| format!("tar does not start: {error}"))?;
    let listed = String::from_utf8_lossy(&listed.stdout);
    for file in TEXTS.iter().chain(&MADE) {
        let path = format!("quasilux-{version}-rehearsal/{file}");
        if !listed.lines().any(|line| line == path) {
            return Err(format!("{}: no {path}, but\n{listed}", archive.display()));
        }
    }
    Ok(())
}

/// Prints the crates to publish, in order.
pub(crate) fn print_crates(root: &Path) -> Result<(), Failure> {
    for name in packages::in_order(root)? {
        println!("{name}");
    }
    Ok(())
}

/// Prints what the changelog says of a version, or of the one that a tag names.
pub(crate) fn print_notes(root: &Path, version: &str) -> Result<(), Failure> {
    let named = version.strip_prefix('v').unwrap_or(version);
    let own = self::version(root)?;
    if named != own && named != "Unreleased" {
        return Err(format!("the tag names version {named}, Cargo.toml {own}"));
    }
    println!("{}", notes(root, named)?);
    Ok(())
}

fn notes(root: &Path, version: &str) -> Result<String, Failure> {
    let path = root.join("CHANGELOG.md");
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    section(&text, version).ok_or_else(|| format!("CHANGELOG.md has no text below [{version}]"))
}

/// Text below the heading of a version; `None` where there is no such heading, or nothing.
fn section(changelog: &str, version: &str) -> Option<String> {
    let heading = format!("## [{version}]");
    let mut lines = changelog.lines().skip_while(|line| !line.starts_with(&heading));
    lines.next()?;
    let body: Vec<&str> = lines.take_while(|line| !line.starts_with("## ")).collect();
    let body = body.join("\n").trim().to_owned();
    (!body.is_empty()).then_some(body)
}

/// The version of all crates.
pub(crate) fn version(root: &Path) -> Result<String, Failure> {
    let path = root.join("Cargo.toml");
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let manifest: toml::Table = text.parse().map_err(|e| format!("{}: {e}", path.display()))?;
    let version = &manifest["workspace"]["package"]["version"];
    version.as_str().map(str::to_owned).ok_or_else(|| "the version is no text".into())
}

fn program_name(target: &str) -> &'static str {
    if target.contains("windows") { "quasilux.exe" } else { "quasilux" }
}

/// Puts the program, its manual, completions and texts into a folder, and that into an archive.
fn pack(root: &Path, program: &Path, target: &str) -> Result<PathBuf, Failure> {
    let name = format!("quasilux-{}-{target}", version(root)?);
    let dist = commands::target_folder(root)?.join("dist");
    let folder = dist.join(&name);
    let _ = fs::remove_dir_all(&folder);
    let wrong = |error: std::io::Error| format!("{}: {error}", folder.display());
    fs::create_dir_all(folder.join("completions")).map_err(wrong)?;
    let own = program.file_name().ok_or("the program has no name")?;
    fs::copy(program, folder.join(own)).map_err(wrong)?;
    for text in TEXTS {
        fs::copy(root.join(text), folder.join(text)).map_err(wrong)?;
    }
    run(Command::new(program).args(["man", "--out"]).arg(folder.join("man1")))?;
    for shell in SHELLS {
        let script = Command::new(program).args(["completions", shell]).output();
        let script = script.map_err(|error| format!("{}: {error}", program.display()))?;
        if !script.status.success() || script.stdout.is_empty() {
            return Err(format!("{} has no completions for {shell}", program.display()));
        }
        let path = folder.join(format!("completions/quasilux.{shell}"));
        fs::write(path, script.stdout).map_err(wrong)?;
    }
    let ending = if target.contains("windows") { "zip" } else { "tar.gz" };
    let archive = dist.join(format!("{name}.{ending}"));
    // Windows has a tar that knows zip files by their names.
    let form = if ending == "zip" { "-acf" } else { "-czf" };
    run(Command::new("tar").arg(form).arg(&archive).arg("-C").arg(&dist).arg(&name))?;
    Ok(archive)
}

fn run(command: &mut Command) -> Result<(), Failure> {
    let status = command.status().map_err(|e| format!("{command:?} does not start: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} ended with {status}")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use xtask::workspace::root as workspace_root;

    #[test]
    fn a_version_has_its_own_text() {
        let text = "# Changelog\n\n## [Unreleased]\n\n## [0.2.0] - 2027-01-01\n\n### Added\n- a\n\n\
                    ## [0.1.0]\n- b\n";
        assert_eq!(section(text, "0.2.0").as_deref(), Some("### Added\n- a"));
        assert_eq!(section(text, "0.1.0").as_deref(), Some("- b"));
        assert_eq!(section(text, "Unreleased"), None);
        assert_eq!(section(text, "0.3.0"), None);
    }

    #[test]
    fn the_version_is_that_of_the_workspace() {
        assert_eq!(version(&workspace_root()).unwrap(), env!("CARGO_PKG_VERSION"));
    }
}
