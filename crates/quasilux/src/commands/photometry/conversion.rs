//! A luminaire in another format.

use super::input::Luminaire;
use super::outputs::Conversion;
use crate::exit::CliError;
use crate::print::tell;
use crate::results;
use quasilux_photometry::{Format, IesStandard, Standard, write_ies, write_ldt};

/// Writes the file; what the format could not hold is said on stderr.
pub(super) fn convert(luminaire: &Luminaire, wanted: &Conversion) -> Result<(), CliError> {
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
