//! The summary of a measured surface, for people.

use super::input::{Input, Surface};
use crate::arguments::Incidence;
use crate::commands::inputs::warning_line;
use quasilux_bsdf::{EnergyBalance, ScatteringMode, Side, luminance};
use quasilux_report::number::brief;
use quasilux_text::printable;

/// A line for the file, lines for each side, and a line for each warning.
pub(super) fn summary(input: &Input, surface: &Surface, incidences: &[Incidence]) -> String {
    let mut text = format!("{}\n", printable(&input.name));
    for (name, value) in facts(surface, incidences) {
        text += format!("  {name:<21} {}", printable(&value)).trim_end();
        text.push('\n');
    }
    for warning in &surface.warnings {
        text += &warning_line(&input.name, warning);
        text.push('\n');
    }
    text
}

fn facts(surface: &Surface, incidences: &[Incidence]) -> Vec<(String, String)> {
    let facts = surface.bsdf.facts();
    let mut rows = Vec::new();
    let mut add = |name: &str, value: String| rows.push((name.to_owned(), value));
    if !facts.name.is_empty() {
        add("surface", facts.name.clone());
    }
    if !facts.manufacturer.is_empty() {
        add("manufacturer", facts.manufacturer.clone());
    }
    add("format", facts.format.name().to_owned());
    if let Some(thickness_m) = facts.thickness_m {
        add("thickness", format!("{} mm (counts as none)", brief(1000.0 * thickness_m, 4)));
    }
    let isotropic = "isotropic: may be turned in its plane";
    let symmetry = if surface.bsdf.is_isotropic() { isotropic } else { "none" };
    add("symmetry", symmetry.to_owned());
    for entry in surface.bsdf.distributions() {
        let (name, table) = (format!("{}, {}", entry.side, entry.mode), entry.distribution);
        let colour = if table.is_coloured() { ", coloured" } else { "" };
        let count = table.incidences().len();
        add(&name, format!("{}, {count} incident directions{colour}", table.kind()));
    }
    for balance in &surface.bsdf.analysis().energy {
        let side = balance.side;
        for incidence in incidences {
            let name = format!("{}, light at {}", side.name(), incidence.text());
            add(
                &name,
                shares(ScatteringMode::ALL.map(|mode| share(surface, side, mode, *incidence))),
            );
        }
        add(&format!("{}, diffuse light", side.name()), shares(balance.diffuse));
        add(&format!("{}, most scattered", side.name()), most(balance));
    }
    for found in &surface.bsdf.analysis().reciprocity {
        let text = format!(
            "{}, {}: swapped directions differ by {} in the mean, {} at worst",
            found.side.name(),
            found.mode.name(),
            percent(found.mean),
            percent(found.worst)
        );
        add("reciprocity", text);
    }
    rows
}

/// Reflected or transmitted of light from one direction, luminous.
pub(super) fn share(
    surface: &Surface,
    side: Side,
    mode: ScatteringMode,
    incidence: Incidence,
) -> f64 {
    let table = surface.bsdf.scattering(side, mode);
    table.map_or(0.0, |table| luminance(table.albedo(incidence.direction())))
}

fn shares([reflected, passed]: [f64; 2]) -> String {
    format!("reflectance {}, transmittance {}", percent(reflected), percent(passed))
}

fn most(balance: &EnergyBalance) -> String {
    let [theta_deg, phi_deg] = Incidence::from_direction(balance.worst_wi).degrees();
    format!(
        "{} of light at {}\u{b0}, {}\u{b0}",
        percent(balance.worst),
        brief(theta_deg, 3),
        brief(phi_deg, 4)
    )
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}
