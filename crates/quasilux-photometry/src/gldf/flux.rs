//! Rated fluxes: a photometric file's light, as bright as the container states.
//!
//! What stands in the container counts before what stands in the photometric file (GLDF
//! documentation, "GLDF over Photometry"). Intensities of EULUMDAT are given for 1000 lm, relative
//! ones of LM-63 and TM-33 for the lumens of the file's lamps: these are scaled to the rated flux
//! of the light source. Absolute ones are scaled so that their integral is the rated flux: the
//! convention holds for "all semantically identical values", whatever the format. A flux that
//! differs is told.

use super::GldfError;
use super::file::FromFile;
use super::told::Told;
use crate::photometry::FLUX_TOLERANCE;
use crate::{Photometry, WarningKind};
use quasilux_text::xml::Element;

/// A flux that the container states.
pub(super) struct Stated<'e> {
    pub(super) flux_lm: f64,
    pub(super) element: &'e Element<'e>,
}

/// A file's luminaire with light sources of that flux.
pub(super) fn at_flux(
    file: &FromFile<'_>,
    stated: Option<&Stated<'_>>,
    told: &mut Told,
) -> Result<Photometry, GldfError> {
    let stated = stated.filter(|stated| {
        if stated.flux_lm <= 0.0 {
            let expected = "a rated flux above 0 lm (that of the photometric file is taken)";
            let found = "a rated luminous flux of 0 lm";
            told.warn(WarningKind::ContainerFlux, stated.element.at, found, expected);
        }
        stated.flux_lm > 0.0
    });
    let Some(&Stated { flux_lm, element }) = stated else {
        if file.lacks_flux {
            let found = "lamps of 0 lm, and no RatedLuminousFlux in the container";
            return Err(GldfError::without_place(&file.part, found, "a flux in one of them"));
        }
        return Ok(file.photometry.clone());
    };
    let of_lamps_lm = file.photometry.rated_flux_lm();
    let of_file_lm = of_lamps_lm.unwrap_or_else(|| file.photometry.flux_lm());
    if of_file_lm <= 0.0 {
        // Told as a file without light.
        return Ok(file.photometry.clone());
    }
    if !file.lacks_flux && (flux_lm / of_file_lm - 1.0).abs() > FLUX_TOLERANCE {
        let found = format!("a rated luminous flux of {flux_lm} lm");
        let of_file = if of_lamps_lm.is_some() { "lamps" } else { "candela" };
        let expected = format!(
            "{of_file_lm:.1} lm, as the {of_file} of {} have it (the container's is taken, as \
             GLDF has it)",
            file.part
        );
        told.warn(WarningKind::ContainerFlux, element.at, found, expected);
    }
    scaled(&file.photometry, flux_lm / of_file_lm, element)
}

/// The luminaire with so many times the light.
pub(super) fn scaled(
    photometry: &Photometry,
    factor: f64,
    element: &Element<'_>,
) -> Result<Photometry, GldfError> {
    photometry
        .scaled(factor)
        .map_err(|error| GldfError::at(element, error, "a flux that a luminaire can have"))
}
