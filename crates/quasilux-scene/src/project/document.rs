//! A TOML document whose every key and value knows its place.
//!
//! Sections of the project file are read through [`Section`] and [`Value`]: each question says
//! what is expected, so that each refusal can.

use super::keys::Key;
use super::renamed::RefusedKey;
use crate::{LoadError, Spanned};
use glam::DVec3;
use quasilux_text::Position;
use std::ops::Range;
use toml::de::{DeTable, DeValue};

/// Largest coordinate in m that a project file may give: far beyond any light on Earth, and its
/// square is far from overflow.
const MAX_COORDINATE_M: f64 = 1e12;

/// Bytes whose characters are counted together.
const BLOCK: usize = 256;

/// Longest piece of a value that a message repeats.
const MAX_QUOTED_CHARS: usize = 40;

/// The text of a project file, and where its lines start.
pub(super) struct Source<'a> {
    pub(super) file: &'a str,
    text: &'a str,
    line_starts: Vec<usize>,
    /// The unit of its positions and lengths in m.
    position_unit_m: f64,
    /// Characters before every [`BLOCK`] bytes: a line may be as long as the file.
    chars_before: Vec<usize>,
}

/// A key of a table with its value.
pub(super) struct Entry<'a> {
    pub(super) key: Spanned<&'a str>,
    pub(super) value: Value<'a>,
}

/// A table of the document.
#[derive(Clone)]
pub(super) struct Section<'a> {
    source: &'a Source<'a>,
    /// As the user writes it, for messages: `[scene]`, `[[lights]]`.
    name: String,
    table: &'a DeTable<'a>,
    span: Range<usize>,
}

/// A value of a table, or an element of an array, with the key it belongs to.
#[derive(Clone, Copy)]
pub(super) struct Value<'a> {
    source: &'a Source<'a>,
    pub(super) key: &'a str,
    value: &'a toml::Spanned<DeValue<'a>>,
}

/// Characters that begin in some bytes of UTF-8.
fn count_chars(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte & 0xC0 != 0x80).count()
}

impl<'a> Source<'a> {
    pub(super) fn new(file: &'a str, text: &'a str) -> Self {
        let breaks = text.bytes().enumerate().filter(|&(_, byte)| byte == b'\n');
        let line_starts = std::iter::once(0).chain(breaks.map(|(at, _)| at + 1)).collect();
        let mut chars = 0;
        let chars_in = |block: &[u8]| {
            chars += count_chars(block);
            chars
        };
        let chars_before =
            std::iter::once(0).chain(text.as_bytes().chunks(BLOCK).map(chars_in)).collect();
        Self { file, text, line_starts, chars_before, position_unit_m: 1.0 }
    }

    /// This text, with positions and lengths in another unit.
    pub(super) fn with_position_unit(self, position_unit_m: f64) -> Self {
        Self { position_unit_m, ..self }
    }

    pub(super) fn place(&self, offset: usize) -> Position {
        let line = self.line_starts.partition_point(|&start| start <= offset);
        let start = self.line_starts[line - 1];
        Position { line, column: self.chars_to(offset) - self.chars_to(start) + 1 }
    }

    /// Characters that begin before a byte.
    fn chars_to(&self, offset: usize) -> usize {
        let offset = offset.min(self.text.len());
        let block = offset / BLOCK;
        self.chars_before[block] + count_chars(&self.text.as_bytes()[block * BLOCK..offset])
    }

    pub(super) fn error(&self, offset: usize, message: impl Into<String>) -> LoadError {
        LoadError::new(self.file, Some(self.place(offset)), message)
    }

    pub(super) fn root(&'a self, table: &'a DeTable<'a>) -> Section<'a> {
        Section { source: self, name: "the project file".to_owned(), table, span: 0..0 }
    }
}

impl<'a> Section<'a> {
    pub(super) fn place(&self) -> Position {
        self.source.place(self.span.start)
    }

    pub(super) fn error(&self, message: impl Into<String>) -> LoadError {
        self.source.error(self.span.start, message)
    }

    /// All entries, in the order of the file.
    pub(super) fn entries(&self) -> Vec<Entry<'a>> {
        let mut entries: Vec<_> = self.table.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        entries
            .into_iter()
            .map(|(key, value)| {
                let name: &str = key.get_ref();
                let place = self.source.place(key.span().start);
                let value = Value { source: self.source, key: name, value };
                Entry { key: Spanned { value: name, place }, value }
            })
            .collect()
    }

    /// Refuses keys that are neither in `known` nor in `planned`; the latter are not built yet.
    pub(super) fn only(&self, known: &[Key], planned: &[&str]) -> Result<(), LoadError> {
        let known: Vec<&str> = known.iter().map(|key| key.name).collect();
        self.only_names(&known, planned)
    }

