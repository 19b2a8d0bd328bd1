//! EULUMDAT files as manufacturers and other programs publish them, whole and damaged.

use crate::corpus::{name, published_files_of};
use crate::mutation::mutate;
use crate::tables::Generator;
use quasilux_photometry::{Deviation, read_ldt};

/// Files whose integrated flux is not lamps' flux times light output ratio, by the start of their
/// names, and why. Confirmed by summing over the zones of each file apart from this reader.
const FLUX_DIFFERS: [(&str, &str); 5] = [
    ("pv-", "made up: the intensities were not scaled to the lamps"),
    ("eul-wiki-batwing", "made up: 2916 lm per 1000 lm"),
    ("eul-wiki-spotlight", "made up: 770 lm per 1000 lm, with a ratio of 90 %"),
    ("eul-projector", "79.4 % by its table, 77.71 % by its header"),
    ("weilim-ldt_min_example", "five angles at 45 degrees"),
];

#[test]
fn published_eulumdat_files_load() {
    let Some(files) = published_files_of("ldt") else {
        return;
    };
    for file in &files {
        let name = name(file);
        // None is refused: each follows the format, or deviates by a documented rule.
        let read = read_ldt(&std::fs::read(file).unwrap())
            .unwrap_or_else(|error| panic!("{name}:{error}"));
        let differs = read.warnings.iter().any(|w| w.deviation() == Deviation::FluxDiffers);
        let expected = FLUX_DIFFERS.iter().any(|(start, _)| name.starts_with(start));
        assert_eq!(differs, expected, "{name}: {:?}", read.warnings);
    }
    println!("{} published EULUMDAT files load, none is refused", files.len());
    assert!(files.len() > 70);
}

/// A file with two sets of lamps and unequal angles, of our own.
fn own() -> Vec<u8> {
    let ratios = "0.5\n".repeat(10);
    format!(
        "Maker\r\n2\n4\n4\n90\n3\n0\nr\nn\nn\nf\nd\n1200\n300\n80\n1100\n200\n0\n0\n0\n0\n100\n\
        80,5\n1\n0\n2\n1\nT\n1000\n-\n-\n20\n-1\nT\n2000\n-\n-\n40\n{ratios}0\n90\n180\n270\n\
        0\n30\n90\n100\n80\n20.5\n90\n70\n0\n"
    )
    .into_bytes()
}

#[test]
fn damaged_eulumdat_files_never_panic() {
    let mut seeds = vec![own()];
    let small = |bytes: &Vec<u8>| bytes.len() < 3000;
    if let Some(files) = published_files_of("ldt") {
        seeds.extend(files.iter().map(|file| std::fs::read(file).unwrap()).filter(small));
    }
    let mut generator = Generator(13);
    let (mut read, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let mut bytes = seeds[generator.below(seeds.len())].clone();
        for _ in 0..=generator.below(4) {
            mutate(&mut bytes, &mut generator);
        }
        match read_ldt(&bytes) {
            Ok(outcome) => {
                read += 1;
                let photometry = outcome.photometry;
                assert!(photometry.flux_lm().is_finite() && photometry.flux_lm() >= 0.0);
                let u = [generator.uniform(), generator.uniform()];
                match photometry.sample(u) {
                    Some(sample) => assert!(sample.pdf_sr > 0.0 && sample.pdf_sr.is_finite()),
                    None => assert_eq!(photometry.flux_lm(), 0.0),
                }
            }
            Err(error) => {
                refused += 1;
                assert!(error.line() > 0 && error.line() <= bytes.len() + 1, "{error}");
                assert!(error.column() > 0 && error.to_string().len() < 400, "{error}");
            }
        }
    }
    println!("of 20000 damaged files {read} load and {refused} are refused");
    assert!(read > 1000 && refused > 1000);
}
