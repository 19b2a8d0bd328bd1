//! What things are called, in the summary and in the document.

use quasilux_photometry::analysis::{FluxCode, Plane};
use quasilux_photometry::{LuminaireFacts, Symmetry};
use std::f64::consts::PI;

pub(super) fn symmetry(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::Rotational => "rotational",
        Symmetry::Quadrant => "quadrant",
        Symmetry::Bilateral => "bilateral",
        Symmetry::None | Symmetry::Open | Symmetry::Sector => "none",
    }
}

pub(super) fn plane(plane: Plane) -> &'static str {
    if plane == Plane::C0_C180 { "C0-C180" } else { "C90-C270" }
}

/// The five figures of the CIE flux code.
pub(super) fn flux_code(code: &FluxCode) -> String {
    whole(&code.percent())
}

/// Numbers rounded to whole ones, between blanks.
pub(super) fn whole(numbers: &[f64]) -> String {
    numbers.iter().map(|number| format!("{number:.0}")).collect::<Vec<_>>().join(" ")
}

/// What the file calls the luminaire, on one line.
pub(super) fn luminaire(facts: &LuminaireFacts) -> Option<String> {
    ["LUMINAIRE", "LUMCAT"].into_iter().find_map(|keyword| keyword_line(facts, keyword))
}

/// The value of a keyword on one line; `None` where it is empty.
pub(super) fn keyword_line(facts: &LuminaireFacts, keyword: &str) -> Option<String> {
    let words: Vec<&str> = facts.keyword(keyword)?.split_whitespace().collect();
    (!words.is_empty()).then(|| words.join(" "))
}

/// Degrees, rounded to the billionth: what a file writes as 50 stays 50.
pub(super) fn degrees(angle_rad: f64) -> f64 {
    (angle_rad / PI * 180.0 * 1e9).round() / 1e9
}
