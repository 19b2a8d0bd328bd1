//! Whether what the documentation shows is true: each command in it is run as it stands, each
//! project file in it is used by such a command, what commands are said to print is compared with
//! what they print, and pictures are those that they make.
//!
//! A document has a scratch folder with the files of the repository that its commands name.
//! Examples in Rust are tests of their crates.

mod blocks;
pub(crate) mod commands;
mod output;
mod pictures;

use blocks::{Block, blocks};
use commands::Line;
use pictures::{PICTURES, Picture};
use std::fs;
use std::path::{Path, PathBuf};
use xtask::workspace::Failure;

/// Folders that commands read.
const COPIED: [&str; 2] = ["examples", "validation"];

/// Documents beside those of whole folders.
const ALONE: [&str; 3] = ["README.md", "research/experiments.md", "validation/README.md"];

/// What project files in documents call the reader's own geometry: a room of 4 m x 4 m x 3 m.
const ROOM: [&str; 2] = [
    "room.obj",
    "usemtl walls\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 3\nv 4 0 3\nv 4 4 3\nv 0 4 3\n\
     f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n",
];

/// A document and the folder where its commands run.
struct Document {
    /// Its path below the root, with slashes.
    name: String,
    blocks: Vec<Block>,
    scratch: PathBuf,
}

/// Runs what the documents show, and compares pictures.
pub(crate) fn check(root: &Path) -> Result<(), Failure> {
    let program = commands::build(root)?;
    for name in documents(root)? {
        let document = Document::open(root, &name)?;
        document.check(root, &program)?;
        // What a failed run left behind is where the search for its cause begins.
        let _ = fs::remove_dir_all(&document.scratch);
    }
    Ok(())
}

/// Writes the pictures anew.
pub(crate) fn draw(root: &Path) -> Result<(), Failure> {
    let program = commands::build(root)?;
    for pictures in PICTURES.chunk_by(Picture::is_made_with) {
        let document = Document::open(root, pictures[0].document)?;
        document.write_projects()?;
        commands::output(&program, &document.scratch, &pictures[0].arguments())?;
        pictures.iter().try_for_each(|picture| picture.copy(root, &document.scratch))?;
        let _ = fs::remove_dir_all(&document.scratch);
    }
    Ok(())
}

/// The documents that show commands or project files.
fn documents(root: &Path) -> Result<Vec<String>, Failure> {
    let mut names = ALONE.map(str::to_owned).to_vec();
    for (folder, ending) in [("docs", ""), ("examples", "/README.md"), ("crates", "/README.md")] {
        let entries = fs::read_dir(root.join(folder)).map_err(|e| format!("{folder}: {e}"))?;
        let name = |entry: fs::DirEntry| entry.file_name().to_string_lossy().into_owned();
        let inside = entries.flatten().map(|entry| format!("{folder}/{}{ending}", name(entry)));
        names.extend(inside.filter(|name| name.ends_with(".md") && root.join(name).is_file()));
    }
    names.sort();
    Ok(names)
}

impl Document {
    fn open(root: &Path, name: &str) -> Result<Self, Failure> {
        let path = root.join(name);
        let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        let own = format!("quasilux-documents-{}/{name}", std::process::id());
        let scratch = std::env::temp_dir().join(own);
        let blocks = blocks(&text);
        if !blocks.is_empty() {
            for folder in COPIED {
                copy(&root.join(folder), &scratch.join(folder))
                    .map_err(|error| format!("{}: {error}", scratch.display()))?;
            }
        }
        Ok(Self { name: name.to_owned(), blocks, scratch })
    }

    fn check(&self, root: &Path, program: &Path) -> Result<(), Failure> {
        self.write_projects()?;
        let mut printed: Option<String> = None;
        for block in &self.blocks {
            let place = format!("{}:{}", self.name, block.line);
            match block.language.as_deref() {
                None => {
                    for line in &block.lines {
                        let ran = self.run(root, program, line);
                        printed = ran.map_err(|failure| format!("{place}: {failure}"))?.or(printed);
                    }
                }
                Some("") => {
                    let printed = printed.as_deref().unwrap_or_default();
                    if let Some(line) = output::first_missing(&block.lines, printed) {
                        return Err(format!("{place}: not printed: {line}\nbut:\n{printed}"));
                    }
                }
                Some("toml") if is_case(block) => {
                    let arguments = ["validate", "validation"].map(str::to_owned);
                    commands::output(program, &self.scratch, &arguments)
                        .map_err(|failure| format!("{place}: {failure}"))?;
                }
                Some("toml") => self.expect_use(block, &place)?,
                // Geometry that a project file names.
                Some("rust" | "obj") => {}
                Some(other) => return Err(format!("{place}: nobody checks {other:?}")),
            }
        }
        Ok(())
    }

