//! Markdown as experiments write it: paragraphs filled to 100 columns.

/// Characters of a line, but for rows of tables and headings.
const COLUMNS: usize = 100;

/// The text with its paragraphs and list items filled. Blank lines, headings, rows of tables,
/// quotations and pictures keep their lines; spans of code are not broken.
pub(crate) fn filled(text: &str) -> String {
    let mut filled = String::new();
    let mut paragraph: Vec<&str> = Vec::new();
    for line in text.lines() {
        let stands_alone = line.is_empty() || line.starts_with(['|', '#', '<', '>', '!']);
        if stands_alone || line.starts_with("- ") {
            fill(&std::mem::take(&mut paragraph), &mut filled);
        }
        if stands_alone {
            filled += line;
            filled.push('\n');
        } else {
            paragraph.push(line.trim());
        }
    }
    fill(&paragraph, &mut filled);
    if !text.ends_with('\n') {
        filled.pop();
    }
    filled
}

fn fill(paragraph: &[&str], filled: &mut String) {
    let text = paragraph.join(" ");
    let indent = if text.starts_with("- ") { "\n  " } else { "\n" };
    let mut columns = 0;
    let mut is_code = false;
    // A word goes to the next space outside of code.
    for word in text.split(|c| {
        is_code ^= c == '`';
        c == ' ' && !is_code
    }) {
        let length = word.chars().count();
        if columns == 0 {
            columns = length;
        } else if columns + 1 + length > COLUMNS {
            *filled += indent;
            columns = indent.len() - 1 + length;
        } else {
            filled.push(' ');
            columns += 1 + length;
        }
        *filled += word;
    }
    if !paragraph.is_empty() {
        filled.push('\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paragraphs_are_filled_and_tables_kept() {
        let word = "abcdefghi";
        let row = format!("| {} |", [word; 12].join(" "));
        let long = [word; 11].join(" ");
        let text = format!("# title\n\n{long}\nend\n{row}\n\n- {long}\n- `{long}`");
        let ten = [word; 10].join(" ");
        let nine = [word; 9].join(" ");
        assert_eq!(
            filled(&text),
            format!(
                "# title\n\n{ten}\n{word} end\n{row}\n\n- {nine}\n  {word} {word}\n-\n  `{long}`"
            )
        );
    }

    #[test]
    fn stored_pages_are_filled() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../experiments");
        for experiment in &crate::EXPERIMENTS {
            let path = folder.join(format!("{}.md", experiment.name));
            let page = std::fs::read_to_string(&path).expect("a stored page");
            let (text, _digests) = page.split_once("\n<!-- ").expect("digests at the end");
            assert!(filled(text) == text, "{} has lines to be filled", path.display());
        }
    }
}
