//! The fields before the angles: the luminaire, its dimensions, its lamps.

use super::fields::Fields;
use crate::count::Count;
use crate::shape::check_signs;
use crate::warning::{WarningKind, Warnings};
use crate::{EulumdatFacts, Keyword, LuminousOpening, Standard};
use quasilux_text::{Number, ParseError, Position, Token};

/// Metres in a millimetre.
pub(super) const METRES_PER_MM: f64 = 1e-3;

/// Lines of one set of lamps.
const LINES_PER_LAMP_SET: usize = 6;

/// Direct ratios, for room indices from 0.6 to 5.
const DIRECT_RATIOS: usize = 10;

/// Fields 1 to 27.
pub(super) struct Header {
    pub(super) keywords: Vec<Keyword>,
    pub(super) layout: Layout,
    pub(super) opening: LuminousOpening,
    /// The downward flux fraction in %.
    pub(super) downward_percent: Number,
    /// Of the luminaire's flux and its lamps', where the file gives it.
    pub(super) light_output_ratio: Option<f64>,
    pub(super) conversion_factor: f64,
    pub(super) measurement_tilt_deg: f64,
    pub(super) lamps: LampSet,
    /// The rest.
    pub(super) eulumdat: EulumdatFacts,
}

/// Fields 3 to 7: the grid of intensities.
pub(super) struct Layout {
    /// `Isym`, 0 to 4.
    pub(super) symmetry: usize,
    pub(super) symmetry_at: Position,
    /// `Mc`.
    pub(super) planes: usize,
    /// `Dc`, in degrees; 0 for planes at unequal distances.
    pub(super) plane_distance: Number,
    /// `Ng`.
    pub(super) angles: usize,
    /// `Dg`, in degrees; 0 for angles at unequal distances.
    pub(super) angle_distance: Number,
}

/// The set of lamps that is taken.
pub(super) struct LampSet {
    pub(super) count: f64,
    /// Whether the number of lamps is negative, which stands for absolute photometry.
    pub(super) is_absolute: bool,
    /// Of all its lamps together.
    pub(super) flux_lm: Number,
    pub(super) input_watts: f64,
}

/// Reads up to the direct ratios.
pub(super) fn read_header(
    fields: &mut Fields<'_>,
    warnings: &mut Warnings,
) -> Result<Header, ParseError> {
    let mut keywords = Vec::new();
    keep(fields, "MANUFAC", "the company (field 1)", &mut keywords)?;
    let mut eulumdat = EulumdatFacts::default();
    let type_indicator = fields.text("the type indicator Ityp (field 2)")?.text;
    type_indicator.clone_into(&mut eulumdat.type_indicator);
    let layout = read_layout(fields, warnings)?;
    for (name, what) in [
        ("TEST", "the measurement report (field 8)"),
        ("LUMINAIRE", "the luminaire's name (field 9)"),
        ("LUMCAT", "the luminaire's number (field 10)"),
        ("FILENAME", "the file's name (field 11)"),
        ("ISSUEDATE", "date and user (field 12)"),
    ] {
        keep(fields, name, what, &mut keywords)?;
    }
    let opening = read_opening(fields, &mut eulumdat, warnings)?;
    let downward_percent =
        fields.number_or_zero("the downward flux fraction in % (field 22)", warnings)?;
    let light_output_ratio = read_ratio(fields, warnings)?;
    let conversion_factor = read_conversion(fields, warnings)?;
    let tilt = fields.number_or_zero("the tilt in degrees (field 25)", warnings)?;
    if tilt.value != 0.0 {
        let found = format_args!("a tilt of {} degrees during measurement", tilt.value).to_string();
        let expected = "0 (the tilt is not applied: the luminaire is taken as measured)";
        warnings.push(WarningKind::MeasurementTilt, tilt.at, found, expected);
    }
    let lamps = read_lamp_sets(fields, &mut keywords, &mut eulumdat, warnings)?;
    eulumdat.conversion_factor = conversion_factor;
    eulumdat.lamps_flux_lm = lamps.flux_lm.value;
    for _ in 0..DIRECT_RATIOS {
        fields.number_or_zero("a direct ratio (field 27)", warnings)?;
    }
    Ok(Header {
        keywords,
        layout,
        opening,
        downward_percent,
        light_output_ratio,
        conversion_factor,
        measurement_tilt_deg: tilt.value,
        lamps,
        eulumdat,
    })
}

