//! EULUMDAT: symmetries, factors, tolerated deviations, refusals with their places.

use glam::DVec3;
use quasilux_photometry::{ParseError, Parsed, Standard, Symmetry, WarningKind, read_ldt};
use std::f64::consts::PI;

/// The pieces of a file: gamma is 0, 90, 180 and each plane is constant over it, so that the flux
/// is 4 pi times the mean intensity over C.
#[derive(Clone)]
struct File {
    isym: &'static str,
    /// `Dc`, and the angles of all planes.
    planes: (&'static str, &'static str),
    /// Fields 13 to 25.
    luminaire: &'static str,
    /// Field 26.
    lamps: &'static str,
    /// One intensity for each stored plane.
    intensities: &'static str,
}

const ROTATIONAL: File = File {
    isym: "1",
    planes: ("0", "0"),
    luminaire: "1200 300 80 1100 200 10 20 10 20 50 100 1 0",
    lamps: "1\n1\nT\n1000\n3000K\n80\n20",
    intensities: "100",
};

const EIGHT_PLANES: (&str, &str) = ("45", "0 45 90 135 180 225 270 315");

impl File {
    fn text(&self) -> String {
        let lines = |blanks: &str| blanks.replace(' ', "\n");
        let (distance, planes) = self.planes;
        let count = planes.split(' ').count();
        let thrice = |value: &str| format!("{value}\n{value}\n{value}\n");
        let intensities: String = self.intensities.split(' ').map(thrice).collect();
        let (luminaire, lamps, ratios) = (lines(self.luminaire), self.lamps, "0.5\n".repeat(10));
        let planes = lines(planes);
        format!(
            "Maker\n2\n{}\n{count}\n{distance}\n3\n90\nreport\nname\nnumber\nfile\ndate\n\
            {luminaire}\n{lamps}\n{ratios}{planes}\n0\n90\n180\n{intensities}",
            self.isym
        )
    }

