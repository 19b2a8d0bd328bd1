//! Models of other programs as projects in memory: the text that `quasilux import` writes.

use super::{Reader, Source, from_the_root};
use crate::exit::CliError;
use crate::input;
use quasilux_scene::{
    FileKind, ImportTerms, Imported, ImportedFile, RadianceTerms, ifc_advice, import_honeybee,
    import_radiance,
};
use std::path::{Component, Path, PathBuf};

/// A model of another program.
#[derive(Clone, Debug)]
pub(crate) enum Model {
    /// A file of Honeybee.
    Honeybee(PathBuf),
    /// A scene of Radiance: its files in their order, points and views.
    Radiance { scene: Vec<PathBuf>, points: Vec<PathBuf>, views: Vec<PathBuf> },
}

/// Whether a file is a model, by its name.
pub(crate) fn is_model(path: &Path) -> bool {
    ends_in(path, "hbjson") || ends_in(path, "rad")
}

fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|it| it.eq_ignore_ascii_case(ending))
}

impl Model {
    /// The model that is one file.
    pub(crate) fn at(path: &Path) -> Self {
        let path = path.to_owned();
        if ends_in(&path, "rad") {
            Self::Radiance { scene: vec![path], points: Vec::new(), views: Vec::new() }
        } else {
            Self::Honeybee(path)
        }
    }

    /// The model of these files, with points and views beside them.
    ///
    /// # Errors
    /// For files that are no model, or not one of them.
    pub(crate) fn from_files(
        files: &[PathBuf],
        points: &[PathBuf],
        views: &[PathBuf],
    ) -> Result<Self, CliError> {
        let refuse = |path: &Path, what: &str| Err(CliError::in_file(path.display(), None, what));
        if let [file] = files
            && ends_in(file, "hbjson")
        {
            return match points.iter().chain(views).next() {
                None => Ok(Self::at(file)),
                Some(other) => refuse(other, "a Honeybee model has its own points and views"),
            };
        }
        let (mut scene, mut points, mut views) = (Vec::new(), points.to_vec(), views.to_vec());
        for file in files {
            if ends_in(file, "rad") || ends_in(file, "mat") {
                scene.push(file.clone());
            } else if ends_in(file, "pts") {
                points.push(file.clone());
            } else if ends_in(file, "vf") {
                views.push(file.clone());
            } else {
                let message = "no model that can be read; expected a name that ends in .hbjson, \
                               or names that end in .rad, .mat, .pts and .vf";
                let advice = ifc_advice(&file.to_string_lossy());
                return refuse(file, advice.as_deref().unwrap_or(message));
            }
        }
        match (scene.is_empty(), files.first()) {
            (true, Some(first)) => refuse(first, "no scene; expected a name that ends in .rad"),
            _ => Ok(Self::Radiance { scene, points, views }),
        }
    }

    /// Its first file.
    pub(crate) fn path(&self) -> &Path {
        match self {
            Self::Honeybee(path) => path,
            Self::Radiance { scene, .. } => &scene[0],
        }
    }

    /// A project for a folder that it is to be in.
    ///
    /// # Errors
    /// When the file cannot be read, or there can be no project of it.
    pub(crate) fn import(
        &self,
        weather: Option<&Path>,
        folder: &Path,
        stem: &str,
    ) -> Result<Imported, CliError> {
        let name = self.path().display().to_string();
        let weather = weather.map(|weather| seen_from(folder, weather));
        let weather = weather.as_deref();
        match self {
            Self::Honeybee(path) => {
                let bytes = input::read_kind(path, FileKind::Model);
                let bytes = bytes.map_err(|error| CliError::in_file(&name, None, error))?;
                let geometry = seen_from(folder, path);
                let terms = ImportTerms { model: &name, geometry: &geometry, weather, stem };
                Ok(import_honeybee(&bytes, &terms)?)
            }
            Self::Radiance { scene, points, views } => {
                let seen = |paths: &[PathBuf]| -> Vec<String> {
                    paths.iter().map(|path| seen_from(folder, path)).collect()
                };
                let [scene, points, views] = [seen(scene), seen(points), seen(views)];
                let source = Source::in_memory(&name, Vec::new()).with_folder(folder);
                let reader = Reader { source: &source, read: std::cell::RefCell::default() };
                let terms = RadianceTerms {
                    model: &name,
                    scene: &scene,
                    points: &points,
                    views: &views,
                    weather,
                    stem,
                };
                Ok(import_radiance(&reader, &terms)?)
            }
        }
    }
}

const NO_GRID: &str = "no sensor grid, and no view that a picture can be taken of; add sensor \
                       grids to the model, or [[sensors]] to the project that `quasilux import` \
                       writes";
const NO_POINTS: &str = "a Radiance scene has no sensor points; write a project with them by \
                         `quasilux import SCENE.rad --points FILE --out PROJECT.toml`";

impl Source {
    /// The project of a model, with the weather of a year where it is to have one.
    pub(crate) fn of_model(model: &Model, weather: Option<&Path>) -> Result<Self, CliError> {
        let path = model.path();
        let folder = path.parent().unwrap_or(Path::new(""));
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let Imported { text, files, findings, measures } = model.import(weather, folder, &stem)?;
        let name = path.display().to_string();
        if !measures {
            let message = match model {
                Model::Honeybee(_) => NO_GRID,
                Model::Radiance { .. } => NO_POINTS,
            };
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