fn read_layout(fields: &mut Fields<'_>, warnings: &mut Warnings) -> Result<Layout, ParseError> {
    let symmetry = fields.count("the symmetry Isym (field 3)", 0, warnings)?;
    if symmetry.value > 4 {
        let expected = "a symmetry Isym between 0 and 4 (field 3)";
        return Err(ParseError::new(symmetry.at, symmetry.value, expected));
    }
    let planes = fields.count("the number of C-planes Mc (field 4)", 1, warnings)?;
    let plane_distance = fields.number_or_zero("the distance Dc (field 5)", warnings)?;
    let angles = fields.count("the number of angles Ng (field 6)", 2, warnings)?;
    let angle_distance = fields.number_or_zero("the distance Dg (field 7)", warnings)?;
    fields.check_room(planes.value, planes.at, "planes")?;
    fields.check_room(angles.value, angles.at, "angles")?;
    Ok(Layout {
        symmetry: symmetry.value,
        symmetry_at: symmetry.at,
        planes: planes.value,
        plane_distance,
        angles: angles.value,
        angle_distance,
    })
}

/// Keeps a line of text under a keyword, unless it is empty.
fn keep(
    fields: &mut Fields<'_>,
    name: &str,
    what: &str,
    keywords: &mut Vec<Keyword>,
) -> Result<(), ParseError> {
    let Token { text, at } = fields.text(what)?;
    if !text.is_empty() {
        let value = text.to_owned();
        keywords.push(Keyword { name: name.to_owned(), value, line: at.line });
    }
    Ok(())
}

/// Fields 13 to 21. The length runs along C90-C270, which is y; the width along C0-C180. A round
/// opening gets the signs that LM-63 gives it.
fn read_opening(
    fields: &mut Fields<'_>,
    eulumdat: &mut EulumdatFacts,
    warnings: &mut Warnings,
) -> Result<LuminousOpening, ParseError> {
    let housing = ["length (field 13)", "width (field 14)", "height (field 15)"];
    for (what, size_m) in housing.iter().zip(&mut eulumdat.housing_m) {
        let what = format!("the luminaire's {what}, in mm");
        *size_m = fields.number_or_zero(&what, warnings)?.value * METRES_PER_MM;
    }
    let what = "the luminous area's length or diameter (field 16), in mm";
    let length = fields.number_or_zero(what, warnings)?;
    let length_m = length.value * METRES_PER_MM;
    let mut dimension = |what: &str| {
        let what = format!("the luminous area's {what}, in mm");
        Ok(fields.number_or_zero(&what, warnings)?.value * METRES_PER_MM)
    };
    let width_m = dimension("width, 0 if round (field 17)")?;
    let mut height_m: f64 = 0.0;
    let planes = ["C0 (field 18)", "C90 (field 19)", "C180 (field 20)", "C270 (field 21)"];
    for (plane, at_plane_m) in planes.iter().zip(&mut eulumdat.opening_heights_m) {
        *at_plane_m = dimension(&format!("height at {plane}"))?;
        height_m = height_m.max(*at_plane_m);
    }
    let is_round = width_m == 0.0 && length_m > 0.0;
    let opening = if is_round {
        LuminousOpening { width_m: -length_m, length_m: -length_m, height_m }
    } else {
        LuminousOpening { width_m: length_m, length_m: width_m, height_m }
    };
    check_signs(Standard::Eulumdat, &opening, length.at, warnings);
    Ok(opening)
}

