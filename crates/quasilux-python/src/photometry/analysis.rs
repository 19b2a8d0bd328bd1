//! The figures of a luminaire, as dictionaries: those of the command line's document, angles in
//! degrees.

use super::arrays::NumberArray;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use quasilux_photometry::analysis::{FluxCode, MaximumIntensity, Plane, PlaneCurve, Spread};
use quasilux_photometry::{Analysis, PhotometricType, Photometry, Symmetry};
use std::f64::consts::PI;

/// Degrees, rounded to the billionth: what a file writes as 50 stays 50.
pub(crate) fn degrees(angle_rad: f64) -> f64 {
    (angle_rad / PI * 180.0 * 1e9).round() / 1e9
}

/// Exact at multiples of 90 degrees.
pub(crate) fn radians(angle_deg: f64) -> f64 {
    angle_deg / 180.0 * PI
}

/// What the symmetry of a table is called.
pub(super) fn symmetry_name(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::Rotational => "rotational",
        Symmetry::Quadrant => "quadrant",
        Symmetry::Bilateral => "bilateral",
        Symmetry::None | Symmetry::Open | Symmetry::Sector => "none",
    }
}

/// The figures of a luminaire but for those of its planes.
#[derive(IntoPyObject)]
pub(super) struct AnalysisEntry {
    flux_lm: f64,
    downward_flux_lm: f64,
    rated_flux_lm: Option<f64>,
    light_output_ratio: Option<f64>,
    efficacy_lm_w: Option<f64>,
    maximum: Option<MaximumEntry>,
    flux_code: FluxCodeEntry,
    zones_lm: [f64; 18],
    measured_planes: usize,
}

#[derive(IntoPyObject)]
struct MaximumEntry {
    intensity_cd: f64,
    c_deg: f64,
    gamma_deg: f64,
}

#[derive(IntoPyObject)]
struct FluxCodeEntry {
    percent: [f64; 5],
    upper: [f64; 3],
    upward: f64,
}

impl AnalysisEntry {
    /// The figures of a luminaire.
    pub(super) fn new(photometry: &Photometry, analysis: &Analysis) -> Self {
        Self {
            flux_lm: analysis.flux_lm,
            downward_flux_lm: analysis.downward_flux_lm,
            rated_flux_lm: photometry.rated_flux_lm(),
            light_output_ratio: analysis.light_output_ratio,
            efficacy_lm_w: analysis.efficacy_lm_w,
            maximum: analysis.maximum.map(MaximumEntry::new),
            flux_code: FluxCodeEntry::new(&analysis.flux_code),
            zones_lm: analysis.zones_lm,
            measured_planes: analysis.measured_planes,
        }
    }
}

impl MaximumEntry {
    fn new(maximum: MaximumIntensity) -> Self {
        Self {
            intensity_cd: maximum.intensity_cd,
            c_deg: degrees(maximum.angles.c_rad),
            gamma_deg: degrees(maximum.angles.gamma_rad),
        }
    }
}

impl FluxCodeEntry {
    fn new(code: &FluxCode) -> Self {
        Self { percent: code.percent(), upper: code.upper, upward: code.upward }
    }
}

/// A vertical plane: its curve, and how wide the luminaire shines in it.
#[derive(IntoPyObject)]
pub(super) struct PlaneEntry<'py> {
    gamma_deg: NumberArray<'py>,
    intensity_cd: NumberArray<'py>,
    maximum_cd: f64,
    centre_cd: f64,
    beam: Option<SpreadEntry>,
    centre_beam: Option<SpreadEntry>,
    field: Option<SpreadEntry>,
}

#[derive(IntoPyObject)]
struct SpreadEntry {
    angle_deg: f64,
    start_deg: f64,
    end_deg: f64,
}

impl<'py> PlaneEntry<'py> {
    /// The plane C and C + 180 degrees.
    pub(super) fn new(py: Python<'py>, photometry: &Photometry, c_deg: f64) -> Self {
        let curve = py.detach(|| PlaneCurve::new(photometry, Plane { c_rad: radians(c_deg) }));
        let maximum_cd = curve.maximum_cd();
        let centre_cd = photometry.intensity_cd(glam::DVec3::NEG_Z);
        let spread = |threshold_cd| curve.spread(threshold_cd).map(SpreadEntry::new);
        let points = curve.points().iter();
        let gamma_deg: Vec<f64> = points.clone().map(|point| degrees(point.gamma_rad)).collect();
        let intensity_cd: Vec<f64> = points.map(|point| point.intensity_cd).collect();
        Self {
            gamma_deg: gamma_deg.into_pyarray(py),
            intensity_cd: intensity_cd.into_pyarray(py),
            maximum_cd,
            centre_cd,
            beam: spread(0.5 * maximum_cd),
            centre_beam: spread(0.5 * centre_cd),
            field: spread(0.1 * maximum_cd),
        }
    }
}

impl SpreadEntry {
    fn new(spread: Spread) -> Self {
        Self {
            angle_deg: degrees(spread.angle_rad()),
            start_deg: degrees(spread.start_rad),
            end_deg: degrees(spread.end_rad),
        }
    }
}

/// Intensities over the angles of the photometric type.
#[derive(IntoPyObject)]
pub(super) struct GridEntry<'py> {
    horizontal_deg: NumberArray<'py>,
    vertical_deg: NumberArray<'py>,
    /// All vertical angles at the first horizontal one, then the next.
    intensity_cd: NumberArray<'py>,
}

impl<'py> GridEntry<'py> {
    /// The grid of the file, mirror images of types A and B written out, or, unfolded, all around.
    pub(super) fn new(py: Python<'py>, photometry: &Photometry, unfolded: bool) -> Self {
        let table = photometry.table();
        let grid = if unfolded { table.unfolded_grid() } else { table.grid() };
        let latitude = |theta_rad: &f64| degrees(theta_rad - 0.5 * PI);
        let longitude_deg: Vec<f64> = grid.phi_rad.iter().copied().map(degrees).collect();
        let columns = longitude_deg.len();
        let kind = photometry.facts().photometric_type;
        let polar_deg: Vec<f64> = match kind {
            PhotometricType::C => grid.theta_rad.iter().copied().map(degrees).collect(),
            PhotometricType::A | PhotometricType::B => {
                grid.theta_rad.iter().map(latitude).collect()
            }
        };
        // Of type B the polar angle is the horizontal one: the rows of the grid are its planes.
        let (horizontal_deg, vertical_deg, intensity_cd) = if kind == PhotometricType::B {
            (polar_deg, longitude_deg, grid.values)
        } else {
            let plane = |column: usize| grid.values.iter().skip(column).step_by(columns).copied();
            let by_plane: Vec<f64> = (0..columns).flat_map(plane).collect();
            (longitude_deg, polar_deg, by_plane)
        };
        Self {
            horizontal_deg: horizontal_deg.into_pyarray(py),
            vertical_deg: vertical_deg.into_pyarray(py),
            intensity_cd: intensity_cd.into_pyarray(py),
        }
    }
}
