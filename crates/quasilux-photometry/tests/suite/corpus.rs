//! Files as manufacturers and other programs publish them, read where they are present.

use quasilux_photometry::{Deviation, read_ies};
use std::path::{Path, PathBuf};

/// Files that are refused, the line of the error, and why by hand.
const REFUSED: [(&str, usize, &str); 1] = [
    // All vertical angles are 25.
    ("gldf-lampsets.ies", 13, "25 after 25"),
];

#[test]
fn published_files_load_or_are_refused_for_a_known_reason() {
    let Some(files) = published_files() else {
        return;
    };
    let (mut loaded, mut refused) = (0, 0);
    for file in &files {
        let name = name(file);
        let expected = REFUSED.iter().find(|(refused, ..)| *refused == name);
        match (read_ies(&std::fs::read(file).unwrap()), expected) {
            (Ok(_), None) => loaded += 1,
            (Err(error), Some((_, line, reason))) => {
                assert_eq!(error.line(), *line, "{name}:{error}");
                assert!(error.to_string().contains(reason), "{name}:{error}");
                refused += 1;
            }
            (Ok(_), Some(_)) => panic!("{name} loads, but is listed as refused"),
            (Err(error), None) => panic!("{name}:{error}"),
        }
    }
    println!("{loaded} published files load, {refused} are refused as listed");
    assert!(loaded > 60);
}

/// Fluxes of relative files against their lamps: more light than the lamps give needs a warning.
#[test]
fn published_fluxes_differ_only_with_a_warning() {
    let Some(files) = published_files() else {
        return;
    };
    for file in &files {
        let Ok(read) = read_ies(&std::fs::read(file).unwrap()) else {
            continue;
        };
        let Some(rated_flux_lm) = read.photometry.rated_flux_lm() else {
            continue;
        };
        let differs = (read.photometry.flux_lm() / rated_flux_lm - 1.0).abs() > 0.01;
        let warned = read.warnings.iter().any(|w| w.deviation() == Deviation::FluxDiffers);
        assert_eq!(differs, warned, "{}", name(file));
    }
}

pub(crate) fn name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The published IES files in the order of their names, or `None`, with a line that says so.
pub(crate) fn published_files() -> Option<Vec<PathBuf>> {
    published_files_of("ies")
}

/// The published files with that extension, which names their folder too.
pub(crate) fn published_files_of(extension: &str) -> Option<Vec<PathBuf>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data").join(extension);
    let Ok(entries) = std::fs::read_dir(&folder) else {
        println!("no published .{extension} files at {}: nothing compared", folder.display());
        return None;
    };
    let fits = |path: &PathBuf| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).filter(fits).collect();
    files.sort();
    Some(files)
}
