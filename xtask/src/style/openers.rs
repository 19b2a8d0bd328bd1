//! Documentation that does not begin with the noun that it is about.

use super::files::TextFile;

/// What such documentation begins with: pronouns for a thing that is named elsewhere, or nowhere.
const OPENERS: [&str; 8] =
    ["The same", "What", "Those", "Such", "Somebody", "Nobody", "So many", "This many"];

/// The numbers of the lines of a Rust file with which documentation of an item opens so.
#[must_use]
pub fn vague_openers(file: &TextFile) -> Vec<usize> {
    let mut found = Vec::new();
    let mut is_inside = false;
    for (i, line) in file.text.lines().enumerate() {
        let documentation = line.trim_start().strip_prefix("///");
        if let Some(text) = documentation.filter(|_| !is_inside) {
            let opens = |opener: &&str| {
                let rest = text.trim_start().strip_prefix(*opener);
                rest.is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
            };
            if OPENERS.iter().any(opens) {
                found.push(i + 1);
            }
        }
        is_inside = documentation.is_some();
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_opens_documentation_is_rejected() {
        let text = [
            "/// What it is.",
            "/// The same",
            "let a = 1;",
            "",
            "/// Whatever.",
            "",
            "    /// The same of it.",
            "// What",
            "//! Those",
            "/// A thing.",
            "/// Such",
        ];
        let text = text.join("\n");
        let file = TextFile { path: "a.rs".to_owned(), text };
        assert_eq!(vague_openers(&file), [1, 7]);
    }
}
