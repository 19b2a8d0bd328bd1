//! Lobes: where light of chosen incidences goes, in the plane of incidence.

use super::input::{Input, Surface};
use crate::arguments::Incidence;
use crate::commands::inputs::stem_of;
use glam::DVec3;
use quasilux_bsdf::{ScatteringMode, Side, luminance};
use quasilux_drawing::diagram::{IntensityCurve, Lobe, LobeDiagram, lobes};
use quasilux_drawing::{Dash, PALETTE, Stroke};

/// Directions are looked at in steps of this.
const STEP_DEG: f64 = 0.25;

/// The drawing as an SVG file: a diagram for each side that scatters light.
pub(super) fn drawing(input: &Input, surface: &Surface, incidences: &[Incidence]) -> String {
    let sides = surface.bsdf.analysis().energy.iter().map(|balance| balance.side);
    let diagrams: Vec<LobeDiagram> = sides
        .map(|side| LobeDiagram {
            title: format!("light on the {}", side.name()),
            lobes: incidences
                .iter()
                .enumerate()
                .map(|(number, incidence)| Lobe {
                    incidence_deg: incidence.degrees()[0],
                    curve: curve(surface, side, *incidence, number),
                })
                .collect(),
        })
        .collect();
    let facts = surface.bsdf.facts();
    let stem = stem_of(&input.name);
    lobes(if facts.name.is_empty() { &stem } else { &facts.name }, &diagrams).to_svg()
}

/// f times the cosine, over the angle around the surface: 180 degrees is the normal of the side
/// with the light, which comes from the left.
fn curve(surface: &Surface, side: Side, incidence: Incidence, number: usize) -> IntensityCurve {
    let wi = incidence.direction();
    let [_, phi_deg] = incidence.degrees();
    let (sin_phi, cos_phi) = libm::sincos(phi_deg.to_radians());
    let value = |mode: ScatteringMode, theta_deg: f64| {
        let (sin, cos) = libm::sincos(theta_deg.to_radians());
        let wo = DVec3::new(sin * cos_phi, sin * sin_phi, cos.max(0.0));
        let table = surface.bsdf.scattering(side, mode);
        table.map_or(0.0, |table| luminance(table.evaluate(wi, wo)) * wo.z)
    };
    let steps = (360.0 / STEP_DEG) as i32;
    let point = |step: i32| {
        let gamma_deg = -180.0 + f64::from(step) * STEP_DEG;
        // Positive angles to the normal are on the side of the light, which is left.
        let found = match gamma_deg {
            gamma if gamma < -90.0 => value(ScatteringMode::Reflection, 180.0 + gamma),
            gamma if gamma > 90.0 => value(ScatteringMode::Reflection, gamma - 180.0),
            gamma => value(ScatteringMode::Transmission, -gamma),
        };
        [gamma_deg, found]
    };
    let colour = PALETTE[number % PALETTE.len()];
    let dash = Dash::ALL[number / PALETTE.len() % Dash::ALL.len()];
    IntensityCurve {
        name: incidence.text(),
        points: (0..=steps).map(point).collect(),
        stroke: Stroke { colour, width_px: 2.0, dash },
    }
}
