//! Drawings as objects of Python, and those of luminaires.

use super::analysis::{degrees, radians};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use quasilux_drawing::diagram::{Diagram, Intensities, IntensityCurve, intensities};
use quasilux_drawing::{Dash, Drawing, PALETTE, Stroke};
use quasilux_photometry::analysis::{Plane, PlaneCurve, PlanePoint};
use quasilux_photometry::{Analysis, Photometry};
use quasilux_report::number::brief;

/// Half-planes that are named beside a diagram, at most.
const NAMED: usize = 4;

/// A drawing that is not written yet.
#[pyclass(frozen, name = "Drawing", module = "quasilux._native")]
pub(crate) struct DrawingHandle(pub(crate) Drawing);

#[pymethods]
impl DrawingHandle {
    fn to_svg(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.to_svg())
    }

    fn to_png<'py>(&self, py: Python<'py>, px_per_unit: f64) -> Bound<'py, PyBytes> {
        let png = py.detach(|| self.0.to_png(px_per_unit));
        PyBytes::new(py, &png)
    }
}

/// Which planes of a luminaire are drawn, and how.
pub(super) struct LuminaireDiagram<'a> {
    /// What stands above the diagram.
    pub(super) title: &'a str,
    /// Each one with that half a turn away.
    pub(super) planes_deg: &'a [f64],
    /// Which diagrams.
    pub(super) diagram: Diagram,
    /// Whether the polar diagram is in candela even where there is a flux to refer them to.
    pub(super) in_candela: bool,
}

impl LuminaireDiagram<'_> {
    /// The diagram of a luminaire.
    pub(super) fn draw(&self, photometry: &Photometry, analysis: &Analysis) -> Drawing {
        let curve = |(number, &c_deg): (usize, &f64)| {
            let stroke = Stroke {
                colour: PALETTE[number % PALETTE.len()],
                width_px: 2.2,
                dash: Dash::ALL[number % Dash::ALL.len()],
            };
            curve(photometry, c_deg, stroke)
        };
        let curves: Vec<IntensityCurve> = self.planes_deg.iter().enumerate().map(curve).collect();
        let reference_lm = photometry.rated_flux_lm().unwrap_or(analysis.flux_lm);
        let is_relative = reference_lm > 0.0 && !self.in_candela;
        let sides = [half_planes(self.planes_deg, 180.0), half_planes(self.planes_deg, 0.0)];
        intensities(&Intensities {
            title: self.title,
            subtitle: &subtitle(photometry, analysis),
            curves: &curves,
            per_klm: is_relative.then(|| 1000.0 / reference_lm),
            sides: [&sides[0], &sides[1]],
            diagram: self.diagram,
        })
    }
}

fn curve(photometry: &Photometry, c_deg: f64, stroke: Stroke) -> IntensityCurve {
    let curve = PlaneCurve::new(photometry, Plane { c_rad: radians(c_deg) });
    let point = |point: &PlanePoint| [degrees(point.gamma_rad), point.intensity_cd];
    IntensityCurve {
        name: [0.0, 180.0].map(|off_deg| half_plane(c_deg + off_deg)).join("\u{2013}"),
        points: curve.points().iter().map(point).collect(),
        stroke,
    }
}

/// The name of a half-plane, such as `C90`.
fn half_plane(c_deg: f64) -> String {
    format!("C{}", brief(c_deg.rem_euclid(360.0), 5))
}

/// The half-planes on one side of the diagram.
fn half_planes(planes_deg: &[f64], off_deg: f64) -> String {
    let named = planes_deg.iter().take(NAMED).map(|c_deg| half_plane(c_deg + off_deg));
    let more = (planes_deg.len() > NAMED).then(|| "\u{2026}".to_owned());
    named.chain(more).collect::<Vec<String>>().join(", ")
}

/// The flux that the scale refers to, the ratio of the two, the flux code.
fn subtitle(photometry: &Photometry, analysis: &Analysis) -> String {
    let flux = match (photometry.rated_flux_lm(), analysis.light_output_ratio) {
        (Some(rated_lm), Some(ratio)) => {
            format!("{} lm of the lamps, output ratio {:.1} %", brief(rated_lm, 5), 100.0 * ratio)
        }
        _ => format!("{} lm of the luminaire", brief(analysis.flux_lm, 5)),
    };
    let code = analysis.flux_code.percent().map(|percent| format!("{percent:.0}")).join(" ");
    format!("{flux}; CIE flux code {code}")
}
