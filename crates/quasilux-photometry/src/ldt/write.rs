//! Writer of EULUMDAT files.

use super::REFERENCE_FLUX_LM;
use super::header::METRES_PER_MM;
use super::ratios::direct_ratios;
use crate::angles::snapped;
use crate::shape::opening_in;
use crate::write::{Encoded, EncodingNote, Half, Writer, aligned, before, degrees, number};
use crate::{Grid, LuminaireFacts, Photometry, SphericalTable, Standard, Symmetry, Tilt};
use glam::DVec3;

/// Keywords that are fields of EULUMDAT.
const FIELDS: [&str; 9] =
    ["MANUFAC", "TEST", "LUMINAIRE", "LUMCAT", "FILENAME", "ISSUEDATE", "LAMP", "COLORTEMP", "CRI"];

/// Writes a luminaire as an EULUMDAT file.
///
/// Reading it back gives the same table: the intensities bit for bit where a decimal exists that
/// the conversion factor and the lamps' flux turn into them, which is so for all that came from an
/// EULUMDAT file, and within one unit in the last place elsewhere; angles as [`write_ies`] has
/// them.
///
/// - Planes: Isym 1 for rotational symmetry, 4 for quarters, 2 and 3 for halves, 0 for the whole
///   turn, without its closing plane and from C0 on. Photometry of types A and B is resampled to
///   type C. Dc and Dg are 0 for angles at unequal distances.
/// - Intensities are in cd/klm of the lamps; in absolute photometry of the luminaire, with a
///   negative number of lamps. A luminaire from an EULUMDAT file keeps its conversion factor.
/// - The downward flux fraction (field 22) is integrated from the table, the direct ratios
///   (field 27) are those of luminaires that cover the ceiling of a square room evenly: see
///   [`crate::formats::eulumdat`]. The light output ratio (field 23) is the file's own, or
///   integrated flux over lamps' flux.
/// - The luminaire's own dimensions and type are kept from an EULUMDAT file; otherwise they are
///   those of the luminous opening, and Ityp is 1 for rotational symmetry and 3 without.
/// - Texts are cut to the lengths of their fields. Deviation: numbers are as long as they must be
///   to read back exactly, where the format gives them 4 to 12 characters.
///
/// Whatever else had to be changed is in [`Encoded::notes`].
///
/// [`write_ies`]: crate::write_ies
pub fn write_ldt(photometry: &Photometry) -> Encoded {
    let mut writer = Writer::default();
    let facts = photometry.facts();
    let grid = aligned(photometry, Half::Front, &mut writer);
    // A grid made of a table's own values makes a table.
    let table = SphericalTable::new(grid.clone()).unwrap_or_else(|_| photometry.table().clone());
    let scale = Scale::new(facts, &table);
    note_losses(facts, &mut writer);

    text(facts, "MANUFAC", "the company (field 1)", 78, &mut writer);
    writer.line(type_indicator(facts, &grid));
    let planes = Planes::new(&grid, &table, &mut writer);
    let gamma: Vec<f64> = grid.theta_rad.iter().map(|&theta| degrees(theta)).collect();
    note_near_axis(&gamma, &mut writer);
    writer.line(planes.isym);
    writer.line(&planes.angles_deg.len().to_string());
    writer.line(&number(distance(&planes.angles_deg)));
    writer.line(&gamma.len().to_string());
    writer.line(&number(distance(&gamma)));
    text(facts, "TEST", "the measurement report (field 8)", 78, &mut writer);
    text(facts, "LUMINAIRE", "the luminaire's name (field 9)", 78, &mut writer);
    text(facts, "LUMCAT", "the luminaire's number (field 10)", 78, &mut writer);
    text(facts, "FILENAME", "the file's name (field 11)", 8, &mut writer);
    text(facts, "ISSUEDATE", "date and user (field 12)", 78, &mut writer);
    write_dimensions(facts, &mut writer);
    write_fluxes(facts, &table, &scale, &mut writer);
    write_lamps(facts, &scale, &mut writer);
    for ratio in direct_ratios(&table) {
        writer.line(&format!("{ratio:.3}"));
    }
    for angle in planes.angles_deg.iter().chain(&gamma) {
        writer.line(&number(*angle));
    }
    for column in planes.stored {
        for row in grid.values.chunks_exact(grid.phi_rad.len()) {
            writer.line(&scale.written(row[column]));
        }
    }
    writer.finish()
}

