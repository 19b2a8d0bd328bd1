//! `quasilux export`: a project as files of another program.

use crate::arguments::ExportArguments;
use crate::exit::{CliError, Exit};
use crate::print::tell;
use crate::{project, results};
use quasilux_scene::{Exported, ExportedFile, export_radiance};
use std::fs;
use std::path::PathBuf;

/// Writes the files, of which none is there, and says what they have otherwise.
pub(crate) fn export(arguments: &ExportArguments) -> Result<Exit, CliError> {
    let ExportArguments { project: file, radiance: folder } = arguments;
    let project = project::open(file)?;
    project::expect_a_time(&project)?;
    let Exported { files, findings } = export_radiance(&project.loaded.scene)
        .map_err(|message| CliError::in_file(&project.name, None, message))?;
    let place = |file: &ExportedFile| folder.join(&file.name);
    let is_there = |path: &PathBuf| path.symlink_metadata().is_ok();
    if let Some(taken) = files.iter().map(place).find(is_there) {
        let message = "is there already; remove it or name another folder by --radiance";
        return Err(CliError::in_file(taken.display(), None, message));
    }
    let _claim = results::claim(folder)?;
    for (number, file) in files.iter().enumerate() {
        let written = results::write_atomic(&place(file), file.text.as_bytes());
        if written.is_err() {
            // A part of a scene is of no use, and would keep the next try from its place.
            files[..number].iter().for_each(|file| _ = fs::remove_file(place(file)));
        }
        written?;
    }
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
