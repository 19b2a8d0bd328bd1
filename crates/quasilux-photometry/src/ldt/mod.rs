//! Reader of EULUMDAT files (Stockmar 1990, "EULUMDAT: ein Leuchtendatenformat fuer den
//! europaeischen Beleuchtungsplaner", Licht '90, 641-644).
//!
//! One field a line, in this order:
//!
//! | field | content |
//! |---|---|
//! | 1, 2 | company; type indicator Ityp (not used: the planes say it all) |
//! | 3 | symmetry Isym: 0 none, 1 rotational, 2 in C0-C180, 3 in C90-C270, 4 in both |
//! | 4, 5 | number of C-planes Mc, their distance Dc in degrees (0: unequal) |
//! | 6, 7 | number of angles gamma Ng, their distance Dg in degrees (0: unequal) |
//! | 8 to 12 | report; luminaire's name; its number; file name; date and user |
//! | 13 to 15 | luminaire in mm: length or diameter, width (0: round), height |
//! | 16 to 21 | luminous area in mm: length or diameter, width (0: round), heights at C0, C90, C180, C270 |
//! | 22, 23 | downward flux fraction, light output ratio, in % |
//! | 24, 25 | conversion factor of the intensities; tilt during measurement in degrees |
//! | 26 | number of lamp sets; for each: a number of lamps (negative: absolute photometry), b type, c total flux in lm, d colour, e rendering, f power in W |
//! | 27 | ten direct ratios |
//! | 28, 29 | Mc angles C; Ng angles gamma |
//! | 30 | intensities in cd/klm, plane by plane: those that Isym leaves |
//!
//! Intensity = value x conversion factor x total flux of the lamps / 1000 lm. The flux of field 26c
//! is that of all lamps of the set. In absolute photometry it is that of the luminaire, and the
//! same product holds.
//!
//! Where the format's text leaves a choice:
//!
//! - The length lies along C90-C270, which is y, the width along C0-C180: C0 looks at the long side
//!   of a linear luminaire. In published files the height of the luminous area is that of the side
//!   wall at C0 and C180 and 0 at the end caps, and intensities at large gamma are lower towards
//!   C90.
//! - The conversion factor multiplies the intensities; converters to LM-63 write it as the candela
//!   multiplier.
//! - With Isym = 3 the stored planes run from C270 over C0 to C90, and are mirrored in C90-C270.
//! - The tilt is the angle between an axis of the luminaire and the horizontal while it was
//!   measured (CIE S 017, 17-25-112): intensities stand in the frame of the goniometer, and turning
//!   them is up to the placement.
//! - Producers scale intensities so that a sum over zones, each reaching halfway to the next angle,
//!   gives the lamps' flux times the light output ratio. The integral here differs from it by up to
//!   0.15 % in published files.
//!
//! What is tolerated beyond the format is listed, rule by rule, in [`WarningKind`].

mod fields;
mod header;
mod planes;
mod ratios;
mod write;

use crate::angles::{gamma_rad, radians};
use crate::candela::intensity_cd;
use crate::photometry::FLUX_TOLERANCE;
use crate::warning::{WarningKind, Warnings};
use crate::{
    Grid, LuminaireFacts, Parsed, PhotometricType, Photometry, SphericalTable, Standard, Tilt,
};
use fields::Fields;
use glam::DVec3;
use header::{Header, LampSet, read_header};
use planes::{check_distance, stored_planes};
use quasilux_text::{ParseError, Position, Token, decode, lines, quoted};
pub use write::write_ldt;

/// Lumens that the written intensities refer to.
const REFERENCE_FLUX_LM: f64 = 1000.0;
/// Downward flux fractions in % that are further from the table's are another luminaire's.
const FRACTION_TOLERANCE_PERCENT: f64 = 5.0;

/// Reads an EULUMDAT file. Total: any bytes give a luminaire or an error with its place, in
/// no more memory than [`crate::max_read_memory_bytes`].
///
/// # Errors
/// [`ParseError`] with the position where a line is missing, no number or out of range.
pub fn read_ldt(bytes: &[u8]) -> Result<Parsed, ParseError> {
    read(bytes, None)
}

/// Reads a file whose flux stands elsewhere: lamps of 0 lm count as 1000 lm, with a warning of the
/// kind [`WarningKind::ZeroLampFlux`].
pub(crate) fn read_ldt_of_any_flux(bytes: &[u8]) -> Result<Parsed, ParseError> {
    read(bytes, Some(REFERENCE_FLUX_LM))
}

