//! EULUMDAT files as manufacturers and other programs publish them.

use crate::corpus::{name, published_files_of};
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
