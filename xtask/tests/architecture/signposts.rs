//! What pages and comments point to is there: links of pages with their headings, and paths of the
//! repository in code marks.

use super::{RustFile, Violation};
use std::fs;
use std::path::Path;

/// How paths of the repository begin.
const FOLDERS: [&str; 9] = [
    "crates/",
    "docs/",
    "examples/",
    "validation/",
    "benches/",
    "research/",
    "xtask/",
    "fuzz/",
    ".ci/",
];

/// Words in paths that stand for a name.
const STAND_INS: [&str; 3] = ["NAME", "TARGET", "RULE"];
/// What only a run makes.
const MADE: [&str; 1] = ["fuzz/artifacts/"];
/// Pages whose links are not of their own folder: a text that another page is made of, and a site
/// whose links its own tests follow.
const LINKED_ELSEWHERE: [&str; 2] =
    ["research/experiments/page.md", "crates/quasilux-python/docs/"];

/// Links of a page of Markdown that lead nowhere. `path` is that of the page below `root`.
pub(crate) fn broken_links(root: &Path, path: &str, page: &str) -> Vec<Violation> {
    if LINKED_ELSEWHERE.iter().any(|begin| path.starts_with(begin)) {
        return Vec::new();
    }
    let folder = root.join(path).parent().expect("a folder").to_owned();
    let mut violations = Vec::new();
    for (line, text) in prose(page) {
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            // Pages of HTML are made with the site.
            if target.contains("://") || target.contains(' ') || target.ends_with(".html") {
                continue;
            }
            let (file, heading) = target.split_once('#').unwrap_or((target, ""));
            let place = if file.is_empty() { root.join(path) } else { folder.join(file) };
            let is_there = place.exists()
                && (heading.is_empty() || headings(&place).iter().any(|it| it == heading));
            if !is_there {
                violations.push(format!("{path}:{line}: nothing at ]({target})"));
            }
        }
    }
    violations
}

/// Paths of the repository between code marks in `text`, a page or the comments of a source file,
/// at which nothing is.
pub(crate) fn gone_paths<'a>(
    root: &Path,
    path: &str,
    text: impl Iterator<Item = (usize, &'a str)>,
) -> Vec<Violation> {
    let folder = root.join(path).parent().expect("a folder").to_owned();
    let mut violations = Vec::new();
    for (line, text) in paragraphs(text) {
        for word in text.split('`').skip(1).step_by(2) {
            let is_path = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
            let is_named = FOLDERS.iter().any(|folder| word.starts_with(folder))
                && !STAND_INS.iter().any(|name| word.contains(name))
                && !MADE.contains(&word);
            // A crate's pages name its own folders, too.
            let mut places = [root, folder.as_path()].into_iter().chain(folder.ancestors().take(3));
            if is_named && word.chars().all(is_path) && !places.any(|it| it.join(word).exists()) {
                violations.push(format!("{path}:{line}: nothing at `{word}`"));
            }
        }
    }
    violations
}

/// Source files between code marks in `text`, by the last part of their path, that are no end of a
/// path of `sources`.
pub(crate) fn gone_sources<'a>(
    sources: &[RustFile],
    path: &str,
    text: impl Iterator<Item = (usize, &'a str)>,
) -> Vec<Violation> {
    let is_path = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    let is_there = |word: &str| sources.iter().any(|file| file.path.ends_with(&format!("/{word}")));
    let mut violations = Vec::new();
    for (line, text) in paragraphs(text) {
        for word in text.split('`').skip(1).step_by(2) {
            let is_whole = FOLDERS.iter().any(|folder| word.starts_with(folder));
            let is_named = word.ends_with(".rs") && word.contains('/') && word.chars().all(is_path);
            if is_named && !is_whole && !is_there(word) {
                violations.push(format!("{path}:{line}: no source file `{word}`"));
            }
        }
    }
    violations
}

/// Calls of `cargo test` in `text` whose filter picks no test of the crate that they name: it is in
/// no path of a file with tests, and in no name of a test there.
pub(crate) fn idle_filters<'a>(
    sources: &[RustFile],
    path: &str,
    text: impl Iterator<Item = (usize, &'a str)>,
) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (line, text) in paragraphs(text) {
        for (place, call) in text.match_indices("cargo test ") {
            let (before, after) = (&text[..place], &text[place + call.len()..]);
            let end = if before.matches('`').count() % 2 == 1 { '`' } else { '\n' };
            let Some((package, filter)) = package_and_filter(after.split(end).next().unwrap())
            else {
                continue;
            };
            if !sources.iter().any(|file| picks(file, package, filter)) {
                violations.push(format!("{path}:{line}: `{filter}` picks no test"));
            }
        }
    }
    violations
}

/// The crate and the filter of a call of `cargo test` with these arguments, where it has both.
fn package_and_filter(arguments: &str) -> Option<(&str, &str)> {
    let (mut package, mut filter) = (None, None);
    let mut words = arguments.split_whitespace().take_while(|word| *word != "--");
    while let Some(word) = words.next() {
        match word {
            "-p" | "--package" => package = words.next(),
            "--test" | "--profile" | "--example" | "--bin" => drop(words.next()),
            word if word.starts_with('-') => {}
            word => filter = Some(word),
        }
    }
    package.zip(filter)
}

