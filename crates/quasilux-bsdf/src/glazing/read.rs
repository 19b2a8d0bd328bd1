//! Reads product files of the IGSDB.

use super::json::{self, AngleBlock, BlockSample, Number, Sample, Summary};
use super::photopic::{WAVELENGTHS, wavelength_nm};
use super::product::{Description, GlazingProduct, ParsedGlazing};
use super::sheet::SheetShares;
use crate::warning::{WarningKind, Warnings};
use quasilux_text::{ParseError, Position, decode, quoted};

/// Wavelengths that a spectrum has to hold, in nm: all but 0.04 % of the light that is seen.
const NEEDED_NM: [f64; 2] = [410.0, 700.0];

/// Shares may be off by rounding and noise.
const MAX_NOISE: f64 = 0.02;

/// Transmittances of both sides differ by no more.
const MAX_BETWEEN_SIDES: f64 = 1e-3;

const PRODUCT: &str = "a glazing product of the IGSDB (JSON)";

/// Reads a product file of the International Glazing and Shading Database, JSON of its first or
/// second interface. Total: any bytes give a product or an error, in no more than 8 bytes for each
/// byte of the file and 4 MiB. What is wrong with the JSON is said with line and column, what is
/// wrong with its values with their path, in line 1.
///
/// # Errors
/// [`ParseError`] where it is no JSON, no glazing that light goes straight through, or its spectra
/// lack visible wavelengths.
pub fn read_glazing(bytes: &[u8]) -> Result<ParsedGlazing, ParseError> {
    quasilux_text::refuse_web_page(bytes)?;
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let file: json::File =
        serde_json::from_str(&text).map_err(|error| json_error(&text, &error))?;
    refuse_scattering(&file)?;
    let is_bare = is_bare(&file);
    let name =
        [file.name.0, file.product_name.0, file.product_description.and_then(|it| it.name.0)]
            .into_iter()
            .flatten()
            .find(|name| !name.trim().is_empty());
    let spectral_data = file.spectral_data.and_then(|data| data.spectral_data);
    let blocks = file
        .physical_properties
        .and_then(|properties| properties.optical_properties?.optical_data?.angle_blocks);
    let lines = match (spectral_data, blocks) {
        (Some(samples), _) if !samples.0.is_empty() => of_samples(&samples.0, &mut warnings)?,
        (_, Some(blocks)) => of_blocks(&blocks.0, &mut warnings)?,
        _ => {
            let expected = "measured values in spectral_data, or in physical_properties";
            return Err(error("no spectrum", expected));
        }
    };
    let spectrum = resampled(&lines, &mut warnings)?;
    let summaries = file.integrated_results_summary.map_or_else(Vec::new, |list| list.0);
    let stated = summaries.iter().find_map(stated);
    let description = Description { name, is_bare, spectrum, stated };
    let product = GlazingProduct::new(description, &mut warnings);
    Ok(ParsedGlazing { product, warnings: warnings.into_vec() })
}

/// Shares at one wavelength.
struct Line {
    nm: f64,
    shares: SheetShares,
}

fn error(found: impl std::fmt::Display, expected: impl std::fmt::Display) -> ParseError {
    ParseError::new(Position::START, found, expected)
}

/// What the JSON library says, its columns in characters.
fn json_error(text: &str, error: &serde_json::Error) -> ParseError {
    let line = error.line().max(1);
    let content = text.split('\n').nth(line - 1).unwrap_or_default();
    let before = error.column().saturating_sub(1).min(content.len());
    let before = (0..=before).rev().find(|&end| content.is_char_boundary(end)).unwrap_or(0);
    let position = Position { line, column: content[..before].chars().count() + 1 };
    let message = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    let message = message.strip_suffix(&place).unwrap_or(&message);
    let (found, expected) = message.rsplit_once(", expected ").unwrap_or((message, PRODUCT));
    // Pieces of the file are escaped in it.
    ParseError::new(position, found, expected)
}

fn refuse_scattering(file: &json::File) -> Result<(), ParseError> {
    let kind = file.kind.0.as_deref().unwrap_or("glazing").trim();
    if !["glazing", "material", ""].iter().any(|known| kind.eq_ignore_ascii_case(known)) {
        return Err(error(format!("a product of the type {}", quoted(kind)), PRODUCT));
    }
    let is_specular = [
        file.measured_data.as_ref().and_then(|data| data.is_specular),
        file.physical_properties.as_ref().and_then(|data| data.is_specular),
    ];
    if is_specular.contains(&Some(false)) {
        let expected = "a sheet that light goes straight through; scattering ones as kind = \
                        \"bsdf\" from a file of WINDOW";
        return Err(error("is_specular = false", expected));
    }
    Ok(())
}

/// Whether the file speaks of no coating and no film.
fn is_bare(file: &json::File) -> bool {
    let is_one_of = |text: &json::Text, words: &[&str]| {
        let text = text.0.as_deref().unwrap_or_default().trim();
        words.iter().any(|word| text.eq_ignore_ascii_case(word))
    };
    is_one_of(&file.subtype, &["", "monolithic", "laminate"])
        && is_one_of(&file.coated_side, &["", "neither", "none", "na", "n/a"])
        && is_one_of(&file.coating_name, &["", "none", "na", "n/a"])
}

fn of_samples(samples: &[Sample], warnings: &mut Warnings) -> Result<Vec<Line>, ParseError> {
    let line = |(number, sample): (usize, &Sample)| {
        let Sample { wavelength, transmitted, front, back } = sample;
        let path = format!("spectral_data[{number}]");
        let values = [transmitted, front, back].map(|number| number.0);
        line(&path, wavelength.0, values, warnings)
    };
    samples.iter().enumerate().map(line).collect()
}

