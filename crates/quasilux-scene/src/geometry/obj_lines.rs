//! The statements of an OBJ file, line by line: positions, faces, objects and materials.
//!
//! Normals, texture coordinates, lines, points and all statements of free-form surfaces are left
//! out. A face may come before its vertices. Format: Wavefront, Object Files (.obj), Advanced
//! Visualizer manual, appendix B1 (1995).

use super::builder::{MAX_TRIANGLES, TriangleError};
use crate::LoadError;
use glam::DVec3;
use quasilux_text::{Position, TextWarning, Warnings};
use std::borrow::Cow;
use std::collections::HashMap;
use std::ops::Range;

/// The statements of an OBJ file that say anything about its surfaces.
#[derive(Debug, Default)]
pub(super) struct ObjLines {
    /// Vertices in order.
    pub(super) positions: Vec<DVec3>,
    /// Indices into `positions`: those of each face, one face after the other.
    pub(super) corners: Vec<u32>,
    /// Faces of three corners or more, in order.
    pub(super) faces: Vec<Face>,
    /// Names of objects with faces, in order; neighbours differ.
    pub(super) objects: Vec<String>,
    /// Material names of `usemtl` statements, in order of first use.
    pub(super) materials: Vec<String>,
    /// Files of `mtllib` statements with their places, in order.
    pub(super) libraries: Vec<(String, Position)>,
    /// Faces of fewer than three corners, left out.
    pub(super) thin_faces: u64,
    /// How many `usemtl` statements have no name.
    pub(super) unnamed_materials: u64,
    /// Curves and surfaces of free form, left out.
    pub(super) free_forms: u64,
    /// Vertices that were read with commas as decimal points, or behind numbers.
    pub(super) vertices_with_commas: u64,
}

/// A face.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Face {
    /// The line that it begins in, from 1.
    pub(super) line: usize,
    /// Its part of `corners`.
    pub(super) corners: Range<usize>,
    /// Index into `objects`.
    pub(super) object: usize,
    /// Index into `materials`; `None` before the first `usemtl`.
    pub(super) material: Option<usize>,
}

/// The name of an object where the file gives none.
const UNNAMED: &str = "unnamed_object";

/// The words of a statement, each with its column counted in bytes from 0.
type Words<'a> = std::iter::Peekable<std::vec::IntoIter<(usize, &'a str)>>;

/// Reads an OBJ file.
pub(super) fn read(file: &str, bytes: &[u8]) -> Result<ObjLines, LoadError> {
    if !is_utf_16(bytes) {
        refuse_binary(file, bytes)?;
    }
    let text = text_of(bytes);
    let mut reader = Reader::default();
    for Statement { line, text } in statements_of(&text) {
        reader.add(&StatementReader { file, line, statement: &text })?;
    }
    reader.finish(file)
}

/// UTF-16 by its byte order mark, as some programs on Windows write it, or else UTF-8, in which
/// names of other encodings lose letters.
pub(super) fn text_of(bytes: &[u8]) -> Cow<'_, str> {
    if is_utf_16(bytes) {
        return quasilux_text::decode(bytes, &mut Warnings::<TextWarning>::default());
    }
    String::from_utf8_lossy(bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes))
}

fn is_utf_16(bytes: &[u8]) -> bool {
    matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..])
}

fn refuse_binary(file: &str, bytes: &[u8]) -> Result<(), LoadError> {
    let Some(at) = bytes.iter().position(|&byte| byte == 0) else {
        return Ok(());
    };
    let line = 1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count();
    let place = Some(Position { line, column: 1 });
    Err(LoadError::new(file, place, "binary data; expected an OBJ file, which is text"))
}

/// Lines that were read so far, and the state that statements change.
#[derive(Default)]
struct Reader {
    lines: ObjLines,
    /// Triangles that all faces so far make.
    triangles: usize,
    object: Option<String>,
    material: Option<usize>,
    material_of: HashMap<String, usize>,
}

