//! Facts of a container for people: mounting, power at part load, maintenance, emergency light.

use super::GldfError;
use super::figures::number;
use super::light::{self, Light, Power};
use super::texts::{attribute, listed};
use super::told::Told;
use quasilux_text::xml::Element;

/// Tells of the light source and what belongs to it.
pub(super) fn of_light(light: &Light<'_>, told: &mut Told) -> Result<(), GldfError> {
    if let Some(name) = light::source_name(light) {
        told.fact("light source", name);
    }
    match light.power {
        Power::Stated(power_w) => told.fact("power", format!("{power_w} W")),
        Power::Unknown => told.fact("power", "unknown of a part of the light"),
        Power::OfFile => {}
    }
    let Some(source) = light.source else {
        return Ok(());
    };
    if let Some(table) = source.child("ActivePowerTable") {
        let pair = |factor: &Element<'_>| {
            let power = attribute(factor, "inputPower")?;
            Some(format!("{} at {power} of the power", factor.text()))
        };
        let pairs: Vec<String> = table.all("FluxFactor").filter_map(pair).collect();
        if !pairs.is_empty() {
            told.fact("dimming", format!("flux {}", listed(&pairs)));
        }
    }
    if let Some(colour) = source.child("ColorInformation") {
        let kelvin = number(colour, "CorrelatedColorTemperature")?.map(|it| format!("{it} K"));
        let ra = number(colour, "ColorRenderingIndex")?.map(|it| format!("Ra {it}"));
        let melanopic = number(colour, "MelanopicFactor")?.map(|it| format!("melanopic {it}"));
        let known: Vec<String> = [kelvin, ra, melanopic].into_iter().flatten().collect();
        if !known.is_empty() {
            told.fact("colour", known.join(", "));
        }
    }
    maintenance(source, told);
    Ok(())
}

/// `LightSourceMaintenance`: CIE 97 factors by hours, or those of LEDs. They scale nothing.
fn maintenance(source: &Element<'_>, told: &mut Told) {
    let Some(maintenance) = source.child("LightSourceMaintenance") else { return };
    let mut lines = Vec::new();
    if let Some(lamp_type) = maintenance.child("Cie97LampType") {
        lines.push(format!("CIE 97 lamp type {}", lamp_type.text()));
    }
    let factors = maintenance.child("CieLampMaintenanceFactors");
    for factor in factors.iter().flat_map(|it| it.all("CieLampMaintenanceFactor")) {
        let value = |name| factor.child(name).map_or("unknown", Element::text);
        let hours = attribute(factor, "burningTime").unwrap_or("unknown");
        let (lumens, survival) = (value("LampLumenMaintenanceFactor"), value("LampSurvivalFactor"));
        lines.push(format!("LLMF {lumens}, LSF {survival} at {hours} h"));
    }
    for factor in maintenance.all("LedMaintenanceFactor") {
        let hours = attribute(factor, "hours").unwrap_or("unknown");
        lines.push(format!("LLMF {} at {hours} h", factor.text()));
    }
    if let Some(hours) = attribute(maintenance, "lifetime") {
        lines.push(format!("lifetime {hours} h"));
    }
    if !lines.is_empty() {
        told.fact("maintenance", format!("{} (not applied)", listed(&lines)));
    }
}

/// `Mountings` of a variant, in mm.
pub(super) fn of_mounting(variant: &Element<'_>, told: &mut Told) {
    let Some(mountings) = variant.child("Mountings") else { return };
    let mut lines = Vec::new();
    for place in &mountings.children {
        let height = sizes(place);
        let kinds: Vec<String> = place
            .children
            .iter()
            .map(|kind| format!("{}{}", words(kind.name), sizes(kind)))
            .collect();
        let kinds = if kinds.is_empty() { String::new() } else { format!(" {}", kinds.join(", ")) };
        lines.push(format!("{}{height}{kinds}", words(place.name)));
    }
    if !lines.is_empty() {
        told.fact("mounting", listed(&lines));
    }
}

/// Lengths of a way of mounting: `, recessed depth 80 mm`.
fn sizes(element: &Element<'_>) -> String {
    let known = ["recessedDepth", "pendantLength", "mountingHeight", "poleHeight"];
    let size = |name: &&str| Some(format!(" ({} {} mm)", words(name), attribute(element, name)?));
    known.iter().filter_map(size).collect()
}

/// A name of XML as words in small letters: `SurfaceMounted` is `surface mounted`.
fn words(name: &str) -> String {
    let mut text = String::new();
    for character in name.chars() {
        if character.is_ascii_uppercase() && !text.is_empty() {
            text.push(' ');
        }
        text.push(character.to_ascii_lowercase());
    }
    text
}
