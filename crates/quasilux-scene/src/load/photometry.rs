//! Luminaire files, and the tilt files that they name.

use crate::geometry::{beside, read_file, reason};
use crate::project::Project;
use crate::{FileKind, Files, LoadError, Spanned, Warning};
use quasilux_photometry::{Format, ParseError, Photometry, Tilt, WarningKind, read_tilt};
use quasilux_text::Position;

/// Reads an IES, EULUMDAT or TM-33 file, as its content or else its extension says, passing its
/// warnings on, but for losses that most luminaires have.
pub(super) fn read(
    project: &Project,
    name: &Spanned<String>,
    files: &dyn Files,
    warnings: &mut Vec<Warning>,
) -> Result<Photometry, LoadError> {
    let bytes = read_file(project, name, files, FileKind::Photometry)?;
    let file = name.value.as_str();
    let format = Format::from_file(file, &bytes).unwrap_or(Format::Lm63);
    if let Some(promised) = format.misnamed(file) {
        let message = format!(
            "found a file in the format {}; expected {}, as the name says (read as what it is)",
            format.name(),
            promised.name()
        );
        warnings.push(Warning::new(file, None, message));
    }
    let read = format.read(&bytes).map_err(|error| load_error(file, &error))?;
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
