//! Numbers of `product.xml`.

use super::GldfError;
use super::texts::{attribute, in_quotes};
use quasilux_text::Token;
use quasilux_text::xml::Element;

/// The number of a child; `None` where there is none, or an empty one.
pub(super) fn number(parent: &Element<'_>, name: &str) -> Result<Option<f64>, GldfError> {
    match parent.child(name) {
        Some(child) if !child.text().is_empty() => {
            let token = Token { text: child.text(), at: child.text_at };
            let number = token.number(child.name);
            number
                .map(|number| Some(number.value))
                .map_err(|error| GldfError::in_part(super::PRODUCT, &error))
        }
        _ => Ok(None),
    }
}

/// The number of a child, at least 0.
pub(super) fn amount(parent: &Element<'_>, name: &str) -> Result<Option<f64>, GldfError> {
    match number(parent, name)? {
        Some(value) if value < 0.0 => {
            let child = parent.child(name).unwrap_or(parent);
            Err(GldfError::at(child, value, format!("{name} of 0 or more")))
        }
        value => Ok(value),
    }
}

/// The number of lamps or gears that an attribute gives; 1 without it.
pub(super) fn count(element: &Element<'_>, name: &str) -> Result<f64, GldfError> {
    let Some(text) = attribute(element, name) else {
        return Ok(1.0);
    };
    match text.parse::<u32>() {
        Ok(count) if count > 0 => Ok(f64::from(count)),
        _ => Err(GldfError::at(element, in_quotes(text), format!("a {name} of 1 or more"))),
    }
}
