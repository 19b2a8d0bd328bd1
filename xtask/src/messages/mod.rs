//! All texts that a user can see, as the sources have them: `xtask/messages.txt`, for people who
//! judge the English.
//!
//! [`rust`] collects them from Rust, [`python`] from Python. `cargo xtask messages` writes the list
//! anew, and the architecture test compares: no text comes in, goes or changes unless the list
//! does.
//! In it `{}` and `{name}` stand for values, and texts of a file stand in the order of the file.

pub mod python;
pub mod rust;

use crate::ratchet;
use crate::style::files;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Where the list is, from the workspace's root.
pub const LIST: &str = "xtask/messages.txt";

const HEAD: &str = "\
# All texts that a user can see, file by file; {} and {name} stand for values.
# Written by `cargo xtask messages`; xtask/src/messages/ says what is collected.
";

/// Folders whose texts no user sees: tools for those who work on the program.
const UNSEEN: [&str; 3] =
    ["crates/quasilux-stats/", "crates/quasilux-corpus/", "research/quasilux-gauntlet/"];

/// The list as the sources of the workspace have it.
///
/// # Errors
/// When a file is missing or malformed.
pub fn of_workspace(root: &Path) -> Result<String, String> {
    let mut found: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for graph in ratchet::graphs(root)? {
        for module in &graph.tree.modules {
            found.entry(module.file.clone()).or_default().extend(rust::of_items(&module.items));
        }
    }
    for file in files::of_workspace(&root.join("crates"), &[".py"])? {
        let path = format!("crates/{}", file.path);
        if path.contains("/python/") {
            found.entry(path).or_default().extend(python::of_text(&file.text));
        }
    }
    let is_seen = |path: &str| {
        let is_package = path.starts_with("crates/") || path.starts_with("research/");
        is_package && !UNSEEN.iter().any(|folder| path.starts_with(folder))
    };
    found.retain(|path, texts| is_seen(path) && !texts.is_empty());
    Ok(HEAD.to_owned()
        + &found.iter().map(|(path, texts)| section(path, texts)).collect::<String>())
}

/// The texts of one file, each once, a line each.
fn section(path: &str, texts: &[String]) -> String {
    let mut known = BTreeSet::new();
    let fresh = texts.iter().filter(|text| known.insert(text.as_str()));
    let lines: String = fresh.map(|text| text.trim().replace('\n', "\\n") + "\n").collect();
    format!("\n## {path}\n{lines}")
}

/// Writes the list.
///
/// # Errors
/// When a file is missing or malformed, or the list cannot be written.
pub fn write(root: &Path) -> Result<(), String> {
    fs::write(root.join(LIST), of_workspace(root)?).map_err(|error| format!("{LIST}: {error}"))?;
    println!("xtask: wrote {LIST}");
    Ok(())
}

/// Differences of two lists, a line each.
#[must_use]
pub fn differences(listed: &str, found: &str) -> Vec<String> {
    let [listed, found] = [lines(listed), lines(found)];
    let gone = listed.difference(&found).map(|line| format!("no longer there: {line}"));
    let fresh = found.difference(&listed).map(|line| format!("not listed: {line}"));
    gone.chain(fresh).collect()
}

/// All texts with their files.
fn lines(list: &str) -> BTreeSet<String> {
    let mut path = "";
    let mut lines = BTreeSet::new();
    for line in list.lines() {
        match line.strip_prefix("## ") {
            Some(next) => path = next,
            None if !path.is_empty() && !line.is_empty() => {
                lines.insert(format!("{path}: {line}"));
            }
            None => {}
        }
    }
    lines
}

/// Whether a literal is a text for people: words, and not a name, a format or a piece of a file.
/// `is_message` where it is printed for sure, so that one word is enough.
fn is_text(literal: &str, is_message: bool) -> bool {
    let is_markup = literal.trim_start().starts_with('<') || literal.contains("=\"{");
    let plain = without_placeholders(literal);
    let trimmed =
        plain.split_whitespace().map(|word| word.trim_matches(|c: char| !c.is_alphanumeric()));
    let is_word = |word: &&str| {
        !word.is_empty() && word.chars().all(|c| c.is_alphabetic() || "-'.".contains(c))
    };
    let words: Vec<&str> = trimmed.filter(is_word).collect();
    let least = if is_message { 1 } else { 2 };
    let is_long = |word: &&str| word.chars().count() >= 2;
    !is_markup && literal.contains(' ') && words.len() >= least && words.iter().any(is_long)
}

/// A literal without the names in its `{..}`.
fn without_placeholders(literal: &str) -> String {
    let mut plain = String::new();
    let mut depth = 0;
    for character in literal.chars() {
        match character {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ if depth <= 0 => plain.push(character),
            _ => {}
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_words_and_not_names_or_formats() {
        for (literal, is_message, expected) in [
            ("no such command", false, true),
            ("Move it down", false, true),
            ("a number", false, true),
            (" samples", true, true),
            ("{count} of {all} points", false, true),
            ("{count} points", true, true),
            ("{count} points", false, false),
            ("workplane", true, false),
            ("{a} {b}", true, false),
            ("<text x=\"1\" y=\"2\">the text", true, false),
            ("fill=\"none\" width=\"{width}\" of a line", true, false),
            ("set kind = \"pane\" for it", false, true),
            ("M {} {} L {} {}", false, false),
        ] {
            assert_eq!(is_text(literal, is_message), expected, "{literal}");
        }
    }

    #[test]
    fn a_new_text_one_that_is_gone_and_a_changed_one_are_told() {
        let list = |texts: &[&str]| {
            let texts: Vec<String> = texts.iter().map(ToString::to_string).collect();
            HEAD.to_owned() + &section("a.rs", &texts)
        };
        let (old, new) = (list(&["one two", "three\nfour"]), list(&["one two", "three four"]));
        assert_eq!(differences(&old, &old), [""; 0]);
        let expected = ["no longer there: a.rs: three\\nfour", "not listed: a.rs: three four"];
        assert_eq!(differences(&old, &new), expected);
    }
}
