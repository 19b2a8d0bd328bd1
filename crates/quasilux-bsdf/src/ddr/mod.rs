//! Reader of Integra DDR (reflection) and DDT (transmission) files.
//!
//! What is read and tolerated stands in [`formats::ddr`](crate::formats::ddr).

mod header;
mod lobes;
mod oddities;

use crate::defects::warn_of_defects;
use crate::defects::warn_of_one_way;
use crate::distribution::Distribution;
use crate::facts::BsdfFacts;
use crate::facts::BsdfFormat;
use crate::measured::MeasuredBsdf;
use crate::parsed::Parsed;
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::tokens;
use crate::tokens::Style;
use crate::tokens::Tokens;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use header::{Colours, Head, Header};
use lobes::Resampled;
use quasilux_text::{ParseError, Position, Token, decode, quoted};
use std::f64::consts::PI;

/// The values of one colour.
struct Block {
    /// A factor for each incidence.
    scales: Vec<f64>,
    /// By `psi`, `sigma`, `phi` and `theta`, the last one running fastest.
    values: Vec<f64>,
}

/// Reads a DDR file, or a DDT file with [`ScatteringMode::Transmission`]: the content does not
/// tell. What is measured counts for light on the front. Total: any bytes give a surface or an
/// error with its place.
///
/// # Errors
/// [`ParseError`] with the position where the header, an angle or a value is missing or out of
/// range.
pub fn read_ddr(bytes: &[u8], mode: ScatteringMode) -> Result<Parsed, ParseError> {
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let start = Position { line: 1, column: 1 };
    let text = text.trim_start_matches('\u{FEFF}');
    let mut words = Words(Tokens::new(text, start, Style::Comments));
    let Head { header, first_block } = header::read(&mut words)?;
    let blocks = blocks(&mut words, &header, first_block, &mut warnings)?;
    let Resampled { table, error } = lobes::resample(&header, &blocks)
        .ok_or_else(|| ParseError::new(start, "values that make no table", "finite values"))?;
    let found = format!(
        "values around the specular direction, {} by {}",
        header.phi_rad.len(),
        header.theta_rad.len()
    );
    let between = table.error_between().map_or_else(String::new, |between| {
        format!(" at incidences of the file, by about {:.2} % between them", 100.0 * between)
    });
    let expected =
        format!("spherical angles (resampled; off by {:.2} % in the mean{between})", 100.0 * error);
    warnings.push(WarningKind::Resampled, header.at, found, expected);
    oddities::warn(&header, &mut warnings);

    let facts = BsdfFacts {
        format: BsdfFormat::Ddr,
        name: String::new(),
        manufacturer: String::new(),
        thickness_m: None,
    };
    let mut bsdf = MeasuredBsdf::new(facts);
    bsdf.set(Side::Front, mode, Distribution::Gridded(table));
    warn_of_one_way(&bsdf, header.at, &mut warnings);
    warn_of_defects(&bsdf, header.at, &mut warnings)?;
    Ok(Parsed { bsdf, warnings: warnings.into_vec() })
}

/// The words of a file.
pub(super) struct Words<'t>(Tokens<'t>);

impl<'t> Words<'t> {
    fn next(&mut self, expected: &str) -> Result<Token<'t>, ParseError> {
        let end = self.0.at();
        self.0.next().ok_or_else(|| ParseError::new(end, "the end of the file", expected))
    }
}

/// One block for each colour; `first` is the word that begins the first one.
fn blocks(
    words: &mut Words<'_>,
    header: &Header,
    first: Token<'_>,
    warnings: &mut Warnings,
) -> Result<Vec<Block>, ParseError> {
    let names: &[&[&str]] = match header.colours {
        Colours::Grey => &[&["bw"]],
        Colours::Rgb => &[&["red"], &["gre", "green"], &["blu", "blue"]],
    };
    let mut blocks = Vec::new();
    let mut word = first;
    for (index, names) in names.iter().enumerate() {
        if index > 0 {
            word = words.next(names[0])?;
        }
        if !names.iter().any(|name| name.eq_ignore_ascii_case(word.text)) {
            return Err(ParseError::new(
                word.at,
                quoted(word.text),
                format_args!("the block {}", names[0]),
            ));
        }
        blocks.push(block(words, header, warnings)?);
    }
    if let Some(further) = words.0.next() {
        let expected = "the end of the file after the last block (left out)";
        warnings.push(WarningKind::TrailingValues, further.at, quoted(further.text), expected);
    }
    Ok(blocks)
}

fn block(
    words: &mut Words<'_>,
    header: &Header,
    warnings: &mut Warnings,
) -> Result<Block, ParseError> {
    let mut word = words.next("kbdf or def")?;
    let mut scales = Vec::new();
    if word.text.eq_ignore_ascii_case("kbdf") {
        for _ in 0..header.incidences() {
            let token = words.next("a scale for each incidence")?;
            scales.push(tokens::value(token, warnings)?);
        }
        word = words.next("def")?;
    } else {
        scales.resize(header.incidences(), 1.0);
    }
    if !word.text.eq_ignore_ascii_case("def") {
        return Err(ParseError::new(word.at, quoted(word.text), "def, before the values"));
    }
    let count = header.incidences().saturating_mul(header.phi_rad.len() * header.theta_rad.len());
    let mut values = Vec::new();
    for _ in 0..count {
        let token = words.next("a value")?;
        if token.text.eq_ignore_ascii_case("enddef") {
            let found = format!("enddef after {} values", values.len());
            let expected = format!("{count}: for each psi, sigma, phi and theta");
            return Err(ParseError::new(token.at, found, expected));
        }
        values.push(tokens::value(token, warnings)? / PI);
    }
    let end = words.next("enddef")?;
    if !end.text.eq_ignore_ascii_case("enddef") {
        return Err(ParseError::new(
            end.at,
            quoted(end.text),
            format_args!("enddef after {count} values"),
        ));
    }
    Ok(Block { scales, values })
}
