//! Reader of ANSI/IES LM-63 files (1986, 1991, 1995, 2002, 2019), photometric types A, B and C.
//!
//! A file is a header up to the line `TILT=`, then numbers in records, and nothing else:
//!
//! | record | values |
//! |---|---|
//! | with `TILT=INCLUDE` | lamp geometry; number of pairs; tilt angles; factors |
//! | 1a | lamps, lumens per lamp (-1: absolute), candela multiplier, |
//! | 1b | numbers of vertical and of horizontal angles, photometric type, |
//! | 1c | units (1 feet, 2 metres), width, length, height |
//! | 2 | ballast factor, ballast-lamp photometric factor, input watts |
//! | 3, 4 | vertical angles, horizontal angles, in degrees |
//! | 5 ... | candela values of all vertical angles, for each horizontal angle |
//!
//! Intensity = candela x multiplier x ballast factor x ballast-lamp factor. The field of the last
//! one changed its meaning:
//!
//! | edition | the field behind the ballast factor | multiplied by |
//! |---|---|---|
//! | 1986, 1991 | ballast-lamp photometric factor | yes |
//! | 1995, 2002 | reserved, 1 | no |
//! | 2019 | file generation type, 1.00001 to 1.11100 (LM-63-19, 5.13, table 2) | no |
//!
//! Radiance's `ies2rad` reads it the same way. Lamp lumens scale nothing: they serve the flux
//! check.
//!
//! The luminous length lies along C0-C180, the width along C90-C270: the horizontal angle 0 is
//! parallel to the length (`ies2rad` puts the length along x, and C0 too).
//!
//! What is tolerated beyond the standard is listed, rule by rule, in [`WarningKind`].

mod candela;
mod header;
mod hv;
mod numbers;
mod planes;
mod tilt;
mod write;

use crate::angles::gamma_rad;
use crate::candela::check_closing;
use crate::count::Count;
use crate::photometry::FLUX_TOLERANCE;
use crate::shape::check_signs;
use crate::warning::{WarningKind, Warnings};
use crate::{
    Grid, IesStandard, LuminaireFacts, LuminousOpening, Parsed, PhotometricType, Photometry,
    SphericalTable, Standard, Tilt,
};
use candela::Planes;
use header::{Header, TiltLine, read_header};
pub(crate) use hv::HvAngles;
use numbers::Numbers;
pub(crate) use planes::{CPlanes, c_planes};
use quasilux_text::{Number, ParseError, Position, Token, decode, lines, quoted};
pub use tilt::{ReadTilt, read_tilt};
pub use write::write_ies;

/// Metres in a foot (international foot, exact).
const METRES_PER_FOOT: f64 = 0.3048;

/// Reads an LM-63 file. Total: any bytes give a luminaire or an error with its place, in
/// no more memory than [`crate::max_read_memory_bytes`].
///
/// # Errors
/// [`ParseError`] with the position where the header, an angle or a value is missing, no number or
/// out of range.
pub fn read_ies(bytes: &[u8]) -> Result<Parsed, ParseError> {
    quasilux_text::refuse_web_page(bytes)?;
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let lines: Vec<&str> = lines(&text).collect();
    let header = read_header(&lines, &mut warnings)?;
    let numbers = || Numbers::new(&lines, header.next_line);
    let mut as_usual = warnings.clone();
    let read = read_numbers(&header, &mut numbers(), &mut as_usual);
    // Commas separate numbers. Where that makes no luminaire, or leaves numbers behind it, they are
    // decimal points if that makes one.
    let is_odd = |warnings: &Warnings| warnings.contains(WarningKind::TrailingText);
    let as_points = (read.is_err() || is_odd(&as_usual))
        .then(|| read_numbers(&header, &mut numbers().with_decimal_commas(), &mut warnings).ok());
    let Records { table, facts } = match as_points.flatten() {
        Some(records) if !is_odd(&warnings) => records,
        _ => {
            warnings = as_usual;
            read?
        }
    };
    let facts = LuminaireFacts { keywords: header.keywords, ..facts };
    Ok(Parsed { photometry: Photometry::new(table, facts), warnings: warnings.into_vec() })
}

/// Record 1.
struct Counts {
    lamp_count: f64,
    lumens_per_lamp: Number,
    multiplier: Number,
    verticals: usize,
    horizontals: usize,
    photometric_type: PhotometricType,
    opening: LuminousOpening,
    opening_at: Position,
}

