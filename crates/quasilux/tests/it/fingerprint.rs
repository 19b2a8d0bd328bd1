//! What changes the fingerprint of a build, and what leaves it.

use crate::build_fingerprint::fingerprint;
use crate::support::Folder;
use std::path::Path;

const LOCK: &str = r#"
version = 4

[[package]]
name = "math"
version = "1.2.3"
source = "registry+https://github.com/rust-lang/crates.io-index"
checksum = "0123"

[[package]]
name = "oracle"
version = "3.0.0"
source = "registry+https://github.com/rust-lang/crates.io-index"
checksum = "4567"

[[package]]
name = "printer"
version = "2.0.0"
source = "registry+https://github.com/rust-lang/crates.io-index"
checksum = "89ab"

[[package]]
name = "quasilux"
version = "0.1.0"
dependencies = ["printer", "quasilux-transport"]

[[package]]
name = "quasilux-sampling"
version = "0.1.0"
dependencies = ["math 1.2.3"]

[[package]]
name = "quasilux-transport"
version = "0.1.0"
dependencies = ["oracle", "quasilux-sampling"]
"#;

/// The first line must stay where it is: the attribute belongs to the file.
const SOURCE: &str = r#"//! Transport of light.
#![forbid(unsafe_code)]
mod path;
/// The speed of light in m/s.
pub const SPEED: f64 = 299_792_458.0;
pub struct Ray { pub origin: f64 /* metres */ }
impl Ray {
    // Not normalised.
    pub fn at(&self, t: f64) -> f64 { self.origin + t * SPEED && true }
    #[cfg(test)]
    fn mirrored(&self) -> f64 { -self.origin }
}
macro_rules! made { () => { /// Documentation made by a macro.
    pub const MADE: u8 = 1; } }
#[cfg(test)]
mod tests;
#[cfg(test)]
const TOLERANCE: f64 = 1e-3;
"#;

/// A workspace with the two crates that decide, and the program that does not.
fn workspace(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("Cargo.lock", LOCK);
    folder.write("Cargo.toml", "[workspace.dependencies]\nmath = \"1.2\"\n");
    folder.write("crates/quasilux/Cargo.toml", "");
    let transport = "crates/quasilux-transport";
    let manifest = "[dependencies]\nquasilux-sampling.path = \"../quasilux-sampling\"\n\
                    [dev-dependencies]\noracle = \"3\"\n";
    folder.write(&format!("{transport}/Cargo.toml"), manifest);
    folder.write(&format!("{transport}/src/lib.rs"), SOURCE);
    folder.write(&format!("{transport}/src/tests.rs"), "fn passes() {}");
    folder.write(&format!("{transport}/src/path/mod.rs"), "mod wave;");
    folder.write(&format!("{transport}/src/path/wave.rs"), "pub fn wave() -> u8 { 7 }");
    folder.write("crates/quasilux-sampling/Cargo.toml", "[dependencies]\nmath.workspace = true\n");
    folder.write("crates/quasilux-sampling/src/lib.rs", "pub const BITS: u32 = 52;");
    folder.write("crates/quasilux-sampling/data/numbers.txt", "1 3 5\n");
    folder
}

fn digest(folder: &Folder) -> String {
    fingerprint(&folder.path("crates/quasilux"), "release: 1.95.0").expect("a fingerprint").sha256
}

/// Whether replacing `old` by `new` in a file of a fresh workspace changes the fingerprint.
fn changes(folder: &Folder, file: &str, old: &str, new: &str) -> bool {
    let before = digest(folder);
    let text = folder.read(file);
    assert!(text.contains(old), "{file} has {old}");
    folder.write(file, text.replace(old, new));
    let after = digest(folder);
    folder.write(file, text);
    assert_eq!(digest(folder), before, "nothing but the files decides");
    before != after
}

