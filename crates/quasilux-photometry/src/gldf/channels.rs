//! Light sources with several channels: all of them at full light, or one.

use super::GldfError;
use super::archive::Archive;
use super::figures::amount;
use super::file::{self, FromFile};
use super::flux::{Stated, at_flux};
use super::product::Product;
use super::selection::GldfChoice;
use super::texts::{in_quotes, is_called, listed, text_of};
use super::told::Told;
use crate::sum::{Summand, sum};
use crate::{Grid, Photometry, WarningKind};
use quasilux_text::xml::Element;

/// Channels of a light source.
const MAX_CHANNELS: usize = 16;

/// Channels together.
pub(super) struct Mixed<'e> {
    pub(super) photometry: Photometry,
    pub(super) parts: Vec<FromFile<'e>>,
    /// Whether no channel was left out, by choice or because it has 0 lm.
    pub(super) is_all: bool,
}

/// The channels of a light source at full light, or the one that was asked for.
pub(super) fn mixed<'e>(
    product: Product<'e>,
    channels: &'e Element<'e>,
    choice: &GldfChoice,
    archive: &mut Archive<'_>,
    told: &mut Told,
) -> Result<Mixed<'e>, GldfError> {
    let all: Vec<&Element<'_>> = channels.all("Channel").collect();
    if all.is_empty() || all.len() > MAX_CHANNELS {
        let found = format!("{} channels", all.len());
        return Err(GldfError::at(channels, found, format!("1 to {MAX_CHANNELS}")));
    }
    let mut on = match &choice.channel {
        Some(wanted) => vec![chosen(&all, wanted, channels)?],
        None => all.clone(),
    };
    let mut dark = Vec::new();
    for channel in &on {
        if amount(channel, "RatedLuminousFlux")? == Some(0.0) {
            dark.push(*channel);
        }
    }
    on.retain(|channel| dark.iter().all(|it| it.at != channel.at));
    if on.is_empty() {
        let found = format!("a rated luminous flux of 0 lm of {}", names(&dark));
        return Err(GldfError::at(channels, found, "a channel that shines"));
    }
    if !dark.is_empty() {
        let found = format!("a rated luminous flux of 0 lm of {}", names(&dark));
        let expected = "channels that shine (without a flux they stay dark)";
        told.warn(WarningKind::ContainerFlux, dark[0].at, found, expected);
    }
    let mut parts = Vec::new();
    let mut lights = Vec::new();
    for channel in &on {
        let file = file::read(product, channel, archive, told)?;
        let flux_lm = amount(channel, "RatedLuminousFlux")?;
        let stated = flux_lm.map(|flux_lm| Stated { flux_lm, element: channel });
        lights.push(at_flux(&file, stated.as_ref(), told)?);
        parts.push(file);
    }
    if on.len() > 1 {
        let found = format!("{} channels: {}", on.len(), names(&on));
        let expected = "\"channel\" with one of them, or all at full light (as they are now)";
        told.warn(WarningKind::SeveralChannels, channels.at, found, expected);
    }
    let photometry = added(&lights, channels)?;
    Ok(Mixed { photometry, parts, is_all: on.len() + dark.len() == all.len() })
}

/// The only channel of that name, else the one of that number, from 1 on.
fn chosen<'e>(
    all: &[&'e Element<'e>],
    wanted: &str,
    channels: &Element<'_>,
) -> Result<&'e Element<'e>, GldfError> {
    let mut called = all.iter().filter(|it| is_called(it.child("DisplayName"), wanted));
    let found = match (called.next(), called.next()) {
        (Some(only), None) => Some(only),
        (None, _) => wanted.parse::<usize>().ok().and_then(|it| all.get(it.checked_sub(1)?)),
        (Some(_), Some(_)) => None,
    };
    found.copied().ok_or_else(|| {
        let expected = format!("one of {}, or its number", names(all));
        GldfError::at(channels, format!("the channel {}", in_quotes(wanted)), expected)
    })
}

fn names(channels: &[&Element<'_>]) -> String {
    let name = |channel: &&Element<'_>| {
        in_quotes(text_of(channel.child("DisplayName")).unwrap_or("without a name"))
    };
    listed(&channels.iter().map(name).collect::<Vec<_>>())
}

/// Lights of channels, added as if from one place.
fn added(lights: &[Photometry], channels: &Element<'_>) -> Result<Photometry, GldfError> {
    let first = &lights[0];
    if lights.len() == 1 {
        return Ok(first.clone());
    }
    let kind = first.facts().photometric_type;
    if lights.iter().any(|light| light.facts().photometric_type != kind) {
        let found = "channels in several photometric types";
        return Err(GldfError::at(channels, found, "the same in all (name one \"channel\")"));
    }
    let grids: Vec<Grid> = lights.iter().map(|light| light.table().grid()).collect();
    let summands: Vec<Summand<'_>> = grids
        .iter()
        .zip(lights)
        .map(|(grid, light)| Summand { grid, table: light.table(), at: channels.at })
        .collect();
    let table = sum(&summands).map_err(|error| GldfError::in_part(super::PRODUCT, &error))?;
    let mut facts = first.facts().clone();
    let rated_lm: Option<f64> = lights.iter().map(Photometry::rated_flux_lm).sum();
    let of_lamps = |light: &Photometry| {
        let eulumdat = light.facts().eulumdat.as_ref();
        eulumdat.map(|it| it.lamps_flux_lm).or_else(|| light.rated_flux_lm())
    };
    let lamps_lm: Option<f64> = lights.iter().map(of_lamps).sum();
    facts.lamp_count = 1.0;
    facts.lumens_per_lamp = rated_lm;
    match (&mut facts.eulumdat, lamps_lm) {
        (Some(eulumdat), Some(lamps_lm)) => {
            // Intensities are written for the lumens of all channels.
            facts.candela_factor *= lamps_lm / eulumdat.lamps_flux_lm;
            eulumdat.lamps_flux_lm = lamps_lm;
        }
        _ => facts.eulumdat = None,
    }
    facts.light_output_ratio = None;
    // That of the first one alone.
    facts.input_watts = 0.0;
    Ok(Photometry::new(table, facts))
}