/// Record 2.
struct Factors {
    ballast_factor: f64,
    ballast_lamp_field: f64,
    input_watts: f64,
    /// Candela of one written candela.
    candela_factor: f64,
}

/// What the records say: the light, and facts without the keywords of the header.
struct Records {
    table: SphericalTable,
    facts: LuminaireFacts,
}

fn read_numbers(
    header: &Header<'_>,
    numbers: &mut Numbers<'_>,
    warnings: &mut Warnings,
) -> Result<Records, ParseError> {
    let tilt = match header.tilt {
        TiltLine::None => Tilt::None,
        TiltLine::Include => tilt::read_factors(numbers, warnings)?,
        TiltLine::File(name) => tilt::in_another_file(name, header.next_line, warnings),
    };
    let counts = read_counts(numbers, warnings)?;
    let standard = Standard::Lm63(header.standard);
    check_signs(standard, &counts.opening, counts.opening_at, warnings);
    let factors = read_factors(&counts, header.standard, numbers, warnings)?;
    let grid = read_grid(&counts, factors.candela_factor, numbers, warnings)?;
    if let Some(Token { text, at }) = numbers.after_last(warnings)
        && !text.trim_matches(['[', ']']).eq_ignore_ascii_case("END")
    {
        warnings.push(WarningKind::TrailingText, at, quoted(text), "the end of the file");
    }

    let lumens = counts.lumens_per_lamp;
    let table = SphericalTable::new(grid)
        .map_err(|error| ParseError::new(lumens.at, error, "a photometric table"))?;
    if lumens.value < 0.0 && lumens.value != -1.0 {
        let expected = "-1 for absolute photometry (read as such)";
        warnings.push(WarningKind::NegativeLumens, lumens.at, lumens.value, expected);
    }
    let facts = LuminaireFacts {
        standard,
        photometric_type: counts.photometric_type,
        keywords: Vec::new(),
        tilt,
        lamp_count: counts.lamp_count,
        lumens_per_lamp: (lumens.value >= 0.0).then_some(lumens.value),
        ballast_factor: factors.ballast_factor,
        ballast_lamp_field: factors.ballast_lamp_field,
        input_watts: factors.input_watts,
        candela_factor: factors.candela_factor,
        opening: counts.opening,
        light_output_ratio: None,
        measurement_tilt_rad: 0.0,
        eulumdat: None,
    };
    check_flux(&table, &facts, lumens.at, warnings);
    Ok(Records { table, facts })
}

fn read_factors(
    counts: &Counts,
    standard: IesStandard,
    numbers: &mut Numbers<'_>,
    warnings: &mut Warnings,
) -> Result<Factors, ParseError> {
    numbers.start_record("the ballast factor", warnings);
    let ballast = numbers.next("the ballast factor", warnings)?;
    let reserved = numbers.next("the ballast-lamp photometric factor", warnings)?;
    let input_watts = numbers.next("the input watts", warnings)?.value;
    let candela_factor = positive(&counts.multiplier, "a candela multiplier above 0")?
        * positive(&ballast, "a ballast factor above 0 (1 if unknown)")?
        * ballast_lamp_factor(&reserved, standard, warnings)?;
    Ok(Factors {
        ballast_factor: ballast.value,
        ballast_lamp_field: reserved.value,
        input_watts,
        candela_factor,
    })
}

/// Records 3 and on.
fn read_grid(
    counts: &Counts,
    factor: f64,
    numbers: &mut Numbers<'_>,
    warnings: &mut Warnings,
) -> Result<Grid, ParseError> {
    numbers.start_record("the vertical angles", warnings);
    let vertical = numbers.list(counts.verticals, "vertical angle", warnings)?;
    numbers.start_record("the horizontal angles", warnings);
    let horizontal = numbers.list(counts.horizontals, "horizontal angle", warnings)?;
    let planes = Planes { verticals: counts.verticals, horizontals: counts.horizontals, factor };
    let grid = match counts.photometric_type {
        PhotometricType::C => {
            let theta_rad = gamma_rad(&vertical, warnings)?;
            let CPlanes { phi_rad, symmetry } = c_planes(&horizontal, warnings)?;
            Grid { theta_rad, phi_rad, symmetry, values: planes.read(numbers, warnings)? }
        }
        a_or_b => {
            let angles = HvAngles::check(a_or_b, &horizontal, &vertical, warnings)?;
            angles.grid(counts.horizontals, &planes.read(numbers, warnings)?)
        }
    };
    check_closing(&grid, horizontal[horizontal.len() - 1].at, warnings);
    Ok(grid)
}

