//! The pictures that documents show beside the commands that make them.

use std::path::Path;
use xtask::workspace::Failure;

/// A picture of the documentation.
pub(super) struct Picture {
    /// The document that shows the command.
    pub(super) document: &'static str,
    /// Where it is, below the root.
    shown: &'static str,
    /// Arguments of the command that makes it.
    pub(super) command: &'static str,
    /// The file that the command writes.
    made: &'static str,
}

pub(super) const PICTURES: [Picture; 10] = [
    Picture {
        document: "README.md",
        shown: "docs/office-workplane.png",
        command: "run examples/office/office.toml",
        made: "out/office/workplane.png",
    },
    Picture {
        document: "README.md",
        shown: "docs/office-plan.png",
        command: "check examples/office/office.toml",
        made: "out/office/plan.png",
    },
    Picture {
        document: "docs/project-file.md",
        shown: "docs/office-view.png",
        command: "run room.toml",
        made: "out/room/door.png",
    },
    Picture {
        document: "docs/luminaires.md",
        shown: "docs/batwing.svg",
        command: "photometry examples/office/batwing.ies --svg batwing.svg",
        made: "batwing.svg",
    },
    Picture {
        document: "docs/cameras.md",
        shown: "docs/box-view.png",
        command: "run box.toml",
        made: "out/box/view.png",
    },
    Picture {
        document: "docs/cameras.md",
        shown: "docs/box-falsecolour.png",
        command: "run box.toml",
        made: "out/box/view-falsecolour.png",
    },
    Picture {
        document: "docs/gallery.md",
        shown: "docs/gallery-overcast.png",
        command: "run examples/daylight-office/overcast.toml",
        made: "out/overcast/workplane.png",
    },
    Picture {
        document: "docs/gallery.md",
        shown: "docs/gallery-autonomy.png",
        command: YEAR,
        made: "out/year/workplane.daylight_autonomy.png",
    },
    Picture {
        document: "docs/gallery.md",
        shown: "docs/gallery-hours.png",
        command: YEAR,
        made: "out/year/workplane.hours.png",
    },
    Picture {
        document: "docs/gallery.md",
        shown: "docs/gallery-lobes.svg",
        command: "bsdf examples/diffuser/diffuser.ddt --svg lobes.svg",
        made: "lobes.svg",
    },
];

/// Command that draws several pictures of one year.
const YEAR: &str = "annual examples/daylight-office/year.toml";

impl Picture {
    /// Whether one run of the program makes both.
    pub(super) fn is_made_with(&self, other: &Self) -> bool {
        (self.document, self.command) == (other.document, other.command)
    }

    /// The arguments of the program that make it.
    pub(super) fn arguments(&self) -> Vec<String> {
        self.command.split(' ').map(str::to_owned).collect()
    }

    /// Puts what the command made in a folder into its place.
    pub(super) fn copy(&self, root: &Path, folder: &Path) -> Result<(), Failure> {
        let (from, to) = (folder.join(self.made), root.join(self.shown));
        std::fs::copy(&from, &to).map_err(|error| format!("{}: {error}", from.display()))?;
        println!("xtask: wrote {}", to.display());
        Ok(())
    }
}

/// Compares the pictures that a document shows of a command with what that made in a folder: all
/// bytes, for they are the same on every machine.
pub(super) fn compare(
    root: &Path,
    document: &str,
    folder: &Path,
    arguments: &[String],
) -> Result<(), Failure> {
    for picture in PICTURES.iter().filter(|picture| picture.document == document) {
        let Picture { shown, command, made, .. } = picture;
        if picture.arguments() == arguments && read(&root.join(shown))? != read(&folder.join(made))?
        {
            return Err(format!(
                "{shown} is not what `{command}` makes: `cargo xtask pictures` writes it anew"
            ));
        }
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
    fn documents_show_each_picture_and_its_command() {
        let root = workspace_root();
        for Picture { document, shown, command, .. } in PICTURES {
            let text = std::fs::read_to_string(root.join(document)).unwrap();
            let beside = shown.strip_prefix("docs/").filter(|_| document.starts_with("docs/"));
            let link = beside.unwrap_or(shown);
            assert!(text.contains(&format!("]({link})")), "{document}: {shown} is not shown");
            let line = format!("    cargo run --release -- {command}\n");
            assert!(text.contains(&line), "{document}: `{command}` is not shown");
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
        let failures = |document: &str| -> Vec<String> {
            let compare =
                |it: &Picture| compare(&workspace_root(), document, &folder, &it.arguments()).err();
            PICTURES.iter().filter_map(compare).collect()
        };
        let (own, other) = ("docs/luminaires.md", "README.md");
        assert!(failures(own).is_empty() && failures(other).is_empty());
        std::fs::write(folder.join(PICTURES[3].made), "another").unwrap();
        let (own, other) = (failures(own), failures(other));
        std::fs::remove_dir_all(&folder).unwrap();
        assert!(own.len() == 1 && other.is_empty(), "{own:?}, {other:?}");
        assert!(own[0].contains("docs/batwing.svg") && own[0].contains("xtask pictures"));
    }
}
