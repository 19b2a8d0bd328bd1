//! Bad input: exit code 2, nothing on stdout, one clear message with file and place, no panic.
//!
//! Each case is one change to a good project, or arguments that make no sense.

mod arguments;
mod cameras;
mod geometry;
mod photometry;
mod project;

use crate::support::{Folder, Run, box_obj};

/// A floor with a closed pillar on it, under a luminaire. Cases refer to its lines.
const PROJECT: &str = r#"[scene]
geometry = ["room.obj"]

[materials.wood]
reflectance = 0.3

[[luminaires]]
photometry = "lamp.ies"
position = [1, 1, 2]
aim = [0, 0, -1]
c0 = [1, 0, 0]
dimming = 1.0

[[sensors]]
name = "plane"
kind = "grid"
origin = [0, 0, 0.5]
u = [2, 0, 0]
v = [0, 2, 0]
counts = [2, 2]

[[sensors]]
name = "probes"
kind = "points"
points = [[1, 0.5, 0.7]]
normals = [[0, 0, 1]]

[simulation]
estimator = "path"
sequence = "sobol"
randomization = "owen"
rel_tol = 0.5
"#;

/// Line 10 has the numbers of angles, line 12 the polar ones, line 14 the candelas.
const LAMP_IES: &str = "IESNA:LM-63-2002\n[TEST] none\n[TESTLAB] none\n[ISSUEDATE] 1-JAN-2026\n\
    [MANUFAC] none\n[LUMCAT] none\n[LUMINAIRE] none\n[LAMP] none\nTILT=NONE\n\
    1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 80 20\n";

/// Its first lines; a pillar follows.
const FLOOR_OBJ: &str = "o floor\nusemtl wood\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n";

/// One change that makes the project bad.
struct Case {
    what: &'static str,
    replaced: Vec<(&'static str, &'static str)>,
    files: Vec<(&'static str, Vec<u8>)>,
    removed: Option<&'static str>,
    arguments: Vec<&'static str>,
    needles: Vec<&'static str>,
}

impl Case {
    fn new(what: &'static str) -> Self {
        Self {
            what,
            replaced: Vec::new(),
            files: Vec::new(),
            removed: None,
            arguments: vec!["run", "project.toml"],
            needles: Vec::new(),
        }
    }

    /// The first `from` of the project file becomes `to`.
    fn replace(mut self, from: &'static str, to: &'static str) -> Self {
        self.replaced.push((from, to));
        self
    }

    /// A file is added, or becomes another.
    fn file(mut self, name: &'static str, bytes: impl AsRef<[u8]>) -> Self {
        self.files.push((name, bytes.as_ref().to_vec()));
        self
    }

    fn remove(mut self, name: &'static str) -> Self {
        self.removed = Some(name);
        self
    }

    /// Arguments after `run project.toml`.
    fn with(mut self, arguments: &[&'static str]) -> Self {
        self.arguments.extend(arguments);
        self
    }

    /// All arguments.
    fn instead(mut self, arguments: &[&'static str]) -> Self {
        self.arguments = arguments.to_vec();
        self
    }

    /// What the message contains; the first needle is the place, where there is one.
    fn says(mut self, needles: &[&'static str]) -> Self {
        self.needles.extend(needles);
        self
    }

    fn run(&self, folder: &Folder) -> Run {
        let mut project = PROJECT.to_owned();
        for (from, to) in &self.replaced {
            assert!(project.contains(from), "{}: no {from} in the project", self.what);
            project = project.replacen(from, to, 1);
        }
        folder.write("project.toml", project);
        folder.write("room.obj", FLOOR_OBJ.to_owned() + &pillar_obj());
        folder.write("lamp.ies", LAMP_IES);
        for (name, bytes) in &self.files {
            folder.write(name, bytes);
        }
        if let Some(name) = self.removed {
            std::fs::remove_file(folder.path(name)).expect("the file is there");
        }
        folder.quasilux(&self.arguments)
    }
}

fn pillar_obj() -> String {
    box_obj("wood", [1.7, 1.7, 0.1], [1.9, 1.9, 0.9], 5)
}

#[test]
fn the_project_itself_is_good() {
    let run = Case::new("nothing").run(&Folder::new("bad_input_none"));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(run.stderr, "");
}

/// Runs the cases of one table, and reports all that do not hold.
fn check(name: &str, cases: &[Case]) {
    let mut faults = String::new();
    for (i, case) in cases.iter().enumerate() {
        let run = case.run(&Folder::new(&format!("bad_input_{name}_{i}")));
        for fault in faults_of(case, &run) {
            faults += &format!("{}: {fault}:\n{}\n", case.what, run.stderr);
        }
    }
    assert!(faults.is_empty(), "\n{faults}");
}

fn faults_of(case: &Case, run: &Run) -> Vec<String> {
    assert!(!case.needles.is_empty(), "{}: every case expects some words", case.what);
    let mut faults = Vec::new();
    if run.code != Some(2) {
        faults.push(format!("exit code {:?}", run.code));
    }
    if !run.stdout.is_empty() {
        faults.push(format!("stdout {:?}", run.stdout));
    }
    if !run.stderr.starts_with("error: ") || run.stderr.matches("error: ").count() != 1 {
        faults.push("not exactly one message".to_owned());
    }
    if run.stderr.lines().count() != 1 {
        faults.push("several lines".to_owned());
    }
    if run.stderr.contains("panicked") {
        faults.push("a panic".to_owned());
    }
    let missing = case.needles.iter().filter(|needle| !run.stderr.contains(*needle));
    faults.extend(missing.map(|needle| format!("no {needle:?}")));
    faults
}
