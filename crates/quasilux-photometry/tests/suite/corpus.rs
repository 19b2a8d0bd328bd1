//! Files as manufacturers and other programs publish them.

use quasilux_photometry::read_ies;
use std::path::{Path, PathBuf};

/// A file that is refused.
struct RefusedFile {
    file: &'static str,
    /// The line of the error.
    line: usize,
    /// A part of its message.
    message: &'static str,
    /// The rule of LM-63 that the file breaks, as seen in it by hand; empty where the file is
    /// valid.
    breaks: &'static str,
}

const REFUSED: [RefusedFile; 1] = [
    // All 47 vertical angles are 25, the only horizontal angle is 205, and of the 47 candela values
    // 28 are 0: angles of several planes got mixed when the file was written.
    RefusedFile {
        file: "gldf-lampsets.ies",
        line: 13,
        message: "25 after 25",
        breaks: "LM-63-19, 5.15: vertical angles ascend, from 0 or 90 to 90 or 180",
    },
];

/// Share of the valid files that must load.
const MIN_SHARE: f64 = 0.97;

#[test]
fn published_files_load_or_are_refused_for_a_known_reason() {
    let Some(files) = published_files() else {
        return;
    };
    let (mut loaded, mut refused, mut invalid) = (0, 0, 0);
    for file in &files {
        let name = name(file);
        let expected = REFUSED.iter().find(|refusal| refusal.file == name);
        match (read_ies(&std::fs::read(file).unwrap()), expected) {
            (Ok(_), None) => loaded += 1,
            (Err(error), Some(refusal)) => {
                assert_eq!(error.line(), refusal.line, "{name}:{error}");
                assert!(error.to_string().contains(refusal.message), "{name}:{error}");
                refused += 1;
                invalid += usize::from(!refusal.breaks.is_empty());
            }
            (Ok(_), Some(_)) => panic!("{name} loads, but is listed as refused"),
            (Err(error), None) => panic!("{name}:{error}"),
        }
    }
    println!("{loaded} published files load, {refused} are refused as listed, {invalid} invalid");
    assert_eq!(refused, REFUSED.len(), "a file that is listed is not there");
    assert!(f64::from(loaded) >= MIN_SHARE * (files.len() - invalid) as f64);
}

pub(crate) fn name(file: &Path) -> String {
    file.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// The published IES files in the order of their names; `None` where the test is left out.
pub(crate) fn published_files() -> Option<Vec<PathBuf>> {
    published_files_of("ies")
}

/// The published files with that extension, which names their folder too.
pub(crate) fn published_files_of(extension: &str) -> Option<Vec<PathBuf>> {
    let folder = quasilux_corpus::find(extension)?;
    let entries = std::fs::read_dir(&folder).expect("a folder of published files");
    let fits = |path: &PathBuf| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).filter(fits).collect();
    files.sort();
    Some(files)
}
