//! A luminaire in another format.

use super::ReadInput;
use super::outputs::Conversion;
use crate::exit::CliError;
use crate::print::tell;
use crate::results;
use quasilux_photometry::{Format, IesStandard, Standard, write_ies, write_ldt};

/// Writes the file; what the format could not hold is said on stderr. A luminaire whose container
/// turns it in a way that no file can hold is refused.
pub(super) fn convert(read: &ReadInput<'_>, wanted: &Conversion) -> Result<(), CliError> {
    let luminaire = read.luminaire;
    if luminaire.container.as_ref().is_some_and(|container| !container.rotation.is_applied) {
        let message = "found a rotation in the container that the converted file cannot hold; \
                       expected one about the vertical axis, by right angles for a linear opening \
                       (unpack the photometric file, and turn the luminaire in the project)";
        return Err(CliError::in_file(&read.input.name, None, message));
    }
    let photometry = &luminaire.photometry;
    let written = match wanted.format {
        Format::Eulumdat => write_ldt(photometry),
        _ => write_ies(photometry, edition(photometry.facts().standard)),
    };
    results::write_atomic(&wanted.path, written.text.as_bytes())?;
    for note in &written.notes {
        tell(format_args!("note: {}: {note}", wanted.path.display()));
    }
    Ok(())
}

/// The edition that most programs read, but for files that are of a later one.
fn edition(standard: Standard) -> IesStandard {
    match standard {
        Standard::Lm63(IesStandard::Lm63Of2019) => IesStandard::Lm63Of2019,
        _ => IesStandard::Lm63Of2002,
    }
}
