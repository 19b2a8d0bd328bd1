//! Where drawings and converted files go; checked before anything is read or written.

use crate::arguments::PhotometryArguments;
use crate::exit::Refusal;
use crate::results;
use quasilux_photometry::Format;
use std::path::{Path, PathBuf};

/// Endings of pictures that are not drawn: nobody means a folder by them.
const OTHER_PICTURES: [&str; 5] = ["png", "jpg", "jpeg", "gif", "pdf"];

/// The files to be written.
pub(super) struct Outputs {
    /// One for each input, or none at all.
    drawings: Vec<PathBuf>,
    /// The converted file.
    pub(super) conversion: Option<Conversion>,
}

/// A luminaire file to be written.
pub(super) struct Conversion {
    pub(super) path: PathBuf,
    pub(super) format: Format,
}

impl Outputs {
    /// Plans the files, and makes sure that they can be written, are all different and replace no
    /// input.
    pub(super) fn prepare(arguments: &PhotometryArguments) -> Result<Self, Refusal> {
        let drawings = match &arguments.svg {
            Some(path) => drawings(path, &arguments.files)?,
            None => Vec::new(),
        };
        for (i, path) in drawings.iter().enumerate() {
            results::prepare_file(path, &[])?;
            if let Some(first) = drawings[..i].iter().position(|other| other == path) {
                return Err(Refusal::new(format!(
                    "{}: the drawing of {} and of {}; give them folders of their own",
                    path.display(),
                    arguments.files[first].display(),
                    arguments.files[i].display()
                )));
            }
            refuse_input(path, &arguments.files)?;
        }
        let conversion = match &arguments.convert {
            Some(path) => Some(conversion(path, &arguments.files)?),
            None => None,
        };
        Ok(Self { drawings, conversion })
    }

    /// Where the drawing of an input goes.
    pub(super) fn drawing(&self, input: usize) -> Option<&Path> {
        self.drawings.get(input).map(PathBuf::as_path)
    }
}

fn drawings(path: &Path, files: &[PathBuf]) -> Result<Vec<PathBuf>, Refusal> {
    let is_file = has_extension(path, "svg") && !path.is_dir();
    if OTHER_PICTURES.iter().any(|other| has_extension(path, other)) && !path.is_dir() {
        return Err(Refusal::new(format!(
            "--svg {}: expected a name that ends in .svg, or a folder",
            path.display()
        )));
    }
    match files {
        [_] if is_file => Ok(vec![path.to_owned()]),
        _ if is_file => Err(Refusal::new(format!(
            "--svg {}: one drawing for {} files; name a folder",
            path.display(),
            files.len()
        ))),
        _ => {
            let drawing = |file: &PathBuf| {
                let stem = match file.file_stem() {
                    Some(stem) if !is_stdin(file) => stem.to_owned(),
                    _ => "stdin".into(),
                };
                let mut name = stem;
                name.push(".svg");
                path.join(name)
            };
            Ok(files.iter().map(drawing).collect())
        }
    }
}

fn conversion(path: &Path, files: &[PathBuf]) -> Result<Conversion, Refusal> {
    let refuse = |what: String| Err(Refusal::new(format!("--convert {}: {what}", path.display())));
    let format = match Format::of_name(&path.to_string_lossy()) {
        Some(format @ (Format::Lm63 | Format::Eulumdat)) => format,
        _ => return refuse("expected a name that ends in .ies or .ldt".to_owned()),
    };
    if files.len() > 1 {
        return refuse(format!("one name for {} files; convert them one by one", files.len()));
    }
    results::prepare_file(path, &[])?;
    refuse_input(path, files)?;
    Ok(Conversion { path: path.to_owned(), format })
}

/// Whether a path stands for the standard input.
pub(super) fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
}

/// A luminaire file is somebody's measurement: it is never written over.
fn refuse_input(path: &Path, files: &[PathBuf]) -> Result<(), Refusal> {
    let Ok(existing) = path.canonicalize() else {
        return Ok(());
    };
    let is_same = |file: &&PathBuf| file.canonicalize().is_ok_and(|input| input == existing);
    match files.iter().find(is_same) {
        Some(file) => {
            Err(Refusal::new(format!("{}: would replace the luminaire file", file.display())))
        }
        None => Ok(()),
    }
}
