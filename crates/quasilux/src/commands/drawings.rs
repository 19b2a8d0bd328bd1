//! Where drawings of measurement files go; checked before anything is read or written.

use super::inputs::is_stdin;
use crate::exit::CliError;
use crate::results;
use std::path::{Path, PathBuf};

/// Endings of pictures that are not drawn: nobody means a folder by them.
const OTHER_PICTURES: [&str; 5] = ["png", "jpg", "jpeg", "gif", "pdf"];

/// A file for the drawing of each input, all different, and none of the inputs: the file that
/// `--svg` names, or files in the folder.
pub(super) fn plan(path: &Path, files: &[PathBuf]) -> Result<Vec<PathBuf>, CliError> {
    let drawings = drawings(path, files)?;
    for (i, path) in drawings.iter().enumerate() {
        results::prepare_file(path, &[])?;
        if let Some(first) = drawings[..i].iter().position(|other| other == path) {
            return Err(CliError::new(format!(
                "{}: the drawing of {} and of {}; give them folders of their own",
                path.display(),
                files[first].display(),
                files[i].display()
            )));
        }
        refuse_input(path, files)?;
    }
    Ok(drawings)
}

/// A file is somebody's measurement: it is never written over.
pub(super) fn refuse_input(path: &Path, files: &[PathBuf]) -> Result<(), CliError> {
    let Ok(existing) = path.canonicalize() else {
        return Ok(());
    };
    let is_same = |file: &&PathBuf| file.canonicalize().is_ok_and(|input| input == existing);
    match files.iter().find(is_same) {
        Some(file) => {
            Err(CliError::new(format!("{}: would replace the measured file", file.display())))
        }
        None => Ok(()),
    }
}

fn drawings(path: &Path, files: &[PathBuf]) -> Result<Vec<PathBuf>, CliError> {
    let is_file = has_extension(path, "svg") && !path.is_dir();
    if OTHER_PICTURES.iter().any(|other| has_extension(path, other)) && !path.is_dir() {
        return Err(CliError::new(format!(
            "--svg {}: expected a name that ends in .svg, or a folder",
            path.display()
        )));
    }
    match files {
        [_] if is_file => Ok(vec![path.to_owned()]),
        _ if is_file => Err(CliError::new(format!(
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

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
}
