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
use std::collections::HashSet;
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
    refuse_binary(file, bytes)?;
    let text = String::from_utf8_lossy(bytes);
    let mut rewriter = Rewriter::default();
    for Statement { line, text } in statements_of(&text) {
        rewriter.add(&Reader { file, line, statement: &text })?;
    }
    rewriter.finish(file)
}

fn refuse_binary(file: &str, bytes: &[u8]) -> Result<(), LoadError> {
    let Some(at) = bytes.iter().position(|&byte| byte == 0) else {
        return Ok(());
    };
    let line = 1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count();
    let place = Some(Position { line, column: 1 });
    Err(LoadError::new(file, place, "binary data; expected an OBJ file, which is text"))
}

/// Statements so far: vertices in the result's text, all others behind them at the end.
#[derive(Default)]
struct Rewriter {
    lines: ObjLines,
    others: String,
    /// The highest index of each face.
    highest: Vec<u64>,
    known_materials: HashSet<String>,
    vertices: u64,
}

impl Rewriter {
    fn add(&mut self, reader: &Reader<'_>) -> Result<(), LoadError> {
        let mut words = words_of(reader.statement);
        let Some((_, keyword)) = words.next() else {
            return Ok(());
        };
        let name = rest(reader.statement);
        match keyword {
            "v" => {
                self.lines.text.push_str(&reader.vertex(words)?);
                self.vertices += 1;
            }
            "f" | "fo" => self.add_face(&reader.face(words, self.vertices)?, reader.line),
            "o" | "g" => {
                let _ = writeln!(self.others, "o {name}");
            }
            "usemtl" if name.is_empty() => {
                return Err(reader.error(0, "usemtl names no material; expected a name"));
            }
            "usemtl" => {
                if self.known_materials.insert(name.to_owned()) {
                    self.lines.materials.push(name.to_owned());
                }
                let _ = writeln!(self.others, "usemtl {name}");
            }
            "mtllib" => self.lines.libraries.push((name.to_owned(), reader.place(0))),
            _ => {}
        }
        Ok(())
    }

    fn add_face(&mut self, corners: &[u64], line: usize) {
        if corners.len() < 3 {
            self.lines.thin_faces += 1;
            return;
        }
        self.others.push('f');
        for corner in corners {
            let _ = write!(self.others, " {corner}");
        }
        self.others.push('\n');
        self.highest.push(corners.iter().copied().max().unwrap_or(0));
        self.lines.face_lines.push(line);
    }

    fn finish(self, file: &str) -> Result<ObjLines, LoadError> {
        let Self { mut lines, others, highest, vertices, .. } = self;
        if let Some(face) = highest.iter().position(|&highest| highest > vertices) {
            let place = Some(Position { line: lines.face_lines[face], column: 1 });
            let message = format!(
                "a face refers to vertex {}; expected 1 to {vertices}, the vertices of the file",
                highest[face]
            );
            return Err(LoadError::new(file, place, message));
        }
        lines.text.push_str(&others);
        Ok(lines)
    }
}

/// A statement without comments, its continued lines joined.
struct Statement<'a> {
    /// The number of its first line.
    line: usize,
    text: Cow<'a, str>,
}

fn statements_of(text: &str) -> impl Iterator<Item = Statement<'_>> {
    let mut lines = text.lines().zip(1..);
    std::iter::from_fn(move || {
        let (line, number) = lines.next()?;
        let mut statement = Cow::Borrowed(without_comment(line));
        while let Some(start) = statement.trim_end().strip_suffix('\\') {
            let next = lines.next().map_or("", |(line, _)| without_comment(line));
            statement = Cow::Owned(format!("{start} {next}"));
        }
        Some(Statement { line: number, text: statement })
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
