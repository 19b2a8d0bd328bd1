//! The polar and the Cartesian diagram of a luminaire.

use super::input::{Input, Luminaire};
use super::words;
use crate::arguments::DiagramName;
use quasilux_drawing::diagram::{Diagram, Intensities, IntensityCurve, intensities};
use quasilux_drawing::{Dash, PALETTE, Stroke};
use quasilux_photometry::Photometry;
use quasilux_photometry::analysis::{Plane, PlaneCurve};
use quasilux_report::number::brief;

/// The drawing as an SVG file.
pub(super) fn drawing(input: &Input, luminaire: &Luminaire, diagram: DiagramName) -> String {
    let photometry = &luminaire.photometry;
    let strokes = [
        Stroke::solid(PALETTE[0], 2.2),
        Stroke { colour: PALETTE[1], width_px: 2.2, dash: Dash::Dashed },
    ];
    let curves: Vec<IntensityCurve> = Plane::PRINCIPAL
        .into_iter()
        .zip(strokes)
        .map(|(plane, stroke)| curve(photometry, plane, stroke))
        .collect();
    let reference_lm = photometry.rated_flux_lm().unwrap_or(luminaire.analysis.flux_lm);
    intensities(&Intensities {
        title: &words::luminaire(photometry.facts()).unwrap_or_else(|| input.stem()),
        subtitle: &subtitle(luminaire),
        curves: &curves,
        per_klm: (reference_lm > 0.0).then(|| 1000.0 / reference_lm),
        sides: ["C180, C270", "C0, C90"],
        diagram: match diagram {
            DiagramName::Polar => Diagram::Polar,
            DiagramName::Cartesian => Diagram::Cartesian,
            DiagramName::Both => Diagram::Both,
        },
    })
    .to_svg()
}

fn curve(photometry: &Photometry, plane: Plane, stroke: Stroke) -> IntensityCurve {
    let curve = PlaneCurve::new(photometry, plane);
    let point = |point: &quasilux_photometry::analysis::PlanePoint| {
        [words::degrees(point.gamma_rad), point.intensity_cd]
    };
    IntensityCurve {
        name: words::plane(plane).replace('-', "\u{2013}"),
        points: curve.points().iter().map(point).collect(),
        stroke,
    }
}

/// The flux that the scale refers to, the ratio of the two, the flux code.
fn subtitle(luminaire: &Luminaire) -> String {
    let analysis = &luminaire.analysis;
    let flux = match (luminaire.photometry.rated_flux_lm(), analysis.light_output_ratio) {
        (Some(rated_lm), Some(ratio)) => {
            format!("{} lm of the lamps, output ratio {:.1} %", brief(rated_lm, 5), 100.0 * ratio)
        }
        _ => format!("{} lm of the luminaire", brief(analysis.flux_lm, 5)),
    };
    format!("{flux}; CIE flux code {}", words::flux_code(&analysis.flux_code))
}
