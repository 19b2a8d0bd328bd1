//! Old words of the project that gave way to those of the field, and where they are left.
//!
//! `xtask/old_words.toml` is the list. An entry has the patterns `old`, in which `*` stands for any
//! letters, digits and underscores, the word to use in their place, `new`, and with `as` what is
//! looked at: `"text"`, all words of code, comments and pages; or the kinds of names that Rust
//! files declare, for words that are also plain English or belong to the standard library.
//! `within` confines an entry to files whose paths begin so, `allowed` excepts some, with the
//! reason.

use super::declarations::{self, Kind};
use super::files::TextFile;
use serde::Deserialize;
use std::collections::BTreeMap;

/// The list of old words.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OldWords {
    word: Vec<OldWord>,
}

/// An entry of the list.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OldWord {
    old: Vec<String>,
    new: String,
    #[serde(rename = "as")]
    scope: Scope,
    #[serde(default)]
    within: Vec<String>,
    /// Reasons by the beginnings of paths.
    #[serde(default)]
    allowed: BTreeMap<String, String>,
}

/// Which words of a file an entry looks at.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
enum Scope {
    Text(Text),
    Declared(Vec<Kind>),
}

#[derive(Clone, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Text {
    /// All words of a file.
    Text,
    /// All declared names.
    Name,
}

/// An old word in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leftover {
    /// The word as it stands there.
    pub word: String,
    /// Its line, from 1.
    pub line: usize,
    /// The word to use in its place.
    pub new: String,
}

impl OldWords {
    /// Reads the list.
    ///
    /// # Errors
    /// When it is malformed, or an exception has no reason.
    pub fn parse(text: &str) -> Result<Self, String> {
        let list: Self = toml::from_str(text).map_err(|error| error.to_string())?;
        for word in &list.word {
            if let Some((path, _)) = word.allowed.iter().find(|(_, why)| why.trim().is_empty()) {
                return Err(format!("{:?} is allowed in {path} without a reason", word.old));
            }
        }
        Ok(list)
    }

    /// The exceptions that no file needs, as told to the reader.
    #[must_use]
    pub fn idle_exceptions(&self, files: &[TextFile]) -> Vec<String> {
        let exceptions =
            self.word.iter().flat_map(|word| word.allowed.keys().map(move |path| (word, path)));
        let is_idle = |(word, path): &(&OldWord, &String)| {
            let strict = OldWord { allowed: BTreeMap::new(), ..(*word).clone() };
            let strict = Self { word: vec![strict] };
            let mut inside = files.iter().filter(|file| file.path.starts_with(path.as_str()));
            inside.all(|file| strict.leftovers(file).is_ok_and(|found| found.is_empty()))
        };
        let idle = exceptions.filter(is_idle);
        idle.map(|(word, path)| format!("{:?} is not in {path}", word.old)).collect()
    }

    /// The old words that are left in a Rust file or in a page.
    ///
    /// # Errors
    /// When a Rust file is malformed.
    pub fn leftovers(&self, file: &TextFile) -> Result<Vec<Leftover>, String> {
        let starts = |path: &String| file.path.starts_with(path.as_str());
        let mut entries: Vec<&OldWord> = self.word.iter().collect();
        entries.retain(|word| word.within.is_empty() || word.within.iter().any(starts));
        entries.retain(|word| !word.allowed.keys().any(starts));
        let mut found = Vec::new();
        for (index, line) in file.text.lines().enumerate() {
            let is_part = |c: char| c.is_alphanumeric() || c == '_';
            for word in line.split(|c| !is_part(c)).filter(|word| !word.is_empty()) {
                let texts = entries.iter().filter(|it| matches!(it.scope, Scope::Text(Text::Text)));
                found.extend(OldWord::first(texts, word, index + 1));
            }
        }
        if file.path.ends_with(".rs") {
            let declared = declarations::of_file(&file.text)
                .map_err(|error| format!("{}: {error}", file.path))?;
            for declaration in declared {
                let named = entries.iter().filter(|it| it.scope.declares(declaration.kind));
                found.extend(OldWord::first(named, &declaration.name, declaration.line));
            }
        }
        Ok(found)
    }
}

