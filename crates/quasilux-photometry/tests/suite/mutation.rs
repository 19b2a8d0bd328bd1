//! Damaged files: any bytes give a luminaire or an error with a place in the file.

use crate::corpus::published_files;
use crate::tables::Generator;
use quasilux_photometry::read_ies;

/// A file with each kind of record, of our own.
const OWN: &[u8] =
    b"IESNA:LM-63-1995\n[TEST] mutation\n[MORE] twice\nTILT=INCLUDE\n1\n2\n0 90\n1 0.9\n\
    2 1500.0 1.0 5 3 1 1 -0.2 0.4 0\n1.0 1.0 36\n0 22.5 45 67.5 90\n0 45 90\n\
    100 90 70 40 0\n100 80 60 30 0\n100 70 50 20 0\n";

const FRAGMENTS: [&[u8]; 16] = [
    b"-1",
    b"0",
    b"1e999",
    b"nan",
    b"inf",
    b"999999999",
    b"1e15",
    b"\n",
    b",",
    b";",
    b"TILT=",
    b"[",
    b"\xFF\xFE",
    b"-90",
    b"360",
    b"\0",
];

#[test]
fn damaged_files_never_panic() {
    let mut seeds = vec![OWN.to_vec()];
    let small = |bytes: &Vec<u8>| bytes.len() < 3000;
    if let Some(files) = published_files() {
        seeds.extend(files.iter().map(|file| std::fs::read(file).unwrap()).filter(small));
    }
    let mut generator = Generator(12);
    let (mut read, mut refused) = (0, 0);
    for _ in 0..40_000 {
        let mut bytes = seeds[generator.below(seeds.len())].clone();
        for _ in 0..=generator.below(4) {
            mutate(&mut bytes, &mut generator);
        }
        match read_ies(&bytes) {
            Ok(outcome) => {
                read += 1;
                let photometry = outcome.photometry;
                assert!(photometry.flux_lm().is_finite() && photometry.flux_lm() >= 0.0);
                let u = [generator.uniform(), generator.uniform()];
                if let Some(sample) = photometry.sample(u) {
                    assert!(sample.pdf_sr > 0.0 && sample.pdf_sr.is_finite());
                    assert!((sample.direction.length() - 1.0).abs() < 1e-9);
                } else {
                    assert_eq!(photometry.flux_lm(), 0.0);
                }
            }
            Err(error) => {
                refused += 1;
                assert!(error.line() > 0 && error.line() <= bytes.len() + 1, "{error}");
                assert!(error.column() > 0 && error.to_string().len() < 400, "{error}");
            }
        }
    }
    println!("of 40000 damaged files {read} load and {refused} are refused");
    assert!(read > 1000 && refused > 1000);
}

/// One change somewhere in the file.
pub(crate) fn mutate(bytes: &mut Vec<u8>, generator: &mut Generator) {
    if bytes.is_empty() {
        return;
    }
    let at = generator.below(bytes.len());
    match generator.below(6) {
        0 => bytes[at] = generator.bits() as u8,
        1 => bytes[at] ^= 1 << generator.below(8),
        2 => bytes.truncate(at),
        3 => {
            let end = (at + generator.below(20)).min(bytes.len());
            bytes.drain(at..end);
        }
        4 => {
            let end = (at + generator.below(50)).min(bytes.len());
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
        _ => {
            let fragment = FRAGMENTS[generator.below(FRAGMENTS.len())];
            bytes.splice(at..at, fragment.iter().copied());
        }
    }
}
