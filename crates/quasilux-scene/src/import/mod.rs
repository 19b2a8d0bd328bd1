//! Models of other programs to project files: what a geometry file cannot say of a scene.
//!
//! A project names the model as its geometry, which keeps surfaces and materials; the text has the
//! rest of the model: sensor grids, views, luminaires, lights and what changes. Files that the text
//! names beside the model come with it.

mod grids;
mod lights;
mod luminaires;
mod materials;
mod names;
mod radiance;
mod states;
mod text;
mod views;

use crate::geometry::look_over;
use crate::honeybee::{Model, Surfaces, surfaces};
use crate::radiance::Findings;
use crate::{LengthUnit, LoadError, Warning};
use names::Names;
pub use radiance::{RadianceTerms, import_radiance};
use std::collections::HashMap;
use text::{Text, quoted};

/// A project that was made of a model.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The project file.
    pub text: String,
    /// Files that it names and that were part of the model.
    pub files: Vec<ImportedFile>,
    /// Parts of the model that the project does not have, or has otherwise. Findings on geometry
    /// and materials are told when the project is loaded, or here if it measures nothing.
    pub findings: Vec<Warning>,
    /// Whether there is something to measure: a sensor or a camera.
    pub measures: bool,
}

/// A file that was part of a model.
#[derive(Clone, Debug)]
pub struct ImportedFile {
    /// Its name, as the project has it.
    pub name: String,
    /// Everything that is in it.
    pub bytes: Vec<u8>,
}

/// How a model becomes a project.
#[derive(Clone, Copy, Debug)]
pub struct ImportTerms<'t> {
    /// Name of the model in messages.
    pub model: &'t str,
    /// The model's file, as the project names it.
    pub geometry: &'t str,
    /// The weather file of a year, as the project names it.
    pub weather: Option<&'t str>,
    /// The beginning of the names of all other files.
    pub stem: &'t str,
}

/// A project of a Honeybee model.
///
/// # Errors
/// When the bytes are no model, or one that there can be no project of.
pub fn import_honeybee(bytes: &[u8], terms: &ImportTerms<'_>) -> Result<Imported, LoadError> {
    let model = Model::parse(terms.model, bytes)?;
    // Told when the project is loaded.
    let mut of_geometry = Findings::default();
    let surfaces = surfaces(terms.model, &model, &mut of_geometry)?;
    let mut writer = Writer {
        terms,
        unit: model.unit(),
        text: Text::default(),
        names: Names::default(),
        file_names: Names::default(),
        files: Vec::new(),
        sheets: HashMap::new(),
        findings: Findings::default(),
    };
    writer.head(&model, &surfaces);
    let lamps = writer.luminaires(&model)? + writer.lights(&surfaces);
    writer.outside(lamps > 0);
    let measures = writer.grids(&model)? + writer.views(&model) > 0;
    writer.states(&surfaces);
    if !measures {
        let note = "no sensor grid and no view that can be taken: add [[sensors]] or [[cameras]] \
                    to the project, or grids to the model";
        writer.findings.note("properties.radiance", note);
    }
    let mut findings: Vec<Warning> = writer.findings.into_warnings(terms.model).collect();
    if !measures {
        findings.extend(look_over(terms.model, &model)?);
    }
    Ok(Imported { text: writer.text.0, files: writer.files, findings, measures })
}

/// Writes the project.
struct Writer<'w> {
    terms: &'w ImportTerms<'w>,
    unit: LengthUnit,
    text: Text,
    /// Of sensors and cameras.
    names: Names,
    file_names: Names,
    files: Vec<ImportedFile>,
    /// Files of measured sheets by the names of their modifiers.
    sheets: HashMap<String, String>,
    findings: Findings,
}

impl Writer<'_> {
    fn head(&mut self, model: &Model, surfaces: &Surfaces<'_>) {
        let (rooms, count) = (model.rooms.len(), surfaces.surfaces.len());
        self.text.line(&format!("# A Honeybee model of {rooms} rooms and {count} surfaces."));
        self.text.line("[scene]");
        self.text.key("geometry", &format!("[{}]", quoted(self.terms.geometry)));
        if self.unit != LengthUnit::Metre {
            let unit = quoted(self.unit.name());
            self.text.key("units", &unit);
            self.text.key("position_units", &unit);
        }
    }

    /// The sky: that of the weather file, or without any light an overcast one.
    fn outside(&mut self, has_lamps: bool) {
        if let Some(weather) = self.terms.weather {
            self.text.section("[sky]");
            self.text.key("model", &quoted("weather"));
            self.text.section("[weather]");
            self.text.key("file", &quoted(weather));
        } else if !has_lamps {
            self.text.section("[sky]");
            self.text.key("model", &quoted("cie"));
            self.text.key("type", "16");
            self.text.key("horizontal_illuminance_lx", "10000");
        }
    }

    /// Adds a file, and hands out its name.
    fn file(&mut self, name: &str, ending: &str, bytes: Vec<u8>) -> String {
        let name = self.file_names.new_name(&format!("{}-{name}", self.terms.stem), &[ending]);
        let name = format!("{name}{ending}");
        self.files.push(ImportedFile { name: name.clone(), bytes });
        name
    }
}
