//! The commands that documents show: which of them are run, and how.

use std::path::{Path, PathBuf};
use std::process::Command;
use xtask::workspace::Failure;

/// How documents call the program.
const CALLS: [&str; 2] = ["cargo run --release -- ", "quasilux "];

/// Commands that are not run here, by how they begin, and the documents where they are not.
const LEFT_OUT: [LeftOut; 16] = [
    LeftOut::anywhere("cargo xtask ", "what runs the commands of the documents"),
    LeftOut::anywhere("cargo test ", "`cargo xtask test tests` runs all tests"),
    LeftOut::anywhere("cargo install ", "installs what has been published"),
    LeftOut::anywhere("cargo run --release -p ", "benchmarks: minutes, and times of one machine"),
    LeftOut::anywhere("cargo run --release -- experiment coverage", "an hour"),
    LeftOut::anywhere("python3 benches/peers/", "needs other programs"),
    LeftOut::anywhere("pip install ", "installs what has been published"),
    LeftOut::anywhere(
        "python -m quasilux.ifc ",
        "`tests/test_ifc_files.py` of the package runs it",
    ),
    LeftOut::anywhere("quasilux check office.toml", "the project of a model of the reader"),
    LeftOut::anywhere("rtrace ", "a program of Radiance"),
    LeftOut::anywhere("sh local.sh ", "`cargo xtask test examples` does the same"),
    LeftOut::anywhere("shards=$(sbatch ", "needs a cluster"),
    LeftOut::anywhere("sbatch ", "needs a cluster"),
    LeftOut::anywhere("DIGEST  NAME", "a line of a list"),
    LeftOut {
        begins: "cargo run --release -- run ",
        documents: "examples/",
        _why: "`cargo xtask test examples` runs them and compares more",
    },
    LeftOut { begins: "cargo run --release -- annual ", documents: "examples/", _why: "the same" },
];

/// Commands that are left out.
struct LeftOut {
    begins: &'static str,
    /// How the names of the documents begin.
    documents: &'static str,
    _why: &'static str,
}

impl LeftOut {
    const fn anywhere(begins: &'static str, why: &'static str) -> Self {
        Self { begins, documents: "", _why: why }
    }
}

/// What is to be done about a line of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Line {
    /// The program is run with these arguments.
    Run(Vec<String>),
    LeftOut,
    /// Nobody knows it.
    Unknown,
}

impl Line {
    pub(super) fn new(line: &str, document: &str) -> Self {
        let is_left_out = |left_out: &LeftOut| {
            line.starts_with(left_out.begins) && document.starts_with(left_out.documents)
        };
        if LEFT_OUT.iter().any(is_left_out) {
            return Self::LeftOut;
        }
        let arguments = CALLS.iter().find_map(|call| line.strip_prefix(call));
        arguments.map_or(Self::Unknown, |arguments| {
            let words = arguments.split_whitespace().take_while(|word| !word.starts_with('#'));
            Self::Run(words.map(str::to_owned).collect())
        })
    }
}

/// Runs the program in a folder and returns what it printed, if it ended with results: exit code 0,
/// or 3 where a limit came before the tolerance.
pub(crate) fn output(
    program: &Path,
    folder: &Path,
    arguments: &[String],
) -> Result<String, Failure> {
    let line = arguments.join(" ");
    println!("xtask: quasilux {line}");
    let output = Command::new(program)
        .args(arguments.iter().flat_map(|word| expanded(folder, word)))
        .current_dir(folder)
        .output()
        .map_err(|error| format!("{}: {error}", program.display()))?;
    if matches!(output.status.code(), Some(0 | 3)) {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("`quasilux {line}` ended with {}: {said}", output.status))
}

/// The files that a name with a star stands for, as a shell would have it; or the word.
fn expanded(folder: &Path, word: &str) -> Vec<String> {
    let Some((before, after)) = word.split_once('*') else {
        return vec![word.to_owned()];
    };
    let (parent, start) = before.rsplit_once('/').unwrap_or(("", before));
    let names = std::fs::read_dir(folder.join(parent)).into_iter().flatten().flatten();
    let names = names.map(|entry| entry.file_name().to_string_lossy().into_owned());
    let fits = |name: &String| name.starts_with(start) && name.ends_with(after);
    let mut names: Vec<String> = names.filter(fits).collect();
    names.sort();
    let path = |name: String| if parent.is_empty() { name } else { format!("{parent}/{name}") };
    if names.is_empty() { vec![word.to_owned()] } else { names.into_iter().map(path).collect() }
}

/// Builds the program and says where it is.
pub(crate) fn build(root: &Path) -> Result<PathBuf, Failure> {
    let output = Command::new("cargo")
        .args(["build", "--profile", "ci", "--package", "quasilux"])
        .args(["--quiet", "--message-format", "json-render-diagnostics"])
        .current_dir(root)
        .output()
        .map_err(|error| format!("cargo does not start: {error}"))?;
    let messages = String::from_utf8_lossy(&output.stdout);
    let messages = messages.lines().filter_map(|line| serde_json::from_str(line).ok());
    let mut programs = messages
        .filter_map(|message: serde_json::Value| message["executable"].as_str().map(PathBuf::from));
    programs.next().ok_or_else(|| {
        format!("the program is not built: {}", String::from_utf8_lossy(&output.stderr))
    })
}

/// Where cargo puts what it builds.
pub(crate) fn target_folder(root: &Path) -> Result<PathBuf, Failure> {
    let output = Command::new("cargo")
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1"])
        .current_dir(root)
        .output()
        .map_err(|error| format!("cargo does not start: {error}"))?;
    let metadata: serde_json::Value =
        serde_json::from_slice(&output.stdout).map_err(|error| error.to_string())?;
    let folder = metadata["target_directory"].as_str().map(PathBuf::from);
    folder.ok_or_else(|| "cargo names no folder for what it builds".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_run_left_out_or_unknown() {
        let words = |text: &str| Line::Run(text.split(' ').map(str::to_owned).collect());
        let readme = |line| Line::new(line, "README.md");
        assert_eq!(readme("cargo run --release -- run a.toml  # here"), words("run a.toml"));
        assert_eq!(readme("quasilux merge parts/*.part"), words("merge parts/*.part"));
        let run = "cargo run --release -- run examples/cube/cube.toml";
        assert_eq!(Line::new(run, "examples/cube/README.md"), Line::LeftOut);
        assert_eq!(readme(run), words("run examples/cube/cube.toml"));
        assert_eq!(readme("cargo xtask test"), Line::LeftOut);
        assert_eq!(readme("make"), Line::Unknown);
    }

    #[test]
    fn stars_stand_for_files() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert_eq!(expanded(folder, "src/documents/b*.rs"), ["src/documents/blocks.rs"]);
        assert_eq!(expanded(folder, "Cargo.t*ml"), ["Cargo.toml"]);
        assert_eq!(expanded(folder, "no*where"), ["no*where"]);
    }
}
