//! Damaged files of measured surfaces, and what must hold of the reader's answer to any bytes.
//!
//! The bounded run of the test suite, the full run (`examples/mutate.rs`) and the fuzz target
//! (`fuzz/`) share this module. Memory is counted for each thread by itself
//! (`allocation-counter`), so that any number of files can be read side by side.

pub(crate) mod glazing;
mod surface;

use quasilux_bsdf::{max_bsdf_memory_bytes, read_bsdf_named};
use quasilux_stats::SplitMix64;
use quasilux_stats::damage::{Outcome, Seeds, check_message};
use std::path::{Path, PathBuf};

/// Files made up for the purpose.
pub(crate) fn samples() -> Seeds {
    Seeds::new(surface::samples())
}

/// The same with the published files; without them where `QUASILUX_CORPUS=none` says so.
pub(crate) fn seeds() -> Seeds {
    let folder = quasilux_corpus::find("bsdf");
    samples().with_files(folder.map_or_else(Vec::new, |folder| published(&folder, "xml")))
}

/// The files of a folder that have the extension, in the order of their names.
fn published(folder: &Path, extension: &str) -> Vec<Vec<u8>> {
    let entries = std::fs::read_dir(folder).expect("a folder of published files");
    let fits = |path: &PathBuf| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).filter(fits).collect();
    paths.sort();
    paths.iter().map(|path| std::fs::read(path).unwrap()).collect()
}

/// Reads any bytes and checks the answer: no more memory than stated, messages with a position in
/// the file, and a surface whose samples and densities are numbers that fit each other.
pub(crate) fn examine(bytes: &[u8]) -> Outcome {
    let mut answer = None;
    let allocated =
        allocation_counter::measure(|| answer = Some(read_bsdf_named(surface::name(bytes), bytes)));
    let answer = answer.expect("the reader was called");
    let peak_bytes = allocated.bytes_max as usize;
    let max = max_bsdf_memory_bytes(bytes.len());
    assert!(peak_bytes <= max, "{peak_bytes} bytes for a file of {}, over {max}", bytes.len());
    match &answer {
        Ok(read) => {
            for warning in &read.warnings {
                check_message(warning.line(), warning.column(), &warning.to_string(), bytes);
            }
            surface::check(&read.bsdf, &mut SplitMix64::new(bytes.len() as u64));
        }
        Err(error) => check_message(error.line(), error.column(), &error.to_string(), bytes),
    }
    Outcome { is_read: answer.is_ok(), peak_bytes }
}
