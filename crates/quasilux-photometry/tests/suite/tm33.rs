//! TM-33: closed forms, symmetries, factors, several emitters, tolerated deviations, refusals.

use glam::DVec3;
use quasilux_photometry::{
    Angles, ParseError, Parsed, Photometry, Standard, Symmetry, Tm33Edition, WarningKind, read_ies,
    read_tm33,
};
use std::f64::consts::PI;

/// The pieces of a file.
#[derive(Clone)]
pub(crate) struct File {
    /// Elements of the emitter before its luminous data.
    pub(crate) emitter: String,
    /// Elements before the intensities.
    pub(crate) head: String,
    pub(crate) points: String,
    /// Elements of the emitter behind its luminous data.
    pub(crate) tail: String,
}

impl File {
    /// One plane with these intensities at 0, 90 and 180 degrees.
    pub(crate) fn rotational(intensities: [f64; 3]) -> Self {
        Self::planes(&[(0.0, intensities)])
    }

    /// Planes with their intensities at 0, 90 and 180 degrees.
    pub(crate) fn planes(planes: &[(f64, [f64; 3])]) -> Self {
        Self::at(&[0.0, 90.0, 180.0], planes)
    }

    /// Planes with their intensities at these vertical angles.
    pub(crate) fn at<const N: usize>(angles: &[f64; N], planes: &[(f64, [f64; N])]) -> Self {
        let point = |h: f64, (v, value): (&f64, f64)| {
            format!("    <IntData h=\"{h}\" v=\"{v}\">{value}</IntData>\n")
        };
        let plane = |(h, values): &(f64, [f64; N])| -> String {
            angles.iter().zip(*values).map(|pair| point(*h, pair)).collect()
        };
        let head = format!(
            "<AbsolutePhotometry>true</AbsolutePhotometry>\n    \
             <NumberMeasured>{}</NumberMeasured><NumberHorz>{}</NumberHorz>\
             <NumberVert>{N}</NumberVert>",
            N * planes.len(),
            planes.len()
        );
        let emitter = "<Quantity>1</Quantity><Description>LED</Description>\
                       <InputWattage>20</InputWattage>";
        let points = planes.iter().map(plane).collect();
        Self { emitter: emitter.to_owned(), head, points, tail: String::new() }
    }

    /// The emitter starts on line 7, its luminous data on line 9, its intensities on line 13.
    pub(crate) fn text(&self) -> String {
        let header = "<Manufacturer>Maker &amp; Co</Manufacturer>\
                      <Description>lamp</Description><Laboratory>lab</Laboratory>\n    \
                      <ReportNumber>1</ReportNumber><ReportDate>2024-01-15</ReportDate>";
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<IESTM33-22>\n<Version>1.1</Version>\n\
             <Header>{header}\n</Header>\n{}\n</IESTM33-22>\n",
            self.element()
        )
    }

    fn element(&self) -> String {
        let Self { emitter, head, points, tail } = self;
        format!(
            "<Emitter>\n  {emitter}\n  <LuminousData>\n  <LuminousIntensity>\n    {head}\n\
             {points}  </LuminousIntensity>\n  </LuminousData>\n  {tail}\n</Emitter>"
        )
    }

    pub(crate) fn read(&self) -> Parsed {
        read(&self.text())
    }
}

