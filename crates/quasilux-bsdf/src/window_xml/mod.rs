//! Reader of LBNL WINDOW files: scattering matrices over Klems patches and tensor trees, in XML.
//!
//! What is read and tolerated stands in [`formats::window_xml`](crate::formats::window_xml).

mod block;
mod klems;
mod reciprocity;
mod tree;

use crate::defects;
use crate::distribution::Distribution;
use crate::facts::BsdfFacts;
use crate::facts::BsdfFormat;
use crate::measured::MeasuredBsdf;
use crate::parsed::Parsed;
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::xml::{self, Element};
use quasilux_text::{Number, ParseError, Position, Token, decode, quoted};
use std::borrow::Cow;

/// How `IncidentDataStructure` orders the data.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Structure {
    /// A matrix; whether a row holds the values of one incident patch.
    Matrix { incident_rows: bool },
    /// A tree of 3 or 4 axes.
    Tree { rank: usize },
}

/// Reads a WINDOW file. Total: any bytes give a surface or an error with its place, and memory is
/// bounded by a multiple of the file's length.
///
/// # Errors
/// [`ParseError`] with the position where the XML is not well formed, or a basis, an axis or a
/// value is missing or out of range.
pub fn read_bsdf_xml(bytes: &[u8]) -> Result<Parsed, ParseError> {
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut Warnings::default());
    let text = without_foreword(text, &mut warnings);
    let root = xml::parse(text.trim_start_matches('\u{FEFF}'))?;
    if root.name != "WindowElement" {
        let found = format!("{} as the root element", quoted(root.name));
        return Err(ParseError::new(root.at, found, "a WINDOW file: WindowElement"));
    }
    let layer = layer(&root, &mut warnings)?;
    let structure = structure(layer)?;
    let facts = facts(layer, structure, &mut warnings)?;
    let blocks = block::select(layer, &mut warnings)?;

    let mut bsdf = MeasuredBsdf::new(facts);
    let bases = klems::bases(layer)?;
    for block in &blocks {
        let distribution = match structure {
            Structure::Matrix { incident_rows } => {
                Distribution::Klems(klems::read(block, &bases, incident_rows, &mut warnings)?)
            }
            Structure::Tree { rank } => {
                Distribution::TensorTree(tree::read(block, rank, &mut warnings)?)
            }
        };
        bsdf.set(block.light.side, block.light.mode, distribution);
    }
    reciprocity::fill_transmission(&mut bsdf, &blocks, &mut warnings);
    block::warn_of_missing_reflection(&blocks, &mut warnings);
    defects::warn_of_defects(&bsdf, blocks[0].element.at, &mut warnings)?;
    Ok(Parsed { bsdf, warnings: warnings.into_vec() })
}

/// The text with blanks in the place of what stands before the XML: messages that a program wrote
/// to its output.
fn without_foreword<'t>(text: Cow<'t, str>, warnings: &mut Warnings) -> Cow<'t, str> {
    let bare = text.trim_start_matches('\u{FEFF}').trim_start();
    let Some(start) = text.find('<').filter(|_| !bare.starts_with('<')) else {
        return text;
    };
    let (foreword, xml) = text.split_at(start);
    let expected = "XML from the first line on (left out)";
    let at = Position { line: 1, column: 1 };
    warnings.push(
        WarningKind::Foreword,
        at,
        quoted(bare.lines().next().unwrap_or_default()),
        expected,
    );
    let is_end = |character: char| matches!(character, '\n' | '\r');
    let blank = |character: char| if is_end(character) { character } else { ' ' };
    Cow::Owned(foreword.chars().map(blank).chain(xml.chars()).collect())
}

fn layer<'e, 't>(
    root: &'e Element<'t>,
    warnings: &mut Warnings,
) -> Result<&'e Element<'t>, ParseError> {
    let layers: Vec<&Element<'_>> = root.all("Optical").flat_map(|o| o.all("Layer")).collect();
    let Some(first) = layers.first() else {
        let found = "no element Layer in an element Optical";
        return Err(ParseError::new(root.at, found, "the optical layer of the surface"));
    };
    if let Some(second) = layers.get(1) {
        let expected = "one layer (the first is read)";
        warnings.push(WarningKind::SeveralLayers, second.at, "another Layer", expected);
    }
    Ok(first)
}

fn structure(layer: &Element<'_>) -> Result<Structure, ParseError> {
    let expected = "IncidentDataStructure: Columns, Rows, TensorTree3 or TensorTree4";
    let element = layer.child("DataDefinition").and_then(|d| d.child("IncidentDataStructure"));
    let Some(element) = element else {
        let found = "no element IncidentDataStructure in DataDefinition";
        return Err(ParseError::new(layer.at, found, expected));
    };
    let words = [
        ("Columns", Structure::Matrix { incident_rows: false }),
        ("Rows", Structure::Matrix { incident_rows: true }),
        ("TensorTree3", Structure::Tree { rank: 3 }),
        ("TensorTree4", Structure::Tree { rank: 4 }),
    ];
    let known = words.into_iter().find(|(word, _)| word.eq_ignore_ascii_case(element.text()));
    known
        .map(|(_, structure)| structure)
        .ok_or_else(|| ParseError::new(element.text_at, quoted(element.text()), expected))
}

fn facts(
    layer: &Element<'_>,
    structure: Structure,
    warnings: &mut Warnings,
) -> Result<BsdfFacts, ParseError> {
    let format = match structure {
        Structure::Matrix { .. } => BsdfFormat::WindowKlems,
        Structure::Tree { .. } => BsdfFormat::WindowTensorTree,
    };
    let material = layer.child("Material");
    let text = |name: &str| {
        material.and_then(|m| m.child(name)).map_or(String::new(), |e| e.text().to_owned())
    };
    let thickness = material.and_then(|material| material.child("Thickness"));
    let thickness_m = thickness.and_then(|element| thickness_m(element, warnings));
    Ok(BsdfFacts { format, name: text("Name"), manufacturer: text("Manufacturer"), thickness_m })
}

/// A thickness that serves no calculation: what cannot be read is left out.
fn thickness_m(element: &Element<'_>, warnings: &mut Warnings) -> Option<f64> {
    if element.text().is_empty() {
        return None;
    }
    let unit = element.attributes.iter().find(|attribute| attribute.name == "unit");
    let unit = unit.map_or("meter", |attribute| attribute.value.trim());
    let units = [
        ("meter", 1.0),
        ("centimeter", 0.01),
        ("millimeter", 0.001),
        ("inch", 0.0254),
        ("foot", 0.3048),
    ];
    let metres = units.into_iter().find(|(name, _)| name.eq_ignore_ascii_case(unit));
    let number = number_of(element);
    match (metres, number) {
        (Some((_, metres)), Ok(number)) if number.value >= 0.0 => Some(metres * number.value),
        _ => {
            let found = format!("a thickness of {} {}", quoted(element.text()), quoted(unit));
            let expected =
                "a number from 0 on, in meter, centimeter, millimeter, inch or foot (left out)";
            warnings.push(WarningKind::UnknownThickness, element.at, found, expected);
            None
        }
    }
}

impl Side {
    /// `Front` or `Back` in a file.
    fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|side| side.name().eq_ignore_ascii_case(word))
    }
}

impl ScatteringMode {
    /// `Reflection` or `Transmission` in a file.
    fn from_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|mode| mode.name().eq_ignore_ascii_case(word))
    }
}

/// The only number of an element.
fn number_of(element: &Element<'_>) -> Result<Number, ParseError> {
    Token { text: element.text(), at: element.text_at }.number(element.name)
}