fn of_blocks(blocks: &[AngleBlock], warnings: &mut Warnings) -> Result<Vec<Line>, ParseError> {
    let Some(block) = blocks.iter().find(|block| block.incidence_angle.0 == 0.0) else {
        return Err(error("no angle_blocks of incidence_angle 0", "values at normal incidence"));
    };
    if blocks.len() > 1 {
        let expected = "normal incidence alone (others are left out)";
        let found = format!("{} angle_blocks", blocks.len());
        warnings.push(WarningKind::OtherIncidences, Position::START, found, expected);
    }
    let line = |(number, sample): (usize, &BlockSample)| {
        let path = format!("wavelength_data[{number}]");
        if sample.diffuse.is_some() {
            let expected = "a sheet that light goes straight through";
            return Err(error(format!("diffuse values in {path}"), expected));
        }
        let [tf, tb, rf, rb] = {
            let it = &sample.specular;
            [it.tf, it.tb, it.rf, it.rb].map(|Number(value)| value)
        };
        if (tf - tb).abs() > MAX_BETWEEN_SIDES {
            let found = format!("tf = {tf} and tb = {tb} in {path}");
            let expected = "the same from both sides (their mean is read)";
            warnings.push(WarningKind::TransmittancesDiffer, Position::START, found, expected);
        }
        line(&path, sample.w.0, [0.5 * (tf + tb), rf, rb], warnings)
    };
    block.wavelength_data.0.iter().enumerate().map(line).collect()
}

/// The line of `values`, transmittance and reflectances, at a wavelength in micrometres.
fn line(
    path: &str,
    wavelength_um: f64,
    values: [f64; 3],
    warnings: &mut Warnings,
) -> Result<Line, ParseError> {
    if !(0.01..=1000.0).contains(&wavelength_um) {
        let found = format!("the wavelength {wavelength_um} in {path}");
        return Err(error(found, "micrometres within 0.01 to 1000"));
    }
    let is_share = |value: &f64| (-MAX_NOISE..=1.0 + MAX_NOISE).contains(value);
    if let Some(value) = values.iter().find(|value| !is_share(value)) {
        return Err(error(format!("{value} in {path}"), "shares of light within 0 to 1"));
    }
    if values.iter().any(|value| *value < 0.0) {
        let found = format!("a negative share in {path}");
        let expected = "no negative value (read as 0)";
        warnings.push(WarningKind::NegativeScattering, Position::START, found, expected);
    }
    let [t, front, back] = values.map(|value| value.clamp(0.0, 1.0));
    let sum = t + front.max(back);
    let scale = if sum > 1.0 { 1.0 / sum } else { 1.0 };
    if sum > 1.0 + 1e-6 {
        let found = format!("transmittance and reflectance of {sum:.4} together in {path}");
        let expected = "at most 1 (scaled down)";
        warnings.push(WarningKind::SharesExceedOne, Position::START, found, expected);
    }
    let shares = SheetShares {
        transmittance: t * scale,
        front_reflectance: front * scale,
        back_reflectance: back * scale,
    };
    Ok(Line { nm: 1000.0 * wavelength_um, shares })
}

/// The values at the wavelengths that are weighed, on straight lines; beyond the ends those of the
/// ends.
fn resampled(lines: &[Line], warnings: &mut Warnings) -> Result<Vec<SheetShares>, ParseError> {
    // Wavelengths are rounded to float in some files.
    const HAIR_NM: f64 = 1e-3;
    if let Some(pair) = lines.windows(2).find(|pair| pair[0].nm >= pair[1].nm) {
        let found = format!("{} nm after {} nm", pair[1].nm, pair[0].nm);
        return Err(error(found, "rising wavelengths"));
    }
    let (Some(first), Some(last)) = (lines.first(), lines.last()) else {
        return Err(error("a spectrum of no wavelength", "visible wavelengths"));
    };
    let [low, high] = NEEDED_NM;
    let found = format!("wavelengths from {:.0} to {:.0} nm", first.nm, last.nm);
    if first.nm > low + HAIR_NM || last.nm < high - HAIR_NM {
        return Err(error(found, format!("visible ones, at least {low} to {high} nm")));
    }
    let ends = [wavelength_nm(0), wavelength_nm(WAVELENGTHS - 1)];
    if first.nm > ends[0] + HAIR_NM || last.nm < ends[1] - HAIR_NM {
        let expected = format!("{} to {} nm (beyond, values are as at the ends)", ends[0], ends[1]);
        warnings.push(WarningKind::ShortSpectrum, Position::START, found, expected);
    }
    Ok((0..WAVELENGTHS).map(|number| at(lines, wavelength_nm(number))).collect())
}

fn at(lines: &[Line], nm: f64) -> SheetShares {
    let behind = lines.partition_point(|line| line.nm < nm);
    let (a, b) = (&lines[behind.saturating_sub(1)], &lines[behind.min(lines.len() - 1)]);
    let fraction = if b.nm > a.nm { ((nm - a.nm) / (b.nm - a.nm)).clamp(0.0, 1.0) } else { 0.0 };
    let between =
        |of: fn(&SheetShares) -> f64| of(&a.shares) * (1.0 - fraction) + of(&b.shares) * fraction;
    SheetShares {
        transmittance: between(|it| it.transmittance),
        front_reflectance: between(|it| it.front_reflectance),
        back_reflectance: between(|it| it.back_reflectance),
    }
}

fn stated(summary: &Summary) -> Option<SheetShares> {
    Some(SheetShares {
        transmittance: summary.tfvis?.0,
        front_reflectance: summary.rfvis?.0,
        back_reflectance: summary.rbvis?.0,
    })
}