    /// Refuses names beside `known` that no table holds.
    pub(super) fn only_names(&self, known: &[&str], planned: &[&str]) -> Result<(), LoadError> {
        for Entry { key, .. } in self.entries() {
            let name = key.value;
            let refuse =
                |message: String| Err(LoadError::new(self.source.file, Some(key.place), message));
            if planned.contains(&name) {
                return refuse(format!("\"{name}\" is not built yet"));
            }
            if !known.contains(&name) {
                let list = known.join(", ");
                let message = format!("unknown key \"{name}\" in {}; expected {list}", self.name);
                return refuse(message).map_err(|e| e.offer(name, known.iter().copied()));
            }
        }
        Ok(())
    }

    /// Refuses keys that there are no more, and says what became of them.
    pub(super) fn refuse(&self, refused: &[RefusedKey]) -> Result<(), LoadError> {
        for Entry { key, .. } in self.entries() {
            if let Some(RefusedKey { old, now }) = refused.iter().find(|it| it.old == key.value) {
                let message = format!("the key \"{old}\" in {} {now}", self.name);
                return Err(LoadError::new(self.source.file, Some(key.place), message));
            }
        }
        Ok(())
    }

    pub(super) fn get(&self, key: &'a str) -> Option<Value<'a>> {
        let (_, value) = self.table.iter().find(|(name, _)| name.get_ref() == key)?;
        Some(Value { source: self.source, key, value })
    }

    pub(super) fn require(&self, key: &'a str, expected: &str) -> Result<Value<'a>, LoadError> {
        self.get(key).ok_or_else(|| {
            self.error(format!("{} lacks \"{key}\"; expected {expected}", self.name))
        })
    }

    /// The one of `keys` that is given.
    pub(super) fn exactly_one(&self, keys: &[&'a str]) -> Result<Value<'a>, LoadError> {
        let mut given = keys.iter().filter_map(|key| self.get(key));
        let list = keys.join(", ");
        let Some(first) = given.next() else {
            let message = format!("{} lacks one of {list}; expected exactly one", self.name);
            return Err(self.error(message));
        };
        match given.next() {
            None => Ok(first),
            Some(second) => Err(second.error(format!(
                "\"{}\" and \"{}\" exclude each other; expected exactly one of {list}",
                first.key, second.key
            ))),
        }
    }

    /// A table under `key`, if given.
    pub(super) fn table(&self, key: &'a str) -> Result<Option<Section<'a>>, LoadError> {
        self.get(key).map(|value| value.section(format!("[{key}]"))).transpose()
    }

    /// The tables of an array of tables; none if the key is not given.
    pub(super) fn tables(&self, key: &'a str) -> Result<Vec<Section<'a>>, LoadError> {
        let Some(value) = self.get(key) else {
            return Ok(Vec::new());
        };
        let expected = format!("[[{key}]], in double brackets");
        let elements = value.array(&expected)?;
        elements.into_iter().map(|element| element.section(format!("[[{key}]]"))).collect()
    }
}

impl<'a> Section<'a> {
    /// One table, or an array of this many tables at most; none if the key is not given.
    pub(super) fn table_or_tables(
        &self,
        key: &'a str,
        most: usize,
    ) -> Result<Vec<Section<'a>>, LoadError> {
        let Some(value) = self.get(key) else { return Ok(Vec::new()) };
        if !matches!(value.value.get_ref(), DeValue::Array(_)) {
            return Ok(vec![value.section(format!("[{key}]"))?]);
        }
        let sections = self.tables(key)?;
        match sections.get(most) {
            Some(one_more) => Err(one_more.error(format!("more than {most} of [[{key}]]"))),
            None => Ok(sections),
        }
    }
}

impl<'a> Value<'a> {
    pub(super) fn place(&self) -> Position {
        self.source.place(self.value.span().start)
    }

    pub(super) fn error(&self, message: impl Into<String>) -> LoadError {
        self.source.error(self.value.span().start, message)
    }

    pub(super) fn spanned<T>(&self, value: T) -> Spanned<T> {
        Spanned { value, place: self.place() }
    }

    /// The refusal that repeats the value and says what was expected instead.
    pub(super) fn unexpected(&self, expected: &str) -> LoadError {
        let text = self.source.text.get(self.value.span()).unwrap_or_default().trim();
        let short = text.chars().count() <= MAX_QUOTED_CHARS && !text.contains('\n');
        let shown = match self.value.get_ref() {
            DeValue::Table(_) => "a table",
            DeValue::Array(_) if !short || text.starts_with("[[") => "an array",
            _ if short && !text.is_empty() => text,
            other => other.type_str(),
        };
        self.error(format!("\"{}\" is {shown}; expected {expected}", self.key))
    }

    pub(super) fn is_string(&self) -> bool {
        matches!(self.value.get_ref(), DeValue::String(_))
    }

    pub(super) fn string(&self, expected: &str) -> Result<&'a str, LoadError> {
        match self.value.get_ref() {
            DeValue::String(text) => Ok(text),
            _ => Err(self.unexpected(expected)),
        }
    }

    /// A date with a time of day, as it is written.
    pub(super) fn time_text(&self) -> Result<String, LoadError> {
        match self.value.get_ref() {
            DeValue::Datetime(time) => Ok(time.to_string()),
            DeValue::String(text) => Ok(text.to_string()),
            _ => Err(self.unexpected("a date and a time such as 2026-03-20T12:00:00")),
        }
    }

    pub(super) fn boolean(&self) -> Result<bool, LoadError> {
        match self.value.get_ref() {
            DeValue::Boolean(value) => Ok(*value),
            _ => Err(self.unexpected("true or false")),
        }
    }

    /// One of a list of names; those in `planned` are known but not built yet.
    pub(super) fn name(&self, known: &[&str], planned: &[&str]) -> Result<&'a str, LoadError> {
        let expected = known.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>();
        let expected = expected.join(" or ");
        let name = self.string(&expected)?;
        if planned.contains(&name) {
            return Err(self.error(format!("{} \"{name}\" is not built yet", self.key)));
        }
        if !known.contains(&name) {
            return Err(self.unexpected(&expected).offer(name, known.iter().copied()));
        }
        Ok(name)
    }

    /// A finite number that `accept`s.
    pub(super) fn number(
        &self,
        expected: &str,
        accept: impl Fn(f64) -> bool,
    ) -> Result<f64, LoadError> {
        let number = match self.value.get_ref() {
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::Integer(integer) => {
                i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|n| n as f64)
            }
            _ => None,
        };
        number
            .filter(|x: &f64| x.is_finite() && accept(*x))
            .ok_or_else(|| self.unexpected(expected))
    }

    /// An integer within `range`.
    pub(super) fn integer(
        &self,
        expected: &str,
        range: std::ops::RangeInclusive<u64>,
    ) -> Result<u64, LoadError> {
        let integer = match self.value.get_ref() {
            DeValue::Integer(integer) => {
                u64::from_str_radix(integer.as_str(), integer.radix()).ok()
            }
            _ => None,
        };
        integer.filter(|n| range.contains(n)).ok_or_else(|| self.unexpected(expected))
    }

    pub(super) fn array(&self, expected: &str) -> Result<Vec<Value<'a>>, LoadError> {
        match self.value.get_ref() {
            DeValue::Array(elements) => Ok(elements
                .iter()
                .map(|value| Value { source: self.source, key: self.key, value })
                .collect()),
            _ => Err(self.unexpected(expected)),
        }
    }

    /// Two finite numbers.
    pub(super) fn pair(&self, expected: &str) -> Result<[f64; 2], LoadError> {
        let elements = self.array(expected)?;
        let [a, b] = elements.as_slice() else { return Err(self.unexpected(expected)) };
        Ok([a.number(expected, |_| true)?, b.number(expected, |_| true)?])
    }

    /// A position, or an edge between two, in m.
    pub(super) fn position_m(&self, expected: &str) -> Result<DVec3, LoadError> {
        Ok(self.vector(expected)? * self.source.position_unit_m)
    }

    /// A length above 0 in m.
    pub(super) fn length_m(&self, expected: &str) -> Result<f64, LoadError> {
        Ok(self.number(expected, |length| length > 0.0)? * self.source.position_unit_m)
    }

    /// Three coordinates, `expected` to be a position or a direction.
    pub(super) fn vector(&self, expected: &str) -> Result<DVec3, LoadError> {
        let elements = self.array(expected)?;
        let [x, y, z] = elements.as_slice() else {
            return Err(self.unexpected(expected));
        };
        let limit = format!("{expected}: finite, and at most {MAX_COORDINATE_M:e}");
        let coordinate = |v: &Value<'_>| v.number(&limit, |x| x.abs() <= MAX_COORDINATE_M);
        Ok(DVec3::new(coordinate(x)?, coordinate(y)?, coordinate(z)?))
    }

    pub(super) fn section(&self, name: String) -> Result<Section<'a>, LoadError> {
        match self.value.get_ref() {
            DeValue::Table(table) => {
                Ok(Section { source: self.source, name, table, span: self.value.span() })
            }
            _ => Err(self.unexpected(&format!("the table {name}"))),
        }
    }
}
