//! Encoded files read back to the same table and facts.

use crate::corpus::{name, published_files_of};
use glam::DVec3;
use quasilux_photometry::{
    Angles, Encoded, EncodingNote, Grid, IesStandard, Keyword, LuminaireFacts, LuminousOpening,
    Parsed, PhotometricType, Photometry, SphericalTable, Standard, Symmetry, Tilt, WarningKind,
    read_ies, read_ldt, write_ies, write_ldt,
};
use std::f64::consts::PI;

fn ies(written: &Encoded) -> Parsed {
    read_ies(written.text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

fn ldt(written: &Encoded) -> Parsed {
    read_ldt(written.text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

fn published() -> Vec<(String, Parsed)> {
    let mut all = Vec::new();
    for (extension, read) in [("ies", read_ies as fn(&[u8]) -> _), ("ldt", read_ldt)] {
        for file in published_files_of(extension).unwrap_or_default() {
            if let Ok(read) = read(&std::fs::read(&file).unwrap()) {
                all.push((name(&file), read));
            }
        }
    }
    all
}

fn degrees(angle: f64, zero: f64) -> Angles {
    Angles { theta_rad: angle / 180.0 * PI, phi_rad: zero / 180.0 * PI }
}

/// Both tables as functions, at their nodes and between them, apart from the reader's own jump
/// at a closing plane. Returns the greatest difference over the greatest value.
fn difference(a: &SphericalTable, b: &SphericalTable) -> f64 {
    let max_value = a.grid().values.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let thetas = a.theta_rad();
    let mut worst = 0.0_f64;
    for pair in thetas.windows(2) {
        for theta_rad in [pair[0], 0.7 * pair[0] + 0.3 * pair[1]] {
            for step in 0..72 {
                let phi_rad = (f64::from(step) * 5.0 + 1.3) / 180.0 * PI;
                let angles = Angles { theta_rad, phi_rad };
                worst = worst.max((a.value_at(angles) - b.value_at(angles)).abs());
            }
        }
    }
    worst / max_value
}

fn same_values(a: &Grid, b: &Grid, relative: f64) {
    assert_eq!(a.values.len(), b.values.len());
    for (a, b) in a.values.iter().zip(&b.values) {
        assert!((a - b).abs() <= relative * a.abs(), "{a:e} became {b:e}");
    }
}

/// Warnings about what the file says, not about how it is written.
fn is_about_content(deviation: WarningKind) -> bool {
    matches!(
        deviation,
        WarningKind::FluxDiffers
            | WarningKind::NoLight
            | WarningKind::VerticalRange
            | WarningKind::TiltFactors
            | WarningKind::TiltFile
            | WarningKind::SeveralLampSets
            | WarningKind::DownwardFluxDiffers
            | WarningKind::MeasurementTilt
            | WarningKind::ClosingPlaneDiffers
            | WarningKind::OpeningOfOtherEdition
            | WarningKind::UnknownOpening
    )
}

fn check_warnings(name: &str, read: &Parsed) {
    for warning in &read.warnings {
        assert!(is_about_content(warning.kind()), "{name}: {warning}");
    }
}

fn check_lines(written: &Encoded, limit: usize) {
    assert!(written.text.ends_with("\r\n"));
    assert!(written.text.lines().all(|line| line.chars().count() <= limit));
}

/// Facts but for the edition, the field that means another thing in each, the signs of dimensions,
/// and lines of keywords.
fn without_edition(facts: &LuminaireFacts) -> LuminaireFacts {
    let added = |keyword: &Keyword| keyword.value == "(not given)";
    let size_m = facts.shape().size_m();
    let mut facts = facts.clone();
    facts.standard = Standard::Eulumdat;
    facts.opening = LuminousOpening { width_m: size_m.y, length_m: size_m.x, height_m: size_m.z };
    facts.ballast_lamp_field = 1.0;
    facts.keywords.retain(|keyword| !added(keyword));
    facts.keywords.iter_mut().for_each(|keyword| {
        keyword.line = 0;
        if keyword.name.is_empty() {
            "OTHER".clone_into(&mut keyword.name);
        }
    });
    facts
}

#[test]
fn published_files_survive_lm63() {
    let mut exact = 0;
    let files = published();
    for (name, original) in &files {
        for edition in [IesStandard::Lm63Of1991, IesStandard::Lm63Of2019] {
            let photometry = &original.photometry;
            let written = write_ies(photometry, edition);
            check_lines(&written, if edition == IesStandard::Lm63Of2019 { 254 } else { 132 });
            let read = ies(&written);
            check_warnings(name, &read);
            assert!(difference(photometry.table(), read.photometry.table()) < 3e-13, "{name}");
            let (before, after) = (photometry.table().grid(), read.photometry.table().grid());
            if before.symmetry == after.symmetry && before.phi_rad == after.phi_rad {
                assert_eq!(before.theta_rad, after.theta_rad, "{name}");
                match photometry.facts().standard {
                    Standard::Lm63(_) => assert!(before.values == after.values, "{name}"),
                    _ => same_values(&before, &after, 2.3e-16),
                }
                exact += usize::from(before == after);
            }
            let again = write_ies(&read.photometry, edition);
            assert!(again.text == written.text, "{name}: written twice, two files");

            let (before, after) = (photometry.facts(), read.photometry.facts());
            if before.standard != Standard::Eulumdat {
                let continued = written.notes.contains(&EncodingNote::TextContinued);
                let (mut a, mut b) = (without_edition(before), without_edition(after));
                if continued {
                    (a.keywords, b.keywords) = Default::default();
                }
                assert_eq!(a, b, "{name}");
            }
        }
    }
    println!("{exact} of {} tables read back bit for bit from LM-63", 2 * files.len());
}

#[test]
fn published_files_survive_eulumdat() {
    let mut exact = 0;
    let files = published();
    for (name, original) in &files {
        let photometry = &original.photometry;
        let written = write_ldt(photometry);
        check_lines(&written, 78);
        let read = ldt(&written);
        check_warnings(name, &read);
        let kind = photometry.facts().photometric_type;
        if kind != PhotometricType::C {
            assert_resampled(&written, photometry, &read);
            continue;
        }
        let dropped =
            |note: &EncodingNote| matches!(note, EncodingNote::ClosingPlaneDropped { .. });
        if !written.notes.iter().any(dropped) {
            assert!(difference(photometry.table(), read.photometry.table()) < 3e-13, "{name}");
        }
        let (before, after) = (photometry.table().grid(), read.photometry.table().grid());
        if before.symmetry == after.symmetry && before.phi_rad == after.phi_rad {
            assert_eq!(before.theta_rad, after.theta_rad, "{name}");
            match photometry.facts().standard {
                Standard::Eulumdat => assert!(before.values == after.values, "{name}"),
                _ => same_values(&before, &after, 2.3e-16),
            }
            exact += usize::from(before == after);
        }
        let again = write_ldt(&read.photometry);
        assert!(again.text == written.text, "{name}: written twice, two files");

        let cut = written.notes.iter().any(|note| matches!(note, EncodingNote::TextCut { .. }));
        if photometry.facts().standard == Standard::Eulumdat && !cut {
            let (mut a, b) = (photometry.facts().clone(), read.photometry.facts());
            if a.light_output_ratio.is_none() {
                a.light_output_ratio = b.light_output_ratio;
            }
            assert_eq!(&a, b, "{name}");
        }
    }
    println!("{exact} of {} tables read back bit for bit from EULUMDAT", files.len());
}

fn facts() -> LuminaireFacts {
    LuminaireFacts {
        standard: Standard::Lm63(IesStandard::Lm63Of2002),
        photometric_type: PhotometricType::C,
        keywords: Vec::new(),
        tilt: Tilt::None,
        lamp_count: 2.0,
        lumens_per_lamp: None,
        ballast_factor: 1.0,
        ballast_lamp_field: 1.0,
        input_watts: 36.5,
        candela_factor: 1.0,
        opening: LuminousOpening { width_m: -0.3, length_m: -0.3, height_m: 0.0 },
        light_output_ratio: None,
        measurement_tilt_rad: 0.0,
        eulumdat: None,
    }
}

/// A table whose values differ at all nodes, none of them a round number.
fn built(planes_deg: &[f64], symmetry: Symmetry) -> Photometry {
    let radians = |degrees: &f64| degrees / 180.0 * PI;
    let theta_rad: Vec<f64> =
        [0.0, 7.5, 20.1, 45.0, 90.0, 130.0, 180.0].iter().map(radians).collect();
    let phi_rad: Vec<f64> = planes_deg.iter().map(radians).collect();
    let count = theta_rad.len() * phi_rad.len();
    let mut values: Vec<f64> = (0..count).map(|i| 100.0 / 3.0 + libm::sqrt(i as f64)).collect();
    if symmetry == Symmetry::None {
        for row in values.chunks_exact_mut(phi_rad.len()) {
            row[planes_deg.len() - 1] = row[0];
        }
    }
    let grid = Grid { theta_rad, phi_rad, symmetry, values };
    Photometry::new(SphericalTable::new(grid).unwrap(), facts())
}

#[test]
fn each_symmetry_survives_in_both_formats() {
    use Symmetry::{Bilateral, None, Open, Quadrant, Rotational};
    // Planes, their symmetry, the last line of planes in LM-63, and Isym.
    let cases: [(&[f64], Symmetry, &str, &str); 14] = [
        (&[0.0], Rotational, "0", "1"),
        (&[30.0], Rotational, "0", "1"),
        (&[0.0, 20.0, 90.0], Quadrant, "0 20 90", "4"),
        (&[90.0, 110.0, 180.0], Quadrant, "0 70 90", "4"),
        (&[270.0, 290.0, 360.0], Quadrant, "0 70 90", "4"),
        (&[0.0, 45.0, 180.0], Bilateral, "0 45 180", "2"),
        (&[180.0, 225.0, 360.0], Bilateral, "0 135 180", "2"),
        (&[90.0, 100.0, 180.0, 270.0], Bilateral, "90 100 180 270", "3"),
        (&[-90.0, -10.0, 0.0, 90.0], Bilateral, "90 180 190 270", "3"),
        (&[90.0, 100.0, 270.0], Bilateral, "90 100 270", "3"),
        (&[0.0, 77.7, 200.0, 360.0], None, "0 77.7 200 360", "0"),
        (&[-180.0, -30.0, 0.0, 100.0, 180.0], None, "0 100 180 330 360", "0"),
        (&[0.0, 90.0, 180.0, 270.0], Open, "0 90 180 270 360", "0"),
        (&[10.0, 100.0, 200.0, 300.0], Open, "0 10 100 200 300 360", "0"),
    ];
    for (planes_deg, symmetry, lm63, isym) in cases {
        let photometry = built(planes_deg, symmetry);
        let written = write_ies(&photometry, IesStandard::Lm63Of2002);
        let lines: Vec<&str> = written.text.lines().collect();
        let angles = lines.iter().position(|line| *line == "0 7.5 20.1 45 90 130 180").unwrap();
        assert_eq!(lines[angles + 1], lm63, "{planes_deg:?}");
        let read = ies(&written);
        assert!(read.warnings.is_empty(), "{planes_deg:?}: {:?}", read.warnings);
        let error = difference(photometry.table(), read.photometry.table());
        assert!(error < 1e-15, "{planes_deg:?}: {error:e}");

        let written = write_ldt(&photometry);
        assert_eq!(written.text.lines().nth(2), Some(isym), "{planes_deg:?}");
        let read = ldt(&written);
        assert!(read.warnings.is_empty(), "{planes_deg:?}: {:?}", read.warnings);
        let error = difference(photometry.table(), read.photometry.table());
        assert!(error < 1e-15, "{planes_deg:?}: {error:e}");
        let added = planes_deg == [90.0, 100.0, 270.0] || planes_deg[0] == 10.0;
        assert_eq!(written.notes.contains(&EncodingNote::FirstPlaneAdded), added, "{planes_deg:?}");
    }
}

/// Symmetry about planes that are no axes, and planes that differ at 0 and 360.
#[test]
fn what_no_format_holds_is_noted() {
    let tilted = built(&[30.0, 60.0, 120.0], Symmetry::Quadrant);
    for (notes, read) in [
        (write_ies(&tilted, IesStandard::Lm63Of2019), ies as fn(&Encoded) -> Parsed),
        (write_ldt(&tilted), ldt),
    ]
    .map(|(written, read)| (written.notes.clone(), read(&written)))
    {
        assert!(notes.contains(&EncodingNote::Unfolded), "{notes:?}");
        assert!(difference(tilted.table(), read.photometry.table()) < 1e-14);
    }

    let sector = built(&[-30.0, 0.0, 45.0], Symmetry::Sector);
    let written = write_ies(&sector, IesStandard::Lm63Of2019);
    assert_resampled(&written, &sector, &ies(&written));
    let written = write_ldt(&sector);
    assert_resampled(&written, &sector, &ldt(&written));

    let mut grid = built(&[0.0, 90.0, 360.0], Symmetry::None).table().grid();
    grid.values[2] += 1.5;
    let jump = Photometry::new(SphericalTable::new(grid).unwrap(), facts());
    let read = ies(&write_ies(&jump, IesStandard::Lm63Of2002));
    assert_eq!(read.photometry.table().grid(), jump.table().grid());
    let notes = write_ldt(&jump).notes;
    assert!(notes.contains(&EncodingNote::ClosingPlaneDropped { difference_cd: 1.5 }), "{notes:?}");
}

#[test]
fn other_poles_are_resampled_on_the_stated_grid() {
    let photometry = built(&[0.0, 90.0, 180.0], Symmetry::Bilateral);
    let kind = PhotometricType::B;
    let facts = LuminaireFacts { photometric_type: kind, ..facts() };
    let other = Photometry::new(photometry.table().clone(), facts);
    let written = write_ldt(&other);
    assert_resampled(&written, &other, &ldt(&written));
    let table = ldt(&written).photometry.table().clone();
    assert_eq!((table.theta_rad().len(), table.phi_rad().count()), (181, 73));
    for (gamma, c) in [(0.0, 0.0), (45.0, 90.0), (90.0, 135.0), (130.0, 355.0), (180.0, 10.0)] {
        let angles = degrees(gamma, c);
        let up = angles.direction();
        let (a, b) = (table.value_at(angles), other.intensity_cd(DVec3::new(up.x, up.y, -up.z)));
        assert!((a / b - 1.0).abs() < 1e-13, "({gamma}, {c}): {a} for {b}");
    }
}

/// A beam between the planes of the finest grid: the note tells what became of its flux.
#[test]
fn a_beam_lost_in_resampling_is_told() {
    let (theta_rad, phi_rad) = ([130.4, 130.5, 130.6], [20.4, 20.5, 20.6]);
    let radians = |degrees: f64| degrees.to_radians();
    let grid = Grid {
        theta_rad: theta_rad.map(radians).to_vec(),
        phi_rad: phi_rad.map(radians).to_vec(),
        symmetry: Symmetry::Sector,
        values: vec![0.0, 0.0, 0.0, 0.0, 1e5, 0.0, 0.0, 0.0, 0.0],
    };
    let facts = LuminaireFacts { photometric_type: PhotometricType::B, ..facts() };
    let beam = Photometry::new(SphericalTable::new(grid).unwrap(), facts);
    let written = write_ldt(&beam);
    let [lost, kept] = written.notes.iter().find_map(resampled_fluxes_lm).expect("a note");
    assert!((lost / beam.flux_lm() - 1.0).abs() < 1e-12);
    assert!((kept / lost - 1.0).abs() > 0.2, "{lost} {kept}");
    assert_resampled(&written, &beam, &ldt(&written));
}

fn resampled_fluxes_lm(note: &EncodingNote) -> Option<[f64; 2]> {
    match *note {
        EncodingNote::Resampled { flux_lm, written_flux_lm, .. } => {
            Some([flux_lm, written_flux_lm])
        }
        _ => None,
    }
}

/// The note names both fluxes, that of the luminaire and that of the file.
fn assert_resampled(written: &Encoded, photometry: &Photometry, read: &Parsed) {
    let fluxes_lm = written.notes.iter().find_map(resampled_fluxes_lm).expect("a note");
    for (noted_lm, flux_lm) in fluxes_lm.into_iter().zip([photometry, &read.photometry]) {
        let flux_lm = flux_lm.flux_lm();
        assert!((noted_lm - flux_lm).abs() <= 1e-12 * flux_lm, "{noted_lm} {flux_lm}");
    }
}

/// Types A and B in LM-63: latitudes from the poles, all horizontal angles, values by planes.
#[test]
fn other_poles_keep_their_angles_in_lm63() {
    let radians = |degrees: f64| degrees / 180.0 * PI;
    let table = SphericalTable::new(Grid {
        theta_rad: [0.0, 90.0, 180.0].map(radians).to_vec(),
        phi_rad: [-180.0, -22.5, 45.0, 180.0].map(radians).to_vec(),
        symmetry: Symmetry::None,
        values: vec![0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 1.0, 5.0, 5.0, 5.0, 5.0],
    })
    .unwrap();
    for (kind, counts, angles_and_values) in [
        (
            PhotometricType::A,
            "2 -1 1 3 4 3 2 0.3 0.2 0",
            "-90 0 90,-180 -22.5 45 180,0 1 5,0 2 5,0 3 5,0 1 5",
        ),
        (
            PhotometricType::B,
            "2 -1 1 4 3 2 2 0.3 0.2 0",
            "-180 -22.5 45 180,-90 0 90,0 0 0 0,1 2 3 1,5 5 5 5",
        ),
    ] {
        let opening = LuminousOpening { width_m: 0.3, length_m: 0.2, height_m: 0.0 };
        let facts = LuminaireFacts { photometric_type: kind, opening, ..facts() };
        let written = write_ies(&Photometry::new(table.clone(), facts), IesStandard::Lm63Of1995);
        assert_eq!(ies(&written).photometry.table().grid(), table.grid());
        let lines: Vec<&str> = written.text.lines().skip(2).collect();
        let expected: Vec<&str> = angles_and_values.split(',').collect();
        assert_eq!((lines[0], lines[1]), (counts, "1 1 36.5"));
        assert_eq!(lines[2..], expected);
        assert!(written.notes.is_empty(), "{:?}", written.notes);
    }
}

#[test]
fn header_facts_are_written_by_edition() {
    let text = "a label\n[TEST] one\n[OTHER] first\n[MORE] second\nTILT=INCLUDE\n2\n3\n0 45 90\n\
        1 0.9 0.8\n2 1200 0.7 2 1 1 1 -1 0 2\n0.95 0.9 36.5\n0 180\n0\n123.4 77.7\n";
    let original = read_ies(text.as_bytes()).unwrap().photometry;
    for edition in IesStandard::ALL {
        let written = write_ies(&original, edition);
        let read = ies(&written);
        let (a, b) = (original.facts(), read.photometry.facts());
        assert_eq!(without_edition(a), without_edition(b), "{edition:?}");
        assert_eq!(b.standard, Standard::Lm63(edition));
        assert_eq!(read.photometry.table().grid(), original.table().grid(), "{edition:?}");
        let field = match edition {
            IesStandard::Lm63Of1986 | IesStandard::Lm63Of1991 => "0.95 0.9 36.5",
            IesStandard::Lm63Of2019 => "0.95 1.00001 36.5",
            _ => "0.95 1 36.5",
        };
        assert!(written.text.lines().any(|line| line == field), "{edition:?}:\n{}", written.text);
        // The numbers that the file gave, not those that they were turned into.
        assert!(written.text.contains("123.4 77.7\r\n"), "{}", written.text);
        let required = EncodingNote::KeywordAdded("TESTLAB");
        assert_eq!(written.notes.contains(&required), edition >= IesStandard::Lm63Of2002);
        let labelled = written.notes.contains(&EncodingNote::LabelAsOther);
        assert_eq!(labelled, edition > IesStandard::Lm63Of1986);
    }
}

#[test]
fn long_texts_are_continued_or_cut() {
    let long = "word ".repeat(80);
    let keywords = ["MANUFAC", "OTHER"].map(|name| Keyword {
        name: name.to_owned(),
        value: long.trim().to_owned(),
        line: 1,
    });
    let facts = LuminaireFacts { keywords: keywords.to_vec(), ..facts() };
    let table = built(&[0.0], Symmetry::Rotational).table().clone();
    let photometry = Photometry::new(table, facts);
    let written = write_ies(&photometry, IesStandard::Lm63Of1995);
    check_lines(&written, 132);
    assert!(written.notes.contains(&EncodingNote::TextContinued));
    let read = ies(&written);
    let value = read.photometry.facts().keyword("MANUFAC").unwrap().replace('\n', " ");
    assert_eq!(value, long.trim());

    let written = write_ldt(&photometry);
    check_lines(&written, 78);
    let cut = EncodingNote::TextCut { field: "the company (field 1)", length: 78 };
    assert!(written.notes.contains(&cut), "{:?}", written.notes);
    assert!(written.notes.contains(&EncodingNote::KeywordsLeftOut(1)), "{:?}", written.notes);
    assert!(written.notes.iter().all(|note| !note.to_string().is_empty()));
}

/// Uniform intensity: half of the flux goes down, and the luminaire is its own reference.
#[test]
fn eulumdat_fluxes_are_integrated() {
    let table = SphericalTable::new(Grid {
        theta_rad: vec![0.0, PI],
        phi_rad: vec![0.0],
        symmetry: Symmetry::Rotational,
        values: vec![100.0, 100.0],
    })
    .unwrap();
    let absolute = write_ldt(&Photometry::new(table.clone(), facts()));
    let lines: Vec<&str> = absolute.text.lines().collect();
    assert_eq!(lines[21..25], ["50", "100", "1", "0"]);
    assert_eq!(lines[26], "-2");
    let flux_lm: f64 = lines[28].parse().unwrap();
    assert!((flux_lm / (400.0 * PI) - 1.0).abs() < 1e-14);

    let lamps = LuminaireFacts { lumens_per_lamp: Some(800.0), ..facts() };
    let relative = write_ldt(&Photometry::new(table, lamps));
    let lines: Vec<&str> = relative.text.lines().collect();
    assert_eq!(lines[21..25], ["50", "78.5398", "1", "0"]);
    assert_eq!((lines[26], lines[28]), ("2", "1600"));
    assert_eq!(lines[lines.len() - 1], "62.5");
}