    /// What a line of a block printed, where it is run. A picture that the document shows is
    /// compared at once: later commands may write another one in its place.
    fn run(&self, root: &Path, program: &Path, line: &str) -> Result<Option<String>, Failure> {
        let folder = match self.name.rsplit_once('/') {
            Some((folder, _))
                if line.starts_with("quasilux ") && folder.starts_with("examples/") =>
            {
                self.scratch.join(folder)
            }
            _ => self.scratch.clone(),
        };
        match Line::new(line, &self.name) {
            Line::Run(arguments) => {
                let printed = commands::output(program, &folder, &arguments)?;
                pictures::compare(root, &self.name, &folder, &arguments)?;
                Ok(Some(printed))
            }
            Line::LeftOut => Ok(None),
            Line::Unknown => Err(format!("nobody knows the command `{line}`")),
        }
    }

    /// Writes the project files and the geometry that the document shows, under the names that it
    /// gives.
    fn write_projects(&self) -> Result<(), Failure> {
        for block in self.blocks.iter().filter(|b| b.language.as_deref() == Some("obj")) {
            let place = format!("{}:{}", self.name, block.line);
            let name = block.name_before(".obj");
            let name = name.ok_or_else(|| format!("{place}: no name before it: `NAME.obj`"))?;
            fs::write(self.scratch.join(name), block.lines.join("\n"))
                .map_err(|error| format!("{place}: {error}"))?;
        }
        for block in self.blocks.iter().filter(|b| b.language.as_deref() == Some("toml")) {
            let place = format!("{}:{}", self.name, block.line);
            let text = block.lines.join("\n");
            let write = |name: &str, text: &str| {
                fs::write(self.scratch.join(name), text).map_err(|e| format!("{place}: {e}"))
            };
            if is_case(block) {
                // Alone among its kind.
                let cases = self.scratch.join("validation/cases");
                let _ = fs::remove_dir_all(&cases);
                fs::create_dir_all(&cases).map_err(|error| format!("{place}: {error}"))?;
                write("validation/cases/shown.toml", &text)?;
                continue;
            }
            write(project_name(block, &place)?, &text)?;
            let [room, geometry] = ROOM;
            if text.contains(&format!("\"{room}\"")) && !self.scratch.join(room).exists() {
                write(room, geometry)?;
            }
        }
        Ok(())
    }

    /// A command of the document names the project, so that it is run.
    fn expect_use(&self, block: &Block, place: &str) -> Result<(), Failure> {
        let name = project_name(block, place)?;
        let lines = self.blocks.iter().filter(|b| b.language.is_none()).flat_map(|b| &b.lines);
        let is_use = |line: &String| match Line::new(line, &self.name) {
            Line::Run(arguments) => arguments.starts_with(&["run".to_owned(), name.to_owned()]),
            // A mapping file of the reader of IFC models, whose tests read the page's.
            _ => line.contains(&format!(" --mapping {name} ")),
        };
        if lines.clone().any(is_use) {
            return Ok(());
        }
        Err(format!("{place}: no command runs {name}"))
    }
}

fn is_case(block: &Block) -> bool {
    block.lines.iter().any(|line| line == "[[expect]]")
}

fn project_name<'a>(block: &'a Block, place: &str) -> Result<&'a str, Failure> {
    let name = block.name_before(".toml");
    name.ok_or_else(|| format!("{place}: the paragraph before does not name the file: `NAME.toml`"))
}

/// Copies a folder with all that is in it.
fn copy(from: &Path, to: &Path) -> std::io::Result<()> {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        let target = to.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            copy(&entry.path(), &target)?;
        } else {
            fs::copy(entry.path(), target)?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use xtask::workspace::root as workspace_root;

    /// Commands that are known, languages that are checked, project files that have a name and are
    /// run: all that can be told without running anything.
    #[test]
    fn the_documents_show_nothing_that_nobody_checks() {
        let root = workspace_root();
        let mut commands = 0;
        for name in documents(&root).unwrap() {
            let text = fs::read_to_string(root.join(&name)).unwrap();
            let (scratch, blocks) = (PathBuf::new(), blocks(&text));
            let document = Document { name, blocks, scratch };
            for block in &document.blocks {
                let place = format!("{}:{}", document.name, block.line);
                match block.language.as_deref() {
                    None => {
                        for line in &block.lines {
                            let line = Line::new(line, &document.name);
                            assert_ne!(line, Line::Unknown, "{place}");
                            commands += usize::from(line != Line::LeftOut);
                        }
                    }
                    Some("toml") if !is_case(block) => document.expect_use(block, &place).unwrap(),
                    Some(language) => {
                        assert!(
                            ["", "obj", "rust", "toml"].contains(&language),
                            "{place}: {language}"
                        );
                    }
                }
            }
        }
        assert!(commands > 20, "only {commands} commands are run");
    }

    #[test]
    fn a_project_that_no_command_runs_is_rejected() {
        let text = "In `a.toml`:\n\n```toml\n[scene]\n```\n\n    quasilux run b.toml\n";
        let (name, scratch) = ("README.md".to_owned(), PathBuf::new());
        let document = Document { name, blocks: blocks(text), scratch };
        let failure = document.expect_use(&document.blocks[0], "here").unwrap_err();
        assert_eq!(failure, "here: no command runs a.toml");
    }
}
