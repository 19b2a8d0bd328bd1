//! Known violations of a rule, which may only become fewer.
//!
//! The list `xtask/ratchet/RULE.txt` has a line for each: how often, and a key that holds no line
//! numbers. A violation that is not listed fails the test, and so does a listed one that is gone.
//! `cargo xtask ratchet` writes the lists anew and refuses a sum that grows. Where a list is empty,
//! its file is deleted, and the rule holds without exception.

use crate::modules::{arrows::Graph, rules, targets};
use crate::packages;
use crate::style::{files, functions, openers, width, words};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Places of the violations of a rule by their keys.
pub type Violations = BTreeMap<String, Vec<String>>;

/// A rule about the sources.
pub struct Rule {
    /// Name of its list.
    pub name: &'static str,
    /// Finds the violations in the workspace at a path.
    pub find: fn(&Path) -> Result<Violations, String>,
}

/// All rules that may have a list.
pub const RULES: [Rule; 7] = [
    Rule { name: "order", find: against_the_order },
    Rule { name: "long_functions", find: long_functions },
    Rule { name: "tuples", find: unlike_tuples },
    Rule { name: "packages", find: lacking_packages },
    Rule { name: "width", find: long_lines },
    Rule { name: "openers", find: vague_openers },
    Rule { name: "old_words", find: old_words },
];

/// Reads the import graphs of all crates of a workspace.
///
/// # Errors
/// When a file is missing or is not Rust.
pub fn graphs(root: &Path) -> Result<Vec<Graph>, String> {
    let read = |path: &str| fs::read_to_string(root.join(path)).ok();
    targets::of_workspace(root)?.iter().map(|target| Graph::read(target, &read)).collect()
}

/// The orders of the rooms, from `xtask/order.toml`.
///
/// # Errors
/// When the file is missing or malformed.
pub fn orders(root: &Path) -> Result<rules::Orders, String> {
    let path = root.join("xtask/order.toml");
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    rules::parse_orders(&text)
}

fn against_the_order(root: &Path) -> Result<Violations, String> {
    let (graphs, orders) = (graphs(root)?, orders(root)?);
    let violations = graphs.iter().flat_map(|graph| rules::violations(graph, &orders));
    let strangers = orders.keys().filter(|name| graphs.iter().all(|g| g.tree.crate_name != **name));
    let mut found: Violations =
        strangers.map(|name| (format!("{name}: no such crate"), Vec::new())).collect();
    found.extend(violations.map(|violation| (violation.key, violation.places)));
    // However many imports join two rooms, it is one arrow: its number may change freely.
    found.values_mut().for_each(|places| *places = vec![places.join("\n    ")]);
    Ok(found)
}

/// Functions of too many lines, by file and name.
fn long_functions(root: &Path) -> Result<Violations, String> {
    let functions = of_all_crates(root)?.into_iter();
    Ok(grouped(functions.filter(|function| function.lines > functions::MAX_LINES).map(
        |function| {
            let place = format!("{}:{}: {} lines", function.file, function.line, function.lines);
            (format!("{}: {}", function.file, function.name), place)
        },
    )))
}

/// Tuples of unlike types in signatures, by file and function.
fn unlike_tuples(root: &Path) -> Result<Violations, String> {
    let functions = of_all_crates(root)?.into_iter();
    Ok(grouped(functions.flat_map(|function| {
        let key = format!("{}: {}", function.file, function.name);
        let place = format!("{}:{}: ", function.file, function.line);
        let found: Vec<_> = function.tuples.iter().map(|t| format!("{place}{t}")).collect();
        found.into_iter().map(move |place| (key.clone(), place))
    })))
}

/// Files and keys that crates lack before others can take them, by crate and name.
fn lacking_packages(root: &Path) -> Result<Violations, String> {
    Ok(grouped(packages::of_workspace(root)?.into_iter().flat_map(|package| {
        let tell = |missing| (format!("{}: {missing}", package.name), "is missing".to_owned());
        package.missing.iter().map(tell).collect::<Vec<_>>()
    })))
}

/// Lines of too many columns, by file.
fn long_lines(root: &Path) -> Result<Violations, String> {
    let files = files::of_workspace(root, &[".rs", ".md"])?;
    Ok(grouped(files.into_iter().flat_map(|file| {
        let lines = width::long_lines(&file).into_iter();
        lines.map(move |line| (file.path.clone(), format!("{}:{line}", file.path)))
    })))
}

/// Documentation that opens without a noun, by file.
fn vague_openers(root: &Path) -> Result<Violations, String> {
    let files = files::of_workspace(root, &[".rs"])?;
    Ok(grouped(files.into_iter().flat_map(|file| {
        let lines = openers::vague_openers(&file).into_iter();
        lines.map(move |line| (file.path.clone(), format!("{}:{line}", file.path)))
    })))
}

