//! What must not be there.

use crate::Violation;
use crate::source::{RustFile, end_of_group, line_of, places};

/// Most lines a source file may have.
pub(crate) const MAX_FILE_LINES: usize = 500;

/// Ways to the clock, the file system, the environment, the network, other programs, and random
/// numbers that belong to a thread.
const OUTSIDE: [&str; 16] = [
    "std::fs",
    "std::env",
    "std::net",
    "std::process",
    "fs::read",
    "fs::write",
    "fs::read_to_string",
    "env::var",
    "env::var_os",
    "env::args",
    "File::open",
    "File::create",
    "OpenOptions",
    "Instant",
    "SystemTime",
    "thread_rng",
];

/// The same as members of a `use std::{...}`.
const OUTSIDE_MODULES: [&str; 4] = ["fs", "env", "net", "process"];

/// Where files and variables for tests are read: in no program, as the arrows between crates show.
const TEST_FILES: [&str; 3] = [
    "crates/quasilux-corpus/src/",
    "crates/quasilux-stats/src/damage/",
    "crates/quasilux-stats/src/deep.rs",
];

/// Where `unsafe` may be.
const UNSAFE_FOLDERS: [&str; 2] = ["crates/quasilux-bvh/", "benches/foreign/"];

/// Names for places where things collect.
const DRAWERS: [&str; 7] = ["utils", "util", "core", "common", "helpers", "misc", "shared"];

/// Reads of the outside in crates below the command line, their tests left out.
pub(crate) fn outside_reads(files: &[RustFile]) -> Vec<Violation> {
    let below = |path: &str| {
        path.starts_with("crates/quasilux-")
            && !path.starts_with("crates/quasilux-python/")
            && path.split('/').nth(2) == Some("src")
            && !TEST_FILES.iter().any(|folder| path.starts_with(folder))
    };
    let mut violations = Vec::new();
    for file in files.iter().filter(|file| below(&file.path) && !is_test_module(file, files)) {
        let code = &file.shipped;
        let mut tell = |place: usize, word: &str| {
            let line = line_of(code, place);
            violations.push(format!("{}:{line}: {word} below the command line", file.path));
        };
        for word in OUTSIDE {
            places(code, word).for_each(|place| tell(place, word));
        }
        for (place, head) in code.match_indices("std::{") {
            let group = &code[place..end_of_group(code, place + head.len() - 1)];
            for module in OUTSIDE_MODULES {
                places(group, module).for_each(|at| tell(place + at, module));
            }
        }
    }
    violations
}

/// Whether the file is a module that its parent declares under `#[cfg(test)]`.
fn is_test_module(file: &RustFile, files: &[RustFile]) -> bool {
    let Some((folder, name)) = file.path.rsplit_once('/') else {
        return false;
    };
    let module = name.trim_end_matches(".rs");
    let declaration = format!("mod {module};");
    let parents = ["lib.rs", "main.rs", "mod.rs"].map(|parent| format!("{folder}/{parent}"));
    files
        .iter()
        .filter(|other| parents.contains(&other.path) || other.path == format!("{folder}.rs"))
        .any(|parent| parent.code.contains(&declaration) && !parent.shipped.contains(&declaration))
}

/// Files over [`MAX_FILE_LINES`] lines that are not on the list, and listed ones that are short.
pub(crate) fn long_files(files: &[RustFile], listed: &[(&str, &str)]) -> Vec<Violation> {
    let mut violations = Vec::new();
    for file in files {
        let lines = file.text.lines().count();
        let is_listed = listed.iter().any(|(path, _)| *path == file.path);
        if lines > MAX_FILE_LINES && !is_listed {
            violations.push(format!("{}: {lines} lines, over {MAX_FILE_LINES}", file.path));
        }
        if lines <= MAX_FILE_LINES && is_listed {
            violations.push(format!("{}: {lines} lines, need not be listed", file.path));
        }
    }
    violations
}

/// `unsafe` outside the ray kernel and the benchmarks' calls into foreign libraries.
pub(crate) fn unsafe_code(files: &[RustFile]) -> Vec<Violation> {
    let may = |path: &str| UNSAFE_FOLDERS.iter().any(|folder| path.starts_with(folder));
    let elsewhere = files.iter().filter(|file| !may(&file.path));
    elsewhere.flat_map(|file| tell_all(file, &file.code, "unsafe")).collect()
}

/// Tests that are switched off but look alive.
pub(crate) fn ignored_tests(files: &[RustFile]) -> Vec<Violation> {
    let mut violations = Vec::new();
    for file in files {
        for (place, _) in file.code.match_indices("#[") {
            let attribute = &file.code[place..end_of_group(&file.code, place + 1)];
            if places(attribute, "ignore").next().is_some() {
                let line = line_of(&file.code, place);
                violations.push(format!("{}:{line}: an ignored test", file.path));
            }
        }
        for (i, line) in file.text.lines().map(str::trim_start).enumerate() {
            let fence = line.strip_prefix("//!").or(line.strip_prefix("///")).map(str::trim_start);
            if fence.is_some_and(|fence| fence.starts_with("```ignore")) {
                violations.push(format!("{}:{}: an ignored doc test", file.path, i + 1));
            }
        }
    }
    violations
}

