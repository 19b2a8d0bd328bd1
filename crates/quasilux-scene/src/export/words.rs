//! The language of Radiance's scene files (G. Ward, "The RADIANCE synthetic imaging system",
//! reference manual): a primitive is a modifier, a type, an identifier, and three counted lists.

use glam::DVec3;
use std::collections::HashSet;
use std::fmt::Write;

/// Most characters of a number: Radiance's programs take longer words apart.
const MAX_DIGITS: usize = 20;

/// A number as all programs of Radiance read it.
pub(super) fn number(value: f64) -> String {
    let plain = format!("{value}");
    if plain.len() <= MAX_DIGITS { plain } else { format!("{value:.10e}") }
}

/// Numbers with blanks between.
pub(super) fn list(values: &[f64]) -> String {
    values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(" ")
}

/// A scene file so far.
#[derive(Debug, Default)]
pub(super) struct Words(pub(super) String);

/// A primitive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Primitive<'p> {
    pub(super) modifier: &'p str,
    pub(super) kind: &'p str,
    pub(super) name: &'p str,
    pub(super) texts: &'p [String],
    pub(super) numbers: &'p [f64],
}

impl Words {
    pub(super) fn comment(&mut self, text: &str) {
        writeln!(self.0, "# {text}").expect("strings grow");
    }

    /// Adds a primitive, with three numbers a line.
    pub(super) fn add(&mut self, primitive: Primitive<'_>) {
        let Primitive { modifier, kind, name, texts, numbers } = primitive;
        let text = &mut self.0;
        let texts: String = texts.iter().map(|it| format!(" {it}")).collect();
        let count = texts.split_whitespace().count();
        write!(text, "{modifier} {kind} {name}\n{count}{texts}\n0\n{}", numbers.len())
            .expect("strings grow");
        for (place, value) in numbers.iter().enumerate() {
            let before = if place % 3 == 0 && numbers.len() > 5 { "\n    " } else { " " };
            write!(text, "{before}{}", number(*value)).expect("strings grow");
        }
        text.push('\n');
    }

    /// Adds a primitive that has numbers alone.
    pub(super) fn of_numbers(&mut self, modifier: &str, kind: &str, name: &str, numbers: &[f64]) {
        self.add(Primitive { modifier, kind, name, texts: &[], numbers });
    }

    /// Adds a polygon, which faces where its corners are counter-clockwise.
    pub(super) fn polygon(&mut self, modifier: &str, name: &str, corners: &[DVec3]) {
        let numbers: Vec<f64> = corners.iter().flat_map(|corner| corner.to_array()).collect();
        self.of_numbers(modifier, "polygon", name, &numbers);
    }
}

/// Identifiers that were handed out.
#[derive(Debug, Default)]
pub(super) struct Identifiers(HashSet<String>);

impl Identifiers {
    /// An identifier near a name, and no other's: without blanks, and no number or word of the
    /// language.
    pub(super) fn near(&mut self, name: &str) -> String {
        let plain: String = name
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
            .take(60)
            .collect();
        let first = format!("m_{plain}");
        let mut name = first.clone();
        let mut number = 2;
        while !self.0.insert(name.clone()) {
            name = format!("{first}_{number}");
            number += 1;
        }
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_words() {
        for value in [1.2246467991473532e-16, 1.0 / 3.0, -123_456.789_012_345_67, 0.0, 1e300, 0.8] {
            let word = number(value);
            assert!(word.len() <= MAX_DIGITS, "{word}");
            let read: f64 = word.parse().expect("a number");
            assert!((read - value).abs() <= 1e-10 * value.abs(), "{word}");
        }
    }
}
