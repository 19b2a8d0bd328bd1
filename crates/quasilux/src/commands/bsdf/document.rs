//! The document in JSON, format "quasilux-bsdf/2", for programs.
//!
//! `files` has an entry for each file, in the order of the command line: its name in `file`, and
//! either `surface` with its `warnings`, or `error`; the other is `null`. Shares are luminous and
//! run from 0 to 1. Angles of incidence are those of the table: theta from the normal of the side
//! that the light arrives on, phi from the x axis towards y, up. `energy` has for each side the
//! shares of light from the directions of `--incidence`.

use super::input::{Input, Surface};
use super::summary::share;
use crate::arguments::Incidence;
use crate::commands::inputs::{ErrorEntry, Failure, WarningEntry};
use quasilux_bsdf::{
    Distribution, EnergyBalance, Reciprocity, ScatteringMode, SheetDistribution, luminance,
};
use quasilux_report::json;
use serde::Serialize;

/// Name and version of the document's format.
const FORMAT: &str = "quasilux-bsdf/2";

/// The document, ending in a line feed.
pub(super) fn document(inputs: &[Input], incidences: &[Incidence]) -> String {
    let files = inputs.iter().map(|input| FileEntry::new(input, incidences)).collect();
    json::text(&Document { format: FORMAT, files })
}

#[derive(Serialize)]
struct Document<'a> {
    format: &'static str,
    files: Vec<FileEntry<'a>>,
}

#[derive(Serialize)]
struct FileEntry<'a> {
    file: &'a str,
    error: Option<ErrorEntry<'a>>,
    surface: Option<SurfaceEntry<'a>>,
    warnings: Vec<WarningEntry>,
}

#[derive(Serialize)]
struct SurfaceEntry<'a> {
    format: &'static str,
    name: &'a str,
    manufacturer: &'a str,
    thickness_m: Option<f64>,
    is_isotropic: bool,
    is_coloured: bool,
    tables: Vec<TableEntry>,
    energy: Vec<EnergyEntry>,
    reciprocity: Vec<ReciprocityEntry>,
}

/// How light that arrives on one side is reflected or transmitted.
#[derive(Serialize)]
struct TableEntry {
    side: &'static str,
    mode: &'static str,
    kind: &'static str,
    incidences: Vec<IncidenceEntry>,
}

#[derive(Serialize)]
struct IncidenceEntry {
    theta_deg: f64,
    phi_deg: f64,
    /// The share of light from there that is scattered in this mode.
    share: f64,
}

#[derive(Serialize)]
struct EnergyEntry {
    side: &'static str,
    /// Those that `--incidence` asks for.
    incidences: Vec<LightEntry>,
    normal_reflectance: f64,
    normal_transmittance: f64,
    diffuse_reflectance: f64,
    diffuse_transmittance: f64,
    most_scattered: f64,
    most_scattered_at_deg: [f64; 2],
}

/// Light from one direction.
#[derive(Serialize)]
struct LightEntry {
    theta_deg: f64,
    phi_deg: f64,
    reflectance: f64,
    transmittance: f64,
}

#[derive(Serialize)]
struct ReciprocityEntry {
    side: &'static str,
    mode: &'static str,
    mean_defect: f64,
    worst_defect: f64,
}

impl<'a> FileEntry<'a> {
    fn new(input: &'a Input, incidences: &[Incidence]) -> Self {
        let surface = input.surface.as_ref();
        let warnings = surface.map_or(&[][..], |surface| &surface.warnings);
        Self {
            file: &input.name,
            error: surface.err().map(Failure::entry),
            surface: surface.ok().map(|surface| SurfaceEntry::new(surface, incidences)),
            warnings: warnings.iter().map(WarningEntry::new).collect(),
        }
    }
}

impl<'a> SurfaceEntry<'a> {
    fn new(surface: &'a Surface, incidences: &[Incidence]) -> Self {
        let bsdf = &surface.bsdf;
        let analysis = bsdf.analysis();
        let facts = bsdf.facts();
        let energy = |balance: &EnergyBalance| EnergyEntry::new(balance, surface, incidences);
        Self {
            format: facts.format.name(),
            name: &facts.name,
            manufacturer: &facts.manufacturer,
            thickness_m: facts.thickness_m,
            is_isotropic: bsdf.is_isotropic(),
            is_coloured: bsdf.is_coloured(),
            tables: bsdf.distributions().map(TableEntry::new).collect(),
            energy: analysis.energy.iter().map(energy).collect(),
            reciprocity: analysis.reciprocity.iter().map(ReciprocityEntry::new).collect(),
        }
    }
}

impl TableEntry {
    fn new(entry: SheetDistribution<&Distribution>) -> Self {
        let table = entry.distribution;
        let incidence = |&wi: &_| {
            let [theta_deg, phi_deg] = Incidence::from_direction(wi).degrees();
            IncidenceEntry { theta_deg, phi_deg, share: luminance(table.albedo(wi)) }
        };
        Self {
            side: entry.side.name(),
            mode: entry.mode.name(),
            kind: table.kind(),
            incidences: table.incidences().iter().map(incidence).collect(),
        }
    }
}

impl EnergyEntry {
    fn new(balance: &EnergyBalance, surface: &Surface, incidences: &[Incidence]) -> Self {
        let light = |&incidence: &Incidence| {
            let [theta_deg, phi_deg] = incidence.degrees();
            let [reflectance, transmittance] =
                ScatteringMode::ALL.map(|mode| share(surface, balance.side, mode, incidence));
            LightEntry { theta_deg, phi_deg, reflectance, transmittance }
        };
        Self {
            side: balance.side.name(),
            incidences: incidences.iter().map(light).collect(),
            normal_reflectance: balance.normal[0],
            normal_transmittance: balance.normal[1],
            diffuse_reflectance: balance.diffuse[0],
            diffuse_transmittance: balance.diffuse[1],
            most_scattered: balance.worst,
            most_scattered_at_deg: Incidence::from_direction(balance.worst_wi).degrees(),
        }
    }
}

impl ReciprocityEntry {
    fn new(found: &Reciprocity) -> Self {
        Self {
            side: found.side.name(),
            mode: found.mode.name(),
            mean_defect: found.mean,
            worst_defect: found.worst,
        }
    }
}
