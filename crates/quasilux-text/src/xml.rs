//! XML as a tree of elements with their places.
//!
//! Well-formed XML 1.0 or 1.1 without a document type: definitions of entities, and with them all
//! expansion, are refused, so a tree takes no more memory than a multiple of the text. Elements
//! nest no deeper than [`MAX_DEPTH`], so that no walk over them can exhaust the stack. Names lose
//! their prefixes; comments and processing instructions are left out.

use crate::{ParseError, Position, quoted, shortened};
use quick_xml::XmlVersion;
use quick_xml::escape::resolve_xml_entity;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::reader::Reader;

/// Levels of elements in a document.
pub const MAX_DEPTH: usize = 64;

/// Attributes of one element.
pub const MAX_ATTRIBUTES: usize = 64;

/// An element with all that is inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Element<'t> {
    /// Without a prefix.
    pub name: &'t str,
    /// Of the `<` that opens it.
    pub at: Position,
    /// In the order of the file.
    pub attributes: Vec<Attribute>,
    /// The elements directly inside, in the order of the file.
    pub children: Vec<Element<'t>>,
    text: String,
    /// Of the first character of the text that is not blank, or that of the element.
    pub text_at: Position,
}

/// A name, without a prefix, and its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Without a prefix.
    pub name: String,
    /// With its references resolved.
    pub value: String,
}

impl<'t> Element<'t> {
    /// The text directly inside, without the blanks around it.
    pub fn text(&self) -> &str {
        self.text.trim()
    }

    /// The first child of that name.
    pub fn child(&self, name: &str) -> Option<&Element<'t>> {
        self.children.iter().find(|child| child.name == name)
    }

    /// All children of that name.
    pub fn all(&self, name: &str) -> impl Iterator<Item = &Element<'t>> {
        self.children.iter().filter(move |child| child.name == name)
    }

    fn push_text(&mut self, text: &str, at: Position) {
        if self.text.is_empty() {
            self.text_at = at;
        }
        self.text.push_str(text);
    }
}

/// The root of a document.
///
/// # Errors
/// Where the text is not well-formed, has a document type or an unknown entity, or exceeds
/// [`MAX_DEPTH`] or [`MAX_ATTRIBUTES`].
pub fn parse(text: &str) -> Result<Element<'_>, ParseError> {
    Parser {
        text,
        places: Places { text, byte: 0, at: Position::START },
        open: Vec::new(),
        root: None,
    }
    .run()
}

struct Parser<'t> {
    text: &'t str,
    places: Places<'t>,
    /// The elements around the place that is read, from the root on.
    open: Vec<Element<'t>>,
    root: Option<Element<'t>>,
}

impl<'t> Parser<'t> {
    fn run(mut self) -> Result<Element<'t>, ParseError> {
        let mut reader = Reader::from_str(self.text);
        loop {
            let start = reader.buffer_position() as usize;
            let event = reader.read_event().map_err(|error| {
                let at = self.places.position(reader.error_position().max(start as u64) as usize);
                ParseError::new(at, shortened(&error.to_string(), 120), "well-formed XML")
            })?;
            match event {
                Event::Start(tag) => self.open(&tag, start)?,
                Event::Empty(tag) => {
                    self.open(&tag, start)?;
                    self.close();
                }
                Event::End(_) => self.close(),
                Event::Text(content) => {
                    self.text(&content.xml_content(XmlVersion::Implicit1_0), start)?;
                }
                Event::CData(content) => {
                    self.text(&content.xml_content(XmlVersion::Implicit1_0), start)?;
                }
                Event::GeneralRef(reference) => {
                    let text = self.resolve(&reference, start)?;
                    self.text(&text, start)?;
                }
                Event::DocType(_) => {
                    let expected = "XML without a document type (remove the DOCTYPE)";
                    return Err(ParseError::new(
                        self.places.position(start),
                        "a DOCTYPE",
                        expected,
                    ));
                }
                Event::Decl(_) | Event::PI(_) | Event::Comment(_) => {}
                Event::Eof => return self.finish(),
            }
        }
    }

    fn open(&mut self, tag: &BytesStart<'_>, start: usize) -> Result<(), ParseError> {
        let at = self.places.position(start);
        let length = tag.name().as_ref().len();
        // A tag begins with "<" and its name.
        let name = self.text.get(start + 1..start + 1 + length).unwrap_or_default();
        let name = name.rsplit_once(':').map_or(name, |(_, local)| local);
        if self.root.is_some() {
            return Err(ParseError::new(at, quoted(name), "the end of the file after the root"));
        }
        if self.open.len() == MAX_DEPTH {
            let expected = format_args!("no more than {MAX_DEPTH} levels of elements").to_string();
            return Err(ParseError::new(
                at,
                format_args!("{} inside them", quoted(name)),
                expected,
            ));
        }
        let attributes = attributes(tag, at)?;
        let (children, text) = (Vec::new(), String::new());
        self.open.push(Element { name, at, attributes, children, text, text_at: at });
        Ok(())
    }

    fn close(&mut self) {
        let closed = self.open.pop();
        match self.open.last_mut() {
            Some(parent) => parent.children.extend(closed),
            None => self.root = closed,
        }
    }

    fn text(&mut self, text: &str, start: usize) -> Result<(), ParseError> {
        let blanks = text.len() - text.trim_start().len();
        if blanks == text.len() {
            return Ok(());
        }
        let at = self.places.position(start + blanks);
        match self.open.last_mut() {
            Some(element) => {
                element.push_text(text, at);
                Ok(())
            }
            None => Err(ParseError::new(at, quoted(text), "an XML element")),
        }
    }

    fn resolve(&mut self, reference: &BytesRef<'_>, start: usize) -> Result<String, ParseError> {
        let known = match reference.resolve_char_ref() {
            Ok(Some(character)) => Some(character.to_string()),
            Ok(None) => resolve_xml_entity(reference).map(str::to_owned),
            Err(_) => None,
        };
        known.ok_or_else(|| {
            let found = format_args!("the entity {}", quoted(reference)).to_string();
            let expected = "a character reference, or one of lt, gt, amp, apos and quot";
            ParseError::new(self.places.position(start), found, expected)
        })
    }

    fn finish(mut self) -> Result<Element<'t>, ParseError> {
        let end = self.places.position(self.text.len());
        if let Some(open) = self.open.last() {
            let expected = format!("the end of {} of line {}", quoted(open.name), open.at.line);
            return Err(ParseError::new(end, "the end of the file", expected));
        }
        self.root.ok_or_else(|| ParseError::new(end, "the end of the file", "an XML element"))
    }
}