impl OldWord {
    fn first<'a>(
        mut entries: impl Iterator<Item = &'a &'a Self>,
        word: &str,
        line: usize,
    ) -> Option<Leftover> {
        let entry = entries.find(|entry| entry.old.iter().any(|old| is_match(old, word)))?;
        Some(Leftover { word: word.to_owned(), line, new: entry.new.clone() })
    }
}

impl Scope {
    fn declares(&self, kind: Kind) -> bool {
        match self {
            Self::Text(Text::Text) => false,
            Self::Text(Text::Name) => true,
            Self::Declared(kinds) => kinds.contains(&kind),
        }
    }
}

/// Whether a word matches a pattern, in which each `*` stands for any part of a word.
fn is_match(pattern: &str, word: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == word,
        Some((start, rest)) => word.strip_prefix(start).is_some_and(|tail| {
            let mut ends = (0..=tail.len()).filter(|&i| tail.is_char_boundary(i));
            ends.any(|i| is_match(rest, &tail[i..]))
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = r#"
        [[word]]
        old = ["Perch", "*divined*"]
        new = "RayOrigin, predicted"
        as = "text"
        allowed = { "a/renamed.rs" = "refuses the option" }

        [[word]]
        old = ["of", "ask_*"]
        new = "new"
        as = ["function"]

        [[word]]
        old = ["signs"]
        new = "symmetry"
        as = "name"
        within = ["tables/"]
    "#;

    fn found(path: &str, text: &str) -> Vec<(usize, String)> {
        let file = TextFile { path: path.to_owned(), text: text.to_owned() };
        let found = OldWords::parse(LIST).unwrap().leftovers(&file).unwrap();
        found.into_iter().map(|leftover| (leftover.line, leftover.word)).collect()
    }

    #[test]
    fn old_words_are_rejected_in_comments_code_pages_and_declarations() {
        for (path, text, word) in [
            ("a.rs", "\n// A Perch point.", "Perch"),
            ("a.rs", "\nfn f(divined_lx: f64) {}", "divined_lx"),
            ("a.rs", "\nimpl A { fn of() {} }", "of"),
            ("a.rs", "\n#[test]\nfn ask_two() {}", "ask_two"),
            ("a.md", "\nwas divined.", "divined"),
            ("tables/a.rs", "\n\nfn f() { let signs = 1; }", "signs"),
        ] {
            let found = found(path, text);
            assert_eq!(found.len(), 1, "{path}: {text}: {found:?}");
            assert_eq!(found[0].1, word, "{path}: {text}");
            assert!(found[0].0 >= 2, "{path}: {text}");
        }
    }

    #[test]
    fn other_words_plain_english_and_excepted_files_are_allowed() {
        for (path, text) in [
            ("a.rs", "// One of three Perches, asked.\nfn f() { a.of(); }"),
            ("a/renamed.rs", "// Perch"),
            ("a.rs", "fn signs() {}"),
            ("tables/a.md", "Two signs of rain."),
            ("a.md", "fn of() {}"),
        ] {
            assert_eq!(found(path, text), [], "{path}: {text}");
        }
    }

    #[test]
    fn exceptions_without_a_reason_and_those_that_nothing_needs_are_told() {
        let no_reason = LIST.replace("refuses the option", " ");
        assert!(OldWords::parse(&no_reason).is_err());
        let list = OldWords::parse(LIST).unwrap();
        let file = |text: &str| TextFile { path: "a/renamed.rs".to_owned(), text: text.to_owned() };
        assert_eq!(list.idle_exceptions(&[file("// Perch")]), [""; 0]);
        assert_eq!(list.idle_exceptions(&[file("// RayOrigin")]).len(), 1);
    }
}
