//! Luminaires of the published files, of every format.

use crate::corpus::{name, published_files_of};
use quasilux_photometry::{Photometry, read_ies, read_ldt};
use std::path::Path;

/// Each published luminaire that loads and gives light, with the name of its file.
pub(crate) fn luminaires() -> impl Iterator<Item = (String, Photometry)> {
    let files = ["ies", "ldt"].into_iter().filter_map(published_files_of).flatten();
    let read = files.filter_map(|file| Some((name(&file), read(&file)?)));
    read.filter(|(_, photometry)| photometry.flux_lm() > 0.0)
}

/// The luminaire of one file; `None` where the test is left out.
pub(crate) fn luminaire(file: &str) -> Option<Photometry> {
    let extension = if file.to_ascii_lowercase().ends_with("ldt") { "ldt" } else { "ies" };
    let files = published_files_of(extension)?;
    let path = files.iter().find(|path| name(path) == file);
    let path = path.unwrap_or_else(|| panic!("{file} is not among the published files"));
    Some(read(path).unwrap_or_else(|| panic!("{file} does not load")))
}

fn read(file: &Path) -> Option<Photometry> {
    let bytes = std::fs::read(file).unwrap();
    let is_ldt = file.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("ldt"));
    let read = if is_ldt { read_ldt(&bytes) } else { read_ies(&bytes) };
    read.ok().map(|read| read.photometry)
}
