//! `quasilux export`: a project as files of another program.

use crate::arguments::ExportArguments;
use crate::exit::{CliError, Exit};
use crate::print::tell;
use crate::{project, results};
use quasilux_scene::{Exported, ExportedFile, export_radiance};

/// Writes the files, of which none is there, and says what they have otherwise.
pub(crate) fn export(arguments: &ExportArguments) -> Result<Exit, CliError> {
    let ExportArguments { project: file, radiance: folder } = arguments;
    let project = project::open(file)?;
    let Exported { files, findings } = export_radiance(&project.loaded.scene)
        .map_err(|message| CliError::in_file(&project.name, None, message))?;
    let place = |file: &ExportedFile| folder.join(&file.name);
    if let Some(taken) = files.iter().map(place).find(|path| path.exists()) {
        let message = "is there already; remove it or name another folder by --radiance";
        return Err(CliError::in_file(taken.display(), None, message));
    }
    results::prepare(folder)?;
    for file in &files {
        results::write_atomic(&place(file), file.text.as_bytes())?;
    }
    for warning in &project.loaded.warnings {
        tell(format_args!("warning: {warning}"));
    }
    for finding in &findings {
        tell(format_args!("warning: {}: {finding}", folder.display()));
    }
    Ok(Exit::Done)
}