impl Reader {
    fn add(&mut self, reader: &StatementReader<'_>) -> Result<(), LoadError> {
        let mut words = words_of(reader.statement);
        let Some((_, keyword)) = words.next() else {
            return Ok(());
        };
        let name = rest(reader.statement);
        match keyword {
            "v" => {
                let position = reader.position(words).or_else(|refusal| {
                    self.lines.vertices_with_commas += 1;
                    reader.position_with_commas().ok_or(refusal)
                });
                self.lines.positions.push(position?);
            }
            "f" | "fo" => self.add_face(reader, words)?,
            "o" | "g" => self.object = Some(name.to_owned()).filter(|name| !name.is_empty()),
            "usemtl" if name.is_empty() => {
                self.material = None;
                self.lines.unnamed_materials += 1;
            }
            "usemtl" => {
                let materials = &mut self.lines.materials;
                let material = *self.material_of.entry(name.to_owned()).or_insert_with(|| {
                    materials.push(name.to_owned());
                    materials.len() - 1
                });
                self.material = Some(material);
            }
            "curv" | "curv2" | "surf" => self.lines.free_forms += 1,
            "mtllib" => self.lines.libraries.push((name.to_owned(), reader.place(0))),
            _ => {}
        }
        Ok(())
    }

    fn add_face(
        &mut self,
        reader: &StatementReader<'_>,
        words: Words<'_>,
    ) -> Result<(), LoadError> {
        let lines = &mut self.lines;
        let start = lines.corners.len();
        for (at, word) in words {
            lines.corners.push(reader.corner(at, word, lines.positions.len())?);
        }
        if lines.corners.len() < start + 3 {
            lines.corners.truncate(start);
            lines.thin_faces += 1;
            return Ok(());
        }
        self.triangles += lines.corners.len() - start - 2;
        if self.triangles > MAX_TRIANGLES {
            return Err(reader.error(0, TriangleError::TooMany.message("the face")));
        }
        let object = self.object.as_deref().unwrap_or(UNNAMED);
        if lines.objects.last().is_none_or(|last| last != object) {
            lines.objects.push(object.to_owned());
        }
        lines.faces.push(Face {
            line: reader.line,
            corners: start..lines.corners.len(),
            object: lines.objects.len() - 1,
            material: self.material,
        });
        Ok(())
    }

    /// Refuses faces with vertices that never came.
    fn finish(self, file: &str) -> Result<ObjLines, LoadError> {
        let lines = self.lines;
        let vertices = lines.positions.len();
        for face in &lines.faces {
            let highest = lines.corners[face.corners.clone()].iter().max();
            if let Some(highest) = highest.filter(|highest| **highest as usize >= vertices) {
                let place = Some(Position { line: face.line, column: 1 });
                let message = format!(
                    "a face refers to vertex {}; expected 1 to {vertices}, the vertices of the \
                     file",
                    u64::from(*highest) + 1
                );
                return Err(LoadError::new(file, place, message));
            }
        }
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
    let mut lines = quasilux_text::lines(text).zip(1..);
    std::iter::from_fn(move || {
        let (line, number) = lines.next()?;
        let mut last = without_comment(line);
        let Some(first) = continued(last) else {
            return Some(Statement { line: number, text: Cow::Borrowed(last) });
        };
        let mut statement = first.to_owned();
        loop {
            last = lines.next().map_or("", |(line, _)| without_comment(line));
            let part = continued(last);
            statement.push(' ');
            statement.push_str(part.unwrap_or(last));
            if part.is_none() {
                return Some(Statement { line: number, text: Cow::Owned(statement) });
            }
        }
    })
}

/// A line without the mark that the next one goes on with its statement; `None` where there is
/// none.
fn continued(line: &str) -> Option<&str> {
    line.trim_end().strip_suffix('\\')
}

/// The line up to a `#` that starts a word; of a statement that is a name, one that is a word:
/// names like `Grey #1` hold one.
pub(super) fn without_comment(line: &str) -> &str {
    let keyword = line.split_whitespace().next().unwrap_or_default();
    let is_name = ["o", "g", "usemtl", "mtllib", "newmtl"].contains(&keyword);
    let is_blank = |c: Option<char>| c.is_none_or(|c| c.is_whitespace() || c == '#');
    let is_comment = |at: usize| {
        let starts_word = line[..at].chars().next_back().is_none_or(char::is_whitespace);
        starts_word && (!is_name || is_blank(line[at + 1..].chars().next()))
    };
    let comment = line.match_indices('#').map(|(at, _)| at).find(|&at| is_comment(at));
    &line[..comment.unwrap_or(line.len())]
}

fn words_of(statement: &str) -> Words<'_> {
    let start = statement.as_ptr() as usize;
    let words: Vec<_> =
        statement.split_whitespace().map(|word| (word.as_ptr() as usize - start, word)).collect();
    words.into_iter().peekable()
}

