//! Models of other programs as projects in memory: the text that `quasilux import` writes.

use super::{Source, from_the_root};
use crate::exit::CliError;
use crate::input;
use quasilux_scene::{FileKind, ImportTerms, Imported, ImportedFile, import_honeybee};
use std::path::{Component, Path, PathBuf};

/// Whether a file is a model, by its name.
pub(crate) fn is_model(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("hbjson"))
}

/// A project of a model for a folder that it is to be in.
///
/// # Errors
/// When the file cannot be read, or there can be no project of it.
pub(crate) fn import(
    model: &Path,
    weather: Option<&Path>,
    folder: &Path,
    stem: &str,
) -> Result<Imported, CliError> {
    let name = model.display().to_string();
    let bytes = input::read_kind(model, FileKind::Model);
    let bytes = bytes.map_err(|error| CliError::in_file(&name, None, error))?;
    let geometry = seen_from(folder, model);
    let weather = weather.map(|weather| seen_from(folder, weather));
    let terms =
        ImportTerms { model: &name, geometry: &geometry, weather: weather.as_deref(), stem };
    Ok(import_honeybee(&bytes, &terms)?)
}

impl Source {
    /// The project of a model, with the weather of a year where it is to have one.
    pub(crate) fn of_model(path: &Path, weather: Option<&Path>) -> Result<Self, CliError> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let Imported { text, files, findings, measures } = import(path, weather, folder, &stem)?;
        let name = path.display().to_string();
        if !measures {
            let message = "no sensor grid, and no view that a picture can be taken of; add sensor \
                           grids to the model, or [[sensors]] to the project that `quasilux \
                           import` writes";
            return Err(CliError::in_file(&name, None, message));
        }
        let source = Self::in_memory(&format!("{name} as a project"), text).with_folder(folder);
        let with_file = |source: Self, file: ImportedFile| source.with_file(&file.name, file.bytes);
        let source = files.into_iter().fold(source, with_file);
        Ok(Self { findings, path: Some(path.to_owned()), ..source })
    }
}

/// A file as a project in a folder names it: from the folder if they share one, else from the root.
fn seen_from(folder: &Path, file: &Path) -> String {
    let folder = whole(if folder.as_os_str().is_empty() { Path::new(".") } else { folder });
    let beside =
        whole(file.parent().filter(|it| !it.as_os_str().is_empty()).unwrap_or(Path::new(".")));
    let file = beside.join(file.file_name().unwrap_or_default());
    let shared = folder.components().zip(file.components()).take_while(|(a, b)| a == b).count();
    let is_named = |it: &Component<'_>| matches!(it, Component::Normal(_));
    if !file.components().take(shared).any(|it| is_named(&it)) {
        return file.display().to_string();
    }
    let up = folder.components().skip(shared).map(|_| "..".to_owned());
    let down =
        file.components().skip(shared).map(|it| it.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<String>>().join("/")
}

/// A path from the root without links, as far as there is something.
fn whole(path: &Path) -> PathBuf {
    let path = from_the_root(path);
    match (path.canonicalize(), path.parent(), path.file_name()) {
        (Ok(found), ..) => found,
        (Err(_), Some(folder), Some(name)) => whole(folder).join(name),
        _ => path,
    }
}

/// The folder of a file.
pub(crate) fn folder_of(file: &Path) -> PathBuf {
    file.parent().map(Path::to_owned).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_named_from_the_folder_of_the_project() {
        let root = std::env::temp_dir().canonicalize().unwrap();
        let named = |folder: &str, file: &str| seen_from(&root.join(folder), &root.join(file));
        assert_eq!(named("a", "a/model.hbjson"), "model.hbjson");
        assert_eq!(named("a", "a/b/model.hbjson"), "b/model.hbjson");
        assert_eq!(named("a/b", "a/model.hbjson"), "../model.hbjson");
        assert_eq!(named("a", "b/site.epw"), "../b/site.epw");
    }
}
