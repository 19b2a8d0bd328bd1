//! Damaged luminaire files, and what must hold of a reader's answer to any bytes.
//!
//! The bounded run of the test suite, the full run (`examples/mutate.rs`) and the fuzz targets
//! (`fuzz/`) share this module. Memory is counted for each thread by itself
//! (`allocation-counter`), so that any number of files can be read side by side.

mod samples;

use quasilux_photometry::{
    ParseError, Parsed, max_read_memory_bytes, read_ies, read_ldt, read_tm33,
};
use quasilux_stats::SplitMix64;
use quasilux_stats::damage::{Outcome, Seeds, check_message};
use std::path::{Path, PathBuf};

/// A format and its reader.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Format {
    Ies,
    Ldt,
    Tm33,
}

impl Format {
    pub(crate) const ALL: [Self; 3] = [Self::Ies, Self::Ldt, Self::Tm33];

    pub(crate) fn read(self, bytes: &[u8]) -> Result<Parsed, ParseError> {
        match self {
            Self::Ies => read_ies(bytes),
            Self::Ldt => read_ldt(bytes),
            Self::Tm33 => read_tm33(bytes),
        }
    }

    /// Files made up for the purpose.
    pub(crate) fn samples(self) -> Seeds {
        Seeds::new(match self {
            Self::Ies => samples::ies(),
            Self::Ldt => samples::ldt(),
            Self::Tm33 => samples::tm33(),
        })
    }

    /// The same with the published files; without them where `QUASILUX_CORPUS=none` says so.
    pub(crate) fn seeds(self) -> Seeds {
        let (folder, extension) = match self {
            Self::Ies => ("ies", "ies"),
            Self::Ldt => ("ldt", "ldt"),
            Self::Tm33 => ("ies/tm33", "xml"),
        };
        let folder = quasilux_corpus::find(folder);
        let files = folder.map_or_else(Vec::new, |folder| published(&folder, extension));
        self.samples().with_files(files)
    }
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
/// the file, and a luminaire whose samples and densities are numbers that fit each other.
pub(crate) fn examine(format: Format, bytes: &[u8]) -> Outcome {
    let mut answer = None;
    let allocated = allocation_counter::measure(|| answer = Some(format.read(bytes)));
    let answer = answer.expect("the reader was called");
    let peak_bytes = allocated.bytes_max as usize;
    let max = max_read_memory_bytes(bytes.len());
    assert!(peak_bytes <= max, "{peak_bytes} bytes for a file of {}, over {max}", bytes.len());
    match &answer {
        Ok(read) => {
            for warning in &read.warnings {
                check_message(warning.line(), warning.column(), &warning.to_string(), bytes);
            }
            check_luminaire(read, bytes);
        }
        Err(error) => check_message(error.line(), error.column(), &error.to_string(), bytes),
    }
    Outcome { is_read: answer.is_ok(), peak_bytes }
}

fn check_luminaire(read: &Parsed, bytes: &[u8]) {
    let photometry = &read.photometry;
    let flux_lm = photometry.flux_lm();
    assert!(flux_lm.is_finite() && flux_lm >= 0.0, "{flux_lm} lm");
    let mut random = SplitMix64::new(bytes.len() as u64);
    for u in [[0.0, 0.0], [1.0, 1.0], [random.uniform(), random.uniform()]] {
        let Some(sample) = photometry.sample(u) else {
            assert_eq!(flux_lm, 0.0);
            continue;
        };
        assert!((sample.direction.length() - 1.0).abs() < 1e-14, "{:?}", sample.direction);
        assert!(sample.pdf_sr > 0.0 && sample.pdf_sr.is_finite(), "{} at {u:?}", sample.pdf_sr);
        let weight_lm = photometry.intensity_cd(sample.direction) / sample.pdf_sr;
        assert!((weight_lm / flux_lm - 1.0).abs() < 1e-12, "{weight_lm} of {flux_lm} lm");
        let back = photometry.invert(sample.direction);
        assert!(back.iter().all(|u| (0.0..=1.0).contains(u)), "{back:?}");
    }
}
