//! Grammar of a Radiance scene: primitives, aliases and commands, one after the other.
//!
//! ```text
//! modifier type identifier          modifier alias identifier reference
//! n string1 .. stringn
//! 0                                 ! command with arguments
//! m real1 .. realm                  # a comment
//! ```

use super::words::{Word, Words};
use crate::LoadError;
use quasilux_text::Position;
use std::sync::Arc;

/// Longest name in a message.
const SHOWN: usize = 60;

/// An entry of a scene, and its line.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) place: Position,
    pub(super) kind: EntryKind,
}

#[derive(Clone, Debug)]
pub(super) enum EntryKind {
    Primitive(Arc<Primitive>),
    Alias(Alias),
    /// A command, without its `!`.
    Command(String),
}

/// A modifier or a surface.
#[derive(Clone, Debug, Default)]
pub(super) struct Primitive {
    pub(super) modifier: Arc<str>,
    pub(super) kind: Arc<str>,
    pub(super) name: Arc<str>,
    pub(super) strings: Vec<Arc<str>>,
    pub(super) reals: Vec<f64>,
}

impl Primitive {
    /// Numbers that take as much memory as its arguments.
    pub(super) fn weight(&self) -> usize {
        self.reals.len() + self.strings.iter().map(|it| 2 + it.len() / 8).sum::<usize>()
    }
}

/// Another name for a modifier.
#[derive(Clone, Debug)]
pub(super) struct Alias {
    pub(super) modifier: Arc<str>,
    pub(super) name: Arc<str>,
    pub(super) reference: Arc<str>,
}

/// Reads the entries of a file.
pub(super) fn parse(file: &str, text: &str) -> Result<Vec<Entry>, LoadError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = Reader { file, words: Words::new(text) };
    let mut entries = Vec::new();
    while let Some(first) = reader.words.skip_blanks() {
        let place = reader.words.place();
        let kind = match first {
            '#' => {
                reader.words.pass_comment();
                continue;
            }
            '!' => {
                let line = reader.words.rest_of_command();
                EntryKind::Command(line[1..].replace("\\\r\n", " ").replace("\\\n", " "))
            }
            _ => reader.primitive()?,
        };
        entries.push(Entry { place, kind });
    }
    Ok(entries)
}

/// A text that names something, short enough for a message.
pub(super) fn shown(text: &str) -> String {
    quasilux_text::shortened(text, SHOWN)
}

struct Reader<'t> {
    file: &'t str,
    words: Words<'t>,
}

impl<'t> Reader<'t> {
    fn error(&self, place: Position, message: String) -> LoadError {
        LoadError::new(self.file, Some(place), message)
    }

    /// A word that has to be there.
    fn word(&mut self, expected: &str) -> Result<Word<'t>, LoadError> {
        match self.words.next() {
            Some(word) => Ok(word),
            None => {
                let place = self.words.place();
                Err(self.error(place, format!("the file ends; expected {expected}")))
            }
        }
    }

    fn name(&mut self, expected: &str) -> Result<Arc<str>, LoadError> {
        Ok(self.word(expected)?.text.into())
    }

    fn primitive(&mut self) -> Result<EntryKind, LoadError> {
        let modifier = self.name("a modifier")?;
        let kind = self.name("the type of a primitive, such as polygon")?;
        let name = self.name("the name of a primitive")?;
        if &*kind == "alias" {
            let reference = self.name("the modifier that the alias stands for")?;
            return Ok(EntryKind::Alias(Alias { modifier, name, reference }));
        }
        let mut strings = Vec::new();
        for _ in 0..self.count("the number of string arguments", &kind)? {
            strings.push(self.name("a string argument")?);
        }
        let integers = self.words.place();
        let expected = "the number of integer arguments, 0";
        if self.count(expected, &kind)? != 0 {
            let message = format!(
                "a primitive of the type {} with integer arguments, which none has; expected 0",
                shown(&kind)
            );
            return Err(self.error(integers, message));
        }
        let mut reals = Vec::new();
        for _ in 0..self.count("the number of real arguments", &kind)? {
            reals.push(self.number("a real argument")?);
        }
        Ok(EntryKind::Primitive(Arc::new(Primitive { modifier, kind, name, strings, reals })))
    }

    fn next_number(&mut self, expected: &str) -> Result<Word<'t>, LoadError> {
        let place = self.words.place();
        match self.words.next_behind_comments() {
            Some(word) => Ok(word),
            None => Err(self.error(place, format!("the file ends; expected {expected}"))),
        }
    }

    fn count(&mut self, expected: &str, kind: &str) -> Result<u64, LoadError> {
        let word = self.next_number(expected)?;
        word.text.parse().map_err(|_| {
            let found = shown(word.text);
            let of = shown(kind);
            self.error(
                word.place,
                format!("found {found} in a primitive of the type {of}; expected {expected}"),
            )
        })
    }

    fn number(&mut self, expected: &str) -> Result<f64, LoadError> {
        let word = self.next_number(expected)?;
        let number = word.text.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| {
            let found = shown(word.text);
            self.error(word.place, format!("found {found}; expected {expected}, a finite number"))
        })
    }
}