#[test]
fn comments_documentation_and_tests_leave_the_fingerprint() {
    let folder = workspace("fingerprint_left");
    let lib = "crates/quasilux-transport/src/lib.rs";
    for (old, new) in [
        ("Transport of light", "How light moves"),
        ("The speed of light", "A speed"),
        ("/// The speed of light in m/s.\n", ""),
        ("/* metres */", ""),
        ("// Not normalised.", "// Of any length.\n"),
        ("-self.origin", "self.origin"),
        ("made by a macro", "of a constant"),
        ("1e-3", "1e-6"),
        ("\n", "\r\n"),
        ("\n", "\n\n"),
    ] {
        assert!(!changes(&folder, lib, old, new), "{old:?} -> {new:?}");
    }
    assert!(!changes(&folder, "crates/quasilux-transport/src/tests.rs", "passes", "fails"));
    assert!(!changes(&folder, "crates/quasilux-sampling/data/numbers.txt", "\n", "\r\n"));
    assert!(!changes(&folder, "Cargo.lock", "89ab", "ffff"), "a crate of the program alone");
    assert!(!changes(&folder, "Cargo.lock", "4567", "ffff"), "a crate of the tests alone");
    assert!(!changes(&folder, "crates/quasilux-transport/Cargo.toml", "oracle = \"3\"", ""));
}

#[test]
fn tokens_constants_data_and_dependencies_change_the_fingerprint() {
    let folder = workspace("fingerprint_changed");
    let lib = "crates/quasilux-transport/src/lib.rs";
    for (old, new) in [
        ("self.origin + t", "self.origin - t"),
        ("299_792_458.0", "299_792_459.0"),
        ("&& true", "& &true"),
        ("MADE: u8 = 1", "MADE: u8 = 2"),
        ("forbid", "deny"),
        ("#[cfg(test)]\nconst", "const"),
    ] {
        assert!(changes(&folder, lib, old, new), "{old:?} -> {new:?}");
    }
    for (file, old, new) in [
        ("crates/quasilux-transport/src/path/wave.rs", "7", "8"),
        ("crates/quasilux-sampling/src/lib.rs", "52", "53"),
        ("crates/quasilux-sampling/data/numbers.txt", "5", "7"),
        ("Cargo.lock", "0123", "ffff"),
        ("Cargo.toml", "\"1.2\"", "{ version = \"1.2\", features = [\"fast\"] }"),
    ] {
        assert!(changes(&folder, file, old, new), "{file}: {old:?} -> {new:?}");
    }
    let own = folder.path("crates/quasilux");
    let other = fingerprint(&own, "release: 1.96.0").expect("a fingerprint").sha256;
    assert_ne!(other, digest(&folder), "the compiler");
}

#[test]
fn versions_decide_in_a_packaged_copy() {
    let folder = Folder::new("fingerprint_packaged");
    let source = "source = \"registry+https://github.com/rust-lang/crates.io-index\"";
    let published = |checksum: &str| {
        let version = "version = \"0.1.0\"\n";
        let with = format!("{version}{source}\nchecksum = \"{checksum}\"\n");
        LOCK.replace(version, &with)
    };
    let digest = |lock: String| {
        folder.write("quasilux-0.1.0/Cargo.lock", lock);
        fingerprint(&folder.path("quasilux-0.1.0"), "").expect("a fingerprint").sha256
    };
    let first = digest(published("aa"));
    assert_eq!(digest(published("aa")), first);
    assert_ne!(digest(published("bb")), first);
    assert_ne!(digest(published("aa").replace("0123", "ffff")), first);
    assert_eq!(digest(published("aa").replace("89ab", "ffff")), first);
}

#[test]
fn all_that_decides_is_read() {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    if own.join("Cargo.lock").is_file() {
        return; // A packaged copy has no sources of others.
    }
    let read = fingerprint(own, "").expect("a fingerprint").read;
    let has = |end: &str| read.iter().any(|path| path.ends_with(end));
    for file in [
        "quasilux-transport/src/run/simulate.rs",
        "quasilux-scene/src/lib.rs",
        "quasilux-text/src/number.rs",
        "quasilux-sampling/data/joe_kuo_1024.txt",
        "quasilux-bvh/src/lanes/mod.rs",
    ] {
        assert!(has(file), "{file}");
    }
    assert!(!has("quasilux-stats/src/lib.rs") && !has("quasilux-report/src/lib.rs"));
}
