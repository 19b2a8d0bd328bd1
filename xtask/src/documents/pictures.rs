//! The pictures that documents show beside the commands that make them.

use std::path::Path;
use xtask::workspace::Failure;

/// The document that shows the commands.
pub(super) const DOCUMENT: &str = "README.md";

/// A picture of the documentation.
struct Picture {
    /// Where it is, below the root.
    shown: &'static str,
    /// Arguments of the command that makes it.
    command: &'static str,
    /// The file that the command writes.
    made: &'static str,
}

const PICTURES: [Picture; 3] = [
    Picture {
        shown: "docs/office-workplane.png",
        command: "run examples/office/office.toml",
        made: "out/office/workplane.png",
    },
    Picture { shown: "docs/office-view.png", command: "run room.toml", made: "out/room/door.png" },
    Picture {
        shown: "docs/batwing.svg",
        command: "photometry examples/office/batwing.ies --svg batwing.svg",
        made: "batwing.svg",
    },
];

/// The commands that make them.
pub(super) fn commands() -> impl Iterator<Item = Vec<String>> {
    PICTURES.iter().map(|picture| picture.command.split(' ').map(str::to_owned).collect())
}

/// Compares the picture of a command with what that made in a folder: all bytes, for they are the
/// same on every machine.
pub(super) fn compare(root: &Path, folder: &Path, arguments: &[String]) -> Result<(), Failure> {
    for Picture { shown, command, made } in PICTURES {
        let is_own = command.split(' ').eq(arguments.iter().map(String::as_str));
        if is_own && read(&root.join(shown))? != read(&folder.join(made))? {
            return Err(format!(
                "{shown} is not what `{command}` makes: `cargo xtask pictures` writes it anew"
            ));
        }
    }
    Ok(())
}

/// Puts the pictures that the commands made in a folder into their places.
pub(super) fn copy(root: &Path, folder: &Path) -> Result<(), Failure> {
    for Picture { shown, made, .. } in PICTURES {
        let (from, to) = (folder.join(made), root.join(shown));
        std::fs::copy(&from, &to).map_err(|error| format!("{}: {error}", from.display()))?;
        println!("xtask: wrote {}", to.display());
    }
    Ok(())
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use xtask::workspace::root as workspace_root;

    #[test]
    fn the_document_shows_each_picture_and_its_command() {
        let root = workspace_root();
        let text = std::fs::read_to_string(root.join(DOCUMENT)).unwrap();
        for Picture { shown, command, .. } in PICTURES {
            assert!(text.contains(&format!("]({shown})")), "{shown} is not shown");
            let line = format!("    cargo run --release -- {command}\n");
            assert!(text.contains(&line), "`{command}` is not shown");
            assert!(root.join(shown).is_file(), "{shown} is not there");
        }
    }

    #[test]
    fn another_picture_is_rejected() {
        let folder = std::env::temp_dir().join(format!("quasilux-pictures-{}", std::process::id()));
        for Picture { shown, made, .. } in PICTURES {
            let file = folder.join(made);
            std::fs::create_dir_all(file.parent().unwrap()).unwrap();
            std::fs::copy(workspace_root().join(shown), &file).unwrap();
        }
        let failures = || commands().map(|it| compare(&workspace_root(), &folder, &it).err());
        assert!(failures().all(|failure| failure.is_none()));
        std::fs::write(folder.join(PICTURES[2].made), "another").unwrap();
        let failures: Vec<String> = failures().flatten().collect();
        std::fs::remove_dir_all(&folder).unwrap();
        assert_eq!(failures.len(), 1);
        let failure = &failures[0];
        assert!(failure.contains("docs/batwing.svg") && failure.contains("xtask pictures"));
    }
}
