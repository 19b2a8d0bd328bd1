//! Folders with projects, the program in them, and what came of it.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A folder of a test's own; the program runs in it.
pub(crate) struct Folder(PathBuf);

/// A finished run of the program.
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Folder {
    /// An empty folder; `name` is unique among all tests.
    pub(crate) fn new(name: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        if path.exists() {
            fs::remove_dir_all(&path).expect("the folder of an earlier run can go");
        }
        fs::create_dir_all(&path).expect("the folder can be made");
        Self(path)
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a file has a folder")).expect("folders are made");
        fs::write(path, bytes).expect("the folder takes files");
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The program in this folder, without a terminal.
    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_quasilux"));
        command.args(arguments).current_dir(&self.0).env_remove("NO_COLOR");
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub(crate) fn quasilux(&self, arguments: &[&str]) -> Run {
        Run::new(self.command(arguments).output().expect("the program starts"))
    }

    /// Runs a project into `out` in quiet, asserts the exit code, and returns the document.
    pub(crate) fn document(&self, project: &str, out: &str, more: &[&str], code: i32) -> String {
        let arguments = [&["run", project, "--out", out, "--quiet"], more].concat();
        let run = self.quasilux(&arguments);
        assert_eq!(run.code, Some(code), "{arguments:?}: {}", run.stderr);
        self.read(&format!("{out}/result.json"))
    }
}

impl Run {
    pub(crate) fn new(output: Output) -> Self {
        let text = |bytes| String::from_utf8(bytes).expect("the program writes UTF-8");
        Self {
            code: output.status.code(),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        }
    }
}

/// What Ctrl-C does.
#[cfg(unix)]
pub(crate) fn interrupt(child: &std::process::Child) {
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.is_ok_and(|status| status.success()), "the program is gone");
}

/// A document without what may differ between runs of one project: how long it took and on how many
/// threads, the time that was predicted, and the memory of those threads.
pub(crate) fn without_seconds_and_threads(document: &str) -> String {
    let mut text = document.to_owned();
    for (key, times) in [("\"seconds\": ", 3), ("\"threads\": ", 1), ("\"bytes\": ", 1)] {
        let mut from = 0;
        for _ in 0..times {
            let found = text[from..].find(key).unwrap_or_else(|| panic!("no {key}in {text}"));
            let start = from + found + key.len();
            let length = text[start..].find([',', '\n', '}']).expect("a value ends");
            text.replace_range(start..start + length, "_");
            from = start;
        }
    }
    text
}

pub(crate) fn parsed(document: &str) -> Value {
    serde_json::from_str(document).unwrap_or_else(|error| panic!("{error} in {document}"))
}

/// A number of a document, by its JSON pointer (RFC 6901).
pub(crate) fn number(document: &Value, pointer: &str) -> f64 {
    let value = document.pointer(pointer).unwrap_or_else(|| panic!("no {pointer}"));
    value.as_f64().unwrap_or_else(|| panic!("{pointer} is {value}"))
}

/// Illuminance and half-width of every point of every sensor.
pub(crate) fn illuminances(document: &Value) -> Vec<(f64, f64)> {
    let sensors = document["sensors"].as_array().expect("sensors");
    let points = sensors.iter().flat_map(|s| s["points"].as_array().expect("points"));
    points
        .map(|point| (number(point, "/illuminance_lx"), number(point, "/half_width_lx")))
        .collect()
}

/// A box as six quads that face inward, each corner shared, so that it is watertight.
/// `first_vertex` counts from 1 through the file.
pub(crate) fn box_obj(name: &str, low: [f64; 3], high: [f64; 3], first_vertex: usize) -> String {
    let mut text = format!("o {name}\nusemtl {name}\n");
    for corner in 0..8 {
        let at = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
        text += &format!("v {} {} {}\n", at(0), at(1), at(2));
    }
    for quad in [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    {
        let [a, b, c, d] = quad.map(|corner| corner + first_vertex);
        text += &format!("f {a} {b} {c} {d}\n");
    }
    text
}

/// A panel of 1 m x 1 m at height `z_m` around (1, 1), facing down.
pub(crate) fn panel_obj(z_m: f64, first_vertex: usize) -> String {
    let [a, b, c, d] = [0, 1, 2, 3].map(|corner| corner + first_vertex);
    format!(
        "o panel\nusemtl panel\nv 0.5 0.5 {z_m}\nv 0.5 1.5 {z_m}\nv 1.5 1.5 {z_m}\nv 1.5 0.5 \
         {z_m}\nf {a} {b} {c} {d}\n"
    )
}

/// Numbers that look random (Knuth's MMIX generator).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound
    }

    pub(crate) fn shuffle<T>(&mut self, things: &mut [T]) {
        for i in (1..things.len()).rev() {
            things.swap(i, self.below(i + 1));
        }
    }
}

/// A file cut short, or with one bit changed, at random.
pub(crate) fn damaged(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let at = numbers.below(bytes.len());
    if numbers.below(2) == 0 {
        bytes.truncate(at);
    } else {
        bytes[at] ^= 1 << numbers.below(8);
    }
    bytes
}

/// A checkpoint or part with another text of the same length in its header, and the digest that
/// belongs to it.
pub(crate) fn forged(bytes: &[u8], old: &str, new: &str) -> Vec<u8> {
    use sha2::{Digest, Sha256};
    assert_eq!(old.len(), new.len());
    let mut bytes = bytes[..bytes.len() - 32].to_vec();
    let at = bytes.windows(old.len()).position(|window| window == old.as_bytes());
    let at = at.unwrap_or_else(|| panic!("no {old}"));
    bytes[at..at + new.len()].copy_from_slice(new.as_bytes());
    let digest = Sha256::digest(&bytes);
    bytes.extend_from_slice(&digest);
    bytes
}
