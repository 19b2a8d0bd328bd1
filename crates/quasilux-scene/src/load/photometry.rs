//! Luminaire files, the containers that they stand in, and the tilt files that they name.

use crate::geometry::{beside, read_file, reason};
use crate::project::{LuminaireEntry, Project};
use crate::{FileKind, Files, LoadError, Warning};
use glam::DMat3;
use quasilux_photometry::{
    Axis, Format, GldfError, ParseError, Photometry, Tilt, WarningKind, is_gldf, read_gldf,
    read_tilt,
};
use quasilux_text::Position;

/// Warnings and facts of luminaire files.
#[derive(Default)]
pub(super) struct Told {
    pub(super) warnings: Vec<Warning>,
    /// Facts, for people: `file: fact`.
    pub(super) notes: Vec<String>,
}

/// A luminaire as its file has it, at the length that the project asks for.
pub(super) struct FilePhotometry {
    pub(super) photometry: Photometry,
    /// From the frame of the photometry to that of the luminaire.
    pub(super) luminaire_from_photometry: DMat3,
}

/// Reads the luminaire of an entry under the name that tells it from others of its file.
pub(super) fn read(
    project: &Project,
    entry: &LuminaireEntry,
    files: &dyn Files,
    told: &mut Told,
) -> Result<FilePhotometry, LoadError> {
    let name = entry.photometry.value.as_str();
    let kind = if is_gldf(name, &[]) { FileKind::Container } else { FileKind::Photometry };
    let bytes = read_file(project, &entry.photometry, files, kind)?;
    let mut read = if is_gldf(name, &bytes) {
        read_container(entry, &bytes, told)?
    } else {
        let photometry = read_photometric(name, &bytes, files, &mut told.warnings)?;
        FilePhotometry { photometry, luminaire_from_photometry: DMat3::IDENTITY }
    };
    if entry.length_m.is_some() {
        read.photometry = at_length(project, entry, &read.photometry, told)?;
    }
    read.photometry = read.photometry.with_name(&full_name(entry));
    Ok(read)
}

/// The name of the file, with what was chosen from it.
fn full_name(entry: &LuminaireEntry) -> String {
    let choice = &entry.choice;
    let names = [&choice.variant, &choice.emitter, &choice.light_source, &choice.channel];
    let mut chosen: Vec<String> = names.into_iter().flatten().cloned().collect();
    if choice.emergency {
        chosen.push("emergency".to_owned());
    }
    if let Some(length_m) = &entry.length_m {
        chosen.push(format!("{} m", length_m.value));
    }
    let file = &entry.photometry.value;
    if chosen.is_empty() { file.clone() } else { format!("{file} ({})", chosen.join(", ")) }
}

/// The light of a GLDF container that the entry chooses.
fn read_container(
    entry: &LuminaireEntry,
    bytes: &[u8],
    told: &mut Told,
) -> Result<FilePhotometry, LoadError> {
    let name = entry.photometry.value.as_str();
    let read = read_gldf(bytes, &entry.choice).map_err(|error| container_error(name, &error))?;
    for warning in &read.warnings {
        // Other lights of the container tell the same of it.
        let warning = passed_on(&format!("{name}/{}", warning.part), &warning.warning);
        if !told.warnings.contains(&warning) {
            told.warnings.push(warning);
        }
    }
    for fact in &read.facts {
        told.notes.push(format!("{}: {}: {}", full_name(entry), fact.name, fact.value));
    }
    let luminaire_from_photometry = read.luminaire_from_photometry;
    Ok(FilePhotometry { photometry: read.photometry, luminaire_from_photometry })
}

fn container_error(name: &str, error: &GldfError) -> LoadError {
    let file = match error.part() {
        "" => name.to_owned(),
        part => format!("{name}/{part}"),
    };
    LoadError::new(&file, error.position(), error.message())
}

/// The luminaire, longer or shorter than in its file.
fn at_length(
    project: &Project,
    entry: &LuminaireEntry,
    photometry: &Photometry,
    told: &mut Told,
) -> Result<Photometry, LoadError> {
    let Some(length_m) = &entry.length_m else {
        return Ok(photometry.clone());
    };
    let name = &entry.photometry.value;
    let longer = photometry.with_length(length_m.value).map_err(|error| {
        let message = format!(
            "found {error} in \"{name}\"; expected the opening of a linear luminaire for \
             \"length_m\" (with a longer side, whose length in the file is known)"
        );
        project.error(length_m.place, message)
    })?;
    let along = if longer.axis == Axis::X { "C0-C180" } else { "C90-C270" };
    told.notes.push(format!(
        "{}: length: {:.4} m of the file along {along} became {} m, {:.1} lm became {:.1} lm",
        full_name(entry),
        longer.length_of_file_m,
        length_m.value,
        photometry.flux_lm(),
        longer.photometry.flux_lm()
    ));
    Ok(longer.photometry)
}

/// Reads an IES, EULUMDAT or TM-33 file, as its content or else its extension says, passing its
/// warnings on, but for losses that most luminaires have.
fn read_photometric(
    file: &str,
    bytes: &[u8],
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Photometry, LoadError> {
    let format = Format::from_file(file, bytes).unwrap_or(Format::Lm63);
    if let Some(promised) = format.misnamed(file) {
        let message = format!(
            "found a file in the format {}; expected {}, as the name says (read as what it is)",
            format.name(),
            promised.name()
        );
        warnings.push(Warning::new(file, None, message));
    }
    let read = format.read(bytes).map_err(|error| load_error(file, &error))?;
    for warning in &read.warnings {
        let is_told = match warning.kind() {
            // Whether that file is there is found out below.
            WarningKind::TiltFile => false,
            WarningKind::FluxDiffers => !read.photometry.has_usual_losses(),
            _ => true,
        };
        if is_told {
            warnings.push(passed_on(file, warning));
        }
    }
    let Tilt::File(tilt_file) = &read.photometry.facts().tilt else {
        return Ok(read.photometry);
    };
    let tilt_path = beside(file, tilt_file);
    match crate::files::read(files, &tilt_path, FileKind::Tilt) {
        Ok(bytes) => {
            let tilt = read_tilt(&bytes).map_err(|error| load_error(&tilt_path, &error))?;
            warnings.extend(tilt.warnings.iter().map(|warning| passed_on(&tilt_path, warning)));
            Ok(read.photometry.with_tilt(tilt.tilt))
        }
        Err(error) => {
            let at = read.warnings.iter().find(|w| w.kind() == WarningKind::TiltFile);
            let place =
                at.map(|warning| Position { line: warning.line(), column: warning.column() });
            let reason = reason(&error);
            let message = format!(
                "cannot read the tilt file \"{tilt_path}\": {reason}; the lamps count as giving \
                 the same light at every tilt (factor 1)"
            );
            warnings.push(Warning::new(file, place, message));
            Ok(read.photometry)
        }
    }
}

pub(super) fn load_error(file: &str, error: &ParseError) -> LoadError {
    let place = Position { line: error.line(), column: error.column() };
    LoadError::new(file, Some(place), error.message())
}

pub(super) fn passed_on<K: Copy>(file: &str, warning: &quasilux_text::Warning<K>) -> Warning {
    let place = Position { line: warning.line(), column: warning.column() };
    Warning::new(file, Some(place), warning.message())
}
