//! The document in JSON, format "quasilux-photometry/1", for programs.
//!
//! `files` has an entry for each file, in the order of the command line: its name in `file`, and
//! either `luminaire` with its `warnings`, or `error`; the other is `null`. Units stand in the
//! names of the keys, shares run from 0 to 1, unknown figures are `null`. Angles are those of the
//! luminaire frame; in planes gamma is negative on the side of C180 or C270, and above 180 where an
//! arc passes zenith. `zones_lm` are 18 zones of 10 degrees from nadir to zenith. `container` is
//! that of a GLDF file: the photometric file in it, the rotation that it gives its photometry (a
//! matrix, row by row; where it is not applied, all figures are those of the photometric file), and
//! facts as texts; warnings have the file in the container that they are about in `part`.

use super::input::{Container, FileWarning, Input, Luminaire};
use super::words::{self, degrees};
use crate::commands::inputs::{ErrorEntry, Failure, WarningEntry};
use quasilux_photometry::ContainerFact;
use quasilux_photometry::analysis::{MaximumIntensity, PlaneAnalysis, Spread};
use quasilux_report::json;
use serde::Serialize;

/// Name and version of the document's format.
const FORMAT: &str = "quasilux-photometry/1";

/// The document, ending in a line feed.
pub(super) fn document(inputs: &[Input]) -> String {
    json::text(&Document { format: FORMAT, files: inputs.iter().map(FileEntry::new).collect() })
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
    luminaire: Option<LuminaireEntry>,
    warnings: Vec<PartWarning<'a>>,
}

#[derive(Serialize)]
struct PartWarning<'a> {
    #[serde(flatten)]
    warning: WarningEntry,
    /// Left out for warnings about the file itself.
    #[serde(skip_serializing_if = "Option::is_none")]
    part: Option<&'a str>,
}

#[derive(Serialize)]
struct ContainerEntry {
    photometric_file: String,
    rotation: RotationEntry,
    facts: Vec<FactEntry>,
}

#[derive(Serialize)]
struct RotationEntry {
    luminaire_from_photometry: [[f64; 3]; 3],
    is_applied: bool,
}

#[derive(Serialize)]
struct FactEntry {
    name: &'static str,
    value: String,
}

#[derive(Serialize)]
struct LuminaireEntry {
    name: Option<String>,
    manufacturer: Option<String>,
    catalog_number: Option<String>,
    standard: &'static str,
    photometric_type: &'static str,
    symmetry: &'static str,
    planes: usize,
    angles: usize,
    flux_lm: f64,
    downward_flux_lm: f64,
    rated_flux_lm: Option<f64>,
    light_output_ratio: Option<f64>,
    input_watts: f64,
    efficacy_lm_w: Option<f64>,
    maximum: Option<MaximumEntry>,
    principal_planes: [PlaneEntry; 2],
    flux_code: FluxCodeEntry,
    zones_lm: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    container: Option<ContainerEntry>,
}

#[derive(Serialize)]
struct MaximumEntry {
    intensity_cd: f64,
    c_deg: f64,
    gamma_deg: f64,
}

#[derive(Serialize)]
struct PlaneEntry {
    plane: &'static str,
    maximum_cd: f64,
    centre_cd: f64,
    beam: Option<SpreadEntry>,
    centre_beam: Option<SpreadEntry>,
    field: Option<SpreadEntry>,
}

#[derive(Serialize)]
struct SpreadEntry {
    angle_deg: f64,
    start_deg: f64,
    end_deg: f64,
}

#[derive(Serialize)]
struct FluxCodeEntry {
    percent: [f64; 5],
    upper: [f64; 3],
    upward: f64,
}

impl<'a> FileEntry<'a> {
    fn new(input: &'a Input) -> Self {
        let luminaire = input.luminaire.as_ref();
        let warnings = luminaire.map_or(&[][..], |luminaire| &luminaire.warnings);
        Self {
            file: &input.name,
            error: luminaire.err().map(Failure::entry),
            luminaire: luminaire.ok().map(LuminaireEntry::new),
            warnings: warnings.iter().map(|told| PartWarning::new(input, told)).collect(),
        }
    }
}

impl LuminaireEntry {
    fn new(luminaire: &Luminaire) -> Self {
        let Luminaire { photometry, analysis, .. } = luminaire;
        let (facts, table) = (photometry.facts(), photometry.table());
        let maximum = |maximum: MaximumIntensity| MaximumEntry {
            intensity_cd: maximum.intensity_cd,
            c_deg: degrees(maximum.angles.c_rad),
            gamma_deg: degrees(maximum.angles.gamma_rad),
        };
        Self {
            name: words::keyword_line(facts, "LUMINAIRE"),
            manufacturer: words::keyword_line(facts, "MANUFAC"),
            catalog_number: words::keyword_line(facts, "LUMCAT"),
            standard: facts.standard.name(),
            photometric_type: facts.photometric_type.name(),
            symmetry: words::symmetry(table.symmetry()),
            planes: analysis.measured_planes,
            angles: table.theta_rad().len(),
            flux_lm: analysis.flux_lm,
            downward_flux_lm: analysis.downward_flux_lm,
            rated_flux_lm: photometry.rated_flux_lm(),
            light_output_ratio: analysis.light_output_ratio,
            input_watts: facts.input_watts,
            efficacy_lm_w: analysis.efficacy_lm_w,
            maximum: analysis.maximum.map(maximum),
            principal_planes: analysis.planes.map(PlaneEntry::new),
            flux_code: FluxCodeEntry {
                percent: analysis.flux_code.percent(),
                upper: analysis.flux_code.upper,
                upward: analysis.flux_code.upward,
            },
            zones_lm: analysis.zones_lm.to_vec(),
            container: luminaire.container.as_ref().map(ContainerEntry::new),
        }
    }
}

impl ContainerEntry {
    fn new(container: &Container) -> Self {
        let turn = container.rotation.luminaire_from_photometry;
        let fact = |it: &ContainerFact| FactEntry { name: it.name, value: it.value.clone() };
        Self {
            photometric_file: container.part.clone(),
            rotation: RotationEntry {
                // Row by row.
                luminaire_from_photometry: turn.transpose().to_cols_array_2d(),
                is_applied: container.rotation.is_applied,
            },
            facts: container.facts.iter().map(fact).collect(),
        }
    }
}

impl<'a> PartWarning<'a> {
    fn new(input: &Input, told: &'a FileWarning) -> Self {
        let part = told.file.strip_prefix(&input.name).and_then(|it| it.strip_prefix('/'));
        Self { warning: WarningEntry::new(&told.warning), part }
    }
}

impl PlaneEntry {
    fn new(plane: PlaneAnalysis) -> Self {
        let spread = |spread: Spread| SpreadEntry {
            angle_deg: degrees(spread.angle_rad()),
            start_deg: degrees(spread.start_rad),
            end_deg: degrees(spread.end_rad),
        };
        Self {
            plane: words::plane(plane.plane),
            maximum_cd: plane.maximum_cd,
            centre_cd: plane.centre_cd,
            beam: plane.beam.map(spread),
            centre_beam: plane.centre_beam.map(spread),
            field: plane.field.map(spread),
        }
    }
}
