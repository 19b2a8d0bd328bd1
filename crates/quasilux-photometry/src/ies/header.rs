//! The lines before the numbers: edition, keywords, `TILT=`.

use crate::warning::{WarningKind, Warnings};
use crate::{IesStandard, Keyword};
use quasilux_text::{ParseError, Position, quoted};

/// What stands before the numbers.
pub(super) struct Header<'t> {
    pub(super) standard: IesStandard,
    pub(super) keywords: Vec<Keyword>,
    pub(super) tilt: TiltLine<'t>,
    /// Index of the first line behind `TILT=`.
    pub(super) next_line: usize,
}

/// The right side of `TILT=`.
pub(super) enum TiltLine<'t> {
    None,
    Include,
    File(&'t str),
}

/// Reads the lines up to and including `TILT=`.
pub(super) fn read_header<'t>(
    lines: &[&'t str],
    warnings: &mut Warnings,
) -> Result<Header<'t>, ParseError> {
    let Some(first) = lines.iter().position(|line| !line.trim().is_empty()) else {
        let at = Position { line: 1, column: 1 };
        return Err(ParseError::new(at, "an empty file", "an IES LM-63 file"));
    };
    let Some(tilt_line) = lines.iter().position(|line| tilt_value(line).is_some()) else {
        let last = lines.len();
        let at = Position { line: last, column: lines[last - 1].chars().count() + 1 };
        let expected = "a line TILT=NONE, TILT=INCLUDE or TILT=<file> (is this an IES LM-63 file?)";
        return Err(ParseError::new(at, "the end of the file", expected));
    };
    if first > 0 {
        let at = Position { line: 1, column: 1 };
        warnings.push(WarningKind::LeadingBlankLine, at, "an empty line", "the identifying line");
    }

    let Edition { standard, is_identified } = if first < tilt_line {
        identify(lines[first], first + 1, warnings)
    } else {
        Edition::UNIDENTIFIED
    };
    let labels = first + usize::from(is_identified)..tilt_line;
    let keywords = read_keywords(&lines[..labels.end], labels.start, standard, warnings);

    let value = tilt_value(lines[tilt_line]).unwrap_or_default();
    let at = Position { line: tilt_line + 1, column: 1 };
    if !lines[tilt_line].starts_with("TILT=")
        || value != value.to_ascii_uppercase() && is_word(value)
    {
        warnings.push(
            WarningKind::TiltSpelling,
            at,
            quoted(lines[tilt_line]),
            "TILT= in capitals, without blanks",
        );
    }
    let tilt = match value.to_ascii_uppercase().as_str() {
        "NONE" => TiltLine::None,
        "INCLUDE" => TiltLine::Include,
        "" => {
            return Err(ParseError::new(
                at,
                "TILT= with nothing behind it",
                "NONE, INCLUDE or the name of a file",
            ));
        }
        _ => TiltLine::File(value),
    };
    Ok(Header { standard, keywords, tilt, next_line: tilt_line + 1 })
}

/// The text behind `TILT=`, if the line is one.
fn tilt_value(line: &str) -> Option<&str> {
    let (name, value) = line.split_once('=')?;
    name.trim().eq_ignore_ascii_case("TILT").then(|| value.trim())
}

fn is_word(value: &str) -> bool {
    value.eq_ignore_ascii_case("NONE") || value.eq_ignore_ascii_case("INCLUDE")
}

/// The edition of a file.
struct Edition {
    standard: IesStandard,
    /// Whether the first line identifies it.
    is_identified: bool,
}

impl Edition {
    /// LM-63-1986 had no identifying line.
    const UNIDENTIFIED: Self = Self { standard: IesStandard::Lm63Of1986, is_identified: false };
}

