//! Contradictions between what a container declares of its photometry and the photometry itself.
//!
//! `DescriptivePhotometry` is for people ("not used in any calculations", GLDF XSD 1.0.0-rc.3), and
//! often of another luminaire. What follows from the intensities is compared: the CIE flux code
//! (CIE 52, EN 13032-2), output ratios, flux fractions, efficacy. Divergences and cut-off angles,
//! of which the format does not say whether they are whole or half angles, and UGR are not.

use super::GldfError;
use super::figures::number;
use super::told::Told;
use crate::{Analysis, Photometry, WarningKind};
use quasilux_text::quoted;
use quasilux_text::xml::Element;

/// Whole per cents of a flux code that differ by more contradict.
const CODE_TOLERANCE: f64 = 2.0;
/// Shares that differ by more contradict.
const SHARE_TOLERANCE: f64 = 0.02;
/// Ratios of efficacies that are further from 1 contradict.
const EFFICACY_TOLERANCE: f64 = 0.05;

/// Compares what a `Photometry` element declares with the intensities.
pub(super) fn compare(
    declared: &Element<'_>,
    photometry: &Photometry,
    told: &mut Told,
) -> Result<(), GldfError> {
    let Some(description) = declared.child("DescriptivePhotometry") else {
        return Ok(());
    };
    let analysis = Analysis::new(photometry);
    if analysis.flux_lm <= 0.0 {
        return Ok(());
    }
    flux_code(description, &analysis, told);
    let down = analysis.downward_flux_lm / analysis.flux_lm;
    let output = analysis.light_output_ratio;
    for (name, value) in [
        ("LightOutputRatio", output),
        ("DownwardFluxFraction", Some(down)),
        ("DownwardLightOutputRatio", output.map(|output| output * down)),
        ("UpwardLightOutputRatio", output.map(|output| output * (1.0 - down))),
    ] {
        let (Some(said), Some(value)) = (number(description, name)?, value) else { continue };
        if (said - value).abs() > SHARE_TOLERANCE {
            tell(description, name, &format!("{said}"), &format!("{value:.3}"), told);
        }
    }
    let efficacy = (number(description, "LuminousEfficacy")?, analysis.efficacy_lm_w);
    if let (Some(said), Some(value)) = efficacy
        && (said / value - 1.0).abs() > EFFICACY_TOLERANCE
    {
        let [said, value] = [said, value].map(|lm_w| format!("{lm_w:.1} lm/W"));
        tell(description, "LuminousEfficacy", &said, &value, told);
    }
    Ok(())
}

fn tell(description: &Element<'_>, name: &str, said: &str, value: &str, told: &mut Told) {
    let at = description.child(name).map_or(description.at, |child| child.at);
    let found = format!("{name} {said}");
    let expected = format!("{value}, as the photometry has it (which counts)");
    told.warn(WarningKind::DescriptionDiffers, at, found, expected);
}

/// Five whole numbers in per cent; the last one only where lamps have a flux.
fn flux_code(description: &Element<'_>, analysis: &Analysis, told: &mut Told) {
    let Some(element) = description.child("CIE-FluxCode") else { return };
    let said = element.text();
    if said.is_empty() {
        return;
    }
    let words = said.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter(|it| !it.is_empty());
    let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
    let value = analysis.flux_code.percent();
    let code = value.map(|percent| format!("{percent:.0}")).join(" ");
    if numbers.len() != value.len() {
        tell(description, "CIE-FluxCode", &quoted(said), &format!("five numbers, {code}"), told);
        return;
    }
    let compared = if analysis.light_output_ratio.is_some() { 5 } else { 4 };
    let differs = |(said, value): (&f64, &f64)| (said - value).abs() > CODE_TOLERANCE;
    if numbers.iter().zip(&value).take(compared).any(differs) {
        tell(description, "CIE-FluxCode", &quoted(said), &code, told);
    }
}