/// Old words by file and word, and exceptions that no file needs.
fn old_words(root: &Path) -> Result<Violations, String> {
    let path = root.join("xtask/old_words.toml");
    let text = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let list = words::OldWords::parse(&text)?;
    let mut files = files::of_workspace(root, &[".rs", ".md", ".toml", ".yml"])?;
    files.retain(|file| file.path != "CHANGELOG.md" && file.path != "xtask/old_words.toml");
    let idle = list.idle_exceptions(&files).into_iter();
    let mut found: Violations = idle.map(|exception| (exception, Vec::new())).collect();
    for file in &files {
        for words::Leftover { word, line, new } in list.leftovers(file)? {
            let place = format!("{}:{line}: `{word}` is called {new}", file.path);
            found.entry(format!("{}: {word}", file.path)).or_default().push(place);
        }
    }
    Ok(found)
}

fn of_all_crates(root: &Path) -> Result<Vec<functions::Function>, String> {
    let graphs = graphs(root)?;
    Ok(graphs.iter().flat_map(|graph| functions::of_crate(&graph.tree)).collect())
}

/// Places by key.
fn grouped(places: impl Iterator<Item = (String, String)>) -> Violations {
    let mut found = Violations::new();
    places.for_each(|(key, place)| found.entry(key).or_default().push(place));
    found
}

/// What differs between the violations found and those listed, one line each.
#[must_use]
pub fn differences(found: &Violations, listed: &BTreeMap<String, usize>) -> Vec<String> {
    let mut told = Vec::new();
    for (key, places) in found {
        let count = places.len().max(1);
        match listed.get(key) {
            Some(&known) if known == count => {}
            Some(&known) if known > count => {
                told.push(format!("{key}: {count} left of {known}: run `cargo xtask ratchet`"));
            }
            _ => told.push(format!("{key}\n    {}", places.join("\n    "))),
        }
    }
    for key in listed.keys().filter(|key| !found.contains_key(*key)) {
        told.push(format!("{key}: is gone: run `cargo xtask ratchet`"));
    }
    told
}

/// The list of a rule, empty where there is no file.
///
/// # Errors
/// When a line is not a number and a key.
pub fn listed(root: &Path, rule: &str) -> Result<BTreeMap<String, usize>, String> {
    let text = fs::read_to_string(file(root, rule)).unwrap_or_default();
    let entry = |line: &str| {
        let (count, key) = line.split_once(' ')?;
        Some((key.to_owned(), count.parse().ok()?))
    };
    text.lines().map(|line| entry(line).ok_or(format!("{rule}.txt: {line:?}"))).collect()
}

/// Writes the list of each rule anew; `may_grow` where a rule is new.
///
/// # Errors
/// When a sum grows, or a file cannot be written.
pub fn write(root: &Path, may_grow: bool) -> Result<(), String> {
    for rule in &RULES {
        let found = (rule.find)(root)?;
        let known: usize = listed(root, rule.name)?.values().sum();
        let now: usize = found.values().map(|places| places.len().max(1)).sum();
        println!("xtask: {}: {known} before, {now} now", rule.name);
        if now > known && !may_grow {
            let new = differences(&found, &listed(root, rule.name)?).join("\n");
            return Err(format!("{} has grown\n{new}", rule.name));
        }
        let line =
            |(key, places): (&String, &Vec<String>)| format!("{} {key}\n", places.len().max(1));
        let path = file(root, rule.name);
        let outcome = if found.is_empty() {
            fs::remove_file(&path).or(Ok(()))
        } else {
            fs::create_dir_all(root.join("xtask/ratchet"))
                .and_then(|()| fs::write(&path, found.iter().map(line).collect::<String>()))
        };
        outcome.map_err(|error: std::io::Error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

fn file(root: &Path, rule: &str) -> PathBuf {
    root.join("xtask/ratchet").join(format!("{rule}.txt"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn new_more_fewer_and_vanished_violations_are_told_and_known_ones_are_not() {
        let two = vec!["a.rs:1".to_owned(), "a.rs:2".to_owned()];
        let found = Violations::from([("a".to_owned(), two)]);
        let told = |known: &[(&str, usize)]| {
            let listed = known.iter().map(|(key, count)| ((*key).to_owned(), *count)).collect();
            differences(&found, &listed)
        };
        assert_eq!(told(&[("a", 2)]), [""; 0]);
        assert!(told(&[])[0].contains("a.rs:1"));
        assert!(told(&[("a", 1)])[0].contains("a.rs:2"));
        assert!(told(&[("a", 3)])[0].contains("2 left of 3"));
        assert!(told(&[("a", 2), ("b", 1)])[0].contains("b: is gone"));
    }
}
