//! Reader of ANSI/IES TM-33 files (2018 and 2023), and of ATLA S001, which they come from.
//!
//! The elements that light depends on, and how they are read, stand in
//! [`formats::tm33`](crate::formats::tm33); what is tolerated beyond the standard is listed, rule
//! by rule, in [`WarningKind`].

mod emitter;
mod fields;
mod grid;
mod opening;

use crate::photometry::FLUX_TOLERANCE;
use crate::sum::{Summand, sum};
use crate::warning::{WarningKind, Warnings};
use crate::{
    Keyword, LuminaireFacts, Parsed, PhotometricType, Photometry, SphericalTable, Standard, Tilt,
    Tm33Edition,
};
use emitter::{Emitter, StatedFlux};
use fields::{is_empty_or_missing, require};
use quasilux_text::xml::{self, Element};
use quasilux_text::{ParseError, quoted};
use std::borrow::Cow;

/// Reads a TM-33 file. Total: any bytes give a luminaire or an error with its place, and memory is
/// bounded by a multiple of the file's length.
///
/// # Errors
/// [`ParseError`] with the position where the XML is not well formed, or an element that
/// intensities depend on is missing or out of range.
pub fn read_tm33(bytes: &[u8]) -> Result<Parsed, ParseError> {
    quasilux_text::refuse_web_page(bytes)?;
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let root = xml::parse(text.trim_start_matches('\u{FEFF}'))?;
    let edition = edition(&root, &mut warnings)?;
    let header = root.child("Header");
    require(&root, &["Version", "Header"], &mut warnings);
    if let Some(header) = header {
        let required = ["Description", "Laboratory", "ReportNumber", "ReportDate"];
        require(header, &required, &mut warnings);
    }
    let photometric_type = emitter::photometric_type(&root, &mut warnings)?;

    let emitters = read_emitters(&root, photometric_type, &mut warnings)?;
    let opening = opening::read(&root, &mut warnings)?;
    let summands: Vec<Summand<'_>> = emitters.iter().map(Emitter::summand).collect();
    let table = sum(&summands)?;
    if table.integral() <= 0.0 {
        let found = "an integrated flux of 0 lm";
        warnings.push(WarningKind::NoLight, emitters[0].at, found, "some light");
    }
    let facts = LuminaireFacts {
        standard: Standard::Tm33(edition),
        photometric_type,
        keywords: keywords(header, &emitters),
        tilt: Tilt::None,
        lamp_count: emitters.iter().map(|emitter| emitter.quantity).sum(),
        lumens_per_lamp: lumens_per_lamp(&emitters),
        ballast_factor: emitters[0].ballast_factor,
        ballast_lamp_field: 1.0,
        input_watts: emitters.iter().map(|emitter| emitter.input_watts).sum(),
        candela_factor: emitters[0].candela_factor,
        opening,
        light_output_ratio: None,
        measurement_tilt_rad: 0.0,
        eulumdat: None,
    };
    let photometry = Photometry::new(table, facts);
    Ok(Parsed { photometry, warnings: warnings.into_vec() })
}

/// The emitters with luminous intensities, at least one.
fn read_emitters(
    root: &Element<'_>,
    photometric_type: PhotometricType,
    warnings: &mut Warnings,
) -> Result<Vec<Emitter>, ParseError> {
    let mut emitters = Vec::new();
    let mut dark = None;
    for element in root.all("Emitter") {
        match Emitter::read(element, photometric_type, warnings)? {
            Some(emitter) => emitters.push(emitter),
            None => dark = dark.or(Some(element)),
        }
    }
    if emitters.is_empty() {
        return Err(no_light(root, dark));
    }
    if let Some(dark) = dark {
        let found = "an emitter without luminous intensities";
        let expected = "LuminousData in each emitter (this one is left out)";
        warnings.push(WarningKind::EmitterWithoutLight, dark.at, found, expected);
    }
    if let [_, second, ..] = &emitters[..] {
        let found = format_args!("{} emitters", emitters.len()).to_string();
        let expected = "one emitter (their intensities are added, as if from one place)";
        warnings.push(WarningKind::SeveralEmitters, second.at, found, expected);
    }
    Ok(emitters)
}

