//! One emitter: its lamps, its factors, its intensities.

use super::fields::{
    factor, is_empty_or_missing, named, optional_boolean, optional_count, optional_number, require,
    word,
};
use super::{check_flux, grid};
use crate::sum::Summand;
use crate::warning::{WarningKind, Warnings};
use crate::{Grid, Keyword, PhotometricType, SphericalTable};
use quasilux_text::xml::Element;
use quasilux_text::{Number, ParseError, Position, quoted};

/// What is kept of an element `Emitter` with luminous intensities.
pub(super) struct Emitter {
    pub(super) at: Position,
    pub(super) quantity: f64,
    /// Of all lamps together; `None` for absolute photometry.
    pub(super) rated_lm: Option<f64>,
    rated_at: Position,
    /// The luminaire's flux by this emitter, where the file states it.
    measured: Option<Number>,
    pub(super) ballast_factor: f64,
    pub(super) input_watts: f64,
    /// Candela of one written candela.
    pub(super) candela_factor: f64,
    pub(super) keywords: Vec<Keyword>,
    pub(super) grid: Grid,
    /// Of that grid.
    pub(super) table: SphericalTable,
}

/// A flux that a file states.
pub(super) struct StatedFlux {
    pub(super) flux_lm: f64,
    pub(super) at: Position,
    /// The noun of the quantity, for messages.
    pub(super) what: &'static str,
}

impl Emitter {
    /// Its part of the sum.
    pub(super) fn summand(&self) -> Summand<'_> {
        Summand { grid: &self.grid, table: &self.table, at: self.at }
    }

    /// `None` for an emitter without luminous intensities.
    pub(super) fn read(
        element: &Element<'_>,
        photometric_type: PhotometricType,
        warnings: &mut Warnings,
    ) -> Result<Option<Self>, ParseError> {
        let Some(data) = intensities(element, warnings)? else {
            return Ok(None);
        };
        if let Some(own) = data.child("PhotometryType")
            && read_type(Some(own), warnings)? != photometric_type
        {
            let expected = format!("type {photometric_type:?}, that of the goniometer");
            return Err(ParseError::new(own.text_at, quoted(own.text()), expected));
        }
        require(element, &["Quantity", "Description"], warnings);
        let quantity = quantity(element, warnings)?;
        let rated = optional_number(element, &["RatedLumens"], warnings)?;
        let input_watts = optional_number(element, &["InputWattage", "InputWatts"], warnings)?;
        let is_absolute = optional_boolean(data, "AbsolutePhotometry")?
            .unwrap_or(rated.is_none_or(|rated| rated.value <= 0.0));
        let ballast_factor = factor(element, "BallastFactor", warnings)?;
        if is_absolute && ballast_factor != 1.0 {
            let found = format_args!("a BallastFactor of {ballast_factor}").to_string();
            let expected = "1 with absolute photometry (not applied: measured with the ballast)";
            warnings.push(WarningKind::AbsoluteBallastFactor, element.at, found, expected);
        }
        note_tilt(element, warnings)?;
        let multiplier = factor(data, "Multiplier", warnings)?;
        let candela_factor = if is_absolute { multiplier } else { multiplier * ballast_factor };
        let grid = grid::read(data, photometric_type, candela_factor, warnings)?;
        let table = SphericalTable::new(grid.clone())
            .map_err(|error| ParseError::new(data.at, error, "a photometric table"))?;
        let emitter = Self {
            at: element.at,
            quantity,
            rated_lm: rated.filter(|rated| !is_absolute && rated.value > 0.0).map(|r| r.value),
            rated_at: rated.map_or(element.at, |rated| rated.at),
            measured: measured_flux(element, warnings)?,
            ballast_factor,
            input_watts: input_watts.map_or(0.0, |watts| watts.value),
            candela_factor,
            keywords: keywords(element),
            grid,
            table,
        };
        check_flux(&emitter.table, &emitter, warnings);
        Ok(Some(emitter))
    }

    /// The flux that the file gives the emitter.
    pub(super) fn stated_flux(&self) -> Option<StatedFlux> {
        if let Some(measured) = self.measured.filter(|measured| measured.value > 0.0) {
            let what = "the flux that the file states";
            return Some(StatedFlux { flux_lm: measured.value, at: measured.at, what });
        }
        let lamps_lm = self.rated_lm? * self.ballast_factor;
        let what = if self.table.integral() < lamps_lm {
            "the lamps' flux, less the luminaire's losses"
        } else {
            "the lamps' flux: check Multiplier and RatedLumens"
        };
        Some(StatedFlux { flux_lm: lamps_lm, at: self.rated_at, what })
    }
}

/// The number of lamps.
fn quantity(element: &Element<'_>, warnings: &mut Warnings) -> Result<f64, ParseError> {
    match optional_count(element, "Quantity", warnings)? {
        Some(0) => {
            let expected = "at least one lamp (read as one)";
            warnings.push(WarningKind::ZeroLampCount, element.at, "a Quantity of 0", expected);
            Ok(1.0)
        }
        quantity => Ok(quantity.unwrap_or(1) as f64),
    }
}

