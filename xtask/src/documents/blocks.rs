//! The blocks of a Markdown text that are code: fenced ones, and indented ones.

/// A block of code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Block {
    /// Line of its first line of code, counted from 1.
    pub(super) line: usize,
    /// Language of a fenced block, `None` of an indented one.
    pub(super) language: Option<String>,
    pub(super) lines: Vec<String>,
    /// The paragraph before it.
    pub(super) said_before: String,
}

/// All blocks of a text, in its order.
pub(super) fn blocks(text: &str) -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut paragraph = String::new();
    // Behind a blank line or a block.
    let mut is_fresh = true;
    let mut lines = text.lines().enumerate().peekable();
    while let Some((number, line)) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let body = lines.by_ref().map(|(_, line)| line).take_while(|line| *line != "```");
            blocks.push(Block {
                line: number + 2,
                language: Some(language.to_owned()),
                lines: body.map(str::to_owned).collect(),
                said_before: paragraph.clone(),
            });
            is_fresh = true;
        } else if let (true, Some(first)) = (is_fresh, line.strip_prefix("    ")) {
            let mut body = vec![first.to_owned()];
            while let Some((_, next)) = lines.next_if(|(_, line)| line.starts_with("    ")) {
                body.push(next[4..].to_owned());
            }
            let said_before = paragraph.clone();
            blocks.push(Block { line: number + 1, language: None, lines: body, said_before });
            is_fresh = true;
        } else {
            let is_blank = line.trim().is_empty();
            if !is_blank && is_fresh {
                paragraph.clear();
            }
            paragraph += line;
            paragraph.push('\n');
            // Indented lines go on with a paragraph, and not with a heading.
            is_fresh = is_blank || line.starts_with('#');
        }
    }
    blocks
}

impl Block {
    /// The last name in backquotes of the paragraph before that ends so.
    pub(super) fn name_before(&self, ending: &str) -> Option<&str> {
        let mut quoted = self.said_before.split('`').skip(1).step_by(2);
        let names: Vec<&str> = quoted.by_ref().filter(|name| name.ends_with(ending)).collect();
        names.last().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "Kept as `a.toml`, not `b.toml`:\n\n```toml\n[scene]\n\nup = \"z\"\n```\n\
        Run\n\n    quasilux run\n    quasilux man\n\n\
        which says\n\n```\nyes\n```\n- a list\n    goes on\n";

    #[test]
    fn fenced_and_indented_blocks_are_found() {
        let found = blocks(TEXT);
        let seen: Vec<(usize, Option<&str>, usize)> =
            found.iter().map(|b| (b.line, b.language.as_deref(), b.lines.len())).collect();
        assert_eq!(seen, [(4, Some("toml"), 3), (10, None, 2), (16, Some(""), 1)]);
        assert_eq!(found[0].name_before(".toml"), Some("b.toml"));
        assert_eq!(found[1].lines, ["quasilux run", "quasilux man"]);
        assert_eq!(found[1].name_before(".toml"), None);
        assert_eq!(found[2].said_before, "which says\n\n");
    }
}
