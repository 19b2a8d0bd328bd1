//! Files of measured surfaces as laboratories and programs publish them.

use super::folder;
use quasilux_bsdf::WarningKind;
use quasilux_bsdf::WarningKind::{
    ByReciprocity, EnergyNotConserved, Foreword, MissingReflection, NotReciprocal,
};
use quasilux_bsdf::read_bsdf;

/// A file with the kind of its tables, how many there are, and its warnings; or why it is refused,
/// as seen in it by hand.
type ExpectedFile =
    (&'static str, Result<(&'static str, usize, &'static [WarningKind]), &'static str>);

const FILES: [ExpectedFile; 17] = [
    // Two rows of two values stand for a matrix of 145 by 145: cut down for a test of separators.
    (
        "bxp-2011-SA1-Small-CommaSeparated-SingleColumnScattering.XML",
        Err("112:15: found 4 values; expected 21025"),
    ),
    ("bxp-2011-SA1-Small-CommaSeparated.XML", Err("109:27: found 4 values; expected 21025")),
    ("bxp-2011-SA1-Small-TabSeparated.XML", Err("109:27: found 4 values; expected 21025")),
    (
        "bxp-THMZ-Geometry-DifferentCapsAttributes.XML",
        Err("124:27: found 4 values; expected 21025"),
    ),
    ("klems-2011-SA1.xml", Ok(("Klems", 4, &[NotReciprocal]))),
    ("klems-frads-aniso_high.xml", Ok(("Klems", 4, &[NotReciprocal]))),
    // Of the visible spectrum transmission alone.
    ("klems-frads-ec60.xml", Ok(("Klems", 2, &[MissingReflection]))),
    ("klems-radbsdf-test_blinds_kf.xml", Ok(("Klems", 4, &[Foreword, NotReciprocal]))),
    ("klems-room-DiffuseGlass.xml", Ok(("Klems", 4, &[EnergyNotConserved]))),
    ("klems-room-blinds.xml", Ok(("Klems", 4, &[Foreword, NotReciprocal]))),
    // Spectral transmittance of clear glass: no directions.
    ("optics-CLEAR_3.DAT", Err("1:1: found spectra of a glazing")),
    ("radiance-BSDFdirections.txt", Err("1:1: found none of their marks")),
    // Made up for a test of Radiance: values up to 32.25 per steradian.
    ("radiance-testBSDF.xml", Ok(("tensor tree", 1, &[EnergyNotConserved, NotReciprocal]))),
    ("rgl-tensor-spectralon_lowres.pbsdf", Err("1:1: found a container of tensors")),
    (
        "tt-pyradiance-t3.xml",
        Ok(("tensor tree", 3, &[ByReciprocity, MissingReflection, NotReciprocal])),
    ),
    ("tt-radiance-sawtooth.xml", Ok(("Klems", 1, &[NotReciprocal]))),
    ("tt-room-blindsT3.xml", Ok(("tensor tree", 4, &[Foreword, NotReciprocal]))),
];

#[test]
fn published_surfaces_load_or_are_refused_for_a_known_reason() {
    let Some(folder) = folder() else {
        return;
    };
    let entries = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap());
    let files = entries.filter(|entry| entry.path().is_file());
    let mut names: Vec<String> =
        files.map(|entry| entry.file_name().into_string().unwrap()).collect();
    names.retain(|name| name != "SOURCES.md");
    names.sort();
    assert_eq!(names, FILES.map(|(name, _)| name));
    for (name, expected) in FILES {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        match (read_bsdf(&bytes), expected) {
            (Ok(read), Ok((kind, tables, warnings))) => {
                let tables_found = read.bsdf.distributions();
                let kinds: Vec<&str> = tables_found.map(|it| it.distribution.kind()).collect();
                assert_eq!(kinds, vec![kind; tables], "{name}");
                let found: Vec<WarningKind> =
                    read.warnings.iter().map(|warning| warning.kind()).collect();
                assert_eq!(found, warnings, "{name}");
            }
            (Err(error), Err(reason)) => {
                assert!(error.to_string().starts_with(reason), "{name}:{error}");
            }
            (Ok(_), Err(_)) => panic!("{name} loads, but is listed as refused"),
            (Err(error), Ok(_)) => panic!("{name}:{error}"),
        }
    }
}