fn attributes(tag: &BytesStart<'_>, at: Position) -> Result<Vec<Attribute>, ParseError> {
    let mut attributes = Vec::new();
    for attribute in tag.attributes() {
        let wrong = |error: &dyn ToString| {
            ParseError::new(at, shortened(&error.to_string(), 120), "well-formed attributes")
        };
        let attribute = attribute.map_err(|error| wrong(&error))?;
        let value =
            attribute.normalized_value(XmlVersion::Implicit1_0).map_err(|error| wrong(&error))?;
        let name = attribute.key.local_name().as_ref().to_owned();
        attributes.push(Attribute { name, value: value.into_owned() });
        if attributes.len() > MAX_ATTRIBUTES {
            let expected = format!("no more than {MAX_ATTRIBUTES} attributes of an element");
            return Err(ParseError::new(at, "more", expected));
        }
    }
    Ok(attributes)
}

/// Turns ascending offsets into places, going over the text once.
struct Places<'t> {
    text: &'t str,
    byte: usize,
    at: Position,
}

impl Places<'_> {
    fn position(&mut self, offset: usize) -> Position {
        let mut characters = self.text[self.byte..].chars().peekable();
        while self.byte < offset
            && let Some(character) = characters.next()
        {
            self.byte += character.len_utf8();
            let ends_line = match character {
                '\r' => characters.peek() != Some(&'\n'),
                _ => character == '\n',
            };
            if ends_line {
                self.at = Position { line: self.at.line + 1, column: 1 };
            } else {
                self.at.column += 1;
            }
        }
        self.at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elements_know_their_places() {
        let text = "<?xml version=\"1.1\"?>\r\n<!-- a -->\n<p:a x='1' p:y=\"&lt;&#65;\">\n \
                    <b/>t <![CDATA[<u>]]>&amp;\r<é>  7 </é><b>2</b></p:a>\n";
        let root = parse(text).unwrap();
        assert_eq!((root.name, root.at), ("a", Position { line: 3, column: 1 }));
        assert_eq!(root.text(), "t <u>&");
        assert_eq!(root.text_at, Position { line: 4, column: 6 });
        let values: Vec<&str> = root.attributes.iter().map(|a| a.value.as_str()).collect();
        assert_eq!(values, ["1", "<A"]);
        assert_eq!(root.attributes[1].name, "y");
        let accented = root.child("é").unwrap();
        assert_eq!(accented.at, Position { line: 5, column: 1 });
        assert_eq!((accented.text(), accented.text_at), ("7", Position { line: 5, column: 6 }));
        let second: Vec<&str> = root.all("b").map(Element::text).collect();
        assert_eq!(second, ["", "2"]);
    }

    #[test]
    fn what_is_no_plain_xml_is_refused_with_its_place() {
        let deep = "<a>".repeat(100_000);
        let many: String = (0..100_000).map(|i| format!(" a{i}=''")).collect();
        let long_name = "x".repeat(10_000);
        let cases = [
            ("", 1, 1, "an XML element"),
            ("lamp", 1, 1, "an XML element"),
            ("<a>\n<b>", 2, 4, "the end of \"b\" of line 2"),
            ("<a>\n <b></a>", 2, 5, "well-formed XML"),
            ("<a/>\n<b/>", 2, 1, "after the root"),
            ("<a/>\ntext", 2, 1, "an XML element"),
            ("<!DOCTYPE a [<!ENTITY b \"c\">]>\n<a>&b;</a>", 1, 1, "without a document type"),
            ("<a>\n  &b;</a>", 2, 3, "one of lt"),
            ("<a>\n<b x=1/></a>", 2, 1, "attributes"),
            ("<a>\n<b x='1' x='2'/></a>", 2, 1, "attributes"),
            ("<a>\n<!-- never", 2, 1, "well-formed XML"),
            (&deep, 1, 1 + 3 * MAX_DEPTH, "64 levels"),
            (&format!("<a{many}/>"), 1, 1, "64 attributes"),
            (&format!("<a></{long_name}>"), 1, 4, "well-formed XML"),
        ];
        for (text, line, column, expected) in cases {
            let error = parse(text).expect_err("a refusal");
            assert_eq!((error.line(), error.column()), (line, column), "{error}");
            assert!(error.to_string().contains(expected), "{error}");
            assert!(error.to_string().len() < 400, "{error}");
        }
    }
}
