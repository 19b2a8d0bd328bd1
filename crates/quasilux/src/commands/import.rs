//! `quasilux import`: a project file of another program's model.

use crate::arguments::ImportArguments;
use crate::exit::{CliError, Exit};
use crate::print::tell;
use crate::project;
use crate::results;
use crate::source::{folder_of, import as import_model, is_model};
use quasilux_scene::Imported;

/// Writes the project and what it names, and says what of the model is not in it.
pub(crate) fn import(arguments: &ImportArguments) -> Result<Exit, CliError> {
    let ImportArguments { model, out, weather } = arguments;
    if !is_model(model) {
        let message = "no model that can be read; expected a name that ends in .hbjson";
        return Err(CliError::in_file(model.display(), None, message));
    }
    if out.exists() {
        let message = "is there already; give --out another name, or remove it";
        return Err(CliError::in_file(out.display(), None, message));
    }
    let folder = folder_of(out);
    if !folder.as_os_str().is_empty() {
        results::prepare(&folder)?;
    }
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let Imported { text, files, findings, measures } =
        import_model(model, weather.as_deref(), &folder, &stem)?;
    for file in &files {
        results::write_atomic(&folder.join(&file.name), &file.bytes)?;
    }
    results::write_atomic(out, text.as_bytes())?;
    findings.iter().for_each(|finding| tell(format_args!("warning: {finding}")));
    if measures {
        let loaded = project::open(out)?.loaded;
        loaded.warnings.iter().for_each(|warning| tell(format_args!("warning: {warning}")));
    }
    Ok(Exit::Done)
}
