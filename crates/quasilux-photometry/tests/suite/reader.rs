//! The reader's rules: factors, editions, tolerated deviations, refusals with their places.

use glam::DVec3;
use quasilux_photometry::{IesStandard, Parsed, Standard, Symmetry, Tilt, WarningKind, read_ies};

/// Header, records 1 and 2, and a table of two vertical angles in one plane.
fn file(first_line: &str, record_1: &str, record_2: &str) -> String {
    format!("{first_line}\nTILT=NONE\n{record_1}\n{record_2}\n0 180\n0\n100 100\n")
}

fn read(text: &str) -> Parsed {
    read_ies(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn deviations(read: &Parsed) -> Vec<WarningKind> {
    read.warnings.iter().map(|warning| warning.kind()).collect()
}

#[test]
fn factors_follow_the_edition() {
    let nadir_cd = |first_line, record_2| {
        let read = read(&file(first_line, "1 -1 2 2 1 1 2 0 0 0", record_2));
        read.photometry.intensity_cd(DVec3::NEG_Z)
    };
    assert_eq!(nadir_cd("a label", "0.5 0.9 10"), 90.0);
    assert_eq!(nadir_cd("IESNA91", "0.5 0.9 10"), 90.0);
    assert_eq!(nadir_cd("IESNA:LM-63-1995", "0.5 0.9 10"), 100.0);
    assert_eq!(nadir_cd("IESNA:LM-63-2002", "0.5 0 10"), 100.0);
    assert_eq!(nadir_cd("IES:LM-63-2019", "0.5 1.10000 10"), 100.0);
}

#[test]
fn header_facts_are_kept() {
    let text = "IESNA:LM-63-2002\n[MANUFAC] A\n[OTHER] one\n[MORE] two\nTILT=NONE\n\
        2 1200 1 2 1 1 1 -1 -1 2\n1 1 36.5\n0 180\n0\n100 100\n";
    let read = read(text);
    let facts = read.photometry.facts();
    assert_eq!(facts.standard, Standard::Lm63(IesStandard::Lm63Of2002));
    assert_eq!(facts.keyword("MANUFAC"), Some("A"));
    assert_eq!(facts.keyword("OTHER"), Some("one\ntwo"));
    assert_eq!(facts.input_watts, 36.5);
    assert_eq!(facts.opening.width_m, -0.3048);
    assert_eq!(facts.opening.length_m, -0.3048);
    assert_eq!(facts.opening.height_m, 0.6096);
    assert_eq!(facts.tilt, Tilt::None);
    assert_eq!(read.photometry.rated_flux_lm(), Some(2400.0));
    assert_eq!(deviations(&read), [WarningKind::FluxDiffers]);
}

#[test]
fn absolute_photometry_has_no_rated_flux() {
    let read = read(&file("IESNA91", "4 -1 1 2 1 1 2 0 0 0", "1 1 10"));
    assert_eq!(read.photometry.rated_flux_lm(), None);
    assert!(read.warnings.is_empty());
}

#[test]
fn symmetries_follow_the_span_of_the_planes() {
    let text = |planes: &str| {
        let count = planes.split(' ').count();
        let rows = "100 50 0\n".repeat(count);
        format!("IESNA91\nTILT=NONE\n1 -1 1 3 {count} 1 2 0 0 0\n1 1 1\n0 45 90\n{planes}\n{rows}")
    };
    let cases = [
        ("0", Symmetry::Rotational, None),
        ("0 90", Symmetry::Quadrant, None),
        ("0 90 180", Symmetry::Bilateral, None),
        ("90 180 270", Symmetry::Bilateral, None),
        ("0 180 360", Symmetry::None, None),
        ("0 90 180 270", Symmetry::Open, Some(WarningKind::MissingClosingPlane)),
        ("-90 0 90", Symmetry::Bilateral, Some(WarningKind::FirstPlane)),
        ("-180 0 180", Symmetry::None, Some(WarningKind::FirstPlane)),
        ("45", Symmetry::Rotational, Some(WarningKind::SinglePlane)),
    ];
    for (planes, symmetry, deviation) in cases {
        let read = read(&text(planes));
        assert_eq!(read.photometry.table().symmetry(), symmetry, "{planes}");
        assert_eq!(deviations(&read).first().copied(), deviation, "{planes}");
    }
}

/// Planes 90 to 270 hold the half with negative x, and are mirrored to positive x.
#[test]
fn half_planes_are_mirrored_where_they_belong() {
    let text =
        "IESNA91\nTILT=NONE\n1 -1 1 2 3 1 2 0 0 0\n1 1 1\n0 180\n90 180 270\n1 1\n2 2\n3 3\n";
    let photometry = read(text).photometry;
    assert_eq!(photometry.intensity_cd(DVec3::Y), 1.0);
    assert_eq!(photometry.intensity_cd(DVec3::NEG_X), 2.0);
    assert_eq!(photometry.intensity_cd(DVec3::X), 2.0);
    assert!((photometry.intensity_cd(DVec3::NEG_Y) - 3.0).abs() < 1e-12);
}

#[test]
fn each_deviation_is_tolerated_and_named() {
    let good = file("IESNA:LM-63-2002", "1 -1 1 2 1 1 2 0 0 0", "1 1 10");
    let cases: &[(WarningKind, &str, &str)] = &[
        (WarningKind::ByteOrderMark, "IESNA", "\u{FEFF}IESNA"),
        (WarningKind::LeadingBlankLine, "IESNA", "\n\nIESNA"),
        (WarningKind::IdentifyingLine, "IESNA:", " IESNA: "),
        (WarningKind::UnknownStandard, "2002", "2031"),
        (WarningKind::LabelWithoutKeyword, "TILT", "no keyword\nTILT"),
        (WarningKind::TiltSpelling, "TILT=NONE", "Tilt = none"),
        (WarningKind::TiltFactors, "NONE", "INCLUDE\n1 2 0 60 1 0.8"),
        (WarningKind::TiltFile, "NONE", "lamp.tlt"),
        (WarningKind::Semicolon, "1 1 10", "1;1;10"),
        (WarningKind::RecordStart, "0 0 0\n", "0 0 0 "),
        (WarningKind::CountWithPoint, "1 2 1 1 2", "1 2.0 1 1 2"),
        (WarningKind::NegativeLumens, "1 -1 1", "1 -2 1"),
        (WarningKind::ZeroBallastLampFactor, "1 1 10", "1 0 10"),
        (WarningKind::BallastLampFactor, "1 1 10", "1 1.1 10"),
        (WarningKind::VerticalRange, "0 180", "0 170"),
        (WarningKind::SinglePlane, "\n0\n", "\n30\n"),
        (WarningKind::NegativeCandela, "100 100", "100 -0.1"),
        (WarningKind::TrailingText, "100 100\n", "100 100\nthe end of it\n"),
        (WarningKind::NoLight, "100 100", "0 0"),
        (WarningKind::FluxDiffers, "1 -1 1", "1 1000 1"),
    ];
    assert!(read(&good).warnings.is_empty());
    for (deviation, from, to) in cases {
        assert!(good.contains(from), "{from}");
        let read = read(&good.replacen(from, to, 1));
        assert_eq!(deviations(&read), [*deviation], "{to:?}");
    }
    let latin_1 = good.replace("TILT", "[LAMP] 30x\nTILT").into_bytes();
    let latin_1: Vec<u8> = latin_1.iter().map(|&b| if b == b'x' { 0xB0 } else { b }).collect();
    let read = read_ies(&latin_1).unwrap();
    assert_eq!(deviations(&read), [WarningKind::Encoding]);
    assert_eq!(read.photometry.facts().keyword("LAMP"), Some("30\u{B0}"));
}

#[test]
fn separators_and_line_ends_do_not_matter() {
    let good = file("IESNA:LM-63-2002", "1 -1 1 2 1 1 2 0 0 0", "1 1 10");
    let same = [
        good.replace('\n', "\r\n"),
        good.replace('\n', "\r"),
        good.replace("1 -1 1 2 1", "1, -1,1\n2\t1,"),
        good.trim_end().to_owned(),
        format!("{good}END\n"),
        format!("{good}\u{1A}"),
        good.replace("100 100", "1.0E2\n+100."),
    ];
    for text in same {
        let read = read(&text);
        assert!(read.warnings.is_empty(), "{text:?}: {:?}", read.warnings);
        assert_eq!(read.photometry.intensity_cd(DVec3::X), 100.0);
    }
}

#[test]
fn refusals_say_where_and_what() {
    let good = file("IESNA:LM-63-2002", "1 -1 1 2 1 1 2 0 0 0", "1 1 10");
    let cases: &[(&str, &str, usize, usize, &str)] = &[
        ("TILT=NONE", "", 7, 8, "TILT=NONE"),
        ("TILT=NONE", "TILT=", 2, 1, "nothing behind"),
        ("1 -1 1 2 1 1", "1 -1 1 2 1 3", 5, 3, "between -90 and 90"),
        ("1 -1 1 2 1 1", "1 -1 1 2 1 7", 3, 12, "photometric type of"),
        ("1 1 2 0 0 0", "1 1 3 0 0 0", 3, 14, "units type"),
        ("1 2 1 1 2", "1 999999999 1 1 2", 3, 8, "no more than the"),
        ("1 2 1 1 2", "1 2 1e14 1 2", 3, 10, "no more than the"),
        ("1 2 1 1 2", "1 1 1 1 2", 3, 8, "at least 2"),
        ("1 2 1 1 2", "1 2 1.5 1 2", 3, 10, "an integer"),
        ("1 -1 1", "1 -1 0", 3, 6, "multiplier above 0"),
        ("1 1 10", "0 1 10", 4, 1, "ballast factor above 0"),
        ("1 1 10", "1 1 nan", 4, 5, "a number"),
        ("1 1 10", "1 1 1e999", 4, 5, "no more than 1e18"),
        ("0 180", "0 0", 5, 3, "ascending"),
        ("0 180", "0 190", 5, 3, "between 0 and 180"),
        ("100 100", "100", 7, 4, "candela value 2 of 2 in plane 1 of 1"),
        ("100 100", "100 1oo", 7, 5, "\"1oo\""),
    ];
    for (from, to, line, column, message) in cases {
        let error = read_ies(good.replacen(from, to, 1).as_bytes()).unwrap_err();
        assert_eq!((error.line(), error.column()), (*line, *column), "{to:?}: {error}");
        assert!(error.to_string().contains(message), "{to:?}: {error}");
    }
    let long = read_ies(good.replacen("0 180", "5 1e-300", 1).as_bytes()).unwrap_err();
    assert!(long.found().len() < 250 && long.found().ends_with("..."), "{long}");
    assert_eq!(read_ies(b"").unwrap_err().line(), 1);
    assert!(read_ies(b"\xFF\xFE").is_err());
    assert!(read_ies(&[0xFF; 1000]).is_err());
}

/// Work is linear in the length of a line: with columns counted from its start each time, this
/// would not end.
#[test]
fn a_file_may_be_one_long_line() {
    let (verticals, planes) = (400, 1000);
    let angles = |count: usize, last: f64| -> String {
        (0..count).map(|i| format!("{} ", last * i as f64 / (count - 1) as f64)).collect()
    };
    let candela = "100 ".repeat(verticals * planes);
    let text = format!(
        "IESNA91\nTILT=NONE\n1 -1 1 {verticals} {planes} 1 2 0 0 0 1 1 1 {}{}{candela}",
        angles(verticals, 180.0),
        angles(planes, 360.0),
    );
    let read = read(&text);
    assert!((read.photometry.flux_lm() / (400.0 * std::f64::consts::PI) - 1.0).abs() < 1e-12);
    assert_eq!(deviations(&read), [WarningKind::RecordStart]);
    assert_eq!(read.warnings[0].count(), planes + 3);
}

/// Commas separate numbers by the standard, and are decimal points in files of some countries: what
/// a file means is what makes a luminaire.
#[test]
fn decimal_commas_are_read_where_commas_separate_nothing() {
    let pointed = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 0.5 3 1 1 2 0.2 1.25 0\n1 1 24.5\n\
        0 45.5 90\n0\n900.5 600.25 0\n";
    let expected = read(pointed).photometry;
    let commas = read(&pointed.replace('.', ","));
    assert_eq!(commas.photometry.facts().opening, expected.facts().opening);
    assert_eq!(commas.photometry.flux_lm(), expected.flux_lm());
    assert!(deviations(&commas).contains(&WarningKind::DecimalComma));
    let separated = read(&pointed.replace(' ', ","));
    assert_eq!(separated.photometry.flux_lm(), expected.flux_lm());
    assert!(!deviations(&separated).contains(&WarningKind::DecimalComma));
    // One comma among points leaves a number too many behind the last, unless it is a point.
    let mixed = pointed.replace("900.5", "900,5");
    assert_eq!(read(&mixed).photometry.flux_lm(), expected.flux_lm());
    // What makes no luminaire either way is refused as it stands there.
    let refused = read_ies(mixed.replace("600.25", "x").as_bytes()).unwrap_err();
    assert_eq!((refused.line(), refused.column()), (7, 7), "{refused}");
}
