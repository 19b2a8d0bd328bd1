//! Texts of `product.xml`, translated ones too, and how messages repeat them.

use quasilux_text::shortened;
use quasilux_text::xml::Element;

/// Choices that a message lists.
const MAX_LISTED: usize = 12;
/// Characters of a name that a message repeats.
const MAX_NAME: usize = 100;
/// Translations of a text: the European Union has 24 languages.
const MAX_TRANSLATIONS: usize = 64;

/// A name as a message repeats it, long enough to be copied.
pub(super) fn in_quotes(text: &str) -> String {
    format!("\"{}\"", shortened(text, MAX_NAME))
}

/// An attribute that is not empty.
pub(super) fn attribute<'e>(element: &'e Element<'_>, name: &str) -> Option<&'e str> {
    let values = element.attributes.iter().filter(|attribute| attribute.name == name);
    values.map(|attribute| attribute.value.trim()).find(|value| !value.is_empty())
}

/// A text that is translated: in English, else the first one, else the element's own.
pub(super) fn text_of<'e>(element: Option<&'e Element<'_>>) -> Option<&'e str> {
    let element = element?;
    let is_english =
        |it: &&Element<'_>| attribute(it, "language").is_some_and(|it| it.starts_with("en"));
    let english = element.all("Locale").find(is_english);
    let text = english.or_else(|| element.child("Locale")).unwrap_or(element).text();
    (!text.is_empty()).then_some(text)
}

/// A text and its translations, the first ones of many.
pub(super) fn translations<'e>(element: &'e Element<'_>) -> impl Iterator<Item = &'e str> {
    let all = std::iter::once(element).chain(element.all("Locale"));
    all.map(Element::text).filter(|it| !it.is_empty()).take(MAX_TRANSLATIONS)
}

/// Whether any translation of a text is this one.
pub(super) fn is_called(element: Option<&Element<'_>>, name: &str) -> bool {
    element.is_some_and(|it| translations(it).any(|text| text == name))
}

/// Choices for a message: `"a", "b" or "c"`, the first ones of many.
pub(super) fn listed(choices: &[String]) -> String {
    let more = choices.len().saturating_sub(MAX_LISTED);
    let mut text = choices[..choices.len() - more].join(", ");
    if more > 0 {
        text += &format!(" and {more} more");
    }
    text
}