/// Rest of a statement after the keyword: a name that may hold spaces.
fn rest(statement: &str) -> &str {
    let statement = statement.trim();
    statement.split_once(char::is_whitespace).map_or("", |(_, rest)| rest.trim())
}

/// Reads the words of one statement.
struct StatementReader<'a> {
    file: &'a str,
    line: usize,
    statement: &'a str,
}

impl StatementReader<'_> {
    fn place(&self, at: usize) -> Position {
        let before = self.statement.get(..at).unwrap_or_default();
        Position { line: self.line, column: before.chars().count() + 1 }
    }

    fn error(&self, at: usize, message: impl Into<String>) -> LoadError {
        LoadError::new(self.file, Some(self.place(at)), message)
    }

    /// The position of a `v` statement; a weight or a colour after it is left out.
    fn position(&self, mut words: Words<'_>) -> Result<DVec3, LoadError> {
        let expected = "expected v with three finite coordinates in metres";
        let mut coordinate = |axis: &str| {
            let (at, word) = words.next().ok_or_else(|| {
                self.error(self.statement.len(), format!("the vertex has no {axis}; {expected}"))
            })?;
            word.parse().ok().filter(|x: &f64| x.is_finite()).ok_or_else(|| {
                let word = short(word);
                self.error(at, format!("{axis} of the vertex is \"{word}\"; {expected}"))
            })
        };
        Ok(DVec3::new(coordinate("x")?, coordinate("y")?, coordinate("z")?))
    }

    /// The position of a `v` statement where a comma is a decimal point, or stands behind a number:
    /// programs write such files in countries with decimal commas.
    fn position_with_commas(&self) -> Option<DVec3> {
        let words = self.statement.split_whitespace().skip(1);
        let number = |word: &str| {
            let word = word.strip_suffix(',').unwrap_or(word);
            word.replacen(',', ".", 1).parse().ok().filter(|x: &f64| x.is_finite())
        };
        let coordinates: Vec<f64> = words.take(3).map(number).collect::<Option<_>>()?;
        Some(DVec3::from_array(coordinates.try_into().ok()?))
    }

    /// The position index of a corner of an `f` statement, counted from 0. One that is counted from
    /// the start may be that of a vertex to come.
    fn corner(&self, at: usize, word: &str, vertices: usize) -> Result<u32, LoadError> {
        let first = word.split('/').next().unwrap_or_default();
        let index = match first.parse::<i64>() {
            Ok(n) if n > 0 => Some(n.unsigned_abs() - 1),
            Ok(n) if n < 0 => (vertices as u64).checked_sub(n.unsigned_abs()),
            _ => None,
        };
        index.and_then(|index| u32::try_from(index).ok()).ok_or_else(|| {
            self.error(
                at,
                format!(
                    "the face's corner is \"{}\"; expected the number of a vertex, 1 to \
                     {vertices} or -{vertices} to -1 here",
                    short(word)
                ),
            )
        })
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
    fn statements_are_read() {
        let text = "# head\nmtllib a b.mtl\no desk#1 # comment\nusemtl wood grain\n\
                    v 0 0 0 1 # w\nv 1 0 0 0.5 0.5 0.5\nvt 0 0\nv 0 1 \\\n 0\n\
                    f 1/1/1 2//2 -1 #\nf 1 2\nl 1 2\nusemtl Grey #1 # it\ncurv 0 1 1 2\n\
                    v 0,5 -1,25 2e1\nv 1, 2, 3,\n";
        let lines = read("a.obj", text.as_bytes()).unwrap();
        let with_commas = [DVec3::new(0.5, -1.25, 20.0), DVec3::new(1.0, 2.0, 3.0)];
        assert_eq!(lines.positions[..3], [DVec3::ZERO, DVec3::X, DVec3::Y]);
        assert_eq!(lines.positions[3..], with_commas);
        assert_eq!((lines.vertices_with_commas, lines.free_forms), (2, 1));
        assert_eq!(lines.corners, [0, 1, 2]);
        let face = Face { line: 10, corners: 0..3, object: 0, material: Some(0) };
        assert_eq!(lines.faces, [face]);
        assert_eq!(lines.objects, ["desk#1"]);
        assert_eq!(lines.libraries, [("a b.mtl".to_owned(), Position { line: 2, column: 1 })]);
        assert_eq!(lines.materials, ["wood grain", "Grey #1"]);
        assert_eq!(lines.thin_faces, 1);
    }

    #[test]
    fn wide_text_is_read() {
        let text = "o Tür\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let marked = format!("\u{FEFF}{text}");
        let utf_16 = |bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
            marked.encode_utf16().flat_map(bytes).collect()
        };
        for bytes in
            [marked.clone().into_bytes(), utf_16(u16::to_le_bytes), utf_16(u16::to_be_bytes)]
                .into_iter()
                .chain([text.replace('\n', "\r").into_bytes()])
        {
            let lines = read("a.obj", &bytes).unwrap();
            assert_eq!((lines.objects, lines.positions.len()), (vec!["Tür".to_owned()], 3));
        }
    }

    #[test]
    fn objects_and_materials_last_until_others_come() {
        let text = "f 1 2 3\nusemtl a\nf 1 2 3\no first\no second\nf 1 2 3\nusemtl b\n\
                    g second\nf 1 2 3\nusemtl a\ng\nf 3 2 1\nusemtl \nf 1 2 3\n\
                    v 0 0 0\nv 1 0 0\nv 0 1 0\n";
        let lines = read("a.obj", text.as_bytes()).unwrap();
        let objects: Vec<&str> =
            lines.faces.iter().map(|face| lines.objects[face.object].as_str()).collect();
        assert_eq!(objects, [UNNAMED, UNNAMED, "second", "second", UNNAMED, UNNAMED]);
        assert_eq!(lines.objects.len(), 3, "{:?}", lines.objects);
        let materials: Vec<Option<usize>> = lines.faces.iter().map(|face| face.material).collect();
        assert_eq!(materials, [None, Some(0), Some(0), Some(1), Some(0), None]);
        assert_eq!(lines.unnamed_materials, 1);
    }

    /// In one pass: a million of them took longer than anyone waits.
    #[test]
    fn a_statement_may_go_on_over_any_number_of_lines() {
        let text = format!("v 0 \\\n{}1 \\ \n2\nv 1 1 1\\", "\\\n".repeat(1_000_000));
        let lines = read("a.obj", text.as_bytes()).unwrap();
        assert_eq!(lines.positions, [DVec3::new(0.0, 1.0, 2.0), DVec3::ONE]);
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
            ("v 0 0 0\n\0\u{1}", (2, 1), "binary"),
        ] {
            let error = read("a.obj", text.as_bytes()).unwrap_err();
            let Position { line, column } = error.place().unwrap();
            assert_eq!((line, column), place, "{error}");
            assert!(error.message().contains(needle), "{error}");
        }
    }
}
