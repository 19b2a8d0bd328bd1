//! Runs every example and checks the numbers that it promises, and those that it predicted of
//! itself.
//!
//! An example is a folder of `examples/` with one or more project files, a `README.md` that gives
//! the command and the numbers, and the same numbers in `expected.toml`. The README says of each
//! project whether it is one for `quasilux run` or for `quasilux annual`.

use crate::expectation::{Expectation, Expected};
use crate::{cluster, prediction};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use xtask::workspace::Failure;

/// The files of one example.
#[derive(Debug)]
struct Example {
    folder: PathBuf,
    projects: Vec<PathBuf>,
    readme: String,
    expected: Expected,
}

/// How a README begins a command.
const COMMAND: &str = "cargo run --release --";

/// What is done with a project.
struct Task {
    /// As `quasilux` has it.
    word: &'static str,
    /// The file with the results.
    document: &'static str,
    /// Whether that says how fast half-widths were to shrink.
    has_prediction: bool,
}

/// Runs all examples of the workspace.
pub(crate) fn run_all(root: &Path) -> Result<(), Failure> {
    let out = std::env::temp_dir().join(format!("quasilux-examples-{}", std::process::id()));
    let outcome = example_folders(root)?.iter().try_for_each(|folder| {
        let example = Example::read(folder)?;
        example.check_readme(root)?;
        example.run(root, &out)
    });
    let outcome = outcome.and_then(|()| cluster::run(root, &out.join("cluster")));
    // What a failed run left behind is where the search for its cause begins.
    if outcome.is_ok() {
        let _ = fs::remove_dir_all(&out);
    } else {
        eprintln!("xtask: the results are in {}", out.display());
    }
    outcome
}

fn example_folders(root: &Path) -> Result<Vec<PathBuf>, Failure> {
    let folders: Vec<_> =
        entries(&root.join("examples"))?.into_iter().filter(|path| path.is_dir()).collect();
    if folders.is_empty() { Err("examples/ is empty".into()) } else { Ok(folders) }
}

impl Example {
    fn read(folder: &Path) -> Result<Self, Failure> {
        let expected = read(&folder.join("expected.toml")).and_then(|text| Expected::parse(&text));
        let projects: Vec<_> =
            entries(folder)?.into_iter().filter(|path| is_project(path)).collect();
        if projects.is_empty() {
            return Err(format!("{} has no project file", folder.display()));
        }
        Ok(Self {
            folder: folder.to_path_buf(),
            projects,
            readme: read(&folder.join("README.md"))?,
            expected: expected
                .map_err(|failure| format!("{}/expected.toml: {failure}", folder.display()))?,
        })
    }

    /// The README gives the command of each project and each promised number.
    fn check_readme(&self, root: &Path) -> Result<(), Failure> {
        let place = self.folder.join("README.md").display().to_string();
        for project in &self.projects {
            let name = relative(project, root);
            if self.task_of(&name).is_none() {
                return Err(format!("{place} does not give the command `{COMMAND} run {name}`"));
            }
        }
        for expectation in &self.expected.expect {
            if !self.readme.contains(&expectation.value.to_string()) {
                return Err(format!("{place} does not give the number {}", expectation.value));
            }
        }
        Ok(())
    }

    /// What the README has done with a project.
    fn task_of(&self, project: &str) -> Option<Task> {
        let tasks = [
            Task { word: "run", document: "result.json", has_prediction: true },
            Task { word: "annual", document: "annual.json", has_prediction: false },
        ];
        let is_given =
            |task: &Task| self.readme.contains(&format!("{COMMAND} {} {project}", task.word));
        tasks.into_iter().find(is_given)
    }

    /// Runs all projects; numbers are promised of each but where they name one.
    fn run(&self, root: &Path, out: &Path) -> Result<(), Failure> {
        for project in &self.projects {
            let name = relative(project, root);
            println!("xtask: {name}");
            let out = out.join(name.replace(['/', '.'], "-"));
            let Some(task) = self.task_of(&name) else { continue };
            run_project(root, &task, &name, &out)
                .map_err(|failure| format!("{name}: {failure}"))?;
            let text = read(&out.join(task.document))?;
            let result = serde_json::from_str(&text)
                .map_err(|error| format!("{name}: {} is not JSON: {error}", task.document))?;
            let file = project.file_name().and_then(|file| file.to_str());
            let is_own = |it: &&Expectation| it.project.is_none() || it.project.as_deref() == file;
            for expectation in self.expected.expect.iter().filter(is_own) {
                expectation.check(&result).map_err(|failure| format!("{name}: {failure}"))?;
            }
            if task.has_prediction {
                prediction::check(&result).map_err(|failure| format!("{name}: {failure}"))?;
            }
        }
        Ok(())
    }
}

fn run_project(root: &Path, task: &Task, project: &str, out: &Path) -> Result<(), Failure> {
    let status = Command::new("cargo")
        .args(["run", "--profile", "ci", "--quiet", "--package", "quasilux", "--"])
        .args([task.word, project, "--quiet", "--out"])
        .arg(out)
        .current_dir(root)
        .status()
        .map_err(|error| format!("cargo does not start: {error}"))?;
    if status.success() {
        Ok(())
    } else {
        Err(format!("`quasilux {}` ended with {status}", task.word))
    }
}

fn is_project(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "toml")
        && path.file_name().is_some_and(|name| name != "expected.toml")
}

/// A path below the root, with slashes on every platform.
fn relative(path: &Path, root: &Path) -> String {
    let parts: Vec<_> = path.strip_prefix(root).unwrap_or(path).iter().collect();
    parts.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}

fn read(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))
}

/// The entries of a folder, sorted by name.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let listing = fs::read_dir(folder).and_then(|entries| {
        entries.map(|entry| entry.map(|entry| entry.path())).collect::<Result<Vec<_>, _>>()
    });
    let mut paths = listing.map_err(|error| format!("{}: {error}", folder.display()))?;
    paths.sort();
    Ok(paths)
}

#[cfg(test)]
mod tests {
    use super::*;
    use xtask::workspace::root as workspace_root;

    #[test]
    fn every_example_says_its_command_and_its_numbers() {
        let root = workspace_root();
        for folder in example_folders(&root).unwrap() {
            Example::read(&folder).unwrap().check_readme(&root).unwrap();
        }
    }

    #[test]
    fn a_readme_that_keeps_a_number_or_the_command_to_itself_is_rejected() {
        let root = workspace_root();
        let mut example = Example::read(&root.join("examples/cube")).unwrap();
        example.expected.expect[0].value += 1.0;
        assert!(example.check_readme(&root).unwrap_err().contains("number"));
        example.readme.clear();
        assert!(example.check_readme(&root).unwrap_err().contains("command"));
    }
}
