//! The texts for people in Python: literals of more than a word, those that stand beside each other
//! joined. Comments and documentation, which stands in three quotes, are left out.

use super::is_text;

/// The texts of a file, in their order.
#[must_use]
pub fn of_text(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    let mut rest = text;
    // Whether only white space stands between a literal and the one before.
    let mut goes_on = false;
    while let Some(at) = rest.find(['"', '\'', '#']) {
        goes_on &= is_joint(&rest[..at]);
        let opening = &rest[at..];
        if opening.starts_with('#') {
            rest = opening.split_once('\n').map_or("", |(_, rest)| rest);
            continue;
        }
        let quote = if opening.starts_with('"') { "\"" } else { "'" };
        let quotes = quote.repeat(3);
        let fence = if opening.starts_with(&quotes) { quotes.as_str() } else { quote };
        let body = &opening[fence.len()..];
        let length = length_up_to(body, fence);
        let literal = &body[..length];
        rest = body.get(length + fence.len()..).unwrap_or_default();
        match found.last_mut() {
            _ if fence.len() == 3 => goes_on = false,
            Some(last) if goes_on => last.push_str(literal),
            _ => {
                found.push(literal.to_owned());
                goes_on = true;
            }
        }
    }
    let unescaped = |literal: &String| literal.replace("\\\"", "\"");
    found.iter().map(unescaped).filter(|literal| is_text(literal, false)).collect()
}

/// Whether literals on both sides of this are one: nothing but space and the letters before quotes.
fn is_joint(between: &str) -> bool {
    matches!(between.trim(), "" | "f" | "r" | "rf" | "fr")
}

/// The length of a literal up to its closing quotes.
fn length_up_to(body: &str, fence: &str) -> usize {
    let mut at = 0;
    while at < body.len() && !body[at..].starts_with(fence) {
        let escape = if body[at..].starts_with('\\') { 1 } else { 0 };
        let mut characters = body[at..].chars();
        at += characters.by_ref().take(1 + escape).map(char::len_utf8).sum::<usize>();
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_are_joined_and_documentation_is_left_out() {
        let text = r#"
"""The head of a module."""
NAME = "name"
def f(a: str = 'no') -> None:  # don't "read this"
    '''Documentation "of f".'''
    raise ValueError(
        f"expected {a!r}, not "
        'a \"number\"'
    )
    warn("one text", "another text")
"#;
        let expected = ["expected {a!r}, not a \"number\"", "one text", "another text"];
        assert_eq!(of_text(text), expected);
    }
}
