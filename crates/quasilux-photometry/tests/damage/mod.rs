//! Damaged files, and what must hold of a reader's answer to any bytes.
//!
//! A damaged file is a pure function of its number and of the undamaged files, so that a finding is
//! told by a number. The bounded run of the test suite, the full run (`examples/mutate.rs`) and the
//! fuzz targets (`fuzz/`) share this module, its allocator included: memory is that of the whole
//! process, so one thread only may read at a time.

mod mutator;
mod random;
mod samples;
mod surface;

pub(crate) use mutator::mutate;
use peak_alloc::PeakAlloc;
use quasilux_photometry::bsdf::{ReadBsdf, read_bsdf_named};
use quasilux_photometry::{
    Read, ReadError, Warning, most_bsdf_memory_bytes, most_read_memory_bytes, read_ies, read_ldt,
    read_tm33,
};
pub(crate) use random::Random;
use std::path::Path;

#[global_allocator]
static ALLOCATOR: PeakAlloc = PeakAlloc;

/// Published files above this length are left out: most of the time would go into a few of them.
const LONGEST_SEED_BYTES: usize = 4000;

/// A format and its reader.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Format {
    Ies,
    Ldt,
    Tm33,
    /// Measured surfaces, of any format.
    Bsdf,
}

/// What a reader makes of a file.
pub(crate) enum Answer {
    Luminaire(Read),
    Surface(ReadBsdf),
}

/// What became of one file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub(crate) is_read: bool,
    /// The most memory that was allocated at one time while reading.
    pub(crate) peak_bytes: usize,
}

/// Undamaged files of a format, to be damaged.
pub(crate) struct Seeds(Vec<Vec<u8>>);

impl Format {
    pub(crate) const ALL: [Self; 4] = [Self::Ies, Self::Ldt, Self::Tm33, Self::Bsdf];

    pub(crate) fn read(self, bytes: &[u8]) -> Result<Answer, ReadError> {
        match self {
            Self::Ies => read_ies(bytes).map(Answer::Luminaire),
            Self::Ldt => read_ldt(bytes).map(Answer::Luminaire),
            Self::Tm33 => read_tm33(bytes).map(Answer::Luminaire),
            Self::Bsdf => read_bsdf_named(surface::name(bytes), bytes).map(Answer::Surface),
        }
    }

    /// The most memory that reading may take.
    fn most_bytes(self, file_bytes: usize) -> usize {
        match self {
            Self::Ies | Self::Ldt | Self::Tm33 => most_read_memory_bytes(file_bytes),
            Self::Bsdf => most_bsdf_memory_bytes(file_bytes),
        }
    }

    /// The files' extension, and their folder.
    fn published(self) -> (&'static str, &'static str) {
        match self {
            Self::Ies => ("ies", "ies"),
            Self::Ldt => ("ldt", "ldt"),
            Self::Tm33 => ("xml", "ies/tm33"),
            Self::Bsdf => ("xml", "bsdf"),
        }
    }
}

impl Seeds {
    /// Files made up for the purpose.
    pub(crate) fn built(format: Format) -> Self {
        Self(match format {
            Format::Ies => samples::ies(),
            Format::Ldt => samples::ldt(),
            Format::Tm33 => samples::tm33(),
            Format::Bsdf => surface::samples(),
        })
    }

    /// The same, with the published files where they are present.
    pub(crate) fn with_published(format: Format) -> Self {
        let Self(mut files) = Self::built(format);
        let (extension, folder) = format.published();
        let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
        let folder = data.join(folder);
        let Ok(entries) = std::fs::read_dir(&folder) else {
            println!("no published .{extension} files at {}", folder.display());
            return Self(files);
        };
        let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        let fits = |e: &std::ffi::OsStr| e.eq_ignore_ascii_case(extension);
        for path in paths.iter().filter(|path| path.extension().is_some_and(fits)) {
            files.push(std::fs::read(path).unwrap());
        }
        files.retain(|file| file.len() <= LONGEST_SEED_BYTES);
        Self(files)
    }

    pub(crate) fn files(&self) -> &[Vec<u8>] {
        &self.0
    }

    /// Damaged file number `index`: one of the seeds after one to five changes.
    pub(crate) fn damaged(&self, index: u64) -> Vec<u8> {
        let mut random = Random::new(index);
        let mut bytes = self.0[random.below(self.0.len())].clone();
        for _ in 0..=random.below(5) {
            mutate(&mut bytes, &self.0, &mut random);
        }
        bytes
    }
}

/// Examines damaged file number `index`, and names it where that fails.
pub(crate) fn examine_damaged(format: Format, seeds: &Seeds, index: u64) -> Outcome {
    let bytes = seeds.damaged(index);
    std::panic::catch_unwind(|| examine(format, &bytes)).unwrap_or_else(|_| {
        panic!("{format:?} file {index}:\n{}", String::from_utf8_lossy(&bytes).escape_debug())
    })
}

/// Reads any bytes and checks the answer: no more memory than stated, messages with a place in the
/// file, and a luminaire or a surface whose samples and densities are numbers that fit each other.
pub(crate) fn examine(format: Format, bytes: &[u8]) -> Outcome {
    let before = ALLOCATOR.current_usage();
    ALLOCATOR.reset_peak_usage();
    let answer = format.read(bytes);
    let peak_bytes = ALLOCATOR.peak_usage() - before;
    let most = format.most_bytes(bytes.len());
    assert!(peak_bytes <= most, "{peak_bytes} bytes for a file of {}, over {most}", bytes.len());
    match &answer {
        Ok(Answer::Luminaire(read)) => {
            check_warnings(&read.warnings, bytes);
            check_luminaire(read, bytes);
        }
        Ok(Answer::Surface(read)) => {
            check_warnings(&read.warnings, bytes);
            surface::check(&read.bsdf, &mut Random::new(bytes.len() as u64));
        }
        Err(error) => check_message(error.line(), error.column(), &error.to_string(), bytes),
    }
    Outcome { is_read: answer.is_ok(), peak_bytes }
}

fn check_message(line: usize, column: usize, message: &str, bytes: &[u8]) {
    assert!(line > 0 && line <= bytes.len() + 1, "{message}");
    assert!(column > 0 && column <= bytes.len() + 1, "{message}");
    assert!(message.len() < 500, "{message}");
}

fn check_warnings(warnings: &[Warning], bytes: &[u8]) {
    for warning in warnings {
        check_message(warning.line(), warning.column(), &warning.to_string(), bytes);
    }
}

fn check_luminaire(read: &Read, bytes: &[u8]) {
    let photometry = &read.photometry;
    let flux_lm = photometry.flux_lm();
    assert!(flux_lm.is_finite() && flux_lm >= 0.0, "{flux_lm} lm");
    let mut random = Random::new(bytes.len() as u64);
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
