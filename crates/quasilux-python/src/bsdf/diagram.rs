//! Lobes of a measured surface: where light of chosen incidences goes, in the plane of incidence.

use super::incidence;
use quasilux_bsdf::{MeasuredBsdf, ScatteringMode, Side, luminance};
use quasilux_drawing::diagram::{IntensityCurve, Lobe, LobeDiagram, lobes};
use quasilux_drawing::{Dash, Drawing, PALETTE, Stroke};
use quasilux_report::number::brief;

/// Directions are looked at in steps of this.
const STEP_DEG: f64 = 0.25;

/// A diagram for each side that scatters light; incidences are polar angles and azimuths in
/// degrees.
pub(super) fn draw(bsdf: &MeasuredBsdf, title: &str, incidences_deg: &[[f64; 2]]) -> Drawing {
    let diagram = |side: Side| {
        let lobe = |(number, &[theta_deg, phi_deg]): (usize, &[f64; 2])| {
            let points = lobe_points(bsdf, side, [theta_deg, phi_deg]);
            let curve =
                IntensityCurve { name: name(theta_deg, phi_deg), points, stroke: stroke(number) };
            Lobe { incidence_deg: theta_deg, curve }
        };
        LobeDiagram {
            title: format!("light on the {}", side.name()),
            lobes: incidences_deg.iter().enumerate().map(lobe).collect(),
        }
    };
    let sides = bsdf.analysis().energy.iter().map(|balance| balance.side);
    lobes(title, &sides.map(diagram).collect::<Vec<LobeDiagram>>())
}

/// f times the cosine, over the angle around the surface: 180 degrees is the normal of the side
/// with the light, which comes from the left.
pub(super) fn lobe_points(
    bsdf: &MeasuredBsdf,
    side: Side,
    incidence_deg: [f64; 2],
) -> Vec<[f64; 2]> {
    let wi = incidence(incidence_deg);
    let value = |mode: ScatteringMode, theta_deg: f64| {
        let [.., phi_deg] = incidence_deg;
        let wo = incidence([theta_deg, phi_deg]);
        let table = bsdf.scattering(side, mode);
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
    (0..=steps).map(point).collect()
}

fn stroke(number: usize) -> Stroke {
    Stroke {
        colour: PALETTE[number % PALETTE.len()],
        width_px: 2.0,
        dash: Dash::ALL[number / PALETTE.len() % Dash::ALL.len()],
    }
}

/// As people write a direction.
fn name(theta_deg: f64, phi_deg: f64) -> String {
    let theta = brief(theta_deg, 6);
    if phi_deg == 0.0 {
        format!("{theta}\u{b0}")
    } else {
        format!("{theta}\u{b0}, {}\u{b0}", brief(phi_deg, 6))
    }
}
