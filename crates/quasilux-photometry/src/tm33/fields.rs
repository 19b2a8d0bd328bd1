//! Elements by name: under the standard's names, or under those that other writers use.

use crate::warning::{WarningKind, Warnings};
use quasilux_text::xml::Element;
use quasilux_text::{Number, ParseError, Token, quoted};

/// The child with the first of these names that there is. The first name is the standard's; a child
/// under another one is noted.
pub(super) fn named<'e, 't>(
    parent: &'e Element<'t>,
    names: &[&str],
    warnings: &mut Warnings,
) -> Option<&'e Element<'t>> {
    let child = names.iter().find_map(|name| parent.child(name))?;
    note_foreign(child, names[0], warnings);
    Some(child)
}

/// Notes an element that has not the standard's name.
pub(super) fn note_foreign(element: &Element<'_>, standard: &str, warnings: &mut Warnings) {
    if element.name != standard {
        let expected = format_args!("{standard} (read as that)").to_string();
        let found = format_args!("the element {}", quoted(element.name)).to_string();
        warnings.push(WarningKind::ForeignElement, element.at, found, expected);
    }
}

/// Notes elements that the standard requires and that are missing or empty.
pub(super) fn require(parent: &Element<'_>, names: &[&str], warnings: &mut Warnings) {
    for name in names {
        let child = parent.child(name);
        let has_children = child.is_some_and(|child| !child.children.is_empty());
        if is_empty_or_missing(child) && !has_children {
            let found = format_args!("{} without {name}", parent.name).to_string();
            warnings.push(WarningKind::MissingElement, parent.at, found, "all that TM-33 requires");
        }
    }
}

/// Whether there is no text.
pub(super) fn is_empty_or_missing(element: Option<&Element<'_>>) -> bool {
    element.is_none_or(|element| element.text().is_empty())
}

/// The text of an element as a number.
pub(super) fn number(element: &Element<'_>) -> Result<Number, ParseError> {
    Token { text: element.text(), at: element.text_at }.number(element.name)
}

/// A child's number, where an empty child counts as none.
pub(super) fn optional_number(
    parent: &Element<'_>,
    names: &[&str],
    warnings: &mut Warnings,
) -> Result<Option<Number>, ParseError> {
    let Some(child) = named(parent, names, warnings) else {
        return Ok(None);
    };
    if child.text().is_empty() {
        let expected = format_args!("a number in {} (read as missing)", child.name).to_string();
        warnings.push(WarningKind::EmptyNumber, child.at, "nothing", expected);
        return Ok(None);
    }
    number(child).map(Some)
}

/// A child's factor, 1 if there is none.
pub(super) fn factor(
    parent: &Element<'_>,
    name: &str,
    warnings: &mut Warnings,
) -> Result<f64, ParseError> {
    match optional_number(parent, &[name], warnings)? {
        None => Ok(1.0),
        Some(Number { value, .. }) if value > 0.0 => Ok(value),
        Some(Number { value, at }) => {
            Err(ParseError::new(at, value, format_args!("a {name} above 0 (1 if unknown)")))
        }
    }
}

/// A child's count, if there is one.
pub(super) fn optional_count(
    parent: &Element<'_>,
    name: &str,
    warnings: &mut Warnings,
) -> Result<Option<usize>, ParseError> {
    let Some(number) = optional_number(parent, &[name], warnings)? else {
        return Ok(None);
    };
    let text = parent.child(name).map_or("", Element::text);
    Token { text, at: number.at }.count(number, name, 0, warnings).map(Some)
}

/// A child's truth value, if there is one.
pub(super) fn optional_boolean(
    parent: &Element<'_>,
    name: &str,
) -> Result<Option<bool>, ParseError> {
    let Some(child) = parent.child(name).filter(|child| !child.text().is_empty()) else {
        return Ok(None);
    };
    match child.text().to_ascii_lowercase().as_str() {
        "true" | "1" => Ok(Some(true)),
        "false" | "0" => Ok(Some(false)),
        other => Err(ParseError::new(child.text_at, quoted(other), "true or false")),
    }
}

/// A word of a list, without the blanks and underscores inside and in small letters: writers spell
/// `Symm_Full` as `Symm _ Full` too.
pub(super) fn word(element: &Element<'_>) -> String {
    let letters = element.text().chars().filter(|c| !c.is_whitespace() && *c != '_');
    letters.flat_map(char::to_lowercase).collect()
}
