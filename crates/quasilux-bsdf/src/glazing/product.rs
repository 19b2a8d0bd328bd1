//! One product: its spectra, and how it depends on the angle.

use super::photopic::visible;
use super::sheet::{Sheet, SheetShares};
use crate::warning::{Warning, WarningKind, Warnings};
use quasilux_text::Position;

/// Front and back of an uncoated sheet reflect alike: no more than this apart in the visible mean,
/// so that the mean of both is right within half of it.
const MAX_APART: f64 = 0.004;

/// Refractive indices of glass and plastics.
const MIN_ETA: f64 = 1.35;
const MAX_ETA: f64 = 1.95;

/// Stated visible values may differ by as much: programs weigh differently.
const MAX_OFF_STATED: f64 = 0.005;

/// One sheet as a database describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct GlazingProduct {
    name: Option<String>,
    normal: SheetShares,
    stated: Option<SheetShares>,
    pub(super) sheet: Sheet,
}

/// A product with the warnings of its reader.
#[derive(Clone, Debug)]
pub struct ParsedGlazing {
    /// The product.
    pub product: GlazingProduct,
    /// What the reader tolerated.
    pub warnings: Vec<Warning>,
}

/// What a file says of a product.
pub(super) struct Description {
    pub(super) name: Option<String>,
    /// Whether it says of no coating and no film.
    pub(super) is_bare: bool,
    /// Values at normal incidence, those of one wavelength adding up to at most 1.
    pub(super) spectrum: Vec<SheetShares>,
    /// Visible values at normal incidence.
    pub(super) stated: Option<SheetShares>,
}

impl GlazingProduct {
    pub(super) fn new(description: Description, warnings: &mut Warnings) -> Self {
        let Description { name, is_bare, spectrum, stated } = description;
        let normal = SheetShares {
            transmittance: visible(|number| spectrum[number].transmittance),
            front_reflectance: visible(|number| spectrum[number].front_reflectance),
            back_reflectance: visible(|number| spectrum[number].back_reflectance),
        };
        if let Some(stated) = &stated {
            compare(&normal, stated, warnings);
        }
        let uncoated = is_bare.then(|| uncoated(&normal, &spectrum, warnings)).flatten();
        let sheet = uncoated.unwrap_or_else(|| Sheet::coated(spectrum));
        Self { name, normal, stated, sheet }
    }

    /// The name of the product.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Visible values at normal incidence, from the spectra.
    #[must_use]
    pub fn normal(&self) -> SheetShares {
        self.normal
    }

    /// The same as the file states them, if it does.
    #[must_use]
    pub fn stated(&self) -> Option<SheetShares> {
        self.stated
    }

    /// The refractive index of an uncoated sheet, its visible mean; `None` of a coated one.
    #[must_use]
    pub fn eta(&self) -> Option<f64> {
        self.sheet.eta()
    }
}

/// The sheet as a slab, unless that does not fit.
fn uncoated(
    normal: &SheetShares,
    spectrum: &[SheetShares],
    warnings: &mut Warnings,
) -> Option<Sheet> {
    let mut refuse = |found: String| {
        warnings.push(
            WarningKind::UnlikeUncoated,
            Position::START,
            found,
            "an uncoated sheet, as the file says (its angles are read as those of a coated one)",
        );
    };
    let SheetShares { front_reflectance, back_reflectance, .. } = *normal;
    if (front_reflectance - back_reflectance).abs() > MAX_APART {
        refuse(format!("reflectances of {front_reflectance:.4} and {back_reflectance:.4}"));
        return None;
    }
    let sheet = Sheet::uncoated(spectrum);
    match sheet.eta() {
        Some(eta) if !(MIN_ETA..=MAX_ETA).contains(&eta) => {
            refuse(format!("a refractive index of {eta:.3}"));
            None
        }
        _ => Some(sheet),
    }
}

fn compare(normal: &SheetShares, stated: &SheetShares, warnings: &mut Warnings) {
    let off = |name: &str, computed: f64, stated: f64| {
        ((computed - stated).abs() > MAX_OFF_STATED)
            .then(|| format!("a visible {name} of {stated:.4}, but {computed:.4} by the spectrum"))
    };
    let found = off("transmittance", normal.transmittance, stated.transmittance)
        .or_else(|| off("front reflectance", normal.front_reflectance, stated.front_reflectance))
        .or_else(|| off("back reflectance", normal.back_reflectance, stated.back_reflectance));
    if let Some(found) = found {
        let expected = "the same (the spectrum counts)";
        warnings.push(WarningKind::StatedOtherwise, Position::START, found, expected);
    }
}