    fn read(&self) -> Parsed {
        let text = self.text();
        read_ldt(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
    }
}

fn deviations(read: &Parsed) -> Vec<WarningKind> {
    read.warnings.iter().map(|warning| warning.kind()).collect()
}

fn at_horizon(read: &Parsed, c_deg: i32) -> f64 {
    let (y, x) = libm::sincos(f64::from(c_deg) / 180.0 * PI);
    read.photometry.intensity_cd(DVec3::new(x, y, 0.0))
}

fn refused(text: &str) -> ParseError {
    read_ldt(text.as_bytes()).expect_err("a refusal")
}

/// The intensities at C = 0, 45, ... 315, and their mean as the trapezia of all planes give it.
#[test]
fn each_symmetry_expands_to_the_whole_turn() {
    let cases = [
        ("0", "100 200 300 400 500 600 700 800", [100, 200, 300, 400, 500, 600, 700, 800]),
        ("1", "100", [100; 8]),
        ("2", "100 200 400 500 800", [100, 200, 400, 500, 800, 500, 400, 200]),
        ("3", "100 150 200 300 400", [200, 300, 400, 300, 200, 150, 100, 150]),
        ("4", "100 300 400", [100, 300, 400, 300, 100, 300, 400, 300]),
    ];
    let symmetries = [
        Symmetry::Open,
        Symmetry::Rotational,
        Symmetry::Bilateral,
        Symmetry::Bilateral,
        Symmetry::Quadrant,
    ];
    for ((isym, intensities, expected_cd), symmetry) in cases.into_iter().zip(symmetries) {
        let read = File { isym, intensities, planes: EIGHT_PLANES, ..ROTATIONAL }.read();
        assert_eq!(read.photometry.table().symmetry(), symmetry, "Isym {isym}");
        for (c_deg, expected_cd) in (0..).step_by(45).zip(expected_cd) {
            let intensity_cd = at_horizon(&read, c_deg);
            assert!(
                (intensity_cd - f64::from(expected_cd)).abs() < 1e-9,
                "Isym {isym}, C{c_deg}: {intensity_cd} cd"
            );
        }
        let mean_cd = f64::from(expected_cd.iter().sum::<i32>()) / 8.0;
        let flux_lm = read.photometry.flux_lm();
        assert!((flux_lm / (4.0 * PI * mean_cd) - 1.0).abs() < 1e-12, "Isym {isym}: {flux_lm} lm");
    }
}

/// Unequal planes are found by their angles, not by their number.
#[test]
fn unequal_planes_keep_their_azimuths() {
    let planes = ("0", "0 30 90 180 270 280 330");
    let read = File { isym: "3", intensities: "1 2 3 4 5 6", planes, ..ROTATIONAL }.read();
    for (c_deg, expected_cd) in
        [(270, 1.0), (280, 2.0), (330, 3.0), (0, 4.0), (30, 5.0), (90, 6.0), (150, 5.0), (210, 3.0)]
    {
        assert!((at_horizon(&read, c_deg) - expected_cd).abs() < 1e-9, "C{c_deg}");
    }
    assert_eq!(deviations(&read), [WarningKind::FluxDiffers]);
}

#[test]
fn intensities_are_per_thousand_lumens_of_the_lamps() {
    let read = File {
        lamps: "1\n2\nT\n5000\n3000K\n80\n20",
        luminaire: "1200 300 80 1100 200 10 20 10 20 50 62.83185 0.5 0",
        ..ROTATIONAL
    }
    .read();
    assert_eq!(at_horizon(&read, 0), 250.0);
    assert_eq!(read.photometry.rated_flux_lm(), Some(5000.0));
    let facts = read.photometry.facts();
    assert_eq!((facts.lamp_count, facts.lumens_per_lamp), (2.0, Some(2500.0)));
    assert_eq!((facts.candela_factor, facts.input_watts), (2.5, 20.0));
    assert!(read.warnings.is_empty(), "{:?}", read.warnings);

    let absolute = File { lamps: "1\n-1\nLED\n2000\n3000K\n80\n20", ..ROTATIONAL }.read();
    assert_eq!(at_horizon(&absolute, 0), 200.0);
    assert_eq!(absolute.photometry.rated_flux_lm(), None);
}

#[test]
fn facts_are_kept() {
    let read = ROTATIONAL.read();
    let facts = read.photometry.facts();
    assert_eq!(facts.standard, Standard::Eulumdat);
    assert_eq!(facts.keyword("MANUFAC"), Some("Maker"));
    assert_eq!(facts.keyword("LUMINAIRE"), Some("name"));
    assert_eq!(facts.keyword("LAMP"), Some("T"));
    assert_eq!(facts.light_output_ratio, Some(1.0));
    let opening = facts.opening;
    assert_eq!((opening.width_m, opening.length_m, opening.height_m), (1.1, 0.2, 0.02));

    let round = File { luminaire: "200 0 80 150 0 0 0 0 0 50 100 1 0", ..ROTATIONAL }.read();
    let opening = round.photometry.facts().opening;
    assert_eq!((opening.width_m, opening.length_m, opening.height_m), (-0.15, -0.15, 0.0));
}

#[test]
fn each_tolerated_deviation_is_reported() {
    let with = |luminaire| File { luminaire, ..ROTATIONAL };
    let closing = ("90", "0 90 180 270 360");
    let cases = [
        (with("1200 300 80 1100 200 10 20 10 20 50 125,66 1 0"), WarningKind::DecimalComma),
        (with("1200  80 1100 200 10 20 10 20 50 125.66 1 0"), WarningKind::EmptyNumber),
        (with("1 1 1 1 1 0 0 0 0 50 0 1 0"), WarningKind::ZeroLightOutputRatio),
        (with("1 1 1 1 1 0 0 0 0 50 125.66 0 0"), WarningKind::ZeroConversionFactor),
        (with("1 1 1 1 1 0 0 0 0 50 125.66 1 15"), WarningKind::MeasurementTilt),
        (with("1 1 1 1 1 0 0 0 0 50 90 1 0"), WarningKind::FluxDiffers),
        (with("1 1 1 1 1 0 0 0 0 90 125.66 1 0"), WarningKind::DownwardFluxDiffers),
        (File { planes: ("30", "0 90 180 270"), ..ROTATIONAL }, WarningKind::AngleDistance),
        (File { isym: "0", ..ROTATIONAL }, WarningKind::SinglePlaneWithoutSymmetry),
        (
            File { isym: "0", planes: closing, intensities: "1 1 1 1 1", ..ROTATIONAL },
            WarningKind::ClosingPlaneGiven,
        ),
        (
            File { isym: "0", planes: ("90", "0 90 180"), intensities: "1 1 1", ..ROTATIONAL },
            WarningKind::PlanesMissing,
        ),
        (File { lamps: "1\n\nT\n1000\n3000K\n80\n20", ..ROTATIONAL }, WarningKind::EmptyNumber),
        (File { lamps: "1\n0\nT\n1000\n3000K\n80\n20", ..ROTATIONAL }, WarningKind::ZeroLampCount),
        (
            File { lamps: "2\n1\nT\n1000\n-\n-\n20\n1\nT\n2000\n-\n-\n40", ..ROTATIONAL },
            WarningKind::SeveralLampSets,
        ),
        (File { intensities: "100 7", ..ROTATIONAL }, WarningKind::TrailingText),
        (File { intensities: "-1", ..ROTATIONAL }, WarningKind::NegativeCandela),
        (File { intensities: "0", ..ROTATIONAL }, WarningKind::NoLight),
        (File { isym: "1.0", ..ROTATIONAL }, WarningKind::CountWithPoint),
    ];
    for (file, deviation) in cases {
        let read = file.read();
        assert!(deviations(&read).contains(&deviation), "{deviation:?}: {:?}", read.warnings);
    }
}

#[test]
fn line_ends_and_encodings_do_not_matter() {
    let text = ROTATIONAL.text();
    let flux_lm = ROTATIONAL.read().photometry.flux_lm();
    let utf_16: Vec<u8> =
        [0xFF, 0xFE].into_iter().chain(text.encode_utf16().flat_map(u16::to_le_bytes)).collect();
    let latin_1: Vec<u8> =
        text.replace("Maker", "M?ller").bytes().map(|b| if b == b'?' { 0xFC } else { b }).collect();
    let variants = [
        text.replace('\n', "\r\n").into_bytes(),
        text.replace('\n', "\r").into_bytes(),
        format!("{text}\n \n\u{1A}").into_bytes(),
        text.trim_end().as_bytes().to_vec(),
        format!("\u{FEFF}{text}").into_bytes(),
        utf_16,
        latin_1,
    ];
    for bytes in variants {
        let read = read_ldt(&bytes).unwrap();
        assert_eq!(read.photometry.flux_lm(), flux_lm);
        assert!(!deviations(&read).contains(&WarningKind::TrailingText));
    }
}

#[test]
fn refusals_name_place_and_field() {
    let text = ROTATIONAL.text();
    let second = |line: usize, new: &str| {
        let mut lines: Vec<&str> = text.lines().collect();
        lines[line - 1] = new;
        lines.join("\n")
    };
    let cases = [
        (String::new(), 1, "the company"),
        (second(3, "5"), 3, "between 0 and 4"),
        (second(3, "2"), 3, "no plane C180"),
        (second(3, "4"), 3, "no plane C90"),
        (second(4, "1000000000"), 4, "no more than the"),
        (second(6, "4000000000"), 6, "no more than the"),
        (second(6, "1"), 6, "at least 2"),
        (second(23, "-1"), 23, "light output ratio"),
        (second(24, "-1"), 24, "conversion factor"),
        (second(26, "99999"), 26, "lamp sets"),
        (second(29, "0"), 29, "above 0 lm"),
        (second(45, "0"), 45, "ascending"),
        (second(46, "200"), 46, "between 0 and 180"),
        (second(47, "inf"), 47, "intensity"),
        (second(48, ""), 48, "intensity"),
        (text.lines().take(48).collect::<Vec<_>>().join("\n"), 3, "intensities"),
        (text.lines().take(20).collect::<Vec<_>>().join("\n"), 21, "field 21"),
    ];
    for (text, line, expected) in cases {
        let error = refused(&text);
        assert_eq!(error.line(), line, "{error}");
        assert!(error.to_string().contains(expected), "{error}");
    }
}
