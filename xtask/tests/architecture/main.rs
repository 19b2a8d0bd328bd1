//! The rules of the house that no compiler checks.
//!
//! [`arrows`] reads the manifests, [`absences`] the sources, [`signposts`] what pages and comments
//! point to. Each rule is a function from text to violations, with a test of its own that proves it
//! rejects a made-up one.

mod absences;
mod arrows;
mod signposts;
mod source;

use source::RustFile;
use std::fs;
use std::path::{Path, PathBuf};

/// Files that may be longer than [`absences::MAX_FILE_LINES`], each with the reason.
const LONG_FILES: [(&str, &str); 0] = [];

/// What a rule found, as told to the reader of a failed test.
type Violation = String;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_path_buf()
}

/// Names of the crates, which are the names of their folders, with their manifests.
fn manifests() -> Vec<(String, toml::Table)> {
    let mut manifests: Vec<_> = ["crates", "research"]
        .iter()
        .flat_map(|folder| fs::read_dir(workspace().join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.join("Cargo.toml").is_file())
        .map(|path| {
            let text = fs::read_to_string(path.join("Cargo.toml")).unwrap();
            (path.file_name().unwrap().to_str().unwrap().to_owned(), text.parse().unwrap())
        })
        .collect();
    manifests.sort_by(|a, b| a.0.cmp(&b.0));
    assert!(manifests.len() >= 8, "only {} crates found", manifests.len());
    manifests
}

/// All Rust files of the workspace, with paths relative to it.
fn rust_files() -> Vec<RustFile> {
    let root = workspace();
    let folders = ["crates", "research", "validation", "xtask", "benches", "fuzz"];
    let files = texts(folders.iter().map(|name| root.join(name)).collect(), ".rs");
    assert!(files.len() >= 20, "only {} Rust files found", files.len());
    files.iter().map(|(path, text)| RustFile::new(path, text)).collect()
}

/// All pages of the repository, with paths relative to it.
fn pages() -> Vec<(String, String)> {
    let pages = texts(vec![workspace()], ".md");
    assert!(pages.len() >= 30, "only {} pages found", pages.len());
    pages
}

/// Paths, relative to the workspace, and texts of all files in these folders whose names end so;
/// without what is hidden and what is built.
fn texts(mut folders: Vec<PathBuf>, ending: &str) -> Vec<(String, String)> {
    let root = workspace();
    let mut texts = Vec::new();
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else {
            continue;
        };
        for path in entries.map(|entry| entry.unwrap().path()) {
            let name = path.file_name().unwrap().to_string_lossy();
            if path.is_dir() {
                let is_own = name != "target" && !name.starts_with('.');
                folders.extend(is_own.then(|| path.clone()));
            } else if name.ends_with(ending) {
                let parts: Vec<_> = path.strip_prefix(&root).unwrap().iter().collect();
                let parts: Vec<_> = parts.iter().map(|part| part.to_str().unwrap()).collect();
                texts.push((parts.join("/"), fs::read_to_string(&path).unwrap()));
            }
        }
    }
    texts.sort();
    texts
}

fn assert_none(violations: &[Violation]) {
    assert!(violations.is_empty(), "\n{}\n", violations.join("\n"));
}

#[test]
fn crate_arrows_are_those_of_the_table() {
    let manifests = manifests();
    assert_none(&arrows::violations(&manifests));
}

#[test]
fn the_brute_force_reference_shares_no_code() {
    let manifest = workspace().join("validation/brute/Cargo.toml");
    let manifest = fs::read_to_string(manifest).unwrap().parse().unwrap();
    assert_none(&arrows::arrows_of_the_independent(&manifest));
}

#[test]
fn the_page_shows_the_table_that_is_tested() {
    let page = fs::read_to_string(workspace().join("ARCHITECTURE.md")).unwrap();
    assert_none(&arrows::page_violations(&page));
}

#[test]
fn no_crate_and_no_module_is_a_drawer() {
    let crates = manifests().into_iter().map(|(name, _)| name);
    let paths = rust_files().into_iter().map(|file| file.path);
    assert_none(&absences::drawers(crates.chain(paths)));
}

#[test]
fn below_the_command_line_nothing_reads_the_outside() {
    assert_none(&absences::outside_reads(&rust_files()));
}

#[test]
fn files_are_short() {
    assert_none(&absences::long_files(&rust_files(), &LONG_FILES));
}

#[test]
fn unsafe_code_stays_in_the_ray_kernel() {
    assert_none(&absences::unsafe_code(&rust_files()));
}

#[test]
fn no_test_sleeps() {
    assert_none(&absences::ignored_tests(&rust_files()));
}

/// Crate by crate the imports of all modules, and the other rules that may have a list of known
/// violations.
#[test]
fn no_violation_is_new_and_none_is_listed_in_vain() {
    let root = workspace();
    for rule in &xtask::ratchet::RULES {
        let found = (rule.find)(&root).unwrap();
        let listed = xtask::ratchet::listed(&root, rule.name).unwrap();
        assert_none(&xtask::ratchet::differences(&found, &listed));
    }
}

/// Whoever changes a text reads it in its list, beside others.
#[test]
fn the_texts_that_users_see_are_listed() {
    let root = workspace();
    let found = xtask::messages::of_workspace(&root).unwrap();
    let listed = fs::read_to_string(root.join(xtask::messages::LIST)).unwrap_or_default();
    let different = xtask::messages::differences(&listed, &found);
    assert!(listed == found, "run `cargo xtask messages`\n{}", different.join("\n"));
}

#[test]
fn pages_and_comments_point_to_what_is_there() {
    let root = workspace();
    let sources = rust_files();
    let mut found = Vec::new();
    for (path, page) in pages() {
        let lines = page.lines().enumerate().map(|(number, line)| (number + 1, line));
        found.extend(signposts::broken_links(&root, &path, &page));
        found.extend(signposts::gone_paths(&root, &path, signposts::prose(&page)));
        found.extend(signposts::gone_sources(&sources, &path, signposts::prose(&page)));
        found.extend(signposts::idle_filters(&sources, &path, lines));
    }
    for RustFile { path, text, .. } in &sources {
        found.extend(signposts::gone_paths(&root, path, signposts::documentation(text)));
        found.extend(signposts::gone_sources(&sources, path, signposts::documentation(text)));
        found.extend(signposts::idle_filters(&sources, path, signposts::documentation(text)));
    }
    assert_none(&found);
}
