//! `quasilux import`: a project file of another program's model.

use crate::arguments::ImportArguments;
use crate::exit::{CliError, Exit};
use crate::heartbeat::Heartbeat;
use crate::print::tell;
use crate::project::Project;
use crate::results::{self, NewFile};
use crate::source::{Model, Source, folder_of};
use quasilux_scene::{Imported, ImportedFile, Warning};
use std::path::Path;

/// Writes the project and what it names, and says what of the model is not in it.
pub(crate) fn import(arguments: &ImportArguments) -> Result<Exit, CliError> {
    let ImportArguments { models, out, weather, points, views } = arguments;
    let model = Model::from_files(models, points, views)?;
    if results::first_taken([out.clone()].into_iter()).is_some() {
        let message = "is there already; give --out another name, or remove it";
        return Err(CliError::in_file(out.display(), None, message));
    }
    let folder = folder_of(out);
    let stem = out.file_stem().unwrap_or_default().to_string_lossy();
    let weather = weather.as_deref();
    let Imported { text, files, findings, measures } = model.import(weather, &folder, &stem)?;
    let beside = |file: &ImportedFile| folder.join(&file.name);
    if let Some(taken) = results::first_taken(files.iter().map(beside)) {
        let message = "is there already, and the project would have a file of this name; give \
                       --out another name, or remove it";
        return Err(CliError::in_file(taken.display(), None, message));
    }
    // Nothing is written of a project that cannot be loaded.
    let warnings = if measures { warnings_of(&model, weather)? } else { findings };
    if !folder.as_os_str().is_empty() {
        results::prepare(&folder)?;
    }
    let new = files.iter().map(|it| NewFile { path: beside(it), bytes: it.bytes.as_slice() });
    let project = NewFile { path: out.clone(), bytes: text.as_bytes() };
    results::write_all_new(&new.chain([project]).collect::<Vec<_>>())?;
    warnings.iter().for_each(|warning| tell(format_args!("warning: {warning}")));
    Ok(Exit::Done)
}

/// Warnings of a model as a project, which has to load.
fn warnings_of(model: &Model, weather: Option<&Path>) -> Result<Vec<Warning>, CliError> {
    let _signs_of_life = Heartbeat::new(&format!("reading {}", model.path().display()));
    Ok(Project::load(Source::of_model(model, weather)?)?.loaded.warnings)
}
