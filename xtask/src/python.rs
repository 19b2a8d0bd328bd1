//! The step for the Python package: its wheel in a fresh virtual environment, and all that a user
//! of the package relies on there; and the site of the program, which a package of Python makes.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use xtask::workspace::Failure;

/// The package's folder, from the workspace's root.
const PACKAGE: &str = "crates/quasilux-python";
/// The oldest minor version of Python 3 that the package is for.
const OLDEST_MINOR: u32 = 10;
/// Environment variable that, set to `none`, leaves this step out.
const CHOICE: &str = "QUASILUX_PYTHON";

/// A virtual environment.
struct Environment {
    root: PathBuf,
    package: PathBuf,
    folder: PathBuf,
}

/// Builds the wheel, installs it and what its tests need, and runs tests, type checks and the
/// documentation; says in one line why not where there is no Python.
pub(crate) fn check(root: &Path) -> Result<(), Failure> {
    #[expect(clippy::disallowed_methods, reason = "who has no Python may say so")]
    let is_unwanted = std::env::var(CHOICE).is_ok_and(|choice| choice == "none");
    if is_unwanted {
        println!("xtask: Python is left out: {CHOICE} is none");
        return Ok(());
    }
    let Some(python) = find_python() else {
        println!("xtask: Python is left out: no Python 3.{OLDEST_MINOR} or later with venv");
        return Ok(());
    };
    let environment = Environment::fresh(root, python)?;
    let wheel = environment.build_wheel()?;
    environment.install(&["--no-deps", &wheel.to_string_lossy()])?;
    // Neither keeps two processors busy.
    std::thread::scope(|scope| {
        let beside =
            scope.spawn(|| CHECKS.iter().try_for_each(|check| environment.check_silently(check)));
        let tests = environment.run("pytest", &["-q", "--no-header", "tests"]);
        tests.and(beside.join().expect("no check panics"))
    })
}

/// What is checked beside the tests, in this order: its name, the module of Python and its
/// arguments, in the package's folder.
const CHECKS: [[&str; 3]; 4] = [
    ["stubs against the module", "mypy.stubtest", "quasilux._native --ignore-disjoint-bases"],
    ["types", "pyright", "--pythonpath {python} python tests"],
    ["site of the program", "mkdocs", "build -f ../../mkdocs.yml --strict -d {folder}/site"],
    ["site of the package", "mkdocs", "build --strict -d {folder}/site/python"],
];

/// A Python that is new enough and can make virtual environments.
fn find_python() -> Option<&'static str> {
    let program = format!("import sys, venv; sys.exit(sys.version_info < (3, {OLDEST_MINOR}))");
    ["python3", "python"].into_iter().find(|python| {
        let mut command = Command::new(python);
        command.args(["-c", &program]).stdout(Stdio::null()).stderr(Stdio::null());
        command.status().is_ok_and(|status| status.success())
    })
}

impl Environment {
    /// A new one in the place of that of an earlier run.
    fn fresh(root: &Path, python: &str) -> Result<Self, Failure> {
        let folder = root.join("target/python");
        let own = Self { root: root.to_owned(), package: root.join(PACKAGE), folder };
        let place = own.folder.join("venv");
        let mut make = Command::new(python);
        run(make.args(["-m", "venv", "--clear"]).arg(place))?;
        own.install(&["-r", "tests/requirements.txt"])?;
        Ok(own)
    }

    fn python(&self) -> PathBuf {
        let within = if cfg!(windows) { "venv/Scripts/python.exe" } else { "venv/bin/python" };
        self.folder.join(within)
    }

    fn install(&self, what: &[&str]) -> Result<(), Failure> {
        let quiet = ["install", "--quiet", "--disable-pip-version-check"];
        self.run("pip", &[&quiet, what].concat())
    }

    /// Builds the wheel with what the tests have built already, and returns its path.
    fn build_wheel(&self) -> Result<PathBuf, Failure> {
        let wheels = self.folder.join("wheels");
        let _ = std::fs::remove_dir_all(&wheels);
        let out = wheels.to_string_lossy();
        self.run("maturin", &["build", "--quiet", "--profile", "ci", "--out", &out])?;
        let entries = std::fs::read_dir(&wheels).map_err(|error| error.to_string())?;
        let mut paths = entries.filter_map(Result::ok).map(|entry| entry.path());
        let is_wheel = |path: &PathBuf| path.extension().is_some_and(|end| end == "whl");
        paths.find(is_wheel).ok_or_else(|| format!("no wheel in {out}"))
    }

    /// Runs a check, and prints all that it says at its end.
    fn check_silently(&self, [name, module, arguments]: &[&str; 3]) -> Result<(), Failure> {
        let arguments: Vec<&str> = arguments.split_whitespace().collect();
        let mut command = self.command(module, &arguments);
        let output =
            command.output().map_err(|error| format!("{command:?} does not start: {error}"))?;
        let [said, told] = [&output.stdout, &output.stderr].map(|it| String::from_utf8_lossy(it));
        println!("xtask: {name}\n{said}{told}");
        let failed = || Err(format!("{command:?} ended with {}", output.status));
        if output.status.success() { Ok(()) } else { failed() }
    }

    /// Runs a module of Python in the package's folder.
    fn run(&self, module: &str, arguments: &[&str]) -> Result<(), Failure> {
        run(&mut self.command(module, arguments))
    }

    fn command(&self, module: &str, arguments: &[&str]) -> Command {
        let python = self.python();
        let [own, folder] = [&python, &self.folder].map(|path| path.to_string_lossy());
        let fill = |word: &&str| word.replace("{python}", &own).replace("{folder}", &folder);
        let mut command = Command::new(&python);
        command.args(["-m", module]).args(arguments.iter().map(fill));
        command.current_dir(&self.package).env("QUASILUX_ROOT", &self.root);
        command.env_remove("PYTHONPATH").env("PYTHONDONTWRITEBYTECODE", "1");
        // What the theme says of another program.
        command.env("NO_MKDOCS_2_WARNING", "1");
        command
    }
}

fn run(command: &mut Command) -> Result<(), Failure> {
    let status =
        command.status().map_err(|error| format!("{command:?} does not start: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} ended with {status}")) }
}
