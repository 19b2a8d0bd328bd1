//! The light of a light emitter: its photometry, as bright as its light sources make it, in normal
//! operation or in an emergency, and its power.

use super::GldfError;
use super::archive::Archive;
use super::channels::{self, Mixed};
use super::figures::{amount, count, number};
use super::file::{self, FromFile};
use super::flux::{Stated, at_flux, scaled};
use super::light_emitter::{Behaviour, EQUIPMENT, LIGHT_SOURCE, LightEmitter};
use super::product::Product;
use super::selection::GldfChoice;
use super::texts::{attribute, in_quotes, text_of};
use super::told::Told;
use crate::{Photometry, WarningKind};
use quasilux_text::xml::Element;

/// The light of a light emitter.
pub(super) struct Light<'e> {
    pub(super) photometry: Photometry,
    /// The photometries that it was made of, as declared; their figures are compared with it.
    pub(super) parts: Vec<FromFile<'e>>,
    pub(super) source: Option<&'e Element<'e>>,
    pub(super) equipment: Option<&'e Element<'e>>,
    /// The number of light sources.
    pub(super) sources: f64,
    pub(super) power: Power,
}

/// The electrical power of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Power {
    /// That of the photometric file: the container states none.
    OfFile,
    /// In W.
    Stated(f64),
    /// The container's and the file's are for more light than this.
    Unknown,
}

/// Reads the light of a light emitter.
pub(super) fn read<'e>(
    product: Product<'e>,
    light: &LightEmitter<'e>,
    choice: &GldfChoice,
    archive: &mut Archive<'_>,
    told: &mut Told,
) -> Result<Light<'e>, GldfError> {
    let equipment = product.refer(light.element, &EQUIPMENT)?;
    let holder = equipment.unwrap_or(light.element);
    let source = product.refer(holder, &LIGHT_SOURCE)?;
    let reference = holder.child("LightSourceReference");
    let sources = reference.map_or(Ok(1.0), |it| count(it, "lightSourceCount"))?;
    let mut power = power(equipment, source, sources)?;
    let (photometry, parts) = match source.and_then(|source| source.child("Channels")) {
        Some(channels) => {
            let Mixed { photometry, parts, is_all } =
                channels::mixed(product, channels, choice, archive, told)?;
            if !is_all {
                power = Power::Unknown;
            }
            (photometry, parts)
        }
        None => {
            if let Some(wanted) = &choice.channel {
                let found = format!("the channel {}", in_quotes(wanted));
                let expected = "no \"channel\": the light source has none to choose";
                return Err(GldfError::at(light.element, found, expected));
            }
            let file = file::read(product, light.element, archive, told)?;
            let stated = stated_flux(holder, source, sources)?;
            let photometry = at_flux(&file, stated.as_ref(), told)?;
            (photometry, vec![file])
        }
    };
    let mut read = Light { photometry, parts, source, equipment, sources, power };
    if choice.emergency || light.behaviour == Behaviour::EmergencyOnly {
        read.power = Power::Unknown;
        read.photometry = in_emergency(&read, light, told)?;
    }
    Ok(read)
}

/// The rated flux of a light emitter (its own, as format 1.0 has it, or of its equipment), else of
/// its light sources together.
fn stated_flux<'e>(
    holder: &'e Element<'e>,
    source: Option<&'e Element<'e>>,
    sources: f64,
) -> Result<Option<Stated<'e>>, GldfError> {
    if let Some(flux_lm) = amount(holder, "RatedLuminousFlux")? {
        return Ok(Some(Stated { flux_lm, element: holder }));
    }
    let Some(source) = source else {
        return Ok(None);
    };
    let flux_lm = amount(source, "RatedLuminousFlux")?;
    Ok(flux_lm.map(|flux_lm| Stated { flux_lm: sources * flux_lm, element: source }))
}

/// The light in an emergency: a part of the rated flux, or a flux.
fn in_emergency(
    read: &Light<'_>,
    light: &LightEmitter<'_>,
    told: &mut Told,
) -> Result<Photometry, GldfError> {
    let holders = [read.equipment, Some(light.element), read.source];
    let kind = WarningKind::EmergencyEmitter;
    for holder in holders.into_iter().flatten() {
        if let Some(factor) = number(holder, "EmergencyBallastLumenFactor")? {
            if !(0.0..=1.0).contains(&factor) {
                let expected = "an EmergencyBallastLumenFactor between 0 and 1";
                return Err(GldfError::at(holder, factor, expected));
            }
            told.fact("emergency", format!("{factor} of the rated flux"));
            return scaled(&read.photometry, factor, holder);
        }
        if let Some(flux_lm) = amount(holder, "EmergencyRatedLuminousFlux")? {
            let photometry = &read.photometry;
            let of_lamps_lm = photometry.rated_flux_lm().unwrap_or_else(|| photometry.flux_lm());
            told.fact("emergency", format!("{flux_lm} lm of the light source"));
            let factor = if of_lamps_lm > 0.0 { flux_lm / of_lamps_lm } else { 0.0 };
            return scaled(photometry, factor, holder);
        }
    }
    if light.behaviour == Behaviour::Combined {
        let found = "a light emitter for emergencies too, without its flux in one";
        let expected = "an EmergencyBallastLumenFactor or EmergencyRatedLuminousFlux (full light \
                        is taken)";
        told.warn(kind, light.element.at, found, expected);
    }
    Ok(read.photometry.clone())
}

/// The electrical power: of the equipment, else of the light sources.
fn power(
    equipment: Option<&Element<'_>>,
    source: Option<&Element<'_>>,
    sources: f64,
) -> Result<Power, GldfError> {
    let of_equipment = equipment.map_or(Ok(None), |it| amount(it, "RatedInputPower"))?;
    let of_source = source.map_or(Ok(None), |it| amount(it, "RatedInputPower"))?;
    let power_w = of_equipment.or_else(|| of_source.map(|power_w| sources * power_w));
    Ok(power_w.map_or(Power::OfFile, Power::Stated))
}

/// Name of the light source, with the number of them.
pub(super) fn source_name(light: &Light<'_>) -> Option<String> {
    let source = light.source?;
    let name = text_of(source.child("Name")).or_else(|| attribute(source, "id"))?;
    Some(if light.sources == 1.0 { name.to_owned() } else { format!("{} x {name}", light.sources) })
}
