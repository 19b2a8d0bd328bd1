//! What a measured surface is said to be and to do, as dictionaries: the figures of the command
//! line's document, with all pairs of directions.

use crate::photometry::arrays::NumberArray;
use glam::DVec3;
use numpy::IntoPyArray;
use pyo3::prelude::*;
use quasilux_bsdf::{
    AngleBasis, BsdfFacts, Distribution, EnergyBalance, KlemsTable, Reciprocity, SheetDistribution,
    ThetaBand,
};
use std::f64::consts::PI;

/// What a file says about its surface.
#[derive(IntoPyObject)]
pub(super) struct BsdfFactsEntry {
    format: &'static str,
    name: String,
    manufacturer: String,
    thickness_m: Option<f64>,
}

impl BsdfFactsEntry {
    /// The facts of a surface.
    pub(super) fn new(facts: &BsdfFacts) -> Self {
        Self {
            format: facts.format.name(),
            name: facts.name.clone(),
            manufacturer: facts.manufacturer.clone(),
            thickness_m: facts.thickness_m,
        }
    }
}

/// A table: how light that arrives on one side is reflected or transmitted.
#[derive(IntoPyObject)]
pub(super) struct TableEntry<'py> {
    side: &'static str,
    mode: &'static str,
    kind: &'static str,
    is_isotropic: bool,
    is_coloured: bool,
    /// Three numbers for each direction that the table is stored for.
    incidences: NumberArray<'py>,
    leaves: Option<usize>,
    resolution: Option<usize>,
    matrix: Option<MatrixEntry<'py>>,
}

impl<'py> TableEntry<'py> {
    /// The entry of a table.
    pub(super) fn new(py: Python<'py>, entry: SheetDistribution<&Distribution>) -> Self {
        let table = entry.distribution;
        let (leaves, resolution) = match table {
            Distribution::TensorTree(tree) => (Some(tree.leaves()), Some(tree.resolution())),
            _ => (None, None),
        };
        let matrix = match table {
            Distribution::Klems(table) => Some(MatrixEntry::new(py, table)),
            _ => None,
        };
        Self {
            side: entry.side.name(),
            mode: entry.mode.name(),
            kind: table.kind(),
            is_isotropic: table.is_isotropic(),
            is_coloured: table.is_coloured(),
            incidences: directions(table.incidences()).into_pyarray(py),
            leaves,
            resolution,
            matrix,
        }
    }
}

/// A matrix over patches.
#[derive(IntoPyObject)]
struct MatrixEntry<'py> {
    /// f in sr^-1: all exit patches for the first incident patch, then for the next.
    values: NumberArray<'py>,
    incident: BasisEntry<'py>,
    exit: BasisEntry<'py>,
}

/// A hemisphere cut into patches.
#[derive(IntoPyObject)]
struct BasisEntry<'py> {
    name: String,
    lower_deg: Vec<f64>,
    upper_deg: Vec<f64>,
    patches: Vec<usize>,
    /// Of each patch.
    projected_solid_angle_sr: NumberArray<'py>,
}

impl<'py> MatrixEntry<'py> {
    fn new(py: Python<'py>, table: &KlemsTable) -> Self {
        Self {
            values: table.values().to_vec().into_pyarray(py),
            incident: BasisEntry::new(py, table.incident_basis()),
            exit: BasisEntry::new(py, table.exit_basis()),
        }
    }
}

impl<'py> BasisEntry<'py> {
    fn new(py: Python<'py>, basis: &AngleBasis) -> Self {
        let bands = basis.bands();
        let of_patch = |band: &ThetaBand| {
            let [low, high] = [band.lower_rad, band.upper_rad].map(squared_sine);
            std::iter::repeat_n(PI * (high - low) / band.patches as f64, band.patches)
        };
        let solid_angles: Vec<f64> = bands.iter().flat_map(of_patch).collect();
        Self {
            name: basis.name().to_owned(),
            lower_deg: bands.iter().map(|band| degrees(band.lower_rad)).collect(),
            upper_deg: bands.iter().map(|band| degrees(band.upper_rad)).collect(),
            patches: bands.iter().map(|band| band.patches).collect(),
            projected_solid_angle_sr: solid_angles.into_pyarray(py),
        }
    }
}

fn squared_sine(theta_rad: f64) -> f64 {
    let z = quasilux_photometry::Angles { theta_rad, phi_rad: 0.0 }.direction().z;
    1.0 - z * z
}

/// Where light of one side goes.
#[derive(IntoPyObject)]
pub(super) struct EnergyEntry {
    side: &'static str,
    normal_reflectance: f64,
    normal_transmittance: f64,
    diffuse_reflectance: f64,
    diffuse_transmittance: f64,
    most_scattered: f64,
    most_scattered_wi: [f64; 3],
}

impl EnergyEntry {
    /// The balance of one side.
    pub(super) fn new(balance: &EnergyBalance) -> Self {
        let ([normal_reflectance, normal_transmittance], [reflectance, transmittance]) =
            (balance.normal, balance.diffuse);
        Self {
            side: balance.side.name(),
            normal_reflectance,
            normal_transmittance,
            diffuse_reflectance: reflectance,
            diffuse_transmittance: transmittance,
            most_scattered: balance.worst,
            most_scattered_wi: balance.worst_wi.to_array(),
        }
    }
}

/// How far swapped directions differ.
#[derive(IntoPyObject)]
pub(super) struct ReciprocityEntry {
    side: &'static str,
    mode: &'static str,
    mean_defect: f64,
    worst_defect: f64,
    worst_pair: [[f64; 3]; 2],
}

impl ReciprocityEntry {
    /// The figures of a table.
    pub(super) fn new(found: &Reciprocity) -> Self {
        Self {
            side: found.side.name(),
            mode: found.mode.name(),
            mean_defect: found.mean,
            worst_defect: found.worst,
            worst_pair: found.worst_pair.map(|direction| direction.to_array()),
        }
    }
}

fn directions(directions: Vec<DVec3>) -> Vec<f64> {
    directions.into_iter().flat_map(|direction| direction.to_array()).collect()
}

/// Degrees, rounded to the billionth.
fn degrees(angle_rad: f64) -> f64 {
    (angle_rad.to_degrees() * 1e9).round() / 1e9
}
