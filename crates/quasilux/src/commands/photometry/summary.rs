//! The summary of a luminaire, for people.

use super::input::{Container, Input, Luminaire};
use super::words::{self, degrees};
use crate::commands::inputs::warning_line;
use quasilux_photometry::analysis::{MaximumIntensity, PlaneAnalysis, Spread};
use quasilux_photometry::{Analysis, PhotometricType, Symmetry};
use quasilux_report::number::brief;
use quasilux_text::printable;

/// Digits of fluxes and intensities.
const DIGITS: i32 = 5;

/// A line for the file, a line for each fact, and a line for each warning.
pub(super) fn summary(input: &Input, luminaire: &Luminaire) -> String {
    let mut text = format!("{}\n", printable(&input.name));
    let container = luminaire.container.iter().flat_map(container_rows);
    for Row { name, value } in rows(luminaire).into_iter().chain(container) {
        text += &format!("  {name:<15} {}\n", printable(&value));
    }
    for warning in &luminaire.warnings {
        text += &warning_line(&warning.file, &warning.warning);
        text.push('\n');
    }
    text
}

/// A line of the summary.
struct Row {
    name: &'static str,
    value: String,
}

fn rows(luminaire: &Luminaire) -> Vec<Row> {
    let Luminaire { photometry, analysis, .. } = luminaire;
    let facts = photometry.facts();
    let mut rows = Vec::new();
    let mut row = |name, value| rows.push(Row { name, value });
    if let Some(name) = words::luminaire(facts) {
        row("luminaire", name);
    }
    if let Some(name) = words::keyword_line(facts, "MANUFAC") {
        row("manufacturer", name);
    }
    row("standard", standard(luminaire));
    row("symmetry", symmetry(luminaire));
    row("flux", flux(luminaire));
    if let Some(ratio) = analysis.light_output_ratio {
        row("output ratio", percent(ratio));
    }
    if let Some(efficacy_lm_w) = analysis.efficacy_lm_w {
        let watts = brief(facts.input_watts, DIGITS);
        row("efficacy", format!("{} lm/W at {watts} W", brief(efficacy_lm_w, 4)));
    }
    row("maximum", maximum(luminaire));
    for plane in &analysis.planes {
        row(words::plane(plane.plane), in_plane(plane));
    }
    row("CIE flux code", flux_code(analysis));
    rows
}

/// Facts of a container, its photometric file first.
fn container_rows(container: &Container) -> Vec<Row> {
    let part = Row { name: "container", value: format!("GLDF, {}", container.part) };
    let facts = container.facts.iter().map(|it| Row { name: it.name, value: it.value.clone() });
    let turned = container.rotation.is_turned().then(|| Row {
        name: "rotated",
        value: if container.rotation.is_applied {
            "yes, figures and diagrams are those of the rotated light".to_owned()
        } else {
            "not here: figures and diagrams are those of the photometric file; projects rotate it"
                .to_owned()
        },
    });
    std::iter::once(part).chain(facts).chain(turned).collect()
}

fn standard(luminaire: &Luminaire) -> String {
    let facts = luminaire.photometry.facts();
    let kind = facts.photometric_type;
    let name = format!("{}, type {kind}", facts.standard);
    match luminaire.misnamed {
        Some(promised) => format!("{name} (the file's name says {})", promised.name()),
        None => name,
    }
}

fn symmetry(luminaire: &Luminaire) -> String {
    let table = luminaire.photometry.table();
    let planes = luminaire.analysis.measured_planes;
    let angles = table.theta_rad();
    let counts = format!("{} x {}", many(planes, "plane"), many(angles.len(), "angle"));
    let symmetry = words::symmetry(table.symmetry());
    if luminaire.photometry.facts().photometric_type != PhotometricType::C {
        return format!("{symmetry}; {counts}");
    }
    let [first, last] = [angles[0], angles[angles.len() - 1]].map(|x| brief(degrees(x), 6));
    format!("{symmetry}; {counts}, gamma {first}\u{b0} to {last}\u{b0}")
}

fn flux(luminaire: &Luminaire) -> String {
    let analysis = &luminaire.analysis;
    let integrated = format!("{} lm integrated", brief(analysis.flux_lm, DIGITS));
    let rated = match luminaire.photometry.rated_flux_lm() {
        Some(rated_lm) => format!("{} lm of the lamps", brief(rated_lm, DIGITS)),
        None => "absolute photometry".to_owned(),
    };
    let upward = percent(analysis.flux_code.upward);
    format!("{integrated} ({upward} upward); {rated}")
}

fn maximum(luminaire: &Luminaire) -> String {
    let Some(MaximumIntensity { intensity_cd, angles }) = luminaire.analysis.maximum else {
        return "no light".to_owned();
    };
    let cd = brief(intensity_cd, DIGITS);
    let gamma = brief(degrees(angles.gamma_rad), 4);
    let is_pole = matches!(gamma.as_str(), "0" | "180");
    let is_round = luminaire.photometry.table().symmetry() == Symmetry::Rotational
        && luminaire.photometry.facts().photometric_type == PhotometricType::C;
    if is_pole {
        format!("{cd} cd at gamma {gamma}\u{b0}")
    } else if is_round {
        format!("{cd} cd at gamma {gamma}\u{b0}, every C")
    } else {
        let c = brief(degrees(angles.c_rad), 4);
        format!("{cd} cd at C {c}\u{b0}, gamma {gamma}\u{b0}")
    }
}

/// Beam and field angle; where the two ends are not symmetric, they are told.
fn in_plane(plane: &PlaneAnalysis) -> String {
    let (Some(beam), Some(field)) = (plane.beam, plane.field) else {
        return "no light".to_owned();
    };
    let mut text = format!("beam {}, field {}", spread(beam), spread(field));
    if plane.centre_beam != plane.beam {
        text += &match plane.centre_beam {
            Some(centre) => format!("; beam by centre intensity {}", spread(centre)),
            None => "; centre dark".to_owned(),
        };
    }
    text
}

fn spread(spread: Spread) -> String {
    let [start, end] = [spread.start_rad, spread.end_rad].map(degrees);
    let angle = angle_text(degrees(spread.angle_rad()));
    if (start + end).abs() < 0.05 || (start + end - 360.0).abs() < 0.05 {
        format!("{angle}\u{b0}")
    } else {
        format!("{angle}\u{b0} ({}\u{b0} to {}\u{b0})", angle_text(start), angle_text(end))
    }
}

fn angle_text(degrees: f64) -> String {
    let text = format!("{degrees:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    (if text == "-0" { "0" } else { text }).to_owned()
}

fn flux_code(analysis: &Analysis) -> String {
    let code = &analysis.flux_code;
    let lower = words::flux_code(code);
    let [u1, u2, u3] = code.upper;
    let upper = [u1, u2, u3, code.upward].map(|share| 100.0 * share);
    if code.upward >= 0.005 { format!("{lower}; upward {}", words::whole(&upper)) } else { lower }
}

fn percent(share: f64) -> String {
    format!("{} %", brief((share * 1000.0).round() / 10.0, 4))
}

fn many(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
