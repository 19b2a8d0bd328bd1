//! Lines over 100 columns, in code, comments and pages.

use super::files::TextFile;

/// Most characters of a line.
pub const MAX_COLUMNS: usize = 100;

/// The numbers of the long lines of a Rust or Markdown file. Rows of tables, lines with a link or a
/// placeholder `{{..}}`, and code on pages may be long.
#[must_use]
pub fn long_lines(file: &TextFile) -> Vec<usize> {
    let is_page = file.path.ends_with(".md");
    let mut is_fenced = false;
    let mut found = Vec::new();
    for (i, line) in file.text.lines().enumerate() {
        let prose = line.trim_start().trim_start_matches(['/', '!']).trim_start();
        let is_fence = prose.starts_with("```");
        is_fenced ^= is_fence && is_page;
        let is_code = is_page && (is_fenced || is_fence || line.starts_with("    "));
        let is_row = prose.starts_with('|') && (is_page || line.trim_start().starts_with("//"));
        let has_link =
            line.contains("://") || (is_page && (line.contains("](") || line.contains("{{")));
        if line.chars().count() > MAX_COLUMNS && !is_code && !is_row && !has_link {
            found.push(i + 1);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(path: &str, text: &str) -> Vec<usize> {
        long_lines(&TextFile { path: path.to_owned(), text: text.to_owned() })
    }

    #[test]
    fn long_lines_are_rejected_in_comments_code_and_prose() {
        let long = "é".repeat(MAX_COLUMNS - 3);
        for (path, start) in [
            ("a.rs", "//! "),
            ("a.rs", "/// "),
            ("a.rs", "let "),
            ("a.rs", "    "),
            ("a.md", "and "),
        ] {
            assert_eq!(found(path, &format!("short\n{start}{long}\n")), [2], "{path} {start}");
            assert_eq!(found(path, &format!("{start}{}", &long[2..])), [0; 0], "{path} {start}");
        }
        assert_eq!(found("a.md", &format!("```\n{long}xxxx\n```\nand {long}")), [4]);
    }

    #[test]
    fn tables_links_and_code_on_pages_are_allowed() {
        let long = "x".repeat(MAX_COLUMNS);
        for (path, text) in [
            ("a.rs", format!("//! | {long} |")),
            ("a.rs", format!("// https://{long}")),
            ("a.md", format!("| {long} |")),
            ("a.md", format!("[paper]({long})")),
            ("a.md", format!("{{{{{long}}}}}")),
            ("a.md", format!("```\n{long}x\n```")),
            ("a.md", format!("    {long}")),
        ] {
            assert_eq!(found(path, &text), [0; 0], "{path}: {text}");
        }
    }
}
