//! TM-33 files as other programs publish them.

use crate::corpus::name;
use quasilux_photometry::{WarningKind, read_tm33};
use std::path::PathBuf;

/// Each file's flux in lumens, by a quadrature that shares nothing with the reader (an XML library
/// of another language, trapezia over the planes, 2000 midpoints between vertical angles), or why
/// it is refused. None of the intensities are scaled to the lumens that stand beside them: all but
/// the refused one were made up to test programs.
const FILES: [(&str, Result<f64, &str>); 15] = [
    ("TM33-DLC-Required_Elements_Hort_01032022.xml", Err("24:1: found an emitter with PhotonData")),
    ("fluorescent.xml", Ok(401.500)),
    ("halogen_lamp.xml", Ok(1717.392)),
    ("heat_lamp.xml", Ok(73.089)),
    ("incandescent_bulb.xml", Ok(923.608)),
    ("sample-luminaire.xml", Ok(350.385)),
    ("tm32-24-office_downlight_bim.xml", Ok(652.077)),
    ("tm32-24-road_luminaire_bim.xml", Ok(2100.318)),
    ("tm33-23-far_red_supplemental.xml", Ok(515.812)),
    ("tm33-23-horticultural_led.xml", Ok(950.451)),
    ("tm33-23-minimal.xml", Ok(974.242)),
    ("tm33-23-seedling_propagation.xml", Ok(916.301)),
    ("tm33-23-uv_supplemental.xml", Ok(199.104)),
    ("tm33-23-with_custom_data.xml", Ok(659.730)),
    ("uv_blacklight.xml", Ok(60.623)),
];

#[test]
fn published_tm33_files_load_or_are_refused_for_a_known_reason() {
    let Some(files) = published() else {
        return;
    };
    let names: Vec<String> = files.iter().map(|file| name(file)).collect();
    assert_eq!(names, FILES.map(|(name, _)| name));
    for (file, (name, expected)) in files.iter().zip(FILES) {
        match (read_tm33(&std::fs::read(file).unwrap()), expected) {
            (Ok(read), Ok(expected_lm)) => {
                let flux_lm = read.photometry.flux_lm();
                assert!((flux_lm / expected_lm - 1.0).abs() < 1e-5, "{name}: {flux_lm} lm");
                let warned = read.warnings.iter().any(|w| w.kind() == WarningKind::FluxDiffers);
                assert!(warned, "{name}: {:?}", read.warnings);
            }
            (Err(error), Err(reason)) => {
                assert!(error.to_string().starts_with(reason), "{name}:{error}");
            }
            (Ok(_), Err(_)) => panic!("{name} loads, but is listed as refused"),
            (Err(error), Ok(_)) => panic!("{name}:{error}"),
        }
    }
}

/// The published TM-33 files in the order of their names; `None` where the test is left out.
fn published() -> Option<Vec<PathBuf>> {
    let folder = quasilux_corpus::find("ies/tm33")?;
    let entries = std::fs::read_dir(&folder).expect("a folder of published files");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    Some(files)
}
