//! Markdown paragraphs filled to the width that the style test allows.

use xtask::style::width::MAX_COLUMNS;

/// The page with every paragraph and list item filled to [`MAX_COLUMNS`] characters. Headings, rows
/// of tables, quotations, references and code keep their lines. A line breaks at spaces, but never
/// within a span of code.
pub(crate) fn wrap(page: &str) -> String {
    let mut wrapped = String::new();
    let mut block: Vec<&str> = Vec::new();
    let mut is_code = false;
    for line in page.lines() {
        let is_fence = line.trim_start().starts_with("```");
        let stands_alone = is_code || is_fence || stands_alone(line);
        if stands_alone || item_indent(line).is_some() {
            fill(&block, &mut wrapped);
            block.clear();
        }
        is_code ^= is_fence;
        if stands_alone {
            wrapped += line;
            wrapped.push('\n');
        } else {
            block.push(line);
        }
    }
    fill(&block, &mut wrapped);
    wrapped
}

/// Whether a line is none of a paragraph or list item.
fn stands_alone(line: &str) -> bool {
    let text = line.trim_start();
    text.is_empty() || text.starts_with(['|', '#', '<', '>']) || text.starts_with("![")
}

/// The column at which the text of a list item begins.
fn item_indent(line: &str) -> Option<usize> {
    let text = line.trim_start();
    let number = text.trim_start_matches(|c: char| c.is_ascii_digit());
    let is_numbered = number.len() < text.len() && number.starts_with(". ");
    let mark = if is_numbered { text.len() - number.len() + 2 } else { 2 };
    let is_item = is_numbered || text.starts_with("- ") || text.starts_with("* ");
    is_item.then_some(line.len() - text.len() + mark)
}

fn fill(block: &[&str], wrapped: &mut String) {
    let Some(first) = block.first() else { return };
    let own_indent = first.len() - first.trim_start().len();
    let indent = item_indent(first).unwrap_or(own_indent);
    let text = block.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ");
    let mut columns = own_indent;
    *wrapped += &" ".repeat(own_indent);
    for (i, word) in words(&text).into_iter().enumerate() {
        let length = word.chars().count();
        if i > 0 && columns + 1 + length > MAX_COLUMNS {
            *wrapped += &format!("\n{}", " ".repeat(indent));
            columns = indent;
        } else if i > 0 {
            wrapped.push(' ');
            columns += 1;
        }
        *wrapped += word;
        columns += length;
    }
    wrapped.push('\n');
}

/// The text cut at spaces outside of spans of code and placeholders `{{..}}`.
fn words(text: &str) -> Vec<&str> {
    let mut words = Vec::new();
    let mut start = 0;
    let mut is_code = false;
    let mut braces = 0_usize;
    for (i, c) in text.char_indices() {
        match c {
            '`' => is_code = !is_code,
            '{' => braces += 1,
            '}' => braces = braces.saturating_sub(1),
            ' ' if !is_code && braces == 0 => {
                words.push(&text[start..i]);
                start = i + 1;
            }
            _ => {}
        }
    }
    words.push(&text[start..]);
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_paragraphs_are_filled_and_words_kept() {
        let text = "some `code that stays` ".repeat(20);
        let wrapped = wrap(text.trim());
        assert!(wrapped.lines().count() > 3);
        for line in wrapped.lines() {
            assert!(line.chars().count() <= MAX_COLUMNS, "{line}");
            assert_eq!(line.matches('`').count() % 2, 0, "{line}");
        }
        assert_eq!(wrapped.split_whitespace().count(), text.split_whitespace().count());
    }

    #[test]
    fn items_hang_and_rows_and_code_stay() {
        let long = "word ".repeat(30);
        let item = format!("- {}", long.trim());
        assert!(wrap(&item).lines().skip(1).all(|line| line.starts_with("  word")));
        for kept in [format!("| {long}|\n"), format!("```\n{long}\n```\n")] {
            assert_eq!(wrap(&kept), kept);
        }
        assert_eq!(wrap("a\nb\n\nc"), "a b\n\nc\n");
        let two = format!("{item}\n{item}");
        assert_eq!(wrap(&two).lines().filter(|line| line.starts_with("- ")).count(), 2);
    }
}