/// What the written intensities refer to.
struct Scale {
    conversion_factor: f64,
    /// Of all lamps, or of the luminaire in absolute photometry.
    flux_lm: f64,
}

impl Scale {
    fn new(facts: &LuminaireFacts, table: &SphericalTable) -> Self {
        let positive = |x: f64| (x > 0.0 && x <= 1e18).then_some(x);
        if let Some(own) = &facts.eulumdat
            && let (Some(conversion_factor), Some(flux_lm)) =
                (positive(own.conversion_factor), positive(own.lamps_flux_lm))
        {
            return Self { conversion_factor, flux_lm };
        }
        let flux_lm = facts.rated_flux_lm().and_then(positive);
        let flux_lm = flux_lm.or_else(|| positive(table.integral()));
        Self { conversion_factor: 1.0, flux_lm: flux_lm.unwrap_or(REFERENCE_FLUX_LM) }
    }

    /// The value that a reader turns into `intensity_cd`.
    fn written(&self, intensity_cd: f64) -> String {
        let factor = self.conversion_factor * self.flux_lm / REFERENCE_FLUX_LM;
        number(before(intensity_cd / factor, intensity_cd, |value| value * factor))
    }
}

/// Fields 3, 28 and 30.
struct Planes {
    isym: &'static str,
    /// All planes around.
    angles_deg: Vec<f64>,
    /// Columns of the grid, in the order in which the file stores them.
    stored: std::ops::Range<usize>,
}

impl Planes {
    fn new(grid: &Grid, table: &SphericalTable, writer: &mut Writer) -> Self {
        let columns = grid.phi_rad.len();
        let isym = match grid.symmetry {
            Symmetry::Rotational => "1",
            Symmetry::Quadrant => "4",
            Symmetry::Bilateral if grid.phi_rad[0] == 0.0 => "2",
            Symmetry::Bilateral => "3",
            _ => "0",
        };
        let closing = if isym == "0" { columns - 1 } else { columns };
        let mut around = table.unfolded_grid().phi_rad;
        around.truncate(if isym == "1" { 1 } else { around.len() - 1 });
        let mut angles_deg: Vec<f64> = around
            .into_iter()
            .map(degrees)
            .map(|angle| if angle < 0.0 { angle + 360.0 } else { angle })
            .collect();
        angles_deg.sort_by(f64::total_cmp);
        note_near_axis(&angles_deg, writer);
        Self { isym, angles_deg, stored: 0..closing }
    }
}

/// The distance of angles, or 0 where it is not the same between all of them.
fn distance(angles: &[f64]) -> f64 {
    let [first, second, ..] = *angles else {
        return 0.0;
    };
    let step = ((second - first) * 1e9).round() / 1e9;
    let is_even = |pair: &[f64]| (pair[1] - pair[0] - step).abs() < 1e-6;
    if angles.windows(2).all(is_even) { step } else { 0.0 }
}

fn note_losses(facts: &LuminaireFacts, writer: &mut Writer) {
    if facts.tilt != Tilt::None {
        writer.note(EncodingNote::TiltLeftOut);
    }
    if facts.ballast_factor != 1.0 && facts.standard != Standard::Eulumdat {
        writer.note(EncodingNote::BallastFactorIncluded);
    }
    let is_first = |index: usize, name: &str| {
        facts.keywords.iter().position(|keyword| keyword.name == name) == Some(index)
    };
    let left_out = facts.keywords.iter().enumerate().filter(|(index, keyword)| {
        !(FIELDS.contains(&keyword.name.as_str()) && is_first(*index, &keyword.name))
    });
    match left_out.count() {
        0 => {}
        count => writer.note(EncodingNote::KeywordsLeftOut(count)),
    }
}

fn note_near_axis(angles_deg: &[f64], writer: &mut Writer) {
    if angles_deg.iter().any(|&angle| snapped(angle, 90.0) != angle) {
        writer.note(EncodingNote::AngleNearAxis);
    }
}

/// A text in one line, cut to the length of its field.
fn text(
    facts: &LuminaireFacts,
    keyword: &str,
    field: &'static str,
    length: usize,
    writer: &mut Writer,
) {
    write_text(facts.keyword(keyword).unwrap_or_default(), field, length, writer);
}