fn read_counts(numbers: &mut Numbers<'_>, warnings: &mut Warnings) -> Result<Counts, ParseError> {
    numbers.start_record("the number of lamps", warnings);
    let lamp_count = numbers.next("the number of lamps", warnings)?.value;
    let lumens_per_lamp = numbers.next("the lumens per lamp", warnings)?;
    let multiplier = numbers.next("the candela multiplier", warnings)?;
    let Count { value: verticals, at: vertical_at } =
        numbers.count("the number of vertical angles", 2, warnings)?;
    let Count { value: horizontals, at } =
        numbers.count("the number of horizontal angles", 1, warnings)?;
    let type_number = numbers.count("the photometric type", 1, warnings)?;
    let units = numbers.count("the units type", 1, warnings)?;
    let metres_per_unit = match units.value {
        1 => METRES_PER_FOOT,
        2 => 1.0,
        _ => {
            let expected = "a units type of 1 (feet) or 2 (metres)";
            return Err(ParseError::new(units.at, units.value, expected));
        }
    };
    let photometric_type = match type_number.value {
        1 => PhotometricType::C,
        2 => PhotometricType::B,
        3 => PhotometricType::A,
        _ => {
            let expected = "a photometric type of 1 (C), 2 (B) or 3 (A)";
            return Err(ParseError::new(type_number.at, type_number.value, expected));
        }
    };
    numbers.check_room(verticals, vertical_at, "vertical angles")?;
    numbers.check_room(horizontals, at, "horizontal angles")?;
    numbers.check_room(verticals.saturating_mul(horizontals), at, "candela")?;
    let width = numbers.next("the luminous width", warnings)?;
    let mut dimension = |what| Ok(numbers.next(what, warnings)?.value * metres_per_unit);
    let opening = LuminousOpening {
        width_m: width.value * metres_per_unit,
        length_m: dimension("the luminous length")?,
        height_m: dimension("the luminous height")?,
    };
    Ok(Counts {
        lamp_count,
        lumens_per_lamp,
        multiplier,
        verticals,
        horizontals,
        photometric_type,
        opening,
        opening_at: width.at,
    })
}

fn positive(number: &Number, expected: &str) -> Result<f64, ParseError> {
    if number.value > 0.0 {
        Ok(number.value)
    } else {
        Err(ParseError::new(number.at, number.value, expected))
    }
}

/// The factor that the field behind the ballast factor stands for: see the table of the module.
fn ballast_lamp_factor(
    field: &Number,
    standard: IesStandard,
    warnings: &mut Warnings,
) -> Result<f64, ParseError> {
    if standard >= IesStandard::Lm63Of2019 {
        return Ok(1.0);
    }
    if field.value == 0.0 {
        let expected = "1 in the field behind the ballast factor (read as 1)";
        warnings.push(WarningKind::ZeroBallastLampFactor, field.at, field.value, expected);
        return Ok(1.0);
    }
    if standard >= IesStandard::Lm63Of1995 {
        if field.value != 1.0 {
            let expected = "1 in the reserved field behind the ballast factor (not applied)";
            warnings.push(WarningKind::BallastLampFactor, field.at, field.value, expected);
        }
        return Ok(1.0);
    }
    positive(field, "a ballast-lamp photometric factor above 0 (1 if unknown)")
}

fn check_flux(
    table: &SphericalTable,
    facts: &LuminaireFacts,
    at: Position,
    warnings: &mut Warnings,
) {
    let flux_lm = table.integral();
    if flux_lm <= 0.0 {
        warnings.push(WarningKind::NoLight, at, "an integrated flux of 0 lm", "some light");
        return;
    }
    let Some(lamps_lm) = facts.lamps_flux_lm() else {
        return;
    };
    let ratio = flux_lm / lamps_lm;
    if (ratio - 1.0).abs() > FLUX_TOLERANCE {
        let found = format_args!(
            "an integrated flux of {flux_lm:.1} lm ({:.1} % of the lamps')",
            100.0 * ratio
        )
        .to_string();
        let expected = if ratio < 1.0 {
            format!(
                "{lamps_lm:.1} lm, the lamps' flux, less the luminaire's \
                losses (candela values count)"
            )
        } else {
            format!(
                "{lamps_lm:.1} lm, the lamps' flux (check multiplier and \
                lumens; candela values count)"
            )
        };
        warnings.push(WarningKind::FluxDiffers, at, found, expected);
    }
}
