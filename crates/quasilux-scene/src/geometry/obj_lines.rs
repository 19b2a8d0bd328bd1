//! An OBJ file, line by line, before `tobj` reads it.
//!
//! `tobj` reports no lines, loses the name of a material that no MTL file defines, stops at bytes
//! that are not UTF-8 and at trailing comments, and trusts indices. So each statement is checked
//! here and written again in the form that it reads without fail: vertices first, faces with
//! absolute position indices alone. Format: Wavefront, Object Files (.obj), Advanced Visualizer
//! manual, appendix B1 (1995).

use crate::LoadError;
use quasilux_text::Position;
use std::borrow::Cow;
use std::collections::HashMap;
use std::fmt::Write;

/// The checked statements of an OBJ file.
#[derive(Debug, Default)]
pub(super) struct ObjLines {
    /// The same geometry in plain statements.
    pub(super) text: String,
    /// Files of `mtllib` statements with their places, in order.
    pub(super) libraries: Vec<(String, Position)>,
    /// Material names of `usemtl` statements, in order of first use.
    pub(super) materials: Vec<String>,
    /// The line of each face in `text`, in order.
    pub(super) face_lines: Vec<usize>,
    /// Faces of fewer than three corners, left out.
    pub(super) thin_faces: u64,
}

/// The words of a statement, each with its column counted in bytes from 0.
type Words<'a> = std::iter::Peekable<std::vec::IntoIter<(usize, &'a str)>>;

struct Reader<'a> {
    file: &'a str,
    line: usize,
    statement: &'a str,
}

/// Checks and rewrites an OBJ file.
pub(super) fn read(file: &str, bytes: &[u8]) -> Result<ObjLines, LoadError> {
    if let Some(at) = bytes.iter().position(|&byte| byte == 0) {
        let line = 1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count();
        let place = Some(Position { line, column: 1 });
        return Err(LoadError::new(
            file,
            place,
            "binary data; expected an OBJ file, which is text",
        ));
    }
    let text = String::from_utf8_lossy(bytes);
    let mut lines = ObjLines::default();
    let mut statements = String::new();
    let mut faces = Vec::new();
    let mut known_materials = HashMap::new();
    let mut vertices: u64 = 0;
    for (line, statement) in statements_of(&text) {
        let reader = Reader { file, line, statement: &statement };
        let mut words = words_of(&statement);
        let Some((_, keyword)) = words.next() else {
            continue;
        };
        match keyword {
            "v" => {
                lines.text.push_str(&reader.vertex(words)?);
                vertices += 1;
            }
            "f" | "fo" => match reader.face(words, vertices)? {
                corners if corners.len() < 3 => lines.thin_faces += 1,
                corners => {
                    statements.push('f');
                    for corner in &corners {
                        let _ = write!(statements, " {corner}");
                    }
                    statements.push('\n');
                    faces.push(corners.into_iter().max().unwrap_or(0));
                    lines.face_lines.push(line);
                }
            },
            "o" | "g" => {
                let _ = writeln!(statements, "o {}", rest(&statement));
            }
            "usemtl" => {
                let name = rest(&statement);
                if name.is_empty() {
                    return Err(reader.error(0, "usemtl names no material; expected a name"));
                }
                known_materials.entry(name.to_owned()).or_insert_with(|| {
                    lines.materials.push(name.to_owned());
                });
                let _ = writeln!(statements, "usemtl {name}");
            }
            "mtllib" => lines.libraries.push((rest(&statement).to_owned(), reader.place(0))),
            _ => {}
        }
    }
    if let Some(face) = faces.iter().position(|&highest| highest > vertices) {
        let place = Some(Position { line: lines.face_lines[face], column: 1 });
        let message = format!(
            "a face refers to vertex {}; expected 1 to {vertices}, the vertices of the file",
            faces[face]
        );
        return Err(LoadError::new(file, place, message));
    }
    lines.text.push_str(&statements);
    Ok(lines)
}

/// Statements with the number of their first line: without comments, continued lines joined.
fn statements_of(text: &str) -> impl Iterator<Item = (usize, Cow<'_, str>)> {
    let mut lines = text.lines().zip(1..);
    std::iter::from_fn(move || {
        let (line, number) = lines.next()?;
        let mut statement = Cow::Borrowed(without_comment(line));
        while let Some(start) = statement.trim_end().strip_suffix('\\') {
            let next = lines.next().map_or("", |(line, _)| without_comment(line));
            statement = Cow::Owned(format!("{start} {next}"));
        }
        Some((number, statement))
    })
}

