//! TOML as it is written: sections, keys, and values that are read back bit by bit.

use glam::DVec3;
use std::fmt::Write;

/// The text so far.
#[derive(Debug, Default)]
pub(super) struct Text(pub(super) String);

impl Text {
    pub(super) fn line(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    /// The head of a section, behind an empty line.
    pub(super) fn section(&mut self, head: &str) {
        self.line("");
        self.line(head);
    }

    pub(super) fn key(&mut self, key: &str, value: &str) {
        self.line(&format!("{key} = {value}"));
    }

    /// A list with a line for each value.
    pub(super) fn list(&mut self, key: &str, values: impl Iterator<Item = String>) {
        self.line(&format!("{key} = ["));
        values.for_each(|value| self.line(&format!("    {value},")));
        self.line("]");
    }
}

/// A basic string, also as a key.
pub(super) fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                write!(quoted, "\\u{:04X}", u32::from(c)).expect("strings grow");
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// A finite number that keeps its bits; whole ones without a point.
pub(super) fn number(value: f64) -> String {
    if value == value.trunc() && value.abs() < 1e15 {
        return format!("{value:.0}");
    }
    format!("{value:?}")
}

pub(super) fn vector(vector: DVec3) -> String {
    let [x, y, z] = vector.to_array().map(number);
    format!("[{x}, {y}, {z}]")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_numbers_are_read_back() {
        let texts = ["", "plain", "a \"b\" \\ c", "line\nfeed\ttab\u{0}\u{7f}", "\u{e4}\u{1F600}"];
        for text in texts {
            let read: toml::Table = format!("a = {}", quoted(text)).parse().unwrap();
            assert_eq!(read["a"].as_str(), Some(text));
            let read: toml::Table = format!("{} = 1", quoted(text)).parse().unwrap();
            assert_eq!(read.keys().next().map(String::as_str), Some(text));
        }
        for value in [0.0, -0.0, 1.0, -3.0, 0.1, 1e-300, 1e300, 1e15, 123456789.25, f64::MIN] {
            let read: toml::Table = format!("a = {}", number(value)).parse().unwrap();
            let read = read["a"].as_float().or(read["a"].as_integer().map(|it| it as f64));
            assert_eq!(read, Some(value));
        }
        assert_eq!(vector(DVec3::new(1.0, -0.5, 0.0)), "[1, -0.5, 0]");
    }
}