fn read(text: &str) -> Parsed {
    read_tm33(text.as_bytes()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Several emitters in one file.
fn together(files: &[File]) -> String {
    let all: Vec<String> = files.iter().map(File::element).collect();
    let text = files[0].text();
    text.replacen(&all[0], &all.join("\n"), 1)
}

fn deviations(read: &Parsed) -> Vec<WarningKind> {
    read.warnings.iter().map(|warning| warning.kind()).collect()
}

fn intensity_cd(photometry: &Photometry, gamma_deg: f64, c_deg: f64) -> f64 {
    let angles = Angles { theta_rad: gamma_deg / 180.0 * PI, phi_rad: c_deg / 180.0 * PI };
    photometry.intensity_cd(angles.direction() * DVec3::new(1.0, 1.0, -1.0))
}

/// Constant over theta, with mean m over C, is 4 pi m. A linear fall from I at 0 to 0 at pi/2 is
/// 2 pi I (1 - 2 / pi): the integral of (1 - 2 t / pi) sin t is 1 - 2 / pi.
#[test]
fn fluxes_have_their_closed_forms() {
    let even = File::rotational([100.0; 3]).read();
    assert!((even.photometry.flux_lm() / (400.0 * PI) - 1.0).abs() < 1e-14);
    assert!(even.warnings.is_empty(), "{:?}", even.warnings);
    let cone = File::rotational([100.0, 0.0, 0.0]).read();
    let expected_lm = 200.0 * PI * (1.0 - 2.0 / PI);
    assert!((cone.photometry.flux_lm() / expected_lm - 1.0).abs() < 1e-14);
    let stated = format!("<LuminousFlux>{expected_lm}</LuminousFlux>\n  </LuminousData>");
    let text = File::rotational([100.0, 0.0, 0.0]).text().replace("</LuminousData>", &stated);
    assert!(read(&text).warnings.is_empty());
}

#[test]
fn each_symmetry_expands_to_the_whole_turn() {
    let plane = |c_deg: f64, value: f64| (c_deg, [value; 3]);
    let cases = [
        (&[plane(0.0, 5.0)][..], "Symm_Full", Symmetry::Rotational, [5.0; 4]),
        (
            &[plane(0.0, 1.0), plane(90.0, 2.0)],
            "Symm_Quad",
            Symmetry::Quadrant,
            [1.0, 2.0, 1.0, 2.0],
        ),
        (
            &[plane(0.0, 1.0), plane(90.0, 2.0), plane(180.0, 3.0)],
            "Symm_Bi_0",
            Symmetry::Bilateral,
            [1.0, 2.0, 3.0, 2.0],
        ),
        (
            &[plane(90.0, 1.0), plane(180.0, 2.0), plane(270.0, 3.0)],
            "Symm_Bi_90",
            Symmetry::Bilateral,
            [2.0, 1.0, 2.0, 3.0],
        ),
        (
            &[
                plane(0.0, 1.0),
                plane(90.0, 2.0),
                plane(180.0, 3.0),
                plane(270.0, 4.0),
                plane(360.0, 1.0),
            ],
            "Symm_None",
            Symmetry::None,
            [1.0, 2.0, 3.0, 4.0],
        ),
    ];
    for (planes, name, symmetry, expected_cd) in cases {
        let mut file = File::planes(planes);
        file.head += &format!("<Symm>{name}</Symm>");
        let read = file.read();
        assert!(read.warnings.is_empty(), "{name}: {:?}", read.warnings);
        assert_eq!(read.photometry.table().symmetry(), symmetry, "{name}");
        for (c_deg, expected_cd) in [0.0, 90.0, 180.0, 270.0].into_iter().zip(expected_cd) {
            let found_cd = intensity_cd(&read.photometry, 60.0, c_deg);
            assert!((found_cd - expected_cd).abs() < 1e-9, "{name}, C{c_deg}: {found_cd}");
        }
    }
}

/// The web of types A and B is that of LM-63: an IES file with the same angles and values is the
/// same luminaire.
#[test]
fn types_a_and_b_are_those_of_lm_63() {
    for (number, name) in [(2, "IES_B"), (3, "IES_A")] {
        let planes = [(-90.0, [1.0, 2.0, 3.0]), (0.0, [4.0, 50.0, 6.0]), (90.0, [7.0, 8.0, 9.0])];
        let goniometer = format!(
            "<Equipment><Gonioradiometer><Type>{name}</Type></Gonioradiometer></Equipment><Emitter>"
        );
        let text = File::at(&[-90.0, 0.0, 90.0], &planes).text();
        let tm33 = read(&text.replacen("<Emitter>", &goniometer, 1)).photometry;
        let ies = format!(
            "IESNA:LM-63-2002\n[TEST] -\nTILT=NONE\n1 -1 1 3 3 {number} 2 0 0 0\n1 1 10\n\
             -90 0 90\n-90 0 90\n1 2 3\n4 50 6\n7 8 9\n"
        );
        let ies = read_ies(ies.as_bytes()).unwrap().photometry;
        assert_eq!(tm33.facts().photometric_type, ies.facts().photometric_type);
        assert_eq!(tm33.flux_lm(), ies.flux_lm());
        for step in 0..500 {
            let angles = Angles { theta_rad: f64::from(step) * 0.006, phi_rad: f64::from(step) };
            let direction = angles.direction();
            assert_eq!(tm33.intensity_cd(direction), ies.intensity_cd(direction), "{name}");
        }
    }
}

#[test]
fn the_order_of_intensities_does_not_matter() {
    let file = File::planes(&[(0.0, [1.0, 2.0, 3.0]), (90.0, [1.0, 5.0, 3.0])]);
    let mut lines: Vec<&str> = file.points.lines().collect();
    lines.reverse();
    lines.swap(0, 3);
    let shuffled = File { points: lines.join("\n") + "\n", ..file.clone() }.read();
    assert_eq!(shuffled.photometry.flux_lm(), file.read().photometry.flux_lm());
    assert!(shuffled.warnings.is_empty());
}

#[test]
fn factors_depend_on_the_kind_of_photometry() {
    let lamps = "<Quantity>2</Quantity><Description>T8</Description>\
                 <RatedLumens>1000</RatedLumens><InputWattage>40</InputWattage>\
                 <BallastFactor>0.5</BallastFactor>";
    let of = |absolute: &str| {
        let mut file = File::rotational([100.0; 3]);
        file.emitter = lamps.to_owned();
        file.head = file.head.replace("true", absolute) + "<Multiplier>3</Multiplier>";
        file.read()
    };
    let relative = of("false");
    assert_eq!(intensity_cd(&relative.photometry, 40.0, 0.0), 150.0);
    let facts = relative.photometry.facts();
    assert_eq!((facts.lamp_count, facts.lumens_per_lamp), (2.0, Some(500.0)));
    assert_eq!((facts.ballast_factor, facts.candela_factor), (0.5, 1.5));
    assert_eq!(relative.photometry.rated_flux_lm(), Some(1000.0));
    assert_eq!(deviations(&relative), [WarningKind::FluxDiffers]);
    // 1885 lm from lamps of 500 lm are no loss.
    assert!(relative.warnings[0].expected().contains("check Multiplier"), "{relative:?}");

    let absolute = of("1");
    assert_eq!(intensity_cd(&absolute.photometry, 40.0, 0.0), 300.0);
    assert_eq!(absolute.photometry.rated_flux_lm(), None);
    assert_eq!(deviations(&absolute), [WarningKind::AbsoluteBallastFactor]);
}

#[test]
fn facts_are_kept() {
    let mut file = File::rotational([1.0; 3]);
    file.emitter += "<ColorTemperature><FixedCCT>4000</FixedCCT></ColorTemperature>\
                     <ColorRendering><CIE_CRI><Ra>92</Ra></CIE_CRI></ColorRendering>";
    let area = |length: f64, width: f64, offset: f64, more: &str| {
        format!(
            "<BottomArea><Length>{length}</Length><Width>{width}</Width>\
             <LengthOffset>{offset}</LengthOffset><WidthOffset>0</WidthOffset>{more}</BottomArea>"
        )
    };
    let areas = |bottom: &str, side: &str| {
        format!("<EmissionAreas><BottomFace>{bottom}</BottomFace>{side}</EmissionAreas>")
    };
    let side = "<C90Face><C90Area><Width>0.2</Width><Height>0.05</Height></C90Area></C90Face>";
    file.tail = areas(&(area(0.5, 0.2, -0.3, "") + &area(0.5, 0.2, 0.3, "")), side);
    let read = file.read();
    assert!(read.warnings.is_empty(), "{:?}", read.warnings);
    let facts = read.photometry.facts();
    assert_eq!(facts.standard, Standard::Tm33(Tm33Edition::Of2023));
    assert_eq!(facts.keyword("MANUFAC"), Some("Maker & Co"));
    assert_eq!(facts.keyword("LUMINAIRE"), Some("lamp"));
    assert_eq!(facts.keyword("LAMP"), Some("LED"));
    assert_eq!((facts.keyword("COLORTEMP"), facts.keyword("CRI")), (Some("4000"), Some("92")));
    assert_eq!(facts.input_watts, 20.0);
    let opening = facts.opening;
    assert_eq!((opening.width_m, opening.length_m, opening.height_m), (1.1, 0.2, 0.05));

    file.tail = areas(&area(0.15, 0.15, 0.0, "<Circular>true</Circular>"), "");
    let opening = file.read().photometry.facts().opening;
    assert_eq!((opening.width_m, opening.length_m, opening.height_m), (-0.15, -0.15, 0.0));
}

#[test]
fn emitters_on_the_same_grid_are_added() {
    let (a, b) = (File::rotational([1.0, 2.0, 3.0]), File::rotational([10.0, 20.0, 30.0]));
    let read = read(&together(&[a, b]));
    assert_eq!(deviations(&read), [WarningKind::SeveralEmitters]);
    assert_eq!(read.photometry.table().symmetry(), Symmetry::Rotational);
    assert_eq!(intensity_cd(&read.photometry, 90.0, 10.0), 22.0);
    assert_eq!(read.photometry.facts().lamp_count, 2.0);
    assert_eq!(read.photometry.facts().input_watts, 40.0);
}

/// Bilinear functions stay so on a finer grid: the sum is that of the parts in every direction, and
/// so is its flux.
#[test]
fn emitters_on_different_grids_are_added_exactly() {
    let parts = [
        File::planes(&[(0.0, [9.0, 2.0, 3.0]), (90.0, [9.0, 5.0, 3.0])]),
        File::at(
            &[0.0, 37.0, 111.0, 180.0],
            &[
                (90.0, [4.0, 7.0, 1.0, 5.0]),
                (150.0, [4.0, 8.0, 2.0, 5.0]),
                (270.0, [4.0, 6.0, 9.0, 5.0]),
            ],
        ),
        File::at(&[0.0, 55.0], &[(0.0, [30.0, 0.0])]),
    ];
    let sum = read(&together(&parts));
    let parts: Vec<Parsed> = parts.iter().map(File::read).collect();
    let flux_lm: f64 = parts.iter().map(|part| part.photometry.flux_lm()).sum();
    assert!((sum.photometry.flux_lm() / flux_lm - 1.0).abs() < 1e-13);
    for step in 0..1000 {
        let (gamma_deg, c_deg) = (f64::from(step) * 0.18, f64::from(step) * 7.3);
        let expected: f64 =
            parts.iter().map(|part| intensity_cd(&part.photometry, gamma_deg, c_deg)).sum();
        let found = intensity_cd(&sum.photometry, gamma_deg, c_deg);
        assert!((found - expected).abs() < 1e-9, "{gamma_deg} {c_deg}: {found} {expected}");
    }
    let cut = File::at(&[0.0, 55.0], &[(0.0, [30.0, 1.0])]);
    let text = together(&[File::rotational([1.0; 3]), cut]);
    let error = read_tm33(text.as_bytes()).expect_err("a refusal");
    assert!(error.to_string().contains("same range of vertical angles"), "{error}");
}

#[test]
fn each_tolerated_deviation_is_reported() {
    let good = File::rotational([100.0; 3]).text();
    let two = together(&[File::rotational([1.0; 3]), File::rotational([1.0; 3])]);
    let dark = good.replacen("<Emitter>", "<Emitter><RadiantData/></Emitter><Emitter>", 1);
    let with = |from: &str, to: &str| {
        assert!(good.contains(from), "no {from}");
        good.replace(from, to)
    };
    let opening = "<Luminaire><LuminousOpening><Shape>Circular</Shape><Length>150</Length>\
                   </LuminousOpening></Luminaire><Emitter>";
    let cases = [
        (with("IESTM33-22", "LuminaireOpticalData"), WarningKind::UnknownStandard),
        (with("IESTM33-22", "IESTM33-30"), WarningKind::UnknownStandard),
        (with("<Version>1.1</Version>", ""), WarningKind::MissingElement),
        (with("<Quantity>1</Quantity>", ""), WarningKind::MissingElement),
        (with("InputWattage", "InputWatts"), WarningKind::ForeignElement),
        (with("h=\"0\"", "horz=\"0\""), WarningKind::ForeignElement),
        (with("IntData", "IntensityData"), WarningKind::ForeignElement),
        (
            with("<NumberMeasured>", "<Symm>symm _ full</Symm><NumberMeasured>"),
            WarningKind::WordSpelling,
        ),
        (
            with("<NumberMeasured>", "<Symm>Symm_Quad</Symm><NumberMeasured>"),
            WarningKind::SymmetryDiffers,
        ),
        (with("<NumberVert>3", "<NumberVert>4"), WarningKind::CountDiffers),
        (with("<NumberVert>3", "<NumberVert>3.0"), WarningKind::CountWithPoint),
        (two, WarningKind::SeveralEmitters),
        (dark, WarningKind::EmitterWithoutLight),
        (with("<Quantity>1<", "<Quantity>0<"), WarningKind::ZeroLampCount),
        (
            with("<Quantity>1<", "<BallastFactor>2</BallastFactor><Quantity>1<"),
            WarningKind::AbsoluteBallastFactor,
        ),
        (
            with("<Quantity>1<", "<PowerFactor/><RatedLumens/><Quantity>1<"),
            WarningKind::EmptyNumber,
        ),
        (
            with(
                "<Quantity>1<",
                "<TiltAngles><Tilt angle=\"10\">0.9</Tilt></TiltAngles><Quantity>1<",
            ),
            WarningKind::TiltFactors,
        ),
        (with("<Emitter>", opening), WarningKind::OpeningInMillimetres),
        (
            with("</LuminousData>", "<LuminousFlux>9</LuminousFlux></LuminousData>"),
            WarningKind::FluxDiffers,
        ),
        (with(">100<", ">-1<"), WarningKind::NegativeCandela),
        (with(">100<", ">0<"), WarningKind::NoLight),
        (with("v=\"180\"", "v=\"120\""), WarningKind::VerticalRange),
    ];
    for (text, deviation) in cases {
        let read = read(&text);
        assert!(deviations(&read).contains(&deviation), "{deviation:?}: {:?}", read.warnings);
    }
}

fn refused(text: &str) -> ParseError {
    read_tm33(text.as_bytes()).expect_err(text)
}

#[test]
fn refusals_name_place_and_element() {
    let good = File::rotational([100.0; 3]).text();
    let first = "h=\"0\" v=\"0\"";
    let cases = [
        ("IESTM33-22", "WindowElement", 2, 1, "in the TM-33 format"),
        ("Emitter", "Emission", 2, 1, "at least one emitter"),
        ("LuminousData", "PhotonData", 7, 1, "only luminous intensities"),
        ("LuminousIntensity", "Radiant", 9, 3, "elements IntData"),
        ("IntData", "Data", 10, 3, "elements IntData"),
        (first, "v=\"0\"", 13, 5, "the angles h and v"),
        (first, "h=\"0\" v=\"nan\"", 13, 5, "v (a number"),
        (first, "h=\"0\" v=\"90\"", 14, 5, "each direction once"),
        (first, "h=\"90\" v=\"0\"", 14, 5, "one for each pair"),
        (first, "h=\"0\" v=\"-10\"", 13, 5, "between 0 and 180"),
        ("h=\"0\"", "h=\"9e9\"", 13, 5, "from 0 to 360"),
        (">100<", "> 1oo<", 13, 27, "\"1oo\""),
        (">100<", "><", 13, 5, "found nothing"),
        ("<Quantity>1<", "<Quantity>1.5<", 8, 13, "an integer"),
        ("<Quantity>1<", "<BallastFactor>0</BallastFactor><Quantity>1<", 8, 18, "above 0"),
        ("<NumberMeasured>", "<Multiplier>-1</Multiplier><NumberMeasured>", 12, 17, "above 0"),
        ("<NumberMeasured>", "<Symm>none</Symm><NumberMeasured>", 12, 11, "Symm_None"),
        (">true<", ">maybe<", 11, 25, "true or false"),
        ("<NumberMeasured>", "<Metric>Radiant</Metric><NumberMeasured>", 12, 13, "luminous"),
        ("<NumberMeasured>", "<Units>cd/klm</Units><NumberMeasured>", 12, 12, "cd intensities"),
        (
            "<Emitter>",
            "<Equipment><Gonioradiometer><Type>CIE_B</Type></Gonioradiometer></Equipment><Emitter>",
            7,
            35,
            "no other goniometer",
        ),
        (
            "</Emitter>",
            "<EmissionAreas><TopFace><TopArea><Width>-1</Width></TopArea></TopFace>\
            </EmissionAreas></Emitter>",
            19,
            41,
            "0 or more",
        ),
        ("</IESTM33-22>", "", 21, 1, "the end of"),
    ];
    for (from, to, line, column, expected) in cases {
        let text = if from == first { good.replacen(from, to, 1) } else { good.replace(from, to) };
        assert_ne!(text, good, "no {from}");
        let error = refused(&text);
        assert_eq!((error.line(), error.column()), (line, column), "{to}: {error}\n{text}");
        assert!(error.to_string().contains(expected), "{to}: {error}");
    }
    let single = refused(&File::at(&[30.0], &[(0.0, [5.0]), (90.0, [5.0])]).text());
    assert!(single.to_string().contains("two or more vertical angles"), "{single}");
    for text in ["", "lamp", "IESNA:LM-63-2002\nTILT=NONE", "<a", "\u{FEFF}"] {
        assert_eq!(refused(text).line(), 1);
    }
}

#[test]
fn encodings_do_not_matter() {
    let text = File::rotational([100.0; 3]).text();
    let flux_lm = read(&text).photometry.flux_lm();
    let wide = |mark: [u8; 2], bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
        mark.into_iter().chain(text.encode_utf16().flat_map(bytes)).collect()
    };
    let variants = [
        format!("\u{FEFF}{text}").into_bytes(),
        text.replace('\n', "\r\n").into_bytes(),
        text.replace('\n', "\r").into_bytes(),
        wide([0xFF, 0xFE], u16::to_le_bytes),
        wide([0xFE, 0xFF], u16::to_be_bytes),
        text.replace("<IESTM33-22>", "<t:IESTM33-22 xmlns:t=\"x\">")
            .replace("</IESTM33-22>", "</t:IESTM33-22>")
            .into_bytes(),
    ];
    for bytes in variants {
        let read = read_tm33(&bytes).unwrap();
        assert_eq!(read.photometry.flux_lm(), flux_lm);
        assert!(read.warnings.is_empty(), "{:?}", read.warnings);
    }
    let latin_1 = |encoding: &str| -> Vec<u8> {
        let text = text.replace("UTF-8", encoding).replace("Maker", "M~ller");
        text.bytes().map(|b| if b == b'~' { 0xFC } else { b }).collect()
    };
    let declared = read_tm33(&latin_1("ISO-8859-1")).unwrap();
    assert!(declared.warnings.is_empty(), "{:?}", declared.warnings);
    let undeclared = read_tm33(&latin_1("UTF-8")).unwrap();
    assert_eq!(deviations(&undeclared), [WarningKind::Encoding]);
}