fn write_text(text: &str, field: &'static str, length: usize, writer: &mut Writer) {
    let text = text.replace(char::is_control, " ");
    let text = text.trim();
    match text.char_indices().nth(length) {
        Some((end, _)) => {
            writer.note(EncodingNote::TextCut { field, length });
            writer.line(text[..end].trim_end());
        }
        None => writer.line(text),
    }
}

/// Field 2.
fn type_indicator<'f>(facts: &'f LuminaireFacts, grid: &Grid) -> &'f str {
    match &facts.eulumdat {
        Some(own) if matches!(own.type_indicator.as_str(), "0" | "1" | "2" | "3") => {
            &own.type_indicator
        }
        _ if grid.symmetry == Symmetry::Rotational => "1",
        _ => "3",
    }
}

/// Fields 13 to 21: the length runs along y, which is the width of LM-63.
fn write_dimensions(facts: &LuminaireFacts, writer: &mut Writer) {
    let mm = |size_m: f64| before(size_m / METRES_PER_MM, size_m, |mm| mm * METRES_PER_MM);
    let opening = opening_in(Standard::Eulumdat, facts.standard, &facts.opening);
    let (length_m, width_m) = (opening.width_m.abs(), opening.length_m.abs());
    let height_m = opening.height_m.abs();
    let is_round = opening.width_m < 0.0 && opening.length_m == opening.width_m;
    let is_curved = [opening.width_m, opening.length_m, opening.height_m].iter().any(|&x| x < 0.0);
    if is_curved && !(is_round && opening.height_m >= 0.0) {
        writer.note(EncodingNote::OpeningAsBox);
    }
    let width_m = if is_round { 0.0 } else { width_m };
    let (housing_m, heights_m) = match &facts.eulumdat {
        Some(own) => (own.housing_m, own.opening_heights_m),
        None => ([length_m, width_m, height_m], [height_m; 4]),
    };
    for size_m in housing_m.into_iter().chain([length_m, width_m]).chain(heights_m) {
        writer.line(&number(mm(size_m)));
    }
}

/// Fields 22 to 25.
fn write_fluxes(
    facts: &LuminaireFacts,
    table: &SphericalTable,
    scale: &Scale,
    writer: &mut Writer,
) {
    // The first coordinate of the horizon is the share of the flux below it.
    let downward = table.invert(DVec3::X)[0];
    writer.line(&number((downward * 1e4).round() / 1e2));
    let percent = match facts.light_output_ratio {
        Some(ratio) => before(ratio * 100.0, ratio, |percent| percent / 100.0),
        None => rounded(100.0 * table.integral() / scale.flux_lm),
    };
    writer.line(&number(percent));
    writer.line(&number(scale.conversion_factor));
    writer.line(&number(degrees(facts.measurement_tilt_rad)));
}

/// Six digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

/// Field 26.
fn write_lamps(facts: &LuminaireFacts, scale: &Scale, writer: &mut Writer) {
    let further = facts.eulumdat.as_ref().map_or(&[][..], |own| &own.further_lamp_sets);
    writer.line(&(further.len() + 1).to_string());
    let count = match facts.lamp_count.abs() {
        count if count > 0.0 && count.is_finite() => count,
        _ => 1.0,
    };
    let is_absolute = facts.rated_flux_lm().is_none();
    writer.line(&number(if is_absolute { -count } else { count }));
    text(facts, "LAMP", "the type of lamps (field 26b)", 24, writer);
    writer.line(&number(scale.flux_lm));
    text(facts, "COLORTEMP", "the colour of the light (field 26d)", 16, writer);
    text(facts, "CRI", "the colour rendering (field 26e)", 6, writer);
    writer.line(&number(facts.input_watts));
    for [count, kind, flux, colour, rendering, power] in further {
        write_text(count, "a number of lamps (field 26a)", 4, writer);
        write_text(kind, "the type of lamps (field 26b)", 24, writer);
        write_text(flux, "the lamps' total flux (field 26c)", 12, writer);
        write_text(colour, "the colour of the light (field 26d)", 16, writer);
        write_text(rendering, "the colour rendering (field 26e)", 6, writer);
        write_text(power, "the power (field 26f)", 8, writer);
    }
}