fn picks(file: &RustFile, package: &str, filter: &str) -> bool {
    let Some((_, below)) = file.path.split_once(&format!("/{package}/")) else { return false };
    let mut attributed = file.text.split("#[test]").skip(1);
    let is_tested = attributed.clone().next().is_some();
    let name = |item: &str| {
        let after = item.split_once("fn ").map_or("", |(_, after)| after);
        after.split('(').next().unwrap_or_default().contains(filter)
    };
    is_tested && (below.contains(filter) || attributed.any(name))
}

/// Lines that follow each other, put together, with the number of the first.
fn paragraphs<'a>(lines: impl Iterator<Item = (usize, &'a str)>) -> Vec<(usize, String)> {
    let mut paragraphs: Vec<(usize, String)> = Vec::new();
    let mut last = 0;
    for (number, line) in lines.filter(|(_, line)| !line.trim().is_empty()) {
        match paragraphs.last_mut() {
            Some((_, paragraph)) if number == last + 1 => {
                paragraph.push('\n');
                paragraph.push_str(line);
            }
            _ => paragraphs.push((number, line.to_owned())),
        }
        last = number;
    }
    paragraphs
}

/// The lines of a page that are not code, with their numbers.
pub(crate) fn prose(page: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut fence: Option<&str> = None;
    page.lines().enumerate().filter_map(move |(number, line)| {
        let opened = ["```", "~~~"].into_iter().find(|fence| line.trim_start().starts_with(fence));
        match (fence, opened) {
            (None, Some(_)) => fence = opened,
            (Some(open), Some(closed)) if open == closed => fence = None,
            (None, None) if !line.starts_with("    ") => return Some((number + 1, line)),
            _ => {}
        }
        None
    })
}

/// The comments of a source file that `rustdoc` shows, with the numbers of their lines.
pub(crate) fn documentation(source: &str) -> impl Iterator<Item = (usize, &str)> {
    source.lines().enumerate().filter_map(|(number, line)| {
        let line = line.trim_start();
        let text = line.strip_prefix("//!").or_else(|| line.strip_prefix("///"))?;
        Some((number + 1, text))
    })
}

/// The headings of a page as links name them: small letters, figures and hyphens.
fn headings(page: &Path) -> Vec<String> {
    let text = fs::read_to_string(page).unwrap_or_default();
    let slug = |heading: &str| -> String {
        let kept = heading.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
        kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
    };
    let titles = prose(&text).filter(|(_, line)| line.starts_with('#'));
    titles.map(|(_, line)| slug(line.trim_start_matches('#').trim())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::workspace;

    #[test]
    fn a_link_to_nowhere_is_found() {
        let page = "[a](README.md), [b](#what-it-is), [c](gone.md)\n\n## What it is\n\n\
                    \x20   [d](no)\n```\n[e](no)\n```\n[f](https://a.b) [g](README.md#gone)\n";
        let found = broken_links(&workspace(), "README.md", page);
        // The page that stands there has no such heading.
        let [own, file, heading] = &found[..] else { panic!("{found:?}") };
        assert!(own.ends_with("](#what-it-is)") && file.ends_with("](gone.md)"), "{found:?}");
        assert_eq!(heading, "README.md:9: nothing at ](README.md#gone)");
    }

    #[test]
    fn a_filter_that_picks_no_test_is_found() {
        let tests = "#[test]\nfn a_cube_is_bright() {}\n";
        let sources = [RustFile::new("crates/a/src/cube.rs", tests)];
        let page = "cargo test --release -p a bright\ncargo test -p a --lib cube -- --nocapture\n\n\
                    `cargo test -p a` is all, `cargo test -p\na dark` nothing, as with\n\n\
                    cargo test -p b cube\n";
        let lines = page.lines().enumerate();
        let found = idle_filters(&sources, "a.md", lines);
        assert_eq!(found, ["a.md:3: `dark` picks no test", "a.md:6: `cube` picks no test"]);
    }

    #[test]
    fn a_path_that_is_gone_is_found() {
        let text =
            "/// `docs/gone.md`, `docs/`, `docs/NAME*` and `xtask/src/main.rs`\nlet a = 1;\n";
        let found = gone_paths(&workspace(), "xtask/src/lib.rs", documentation(text));
        assert_eq!(found, ["xtask/src/lib.rs:1: nothing at `docs/gone.md`"]);
    }

    #[test]
    fn a_source_file_that_is_gone_is_found() {
        let sources = [RustFile::new("crates/a/src/path/trace.rs", "")];
        let page = "`path/trace.rs` and `trace.rs`, `stats/trace.rs`\n";
        let found = gone_sources(&sources, "a.md", page.lines().enumerate());
        assert_eq!(found, ["a.md:0: no source file `stats/trace.rs`"]);
    }
}
