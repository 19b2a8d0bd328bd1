//! `quasilux sky [PROJECT]`: what shines from outside, as a summary, a document or a picture, and
//! where the sun is on chosen days.

mod document;
mod picture;
mod positions;
mod subject;
mod summary;

use crate::arguments::SkyArguments;
use crate::exit::{CliError, Exit};
use crate::print::{print, print_document, tell};
use crate::results;
use positions::ListedDay;
use quasilux_drawing::Drawing;
use std::path::Path;
pub use subject::CieSky;
pub(crate) use subject::{ShownSky, Subject};

/// Cells along the diameter of the sky, in a picture and in a drawing.
const PNG_CELLS: usize = 676;
const SVG_CELLS: usize = 169;

/// Says what is outside.
pub(crate) fn sky(arguments: &SkyArguments) -> Result<Exit, CliError> {
    let read: Vec<&Path> = arguments.project.iter().map(std::path::PathBuf::as_path).collect();
    for path in [&arguments.png, &arguments.svg, &arguments.csv].into_iter().flatten() {
        results::prepare_file(path, &read)?;
    }
    let subject = Subject::new(arguments)?;
    let days = match &arguments.positions {
        Some(days) => ListedDay::list(subject.site_for_positions()?, days)?,
        None => Vec::new(),
    };
    let drawn = |cells| match &subject.sky {
        Some(sky) => Ok(picture::drawing(&subject, sky, cells)),
        None => Err(CliError::new("there is no sky to draw; give a project, or --type")),
    };
    if let Some(path) = &arguments.png {
        results::write_atomic(path, &drawn(PNG_CELLS)?.to_png(1.0))?;
    }
    if let Some(path) = &arguments.svg {
        results::write_atomic(path, drawn(SVG_CELLS)?.to_svg().as_bytes())?;
    }
    if let Some(path) = &arguments.csv {
        results::write_atomic(path, positions::csv(&days).as_bytes())?;
    }
    if arguments.json {
        print_document(&document::document(&subject, &days))?;
        return Ok(Exit::Done);
    }
    subject.warnings.iter().for_each(|warning| tell(format_args!("warning: {warning}")));
    print(&summary::summary(&subject))?;
    print(&days.iter().map(ListedDay::text).collect::<String>())?;
    Ok(Exit::Done)
}

/// The document for programs, without places of the sun.
pub(crate) fn document(subject: &Subject) -> String {
    document::document(subject, &[])
}

/// Figures and luminances for people.
pub(crate) fn text(subject: &Subject) -> String {
    summary::summary(subject)
}

/// The sky in false colours.
pub(crate) fn drawing(subject: &Subject, sky: &ShownSky) -> Drawing {
    picture::drawing(subject, sky, SVG_CELLS)
}