/// Crates, folders and files with a name that says nothing.
pub(crate) fn drawers(names: impl Iterator<Item = String>) -> Vec<Violation> {
    let is_drawer = |name: &str| {
        let says = |part: &str| {
            let part = part.trim_end_matches(".rs");
            DRAWERS.contains(&part.strip_prefix("quasilux-").unwrap_or(part))
        };
        name.split('/').any(says)
    };
    names.filter(|name| is_drawer(name)).map(|name| format!("{name}: say what is in it")).collect()
}

fn tell_all(file: &RustFile, code: &str, word: &str) -> Vec<Violation> {
    let lines = places(code, word).map(|place| line_of(code, place));
    lines.map(|line| format!("{}:{line}: {word}", file.path)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIBRARY: &str = "crates/quasilux-scene/src/load.rs";

    fn reads(path: &str, text: &str) -> usize {
        outside_reads(&[RustFile::new(path, text)]).len()
    }

    #[test]
    fn every_way_outside_is_rejected() {
        for text in [
            "use std::fs;",
            "let t = std::fs::read(p);",
            "use std::{io, fs};",
            "use std::{collections::{BTreeMap, BTreeSet}, env};",
            "let f = File::open(p);",
            "let v = std::env::var(n);",
            "use std::time::Instant;",
            "let t = SystemTime::now();",
            "let r = rand::thread_rng();",
            "std::process::exit(2);",
        ] {
            assert!(reads(LIBRARY, text) > 0, "{text}");
        }
    }

    #[test]
    fn the_command_line_tests_and_words_alike_are_not_rejected() {
        assert_eq!(reads("crates/quasilux/src/main.rs", "use std::fs;"), 0);
        assert_eq!(reads("crates/quasilux-scene/tests/all.rs", "use std::fs;"), 0);
        for text in [
            "#[cfg(test)]\nmod tests { use std::fs; }",
            "// std::fs is not used here",
            "let a = \"std::fs\";",
            "let v = env!(\"CARGO_PKG_VERSION\");",
            "use std::{fmt, sync::Arc};",
            "struct InstantReply;",
        ] {
            assert_eq!(reads(LIBRARY, text), 0, "{text}");
        }
    }

    #[test]
    fn a_module_is_a_test_only_where_its_parent_says_so() {
        let tests = RustFile::new("crates/quasilux-scene/src/tests.rs", "use std::fs;");
        let parent = |text| RustFile::new("crates/quasilux-scene/src/lib.rs", text);
        assert_eq!(outside_reads(&[tests.clone(), parent("#[cfg(test)]\nmod tests;")]).len(), 0);
        assert_eq!(outside_reads(&[tests, parent("mod tests;")]).len(), 1);
    }

    #[test]
    fn a_long_file_is_rejected_unless_listed_with_a_reason() {
        let long = RustFile::new(LIBRARY, &"\n".repeat(MAX_FILE_LINES + 1));
        let short = RustFile::new(LIBRARY, &"\n".repeat(MAX_FILE_LINES));
        let listed = [(LIBRARY, "a table of a standard")];
        assert_eq!(long_files(std::slice::from_ref(&long), &[]).len(), 1);
        assert_eq!(long_files(&[long], &listed).len(), 0);
        assert_eq!(long_files(std::slice::from_ref(&short), &[]).len(), 0);
        assert_eq!(long_files(&[short], &listed).len(), 1);
    }

    #[test]
    fn unsafe_code_is_rejected_outside_the_kernel() {
        let text = "fn f() { unsafe { g() } }";
        assert_eq!(unsafe_code(&[RustFile::new(LIBRARY, text)]).len(), 1);
        assert_eq!(unsafe_code(&[RustFile::new("benches/src/points.rs", text)]).len(), 1);
        assert_eq!(unsafe_code(&[RustFile::new("crates/quasilux-bvh/src/simd.rs", text)]).len(), 0);
        assert_eq!(unsafe_code(&[RustFile::new(LIBRARY, "#![forbid(unsafe_code)]")]).len(), 0);
    }

    #[test]
    fn sleeping_tests_are_rejected() {
        for text in [
            "#[test]\n#[ignore]\nfn slow() {}",
            "#[ignore = \"slow\"]\nfn slow() {}",
            "#[cfg_attr(debug_assertions, ignore)]\nfn slow() {}",
            "/// ```ignore\n/// x\n/// ```\nfn f() {}",
        ] {
            assert_eq!(ignored_tests(&[RustFile::new(LIBRARY, text)]).len(), 1, "{text}");
        }
        let awake = "#[test]\nfn ignore() { ignore(v[0]); }";
        assert_eq!(ignored_tests(&[RustFile::new(LIBRARY, awake)]).len(), 0);
    }

    #[test]
    fn drawers_are_rejected() {
        let found = |name: &str| drawers(std::iter::once(name.to_owned())).len();
        for name in
            ["quasilux-core", "quasilux-utils", "crates/a/src/utils.rs", "a/tests/common/mod.rs"]
        {
            assert_eq!(found(name), 1, "{name}");
        }
        for name in ["quasilux-scene", "crates/quasilux-scene/src/commons.rs"] {
            assert_eq!(found(name), 0, "{name}");
        }
    }
}
