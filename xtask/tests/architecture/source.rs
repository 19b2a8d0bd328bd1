//! Rust source with comments, literals and test modules blanked out.
//!
//! Blanking keeps the line breaks, so that a position still names its line. This is a scanner, not
//! a parser: it knows comments, strings, raw strings, characters and lifetimes, and braces.

/// One source file.
#[derive(Clone, Debug)]
pub(crate) struct RustFile {
    /// Path from the workspace root, with slashes.
    pub(crate) path: String,
    /// The text as it stands.
    pub(crate) text: String,
    /// The text without comments and literals.
    pub(crate) code: String,
    /// The same without `#[cfg(test)]` modules and functions.
    pub(crate) shipped: String,
}

impl RustFile {
    /// Reads a file's text.
    pub(crate) fn new(path: &str, text: &str) -> Self {
        let code = without_comments_and_literals(text);
        let shipped = without_test_items(&code);
        Self { path: path.to_owned(), text: text.to_owned(), code, shipped }
    }
}

/// The places where `word` stands in `code` with no identifier character around it.
pub(crate) fn places<'a>(code: &'a str, word: &'a str) -> impl Iterator<Item = usize> + 'a {
    let continues = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(word).map(|(place, _)| place).filter(move |&place| {
        !code[..place].ends_with(continues) && !code[place + word.len()..].starts_with(continues)
    })
}

/// The number of the line that `place` is on.
pub(crate) fn line_of(code: &str, place: usize) -> usize {
    1 + code[..place].matches('\n').count()
}

/// The end of the bracketed part that opens at `open`, behind its closing bracket.
pub(crate) fn end_of_group(code: &str, open: usize) -> usize {
    let mut depth = 0_i32;
    for (i, byte) in code.bytes().enumerate().skip(open) {
        match byte {
            b'{' | b'(' | b'[' => depth += 1,
            b'}' | b')' | b']' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return i + 1;
        }
    }
    code.len()
}

fn without_comments_and_literals(text: &str) -> String {
    let bytes = text.as_bytes();
    let mut out = Vec::with_capacity(bytes.len());
    let mut i = 0;
    while i < bytes.len() {
        let end = i + blank_length(&bytes[i..], out.last().copied());
        if end == i {
            out.push(bytes[i]);
            i += 1;
        }
        while i < end.min(bytes.len()) {
            out.push(if bytes[i] == b'\n' { b'\n' } else { b' ' });
            i += 1;
        }
    }
    // Literals and comments are blanked byte by byte, so whole characters remain or vanish.
    String::from_utf8(out).unwrap()
}

/// Length of the comment or literal at the start of `rest`, 0 where there is none.
fn blank_length(rest: &[u8], before: Option<u8>) -> usize {
    let in_identifier = before.is_some_and(|b| b.is_ascii_alphanumeric() || b == b'_');
    match rest {
        [b'/', b'/', ..] => rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len()),
        [b'/', b'*', ..] => block_comment_length(rest),
        [b'"', ..] => quoted_length(rest, 0, b'"'),
        [b'b', b'"', ..] if !in_identifier => quoted_length(rest, 1, b'"'),
        [b'r', ..] if !in_identifier => raw_string_length(rest, 1),
        [b'b', b'r', ..] if !in_identifier => raw_string_length(rest, 2),
        [b'\'', b'\\', ..] => quoted_length(rest, 0, b'\''),
        // A lifetime has no quote behind its first character.
        [b'\'', first, ..] => {
            let length = match first {
                0xf0.. => 4,
                0xe0.. => 3,
                0xc0.. => 2,
                _ => 1,
            };
            if rest.get(1 + length) == Some(&b'\'') { 2 + length } else { 0 }
        }
        _ => 0,
    }
}

fn block_comment_length(rest: &[u8]) -> usize {
    let (mut depth, mut i) = (0, 0);
    while i + 1 < rest.len() {
        match (rest[i], rest[i + 1]) {
            (b'/', b'*') => (depth, i) = (depth + 1, i + 2),
            (b'*', b'/') => (depth, i) = (depth - 1, i + 2),
            _ => i += 1,
        }
        if depth == 0 {
            return i;
        }
    }
    rest.len()
}

fn quoted_length(rest: &[u8], open: usize, quote: u8) -> usize {
    let mut i = open + 1;
    while i < rest.len() && rest[i] != quote {
        i += if rest[i] == b'\\' { 2 } else { 1 };
    }
    i + 1
}

fn raw_string_length(rest: &[u8], prefix: usize) -> usize {
    let hashes = rest[prefix..].iter().take_while(|&&b| b == b'#').count();
    if rest.get(prefix + hashes) != Some(&b'"') {
        return 0;
    }
    let mut close = vec![b'"'];
    close.resize(1 + hashes, b'#');
    let body = prefix + hashes + 1;
    let found = rest[body..].windows(close.len()).position(|window| window == close);
    found.map_or(rest.len(), |at| body + at + close.len())
}

/// Blanks the item behind each `#[cfg(test)]`, from the attribute to its brace or semicolon.
fn without_test_items(code: &str) -> String {
    let mut out = code.to_owned();
    for (place, attribute) in code.match_indices("#[cfg(test)]") {
        let body = place + attribute.len();
        let end = code[body..].find(['{', ';']).map_or(code.len(), |at| {
            let at = body + at;
            if code.as_bytes()[at] == b'{' { end_of_group(code, at) } else { at + 1 }
        });
        let blank: String =
            code[place..end].bytes().map(|b| if b == b'\n' { '\n' } else { ' ' }).collect();
        out.replace_range(place..end, &blank);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_literals_vanish_and_code_stays() {
        let text = r####"let a = "unsafe \" x"; // unsafe
/* unsafe /* unsafe */ unsafe */ let b = 'u'; let c: &'static str = r#"unsafe " "#;
let d = b"unsafe"; let e = '\''; let f = "é"; let g = 'é'; unsafe { h() }"####;
        let file = RustFile::new("x.rs", text);
        let found: Vec<_> = places(&file.code, "unsafe").collect();
        assert_eq!(found.len(), 1, "{}", file.code);
        assert_eq!(line_of(&file.code, found[0]), 3);
        assert!(file.code.contains("&'static str"));
        assert_eq!(file.code.len(), text.len());
    }

    #[test]
    fn test_modules_are_not_shipped() {
        let text = "fn a() { x::y(); }\n#[cfg(test)]\nmod tests { fn b() { z(); } }\n\
                    #[cfg(test)]\nuse w::v;\nfn c() { z(); }";
        let shipped = RustFile::new("x.rs", text).shipped;
        assert_eq!(places(&shipped, "z").map(|at| line_of(&shipped, at)).collect::<Vec<_>>(), [6]);
        assert_eq!(places(&shipped, "v").count(), 0);
        assert_eq!(places(&shipped, "y").count(), 1);
    }

    #[test]
    fn words_are_whole() {
        assert_eq!(places("Instant InstantX x.Instant xInstant", "Instant").count(), 2);
    }
}