/// The text. XML may start with a byte order mark, be UTF-16, or name its encoding.
fn decode<'b>(bytes: &'b [u8], warnings: &mut Warnings) -> Cow<'b, str> {
    let mut found = Warnings::default();
    let text = quasilux_text::decode(bytes, &mut found);
    let names_latin_1 = text.lines().next().is_some_and(|line| {
        let line = line.to_ascii_lowercase();
        line.contains("iso-8859-1") || line.contains("windows-1252")
    });
    let is_wide = matches!(bytes, [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..]);
    if !names_latin_1 && !is_wide {
        warnings.take_kind(found, WarningKind::Encoding);
    }
    text
}

/// What the root names.
fn edition(root: &Element<'_>, warnings: &mut Warnings) -> Result<Tm33Edition, ParseError> {
    let (edition, is_known) = match root.name {
        "IESTM33-22" => (Tm33Edition::Of2023, true),
        "IESTM33" | "IESTM33-18" => (Tm33Edition::Of2018, true),
        "ATLA_S001" | "ATLA_S001_A" => (Tm33Edition::AtlaS001, true),
        "LuminaireOpticalData" => (Tm33Edition::AtlaS001, false),
        name if name.to_ascii_uppercase().starts_with("IESTM33") => (Tm33Edition::Of2023, false),
        name => {
            let found = format!("{} as the root element", quoted(name));
            let expected = "a luminaire in the TM-33 format: IESTM33-22, IESTM33 or ATLA_S001";
            return Err(ParseError::new(root.at, found, expected));
        }
    };
    if !is_known {
        let found = format_args!("{} as the root element", quoted(root.name));
        let expected = "IESTM33-22, IESTM33 or ATLA_S001 (read as the nearest of them)";
        warnings.push(WarningKind::UnknownStandard, root.at, found.to_string(), expected);
    }
    Ok(edition)
}

/// Why a file without luminous intensities is refused: what it has instead.
fn no_light(root: &Element<'_>, dark: Option<&Element<'_>>) -> ParseError {
    let Some(emitter) = dark else {
        return ParseError::new(root.at, "no element Emitter", "at least one emitter");
    };
    let other = ["RadiantData", "PhotonData", "SpectralData", "IllumData", "IrradData", "PFDData"];
    let found = match other.iter().find(|name| emitter.child(name).is_some()) {
        Some(name) => format!("an emitter with {name} but no LuminousData"),
        None => "an emitter without LuminousData".to_owned(),
    };
    let expected = "LuminousData with LuminousIntensity: only luminous intensities are read";
    ParseError::new(emitter.at, found, expected)
}

/// Lumens of one lamp; `None` if an emitter is measured absolutely.
fn lumens_per_lamp(emitters: &[Emitter]) -> Option<f64> {
    let rated_lm: Option<f64> = emitters.iter().map(|emitter| emitter.rated_lm).sum();
    let lamps: f64 = emitters.iter().map(|emitter| emitter.quantity).sum();
    Some(rated_lm? / lamps)
}

/// The texts, under the keywords of LM-63 that mean the same.
fn keywords(header: Option<&Element<'_>>, emitters: &[Emitter]) -> Vec<Keyword> {
    let mut keywords = Vec::new();
    if let Some(header) = header {
        for (name, source) in [
            ("MANUFAC", "Manufacturer"),
            ("LUMCAT", "CatalogNumber"),
            ("LUMINAIRE", "Description"),
            ("TESTLAB", "Laboratory"),
            ("TEST", "ReportNumber"),
            ("ISSUEDATE", "ReportDate"),
            ("OTHER", "Comment"),
        ] {
            let texts = header.all(source).filter(|element| !is_empty_or_missing(Some(element)));
            keywords.extend(texts.map(|element| Keyword {
                name: name.to_owned(),
                value: element.text().to_owned(),
                line: element.text_at.line,
            }));
        }
    }
    keywords.extend(emitters.iter().flat_map(|emitter| emitter.keywords.iter().cloned()));
    keywords
}

/// Compares an emitter's flux with the one that its element states.
fn check_flux(table: &SphericalTable, emitter: &Emitter, warnings: &mut Warnings) {
    let flux_lm = table.integral();
    let Some(StatedFlux { flux_lm: stated_lm, at, what }) = emitter.stated_flux() else {
        return;
    };
    if flux_lm > 0.0 && (flux_lm / stated_lm - 1.0).abs() > FLUX_TOLERANCE {
        let ratio = 100.0 * flux_lm / stated_lm;
        let found =
            format_args!("an integrated flux of {flux_lm:.1} lm ({ratio:.1} %)").to_string();
        let expected = format!("{stated_lm:.1} lm, {what} (intensities count)");
        warnings.push(WarningKind::FluxDiffers, at, found, expected);
    }
}
