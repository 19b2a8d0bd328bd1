//! The commit that the sources are of: what `--version` tells, and nothing depends on.

use std::path::{Path, PathBuf};
use std::process::Command;

/// Digits of the name of a commit.
const DIGITS: usize = 12;

/// A commit, and what to watch for another one.
pub(crate) struct Commit {
    /// The first digits of its name; `unknown` where nothing tells it.
    pub(crate) name: String,
    pub(crate) read: Vec<PathBuf>,
}

/// The commit of a package's folder: as `cargo package` noted it, or as git has it.
pub(crate) fn commit(package: &Path) -> Commit {
    let note = package.join(".cargo_vcs_info.json");
    if let Ok(text) = std::fs::read_to_string(&note) {
        return Commit { name: noted(&text), read: vec![note] };
    }
    let Some(name) = git(package, &["rev-parse", "HEAD"]) else {
        return Commit { name: short(""), read: Vec::new() };
    };
    // Grows with each commit and each change of branch; without it, the file that names the branch.
    let paths = ["logs/HEAD", "HEAD"].into_iter();
    let paths = paths.filter_map(|file| git(package, &["rev-parse", "--git-path", file]));
    let read = paths.map(|path| package.join(path)).find(|path| path.exists());
    Commit { name: short(&name), read: read.into_iter().collect() }
}

/// The commit in the note of `cargo package`.
fn noted(note: &str) -> String {
    let after = note.split_once("\"sha1\"").map_or("", |(_, after)| after);
    short(after.split('"').nth(1).unwrap_or_default())
}

fn short(name: &str) -> String {
    let is_name = name.len() >= DIGITS && name.bytes().all(|byte| byte.is_ascii_hexdigit());
    if is_name { name[..DIGITS].to_owned() } else { "unknown".to_owned() }
}

/// Output of git in a folder, if the folder is one of this project and not of another around it.
fn git(folder: &Path, arguments: &[&str]) -> Option<String> {
    let said = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).current_dir(folder).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    // The package's own manifest is a file of the repository.
    said(&["ls-files", "--error-unmatch", "Cargo.toml"])?;
    said(arguments)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_note_of_a_package_names_its_commit() {
        let note =
            "{\n  \"git\": {\n    \"sha1\": \"d25047e9b1aa0123456789abcdef0123456789ab\"\n  }\n}";
        assert_eq!(noted(note), "d25047e9b1aa");
        assert_eq!(noted("{}"), "unknown");
        assert_eq!(noted("\"sha1\": \"main\""), "unknown");
    }

    #[test]
    fn a_folder_of_no_repository_has_no_commit() {
        let folder = std::env::temp_dir();
        let Commit { name, read } = commit(&folder);
        assert!(name == "unknown" && read.is_empty(), "{name} {read:?}");
    }
}