/// The luminaire's flux in lumen, beside the intensities or in the emitter.
fn measured_flux(
    element: &Element<'_>,
    warnings: &mut Warnings,
) -> Result<Option<Number>, ParseError> {
    let data = element.child("LuminousData").unwrap_or(element);
    match optional_number(data, &["LuminousFlux"], warnings)? {
        None => optional_number(element, &["LuminousFlux", "MeasuredLumens"], warnings),
        flux => Ok(flux),
    }
}

/// The type of photometry: that of the goniometer, or else that beside the intensities, where other
/// writers have it.
pub(super) fn photometric_type(
    root: &Element<'_>,
    warnings: &mut Warnings,
) -> Result<PhotometricType, ParseError> {
    let goniometer = root
        .child("Equipment")
        .and_then(|equipment| named(equipment, &["Gonioradiometer", "Goniometer"], warnings))
        .and_then(|goniometer| named(goniometer, &["Type", "GoniometerType"], warnings));
    let beside = || {
        let emitter = root.child("Emitter")?;
        ["LuminousData", "IntensityDistribution"]
            .iter()
            .find_map(|name| emitter.child(name)?.child("PhotometryType"))
    };
    read_type(goniometer.or_else(beside), warnings)
}

/// Type C is the same in the webs of IES and CIE; of the others those of IES are read. A file that
/// says nothing has type C.
fn read_type(
    element: Option<&Element<'_>>,
    warnings: &mut Warnings,
) -> Result<PhotometricType, ParseError> {
    let Some(element) = element.filter(|element| !is_empty_or_missing(Some(element))) else {
        return Ok(PhotometricType::C);
    };
    let photometric_type = match word(element).as_str() {
        "iesc" | "ciec" | "typec" | "c" => PhotometricType::C,
        "iesb" | "typeb" | "b" => PhotometricType::B,
        "iesa" | "typea" | "a" => PhotometricType::A,
        _ => {
            let expected = "IES_A, IES_B, IES_C or CIE_C: no other goniometer types are read";
            return Err(ParseError::new(element.text_at, quoted(element.text()), expected));
        }
    };
    if !matches!(element.text(), "IES_A" | "IES_B" | "IES_C" | "CIE_C") {
        let expected = format_args!("IES_{photometric_type:?} or CIE_C (read as that)").to_string();
        warnings.push(WarningKind::WordSpelling, element.text_at, quoted(element.text()), expected);
    }
    Ok(photometric_type)
}

/// The element around the intensities: `LuminousData/LuminousIntensity`, or what other writers have
/// in its place.
fn intensities<'e, 't>(
    element: &'e Element<'t>,
    warnings: &mut Warnings,
) -> Result<Option<&'e Element<'t>>, ParseError> {
    let outer = named(element, &["LuminousData", "IntensityDistribution"], warnings);
    let Some(outer) = outer else {
        return Ok(None);
    };
    let data = outer.child("LuminousIntensity").unwrap_or(outer);
    for (name, expected) in [("Metric", "luminous"), ("Units", "cd")] {
        if let Some(child) = data.child(name).filter(|child| word(child) != expected) {
            let expected = format_args!("{expected} intensities: no others are read").to_string();
            return Err(ParseError::new(child.text_at, quoted(child.text()), expected));
        }
    }
    Ok(Some(data))
}

/// Tilt factors are not applied: the luminaire is taken in the position it was measured in.
fn note_tilt(element: &Element<'_>, warnings: &mut Warnings) -> Result<(), ParseError> {
    let Some(angles) = element.child("TiltAngles") else {
        return Ok(());
    };
    for tilt in angles.all("Tilt") {
        let factor = super::fields::number(tilt)?;
        if factor.value != 1.0 {
            let found = format_args!("a tilt factor of {}", factor.value).to_string();
            let expected = "1 (tilt factors are not applied: the luminaire is taken as measured)";
            warnings.push(WarningKind::TiltFactors, factor.at, found, expected);
        }
    }
    Ok(())
}

fn keywords(element: &Element<'_>) -> Vec<Keyword> {
    let colour = element.child("ColorTemperature").unwrap_or(element);
    let rendering = element.child("ColorRendering");
    let rendering = rendering.and_then(|r| r.child("CIE_CRI").or(Some(r)));
    [
        ("LAMP", element.child("Description")),
        ("LAMPCAT", element.child("CatalogNumber")),
        ("COLORTEMP", colour.child("FixedCCT").or(element.child("CCT"))),
        ("CRI", rendering.and_then(|rendering| rendering.child("Ra"))),
    ]
    .into_iter()
    .filter_map(|(name, child)| {
        let child = child.filter(|child| !child.text().is_empty())?;
        let (name, value) = (name.to_owned(), child.text().to_owned());
        Some(Keyword { name, value, line: child.text_at.line })
    })
    .collect()
}
