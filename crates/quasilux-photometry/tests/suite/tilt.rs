//! Tilt factors: in the file and beside it, right and wrong.

use crate::tables::Generator;
use glam::DVec3;
use quasilux_photometry::{Tilt, TiltSupport, WarningKind, read_ies, read_tilt};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

const TILT: &str = "1\n3\n0 45 90\n1 0.9 0.6\n";

fn ies(tilt: &str) -> String {
    format!("IESNA:LM-63-2002\n[TEST] t\nTILT={tilt}1 -1 1 2 1 1 2 0 0 0\n1 1 9\n0 180\n0\n9 9\n")
}

/// Straight down in the frame of a luminaire that aims level.
const LEVEL: DVec3 = DVec3::Y;

#[test]
fn factors_in_the_file_and_beside_it_are_the_same() {
    let included = read_ies(ies(&format!("INCLUDE\n{TILT}")).as_bytes()).unwrap();
    let beside = read_ies(ies("mh.tlt\n").as_bytes()).unwrap();
    let file = read_tilt(TILT.as_bytes()).unwrap();
    assert!(included.warnings.is_empty() && file.warnings.is_empty());
    let expected = Tilt::Include {
        lamp_geometry: 1,
        angles_rad: vec![0.0, FRAC_PI_4, FRAC_PI_2],
        factors: vec![1.0, 0.9, 0.6],
    };
    assert_eq!(included.photometry.facts().tilt, expected);
    assert_eq!(file.tilt, expected);

    assert_eq!(beside.warnings[0].kind(), WarningKind::TiltFile);
    let unread = beside.photometry.tilt_factor(LEVEL);
    assert_eq!((unread.factor, unread.support), (1.0, TiltSupport::NotRead));
    let read = beside.photometry.with_tilt(file.tilt);
    for photometry in [&included.photometry, &read] {
        let tilt = photometry.tilt_factor(LEVEL);
        assert_eq!((tilt.factor, tilt.angle_rad), (0.6, FRAC_PI_2));
        // The table is that of the luminaire as measured.
        assert!((photometry.flux_lm() / (36.0 * PI) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn oddities_are_reported_and_nonsense_is_refused() {
    let odd = read_tilt(b"2 2\n10 60\n1 0.5\nand more").unwrap();
    let deviations: Vec<WarningKind> = odd.warnings.iter().map(|w| w.kind()).collect();
    assert_eq!(deviations, [WarningKind::TiltFactors, WarningKind::TrailingText]);
    let cases = [
        ("", 1, 1, "geometry"),
        ("4\n1\n0\n1", 1, 1, "1, 2 or 3"),
        ("1\n0\n", 2, 1, "an integer"),
        ("1\n999999999\n0 90\n1 1", 2, 10, "fit into the rest"),
        ("1\n2\n0 90\n1", 4, 2, "tilt factor"),
        ("1\n2\n90 0\n1 1", 3, 4, "ascending"),
        ("1\n2\n0 200\n1 1", 3, 3, "between 0 and 180"),
        ("1\n2\n-10 90\n1 1", 3, 1, "between 0 and 180"),
        ("1\n2\n0 90\n1 -0.5", 4, 3, "between 0 and 100"),
        ("1\n2\n0 90\n1 1e9", 4, 3, "between 0 and 100"),
    ];
    for (text, line, column, message) in cases {
        let error = read_tilt(text.as_bytes()).unwrap_err();
        assert_eq!((error.line(), error.column()), (line, column), "{text:?}: {error}");
        assert!(error.to_string().contains(message), "{text:?}: {error}");
    }
}

fn below(n: usize, generator: &mut Generator) -> usize {
    (generator.uniform() * n as f64) as usize
}

/// Loses, changes or gains a byte.
fn damage(bytes: &mut Vec<u8>, generator: &mut Generator) {
    const ALPHABET: &[u8] = b"0123456789 .-e,;\n\r\xFF\0x";
    let at = below(bytes.len() + 1, generator);
    let byte = ALPHABET[below(ALPHABET.len(), generator)];
    match below(3, generator) {
        0 if at < bytes.len() => drop(bytes.remove(at)),
        1 if at < bytes.len() => bytes[at] = byte,
        _ => bytes.insert(at, byte),
    }
}

#[test]
fn damaged_tilt_files_never_panic() {
    let mut generator = Generator(17);
    let (mut read, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let mut bytes = TILT.as_bytes().to_vec();
        for _ in 0..=below(4, &mut generator) {
            damage(&mut bytes, &mut generator);
        }
        match read_tilt(&bytes) {
            Ok(outcome) => {
                read += 1;
                let angle_rad = PI * generator.uniform();
                let factor = outcome.tilt.factor_at(angle_rad).factor;
                assert!((0.0..=100.0).contains(&factor), "{:?}: {factor}", outcome.tilt);
            }
            Err(error) => {
                refused += 1;
                assert!(error.line() > 0 && error.column() > 0, "{error}");
            }
        }
    }
    println!("of 20000 damaged tilt files {read} load and {refused} are refused");
    assert!(read > 1000 && refused > 1000);
}