fn read(bytes: &[u8], for_zero_lm: Option<f64>) -> Result<Parsed, ParseError> {
    quasilux_text::refuse_web_page(bytes)?;
    let mut warnings = Warnings::default();
    let text = decode(bytes, &mut warnings);
    let lines: Vec<&str> = lines(&text).collect();
    let mut fields = Fields::new(&lines);
    fields.for_zero_lm = for_zero_lm;
    let header = read_header(&mut fields, &mut warnings)?;
    let table = read_table(&header, &mut fields, &mut warnings)?;
    if let Some(Token { text, at }) = fields.after_last() {
        warnings.push(WarningKind::TrailingText, at, quoted(text), "the end of the file");
    }
    check_flux(&table, &header, &mut warnings);
    let photometry = Photometry::new(table, facts(header));
    Ok(Parsed { photometry, warnings: warnings.into_vec() })
}

/// Fields 28 to 30.
fn read_table(
    header: &Header,
    fields: &mut Fields<'_>,
    warnings: &mut Warnings,
) -> Result<SphericalTable, ParseError> {
    let planes = fields.list(header.layout.planes, "an angle C in degrees (field 28)", warnings)?;
    let angles =
        fields.list(header.layout.angles, "an angle gamma in degrees (field 29)", warnings)?;
    check_distance(&header.layout.plane_distance, &planes, "planes", warnings);
    check_distance(&header.layout.angle_distance, &angles, "angles", warnings);
    let theta_rad = gamma_rad(&angles, warnings)?;
    let stored =
        stored_planes(header.layout.symmetry, header.layout.symmetry_at, &planes, warnings)?;
    let (rows, columns) = (theta_rad.len(), stored.phi_rad.len());
    fields.check_room(rows.saturating_mul(columns), header.layout.symmetry_at, "intensities")?;

    let factor = candela_factor(header);
    let mut values = vec![0.0; rows * columns];
    for column in 0..columns {
        for row in 0..rows {
            let value = fields.number("an intensity in cd/klm (field 30)", warnings)?;
            values[row * columns + column] = intensity_cd(value, factor, warnings)?;
        }
    }
    SphericalTable::new(Grid {
        theta_rad,
        phi_rad: stored.phi_rad,
        symmetry: stored.symmetry,
        values,
    })
    .map_err(|error| ParseError::new(header.layout.symmetry_at, error, "a photometric table"))
}

/// Candela of one written cd/klm.
fn candela_factor(header: &Header) -> f64 {
    header.conversion_factor * header.lamps.flux_lm.value / REFERENCE_FLUX_LM
}

fn facts(header: Header) -> LuminaireFacts {
    let candela_factor = candela_factor(&header);
    let LampSet { count, is_absolute, flux_lm, input_watts } = header.lamps;
    LuminaireFacts {
        standard: Standard::Eulumdat,
        photometric_type: PhotometricType::C,
        keywords: header.keywords,
        tilt: Tilt::None,
        lamp_count: count,
        lumens_per_lamp: (!is_absolute).then_some(flux_lm.value / count),
        ballast_factor: 1.0,
        ballast_lamp_field: 1.0,
        input_watts,
        candela_factor,
        opening: header.opening,
        light_output_ratio: header.light_output_ratio,
        measurement_tilt_rad: radians(header.measurement_tilt_deg),
        eulumdat: Some(header.eulumdat),
    }
}

fn check_flux(table: &SphericalTable, header: &Header, warnings: &mut Warnings) {
    let (flux_lm, at): (f64, Position) = (table.integral(), header.lamps.flux_lm.at);
    if flux_lm <= 0.0 {
        warnings.push(WarningKind::NoLight, at, "an integrated flux of 0 lm", "some light");
        return;
    }
    // The first coordinate of the horizon is the share of the flux below it.
    let (said, found) = (header.downward_percent, 100.0 * table.invert(DVec3::X)[0]);
    if said.value > 0.0 && (found - said.value).abs() > FRACTION_TOLERANCE_PERCENT {
        let expected = format!("{found:.1} %, as the intensities have it (they count)");
        let found = format!("a downward flux fraction of {} %", said.value);
        warnings.push(WarningKind::DownwardFluxDiffers, said.at, found, expected);
    }
    let Some(ratio) = header.light_output_ratio else {
        return;
    };
    let claimed_lm = header.lamps.flux_lm.value * ratio;
    if (flux_lm / claimed_lm - 1.0).abs() > FLUX_TOLERANCE {
        let found = format_args!("an integrated flux of {flux_lm:.1} lm").to_string();
        let expected =
            format!("{claimed_lm:.1} lm, lamps' flux x light output ratio (intensities count)");
        warnings.push(WarningKind::FluxDiffers, at, found, expected);
    }
}