/// The line up to a `#` that starts a word: names may hold one.
fn without_comment(line: &str) -> &str {
    let starts_word = |at: usize| line[..at].chars().next_back().is_none_or(char::is_whitespace);
    let comment = line.match_indices('#').map(|(at, _)| at).find(|&at| starts_word(at));
    &line[..comment.unwrap_or(line.len())]
}

fn words_of(statement: &str) -> Words<'_> {
    let start = statement.as_ptr() as usize;
    let words: Vec<_> =
        statement.split_whitespace().map(|word| (word.as_ptr() as usize - start, word)).collect();
    words.into_iter().peekable()
}

/// What follows the keyword: a name that may hold spaces.
fn rest(statement: &str) -> &str {
    let statement = statement.trim();
    statement.split_once(char::is_whitespace).map_or("", |(_, rest)| rest.trim())
}

impl Reader<'_> {
    fn place(&self, at: usize) -> Position {
        let before = self.statement.get(..at).unwrap_or_default();
        Position { line: self.line, column: before.chars().count() + 1 }
    }

    fn error(&self, at: usize, message: impl Into<String>) -> LoadError {
        LoadError::new(self.file, Some(self.place(at)), message)
    }

    /// A `v` statement; a weight or a colour after the coordinates is left out.
    fn vertex(&self, mut words: Words<'_>) -> Result<String, LoadError> {
        let mut statement = "v".to_owned();
        for axis in ["x", "y", "z"] {
            let expected = "expected v with three finite coordinates in metres";
            let (at, word) = words.next().ok_or_else(|| {
                self.error(self.statement.len(), format!("the vertex has no {axis}; {expected}"))
            })?;
            if !word.parse().is_ok_and(f64::is_finite) {
                let message = format!("{axis} of the vertex is \"{}\"; {expected}", short(word));
                return Err(self.error(at, message));
            }
            statement.push(' ');
            statement.push_str(word);
        }
        statement.push('\n');
        Ok(statement)
    }

    /// The position indices of an `f` statement, counted from 1; not above `u32::MAX`.
    fn face(&self, words: Words<'_>, vertices: u64) -> Result<Vec<u64>, LoadError> {
        words
            .map(|(at, word)| {
                let first = word.split('/').next().unwrap_or_default();
                let index = match first.parse::<i64>() {
                    Ok(n) if n > 0 => Some(n.unsigned_abs()),
                    Ok(n) if n < 0 => vertices.checked_sub(n.unsigned_abs()).map(|n| n + 1),
                    _ => None,
                };
                index.filter(|&n| n <= u64::from(u32::MAX)).ok_or_else(|| {
                    self.error(
                        at,
                        format!(
                            "the face's corner is \"{}\"; expected the number of a vertex, 1 to \
                             {vertices} or -{vertices} to -1 here",
                            short(word)
                        ),
                    )
                })
            })
            .collect()
    }
}

/// As much of a word as a message can hold.
fn short(word: &str) -> String {
    word.chars().filter(|c| !c.is_control()).take(24).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_come_out_plain() {
        let text = "# head\nmtllib a b.mtl\no desk#1 # comment\nusemtl wood grain\n\
                    v 0 0 0 1 # w\nv 1 0 0 0.5 0.5 0.5\nvt 0 0\nv 0 1 \\\n 0\n\
                    f 1/1/1 2//2 -1\nf 1 2\nl 1 2\n";
        let lines = read("a.obj", text.as_bytes()).unwrap();
        assert_eq!(lines.text, "v 0 0 0\nv 1 0 0\nv 0 1 0\no desk#1\nusemtl wood grain\nf 1 2 3\n");
        assert_eq!(lines.libraries, [("a b.mtl".to_owned(), Position { line: 2, column: 1 })]);
        assert_eq!(lines.materials, ["wood grain"]);
        assert_eq!((lines.face_lines, lines.thin_faces), (vec![10], 1));
    }

    #[test]
    fn refusals_name_line_and_column() {
        for (text, place, needle) in [
            ("v 0 0\n", (1, 6), "no z"),
            ("v 0 0 0\nv 1 nan 0\n", (2, 5), "\"nan\""),
            ("v 0 0 0\nf 1 2 3\n", (2, 1), "vertex 3; expected 1 to 1"),
            ("v 0 0 0\nf 1 1 -2\n", (2, 7), "\"-2\""),
            ("f 1 0 1\n", (1, 5), "\"0\""),
            ("f 1 2 99999999999\n", (1, 7), "\"99999999999\""),
            ("usemtl\n", (1, 1), "names no material"),
            ("v 0 0 0\n\0\u{1}", (2, 1), "binary"),
        ] {
            let error = read("a.obj", text.as_bytes()).unwrap_err();
            let Position { line, column } = error.place().unwrap();
            assert_eq!((line, column), place, "{error}");
            assert!(error.message().contains(needle), "{error}");
        }
    }
}
