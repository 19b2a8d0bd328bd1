//! `quasilux export`: a project as files of another program.

use crate::arguments::ExportArguments;
use crate::exit::{CliError, Exit};
use crate::print::tell;
use crate::results::NewFile;
use crate::{project, results};
use quasilux_scene::{Exported, ExportedFile, export_radiance};

/// Writes the files, of which none is there, and says what they have otherwise.
pub(crate) fn export(arguments: &ExportArguments) -> Result<Exit, CliError> {
    let ExportArguments { project: file, radiance: folder } = arguments;
    let project = project::open(file)?;
    project::expect_a_time(&project)?;
    let Exported { files, findings } = export_radiance(&project.loaded.scene)
        .map_err(|message| CliError::in_file(&project.name, None, message))?;
    let place = |file: &ExportedFile| folder.join(&file.name);
    if let Some(taken) = results::first_taken(files.iter().map(place)) {
        let message = "is there already; remove it or name another folder by --radiance";
        return Err(CliError::in_file(taken.display(), None, message));
    }
    let _claim = results::claim(folder)?;
    let new = files.iter().map(|it| NewFile { path: place(it), bytes: it.text.as_bytes() });
    results::write_all_new(&new.collect::<Vec<_>>())?;
    if project.loaded.blinds.is_some() {
        tell(format_args!("warning: {}: blinds are open", folder.display()));
    }
    for warning in &project.loaded.warnings {
        tell(format_args!("warning: {warning}"));
    }
    for finding in &findings {
        tell(format_args!("warning: {}: {finding}", folder.display()));
    }
    Ok(Exit::Done)
}
