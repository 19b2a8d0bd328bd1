//! What a luminaire's header says and what its file was warned of, as dictionaries.

use super::analysis::degrees;
use pyo3::prelude::*;
use quasilux_photometry::{
    EncodingNote, EulumdatFacts, Keyword, LuminaireFacts, LuminousShape, Tilt,
};
use std::fmt;

/// A warning of a reader.
#[derive(Clone, IntoPyObject)]
pub(crate) struct WarningEntry {
    file: String,
    line: usize,
    column: usize,
    count: usize,
    /// The name of the rule, as the `WarningKind` of the reader's crate lists it.
    kind: String,
    message: String,
}

impl WarningEntry {
    /// A warning about the file of that name.
    pub(crate) fn new<K: Copy + fmt::Debug>(
        file: &str,
        warning: &quasilux_text::Warning<K>,
    ) -> Self {
        Self {
            file: file.to_owned(),
            line: warning.line(),
            column: warning.column(),
            count: warning.count(),
            kind: format!("{:?}", warning.kind()),
            message: warning.message(),
        }
    }

    /// Whether it is a warning of that rule.
    pub(crate) fn is_of(&self, kind: &str) -> bool {
        self.kind == kind
    }
}

/// What a writer changed.
#[derive(IntoPyObject)]
pub(super) struct NoteEntry {
    /// The name of the variant of [`EncodingNote`].
    kind: String,
    message: String,
}

impl NoteEntry {
    /// A note of a writer.
    pub(super) fn new(note: &EncodingNote) -> Self {
        let kind = format!("{note:?}").chars().take_while(|c| c.is_alphanumeric()).collect();
        Self { kind, message: note.to_string() }
    }
}

/// The facts of a header.
#[derive(IntoPyObject)]
pub(super) struct FactsEntry {
    standard: &'static str,
    photometric_type: &'static str,
    keywords: Vec<KeywordEntry>,
    tilt: Option<TiltEntry>,
    tilt_file: Option<String>,
    lamp_count: f64,
    lumens_per_lamp: Option<f64>,
    ballast_factor: f64,
    ballast_lamp_field: f64,
    input_watts: f64,
    candela_factor: f64,
    opening_width_m: f64,
    opening_length_m: f64,
    opening_height_m: f64,
    light_output_ratio: Option<f64>,
    measurement_tilt_deg: f64,
    eulumdat: Option<EulumdatEntry>,
}

/// A line of a header.
#[derive(IntoPyObject)]
struct KeywordEntry {
    name: String,
    value: String,
    line: usize,
}

/// The factors of tilted lamps.
#[derive(IntoPyObject)]
struct TiltEntry {
    lamp_geometry: u8,
    angles_deg: Vec<f64>,
    factors: Vec<f64>,
}

/// What only EULUMDAT has.
#[derive(IntoPyObject)]
struct EulumdatEntry {
    type_indicator: String,
    housing_m: [f64; 3],
    opening_heights_m: [f64; 4],
    conversion_factor: f64,
    lamps_flux_lm: f64,
    further_lamp_sets: Vec<[String; 6]>,
}

impl FactsEntry {
    /// The facts of a luminaire.
    pub(super) fn new(facts: &LuminaireFacts) -> Self {
        let tilt_file = match &facts.tilt {
            Tilt::File(name) => Some(name.clone()),
            Tilt::None | Tilt::Include { .. } => None,
        };
        Self {
            standard: facts.standard.name(),
            photometric_type: facts.photometric_type.name(),
            keywords: facts.keywords.iter().map(KeywordEntry::new).collect(),
            tilt: TiltEntry::new(&facts.tilt),
            tilt_file,
            lamp_count: facts.lamp_count,
            lumens_per_lamp: facts.lumens_per_lamp,
            ballast_factor: facts.ballast_factor,
            ballast_lamp_field: facts.ballast_lamp_field,
            input_watts: facts.input_watts,
            candela_factor: facts.candela_factor,
            opening_width_m: facts.opening.width_m,
            opening_length_m: facts.opening.length_m,
            opening_height_m: facts.opening.height_m,
            light_output_ratio: facts.light_output_ratio,
            measurement_tilt_deg: degrees(facts.measurement_tilt_rad),
            eulumdat: facts.eulumdat.as_ref().map(EulumdatEntry::new),
        }
    }
}

impl KeywordEntry {
    fn new(keyword: &Keyword) -> Self {
        Self { name: keyword.name.clone(), value: keyword.value.clone(), line: keyword.line }
    }
}

impl TiltEntry {
    fn new(tilt: &Tilt) -> Option<Self> {
        let Tilt::Include { lamp_geometry, angles_rad, factors } = tilt else { return None };
        Some(Self {
            lamp_geometry: *lamp_geometry,
            angles_deg: angles_rad.iter().copied().map(degrees).collect(),
            factors: factors.clone(),
        })
    }
}

impl EulumdatEntry {
    fn new(facts: &EulumdatFacts) -> Self {
        Self {
            type_indicator: facts.type_indicator.clone(),
            housing_m: facts.housing_m,
            opening_heights_m: facts.opening_heights_m,
            conversion_factor: facts.conversion_factor,
            lamps_flux_lm: facts.lamps_flux_lm,
            further_lamp_sets: facts.further_lamp_sets.clone(),
        }
    }
}

/// What of a luminaire shines.
#[derive(IntoPyObject)]
pub(super) struct ShapeEntry {
    name: &'static str,
    size_m: [f64; 3],
}

impl ShapeEntry {
    /// The entry of a shape.
    pub(super) fn new(shape: &LuminousShape) -> Self {
        Self { name: shape.name(), size_m: shape.size_m().to_array() }
    }
}
