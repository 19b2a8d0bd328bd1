//! Which format a file has, told by its content.

use crate::warning::Warnings;
use crate::{Parsed, read_ies, read_ldt, read_tm33};
use quasilux_sampling::ParseNameError;
use quasilux_text::{ParseError, decode, lines};
use std::fmt;
use std::str::FromStr;

/// The formats of luminaire files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// ANSI/IES LM-63.
    Lm63,
    /// EULUMDAT.
    Eulumdat,
    /// ANSI/IES TM-33, an XML format.
    Tm33,
}

/// The mark of a format stands within this many bytes.
const MAX_SEARCHED: usize = 1 << 16;
/// EULUMDAT: lines 3 to 7 hold the symmetry and the numbers and distances of planes and angles.
const LDT_NUMBERS: std::ops::Range<usize> = 2..7;

impl Format {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Lm63, Self::Eulumdat, Self::Tm33];

    /// The format that the content shows: a line `TILT=` or an identifying line makes it LM-63, an
    /// opening angle bracket TM-33, numbers in lines 3 to 7 EULUMDAT: there, a later line that
    /// begins as `TILT=` does is a name. `None` where there is no such mark.
    pub fn from_content(bytes: &[u8]) -> Option<Self> {
        let start = &bytes[..bytes.len().min(MAX_SEARCHED)];
        let text = decode(start, &mut Warnings::default());
        let lines: Vec<&str> = lines(&text).collect();
        let first = lines.iter().map(|line| line.trim()).find(|line| !line.is_empty())?;
        let begins = |line: &str, mark: &str| {
            line.get(..mark.len()).is_some_and(|head| head.eq_ignore_ascii_case(mark))
        };
        let is_tilt = |line: &&str| {
            begins(line.trim_start(), "TILT")
                && line.trim_start()[4..].trim_start().starts_with('=')
        };
        let is_number =
            |line: &&str| line.trim().replace(',', ".").parse::<f64>().is_ok_and(f64::is_finite);
        let (early, late) = lines.split_at(lines.len().min(LDT_NUMBERS.end));
        if first.starts_with('<') {
            Some(Self::Tm33)
        } else if begins(first, "IESNA") || begins(first, "IES:LM-63") || early.iter().any(is_tilt)
        {
            Some(Self::Lm63)
        } else if early.get(LDT_NUMBERS).is_some_and(|lines| lines.iter().all(is_number)) {
            Some(Self::Eulumdat)
        } else {
            late.iter().any(is_tilt).then_some(Self::Lm63)
        }
    }

    /// The format that a file's name promises: `.ies`, `.ldt` or `.xml`, in letters of any case.
    pub fn from_name(name: &str) -> Option<Self> {
        let (_, extension) = name.rsplit_once('.')?;
        [("ies", Self::Lm63), ("ldt", Self::Eulumdat), ("xml", Self::Tm33)]
            .into_iter()
            .find(|(known, _)| extension.eq_ignore_ascii_case(known))
            .map(|(_, format)| format)
    }

    /// The format of a file: what its content shows, or else what its name promises.
    pub fn from_file(name: &str, bytes: &[u8]) -> Option<Self> {
        Self::from_content(bytes).or_else(|| Self::from_name(name))
    }

    /// What the name of a file of this format promises, where that is another format.
    pub fn misnamed(self, name: &str) -> Option<Self> {
        Self::from_name(name).filter(|promised| *promised != self)
    }

    /// `LM-63`, `EULUMDAT` or `TM-33`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lm63 => "LM-63",
            Self::Eulumdat => "EULUMDAT",
            Self::Tm33 => "TM-33",
        }
    }

    /// Reads a file of this format.
    ///
    /// # Errors
    /// All errors of [`read_ies`], [`read_ldt`] or [`read_tm33`].
    pub fn read(self, bytes: &[u8]) -> Result<Parsed, ParseError> {
        match self {
            Self::Lm63 => read_ies(bytes),
            Self::Eulumdat => read_ldt(bytes),
            Self::Tm33 => read_tm33(bytes),
        }
    }
}

impl fmt::Display for Format {
    /// Its [name](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Format {
    type Err = ParseNameError;

    /// The format of that [name](Self::name).
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        let known = Self::ALL.into_iter().find(|format| format.name() == name);
        known.ok_or_else(|| ParseNameError::new("format", name, "LM-63, EULUMDAT, TM-33"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_tells_the_format() {
        for (content, format) in [
            ("IESNA:LM-63-2002\n[TEST]", Some(Format::Lm63)),
            ("ies:lm-63-2019\n", Some(Format::Lm63)),
            ("\n\nold label\nanother\n tilt = NONE\n1 2 3", Some(Format::Lm63)),
            ("\u{feff}  <?xml version=\"1.0\"?>", Some(Format::Tm33)),
            ("maker\n1\n0\n24\n15,0\n19\n5.0\nreport\n", Some(Format::Eulumdat)),
            ("maker\n1\n0\n24\n15\n19\n5\nreport\nTILT=INCLUDE lamp\n", Some(Format::Eulumdat)),
            ("label\nTILT=NONE\n1\n1000\n1\n2\n1\n1\n2\n", Some(Format::Lm63)),
            ("1\n2\n3\nfour\n5\n6\n7\n8\nTILT=NONE\n1 1000", Some(Format::Lm63)),
            ("maker\n1\n0\n24\n15,0\nnineteen\n5.0\nreport\n", None),
            ("TILTED lamps\nTIL\u{e4}=\nTILT", None),
            ("1\n2\n3", None),
            (" \n\n", None),
            ("", None),
        ] {
            assert_eq!(Format::from_content(content.as_bytes()), format, "{content:?}");
        }
    }

    #[test]
    fn formats_are_read_back_from_their_names() {
        for format in Format::ALL {
            assert_eq!(format.to_string().parse(), Ok(format));
        }
        let error = "IES".parse::<Format>().unwrap_err();
        assert_eq!(error.to_string(), "unknown format \"IES\"; expected LM-63, EULUMDAT, TM-33");
    }

    #[test]
    fn names_tell_it_by_their_extension() {
        assert_eq!(Format::from_name("a.b.IES"), Some(Format::Lm63));
        assert_eq!(Format::from_name("a.Ldt"), Some(Format::Eulumdat));
        assert_eq!(Format::from_name("ies"), None);
    }
}