/// The edition that a line identifies.
fn identify(line: &str, number: usize, warnings: &mut Warnings) -> Edition {
    let compact: String =
        line.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_ascii_uppercase()).collect();
    let year = compact.split_once("LM-63-").map(|(_, year)| year);
    let (standard, spelling) = match (compact.as_str(), year) {
        ("IESNA91", _) | (_, Some("1991" | "91")) => (IesStandard::Lm63Of1991, "IESNA91"),
        ("IESNA86", _) | (_, Some("1986" | "86")) => (IesStandard::Lm63Of1986, ""),
        (_, Some("1995" | "95")) => (IesStandard::Lm63Of1995, "IESNA:LM-63-1995"),
        (_, Some("2002" | "02")) => (IesStandard::Lm63Of2002, "IESNA:LM-63-2002"),
        (_, Some("2019" | "19")) => (IesStandard::Lm63Of2019, "IES:LM-63-2019"),
        _ if compact.starts_with("IESNA") || year.is_some() => {
            let at = Position { line: number, column: 1 };
            let expected = "an edition between IESNA91 and IES:LM-63-2019 (read as LM-63-2002)";
            warnings.push(WarningKind::UnknownStandard, at, quoted(line), expected);
            return Edition { standard: IesStandard::Lm63Of2002, is_identified: true };
        }
        _ => return Edition::UNIDENTIFIED,
    };
    if line.trim_end() != spelling {
        let at = Position { line: number, column: 1 };
        let expected =
            if spelling.is_empty() { "no identifying line in LM-63-1986" } else { spelling };
        warnings.push(WarningKind::IdentifyingLine, at, quoted(line), expected);
    }
    Edition { standard, is_identified: true }
}

fn read_keywords(
    lines: &[&str],
    start: usize,
    standard: IesStandard,
    warnings: &mut Warnings,
) -> Vec<Keyword> {
    let mut keywords: Vec<Keyword> = Vec::new();
    for (index, line) in lines.iter().enumerate().skip(start) {
        let text = line.trim();
        let bracketed = text.strip_prefix('[').and_then(|rest| rest.split_once(']'));
        let (name, value) = match bracketed {
            Some((name, value)) => (name.trim().to_uppercase(), value.trim()),
            None if text.is_empty() => continue,
            None => {
                if standard > IesStandard::Lm63Of1986 {
                    let at = Position { line: index + 1, column: 1 };
                    let expected = "a keyword in brackets (kept as a label)";
                    warnings.push(WarningKind::LabelWithoutKeyword, at, quoted(text), expected);
                }
                (String::new(), text)
            }
        };
        match keywords.last_mut() {
            Some(previous) if name == "MORE" => {
                previous.value.push('\n');
                previous.value.push_str(value);
            }
            _ => keywords.push(Keyword { name, value: value.to_owned(), line: index + 1 }),
        }
    }
    keywords
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn editions_are_known_by_their_number() {
        let edition = |line| {
            let mut warnings = Warnings::default();
            let standard = identify(line, 1, &mut warnings).standard;
            (standard, warnings.into_vec().first().map(|warning| warning.kind()))
        };
        assert_eq!(edition("IESNA91"), (IesStandard::Lm63Of1991, None));
        assert_eq!(edition("IESNA:LM-63-1995  "), (IesStandard::Lm63Of1995, None));
        assert_eq!(edition("IESNA:LM-63-2002"), (IesStandard::Lm63Of2002, None));
        assert_eq!(edition("IES:LM-63-2019"), (IesStandard::Lm63Of2019, None));
        assert_eq!(edition("A label of 1986"), (IesStandard::Lm63Of1986, None));
        let spelling = Some(WarningKind::IdentifyingLine);
        assert_eq!(edition(" IESNA: lm-63-2002"), (IesStandard::Lm63Of2002, spelling));
        assert_eq!(edition("ANSI/IES LM-63-19"), (IesStandard::Lm63Of2019, spelling));
        let unknown = Some(WarningKind::UnknownStandard);
        assert_eq!(edition("IESNA:LM-63-2031"), (IesStandard::Lm63Of2002, unknown));
    }
}
