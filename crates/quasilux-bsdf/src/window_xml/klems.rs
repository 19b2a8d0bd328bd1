//! Matrices over angular patches: bases and values.

use super::block::Block;
use super::number_of;
use crate::klems::KlemsTable;
use crate::klems::{AngleBasis, BandDefinition};
use crate::tokens;
use crate::tokens::Style;
use crate::tokens::Tokens;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::xml::Element;
use quasilux_text::{ParseError, quoted};
use std::f64::consts::FRAC_PI_2;

/// Bands of one basis, and bases of one file: far above what any file has.
const MAX_BANDS: usize = 256;

/// A basis may end so far from the horizon by rounding.
const ROUNDING_RAD: f64 = 1e-4;

/// The bases that the file defines.
pub(super) fn bases(layer: &Element<'_>) -> Result<Vec<AngleBasis>, ParseError> {
    let definitions = layer.all("DataDefinition").flat_map(|data| data.all("AngleBasis"));
    definitions.take(MAX_BANDS).map(basis).collect()
}

fn basis(element: &Element<'_>) -> Result<AngleBasis, ParseError> {
    let name = element.child("AngleBasisName").map_or("", |name| name.text());
    let mut bands = Vec::new();
    let mut lower_deg = 0.0;
    for block in element.all("AngleBasisBlock").take(MAX_BANDS) {
        let missing = |what: &str| {
            ParseError::new(block.at, format_args!("no {what}"), "bounds and count of a band")
        };
        let bounds = block.child("ThetaBounds").ok_or_else(|| missing("ThetaBounds"))?;
        let upper = bounds.child("UpperTheta").ok_or_else(|| missing("UpperTheta"))?;
        let lower = bounds.child("LowerTheta").map(number_of).transpose()?;
        let upper = number_of(upper)?;
        if let Some(lower) = lower.filter(|lower| (lower.value - lower_deg).abs() > 1e-6) {
            let found = format!("a band from {} degrees", lower.value);
            let expected = format!("{lower_deg}, where the one before it ends");
            return Err(ParseError::new(lower.at, found, expected));
        }
        let count = block.child("nPhis").ok_or_else(|| missing("nPhis"))?;
        let patches = number_of(count)?;
        let is_count = patches.value.fract() == 0.0 && (1.0..=1e6).contains(&patches.value);
        if !is_count {
            let expected = "a number of patches from 1 to 1000000";
            return Err(ParseError::new(patches.at, quoted(count.text()), expected));
        }
        bands.push(BandDefinition::new(upper.value, patches.value as usize));
        lower_deg = upper.value;
    }
    AngleBasis::new(name, &bands).ok_or_else(|| {
        let found = format!("{} bands in {}", bands.len(), quoted(name));
        ParseError::new(element.at, found, "bands with angles that ascend to 90 degrees at most")
    })
}

/// The matrix of one block.
///
/// `Columns`: a row of the text holds one exit patch, a column one incident patch.
/// `ColumnAngleBasis` is the incident basis and `RowAngleBasis` the exit basis in both structures,
/// as Radiance reads them.
pub(super) fn read(
    block: &Block<'_, '_>,
    bases: &[AngleBasis],
    incident_rows: bool,
    warnings: &mut Warnings,
) -> Result<KlemsTable, ParseError> {
    let incident = basis_of(block, "ColumnAngleBasis", bases)?;
    let exit = basis_of(block, "RowAngleBasis", bases)?;
    for basis in [&incident, &exit] {
        let last_rad = basis.bands().last().map_or(0.0, |band| band.upper_rad);
        if last_rad < FRAC_PI_2 - ROUNDING_RAD {
            let found = format!(
                "the basis {} that ends {:.1} degrees from the normal",
                quoted(basis.name()),
                last_rad.to_degrees()
            );
            let expected = "bands to 90 degrees (light beyond is neither taken nor sent)";
            warnings.push(WarningKind::BasisEndsEarly, block.element.at, found, expected);
        }
    }
    let Some(data) = block.element.child("ScatteringData") else {
        let found = "no element ScatteringData";
        return Err(ParseError::new(block.element.at, found, "the values of the block"));
    };
    let expected = incident.patches().saturating_mul(exit.patches());
    let mut tokens = Tokens::new(data.text(), data.text_at, Style::Plain);
    // A value takes two bytes at least.
    let mut values = Vec::with_capacity(expected.min(data.text().len() / 2 + 1));
    for token in tokens.by_ref().take(expected) {
        values.push(tokens::value(token, warnings)?);
    }
    if values.len() < expected {
        let (rows, columns) = (exit.patches(), incident.patches());
        let expected = format!("{expected}: {columns} incident by {rows} exit patches");
        let found = format!("{} values", values.len());
        return Err(ParseError::new(tokens.at(), found, expected));
    }
    if let Some(further) = tokens.next() {
        let expected = format!("the end of the data after {expected} values (left out)");
        warnings.push(WarningKind::TrailingValues, further.at, quoted(further.text), expected);
    }
    let values = if incident_rows { values } else { transposed(&values, incident.patches()) };
    let at = block.element.at;
    KlemsTable::new(incident, exit, values)
        .ok_or_else(|| ParseError::new(at, "an unusable matrix", "finite values"))
}

fn basis_of(
    block: &Block<'_, '_>,
    role: &str,
    bases: &[AngleBasis],
) -> Result<AngleBasis, ParseError> {
    let Some(element) = block.element.child(role) else {
        let found = format!("no element {role}");
        return Err(ParseError::new(block.element.at, found, "the name of an angular basis"));
    };
    let name = element.text();
    let defined = bases.iter().find(|basis| basis.name().eq_ignore_ascii_case(name));
    defined.cloned().or_else(|| AngleBasis::known(name)).ok_or_else(|| {
        let expected = "a basis that the file defines, or LBNL/Klems Full, Half or Quarter";
        ParseError::new(element.text_at, quoted(name), expected)
    })
}

/// Columns become rows.
fn transposed(values: &[f64], columns: usize) -> Vec<f64> {
    let column = |start: usize| values[start..].iter().step_by(columns);
    (0..columns).flat_map(column).copied().collect()
}