/// Field 23.
fn read_ratio(fields: &mut Fields<'_>, warnings: &mut Warnings) -> Result<Option<f64>, ParseError> {
    let percent = fields.number_or_zero("the light output ratio in % (field 23)", warnings)?;
    if percent.value < 0.0 {
        return Err(ParseError::new(
            percent.at,
            percent.value,
            "a light output ratio of 0 or more",
        ));
    }
    if percent.value == 0.0 {
        let expected = "a light output ratio in % (the flux is not compared with it)";
        warnings.push(WarningKind::ZeroLightOutputRatio, percent.at, percent.value, expected);
        return Ok(None);
    }
    Ok(Some(percent.value / 100.0))
}

/// Field 24.
fn read_conversion(fields: &mut Fields<'_>, warnings: &mut Warnings) -> Result<f64, ParseError> {
    let factor = fields.number_or_zero("the conversion factor (field 24)", warnings)?;
    if factor.value < 0.0 {
        let expected = "a conversion factor above 0 (1 if none)";
        return Err(ParseError::new(factor.at, factor.value, expected));
    }
    if factor.value == 0.0 {
        let expected = "a conversion factor above 0 (read as 1)";
        warnings.push(WarningKind::ZeroConversionFactor, factor.at, factor.value, expected);
        return Ok(1.0);
    }
    Ok(factor.value)
}

/// Field 26: the first set; the others are kept as written.
fn read_lamp_sets(
    fields: &mut Fields<'_>,
    keywords: &mut Vec<Keyword>,
    eulumdat: &mut EulumdatFacts,
    warnings: &mut Warnings,
) -> Result<LampSet, ParseError> {
    let Count { value: sets, at } =
        fields.count("the number of lamp sets (field 26)", 1, warnings)?;
    fields.check_room(sets.saturating_mul(LINES_PER_LAMP_SET), at, "lamp sets")?;
    if sets > 1 {
        let expected = "one set of lamps (the first one is taken)";
        let found = format_args!("{sets} sets of lamps").to_string();
        warnings.push(WarningKind::SeveralLampSets, at, found, expected);
    }
    let count = fields.number_or_zero("the number of lamps (field 26a)", warnings)?;
    if count.value == 0.0 {
        let expected = "at least one lamp, or a negative number for absolute photometry";
        warnings.push(WarningKind::ZeroLampCount, count.at, count.value, expected);
    }
    keep(fields, "LAMP", "the type of lamps (field 26b)", keywords)?;
    let mut flux_lm = fields.number("the lamps' total flux in lm (field 26c)", warnings)?;
    if let (true, Some(instead_lm)) = (flux_lm.value == 0.0, fields.for_zero_lm) {
        let expected = "a total flux above 0 lm (that of the container counts)";
        warnings.push(WarningKind::ZeroLampFlux, flux_lm.at, "lamps of 0 lm", expected);
        flux_lm.value = instead_lm;
    }
    if flux_lm.value <= 0.0 {
        let expected = "a total flux of the lamps above 0 lm (field 26c)";
        return Err(ParseError::new(flux_lm.at, flux_lm.value, expected));
    }
    keep(fields, "COLORTEMP", "the colour of the light (field 26d)", keywords)?;
    keep(fields, "CRI", "the colour rendering (field 26e)", keywords)?;
    let input_watts = fields.number_or_zero("the power in W (field 26f)", warnings)?.value;
    for _ in 1..sets {
        let mut set: [String; LINES_PER_LAMP_SET] = Default::default();
        for (text, letter) in set.iter_mut().zip('a'..='f') {
            fields.text(&format!("field 26{letter} of a lamp set"))?.text.clone_into(text);
        }
        eulumdat.further_lamp_sets.push(set);
    }
    Ok(LampSet {
        count: if count.value == 0.0 { 1.0 } else { count.value.abs() },
        is_absolute: count.value < 0.0,
        flux_lm,
        input_watts,
    })
}
