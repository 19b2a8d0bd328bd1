//! WINDOW files made up for one property each.

use super::direction;
use glam::DVec3;
use quasilux_bsdf::WarningKind;
use quasilux_bsdf::{Distribution, KlemsTable, Parsed, ScatteringMode, Side, read_bsdf_xml};
use std::f64::consts::PI;

/// Two bands: the cap up to 30 degrees, and four patches.
const BASIS: &str = "<AngleBasis><AngleBasisName>five</AngleBasisName>\
    <AngleBasisBlock><ThetaBounds><LowerTheta>0</LowerTheta><UpperTheta>30</UpperTheta>\
    </ThetaBounds>\
    <nPhis>1</nPhis></AngleBasisBlock>\
    <AngleBasisBlock><ThetaBounds><LowerTheta>30</LowerTheta><UpperTheta>90</UpperTheta>\
    </ThetaBounds>\
    <nPhis>4</nPhis></AngleBasisBlock></AngleBasis>";

fn file(structure: &str, data: &str) -> String {
    format!(
        "<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>{structure}\
         </IncidentDataStructure>{BASIS}</DataDefinition>\n\
         {data}\n</Layer></Optical></WindowElement>"
    )
}

fn block(spectrum: &str, direction: &str, bases: &str, values: &str) -> String {
    format!(
        "<WavelengthData><Wavelength>{spectrum}</Wavelength><WavelengthDataBlock>\
         <WavelengthDataDirection>{direction}</WavelengthDataDirection>{bases}<ScatteringData>\
         {values}</ScatteringData></WavelengthDataBlock></WavelengthData>"
    )
}

fn matrix(direction: &str, values: &str) -> String {
    let bases = "<ColumnAngleBasis>Five</ColumnAngleBasis><RowAngleBasis>FIVE</RowAngleBasis>";
    block("Visible", direction, bases, values)
}

fn tree(direction: &str, values: &str) -> String {
    block("Visible", direction, "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>", values)
}

fn read(text: &str) -> Parsed {
    read_bsdf_xml(text.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

fn scattering(read: &Parsed, side: Side, mode: ScatteringMode) -> &Distribution {
    read.bsdf.scattering(side, mode).unwrap()
}

/// 25 values that tell their place: row and column as tenths and hundredths.
fn places() -> String {
    let value = |i: usize| format!("0.{}{}", i / 5 + 1, i % 5 + 1);
    (0..25).map(value).collect::<Vec<_>>().join(",\n\t")
}

/// Patch 1 is around azimuth 0 of the direction that light goes to.
#[test]
fn columns_and_rows_are_incident_patches() {
    for (structure, expected) in [("columns", [0.31, 0.13]), ("Rows", [0.13, 0.31])] {
        let read = read(&file(structure, &matrix("reflection front", &places())));
        let front = scattering(&read, Side::Front, ScatteringMode::Reflection);
        // Patch 2 is around azimuth 90 degrees.
        let to_patch_2 = direction(60.0, 90.0);
        assert_eq!(front.evaluate(DVec3::Z, to_patch_2)[0], expected[0]);
        let onwards_to_patch_2 = direction(60.0, 270.0);
        assert_eq!(front.evaluate(onwards_to_patch_2, DVec3::Z)[0], expected[1]);
        assert_eq!(front.evaluate(DVec3::Z, -DVec3::Z), [0.0; 3]);
    }
}

#[test]
fn a_matrix_has_its_values_by_incident_patch() {
    for (structure, second) in [("columns", [0.12, 0.22]), ("Rows", [0.21, 0.22])] {
        let read = read(&file(structure, &matrix("reflection front", &places())));
        let Distribution::Klems(table) = scattering(&read, Side::Front, ScatteringMode::Reflection)
        else {
            panic!("patches make a matrix");
        };
        assert_eq!(table.values().len(), 25);
        assert_eq!(table.values()[5..7], second);
    }
}

#[test]
fn a_matrix_knows_its_albedo() {
    let read = read(&file("Columns", &matrix("Reflection Back", &places())));
    let back = scattering(&read, Side::Back, ScatteringMode::Reflection);
    let (cap, patch) = (0.25 * PI, 0.75 * PI / 4.0);
    let column_1 = cap * 0.11 + patch * (0.21 + 0.31 + 0.41 + 0.51);
    assert!((back.albedo(DVec3::Z)[0] - column_1).abs() < 1e-14);
    let energy = read.bsdf.analysis().clone().energy;
    assert_eq!(energy.len(), 1);
    assert!((energy[0].normal[0] - column_1).abs() < 1e-14 && energy[0].normal[1] == 0.0);
    // The last column is the greatest.
    let worst = cap * 0.15 + patch * (0.25 + 0.35 + 0.45 + 0.55);
    assert!((energy[0].worst - worst).abs() < 1e-14, "{}", energy[0].worst);
}

/// Rank 3: sines below and above a half, the exit turned with the incidence.
#[test]
fn an_isotropic_tree_turns_with_the_incidence() {
    // Boxes of the incident axis, of the first exit axis and of the second: the first is the
    // slowest.
    let text = file(
        "TensorTree3",
        &tree("Reflection Front", "{ {1 2 3 4 5 6 7 8}".replace("{ {", "{ ").as_str()),
    );
    let text = text.replace("7 8</", "7 8 }</");
    let read = read(&text);
    let front = scattering(&read, Side::Front, ScatteringMode::Reflection);
    assert!(front.is_isotropic() && front.incidences().len() == 1);
    for turn_deg in [0.0, 77.0, 200.0] {
        // Light goes to azimuth `turn_deg`; the incident axis above a half is not in use.
        let wi = direction(20.0, turn_deg + 180.0);
        let at = |phi_deg| front.evaluate(wi, direction(50.0, turn_deg + phi_deg))[0];
        assert_eq!([at(225.0), at(135.0), at(-45.0), at(45.0)], [1.0, 2.0, 3.0, 4.0]);
        assert!((front.albedo(wi)[0] - 2.5 * PI).abs() < 1e-14);
    }
}

/// A branch of rank 4 whose only lit leaf is child 0b0110: the incident square's upper half along
/// y, the exit square's upper half along x. From the other side directions are swapped.
#[test]
fn an_anisotropic_tree_is_turned_round_exactly() {
    let leaves: String = (0..16).map(|n| if n == 0b0110 { "{ 1 }" } else { "{ 0 }" }).collect();
    let read = read(&file("TensorTree4", &tree("Transmission Front", &format!("{{ {leaves} }}"))));
    assert_eq!(read.warnings[0].kind(), WarningKind::ByReciprocity, "{:?}", read.warnings);
    let front = scattering(&read, Side::Front, ScatteringMode::Transmission);
    let back = scattering(&read, Side::Back, ScatteringMode::Transmission);
    assert!(!front.is_isotropic());
    // Light goes to azimuth 135 degrees, and leaves towards -45.
    let (wi, wo) = (direction(40.0, -45.0), direction(40.0, -45.0));
    assert_eq!(front.evaluate(wi, wo), [1.0; 3]);
    assert_eq!(front.evaluate(wi, direction(40.0, 45.0)), [0.0; 3]);
    for (theta_i, phi_i, theta_o, phi_o) in
        [(40.0, -45.0, 40.0, -45.0), (30.0, 130.0, 60.0, 170.0), (10.0, 0.0, 20.0, 100.0)]
    {
        let (a, b) = (direction(theta_i, phi_i), direction(theta_o, phi_o));
        assert_eq!(front.evaluate(a, b), back.evaluate(b, a));
    }
    let reciprocity = read.bsdf.analysis().clone().reciprocity;
    assert!(reciprocity.len() == 1 && reciprocity[0].mean == 0.0, "{reciprocity:?}");
}

/// Two patches of a half each; f is 1 or 3 by the incident one alone: a quarter of pairs have 1, a
/// quarter 3, and half both.
#[test]
fn reciprocity_is_measured() {
    let two = file("Columns", &matrix("Reflection Front", "0.1 0.3 0.1 0.3"));
    let cap = two.find("<AngleBasisBlock>").unwrap();
    let bands = two.rfind("</AngleBasisBlock>").unwrap();
    let band =
        "<AngleBasisBlock><ThetaBounds><UpperTheta>90</UpperTheta></ThetaBounds><nPhis>2</nPhis>";
    let read = read(&(two[..cap].to_owned() + band + &two[bands..]));
    let reciprocity = &read.bsdf.analysis().clone().reciprocity[0];
    let expected = 0.5 * 2.0 / (0.25 + 0.25 * 3.0 + 0.5 * 3.0);
    assert!((reciprocity.mean - expected).abs() < 1e-12, "{}", reciprocity.mean);
    assert!((reciprocity.worst - 2.0 / 3.0).abs() < 1e-12);
    let warning = read.warnings.last().unwrap();
    assert_eq!(warning.kind(), WarningKind::NotReciprocal);
    assert!(warning.to_string().contains("by 40.0 % in the mean"), "{warning}");
}

/// Exactly: as much diffuse light passes one way as the other, and swapped directions have the
/// same value.
#[test]
fn transmission_from_the_other_side_is_reciprocal() {
    let read_matrix = read(&file("Columns", &matrix("Transmission Back", &places())));
    assert_eq!(read_matrix.warnings[0].kind(), WarningKind::ByReciprocity);
    let reciprocity = &read_matrix.bsdf.analysis().clone().reciprocity;
    assert_eq!((reciprocity[0].mode, reciprocity[0].mean), (ScatteringMode::Transmission, 0.0));

    let Some(bsdf) = super::surface("tt-pyradiance-t3.xml") else {
        return;
    };
    let energy = bsdf.analysis().clone().energy;
    let passed = [0, 1].map(|side: usize| energy[side].diffuse[1]);
    println!("diffuse transmittance {:.5} and {:.5}", passed[0], passed[1]);
    assert!((passed[0] / passed[1] - 1.0).abs() < 1e-12, "{passed:?}");
    let reciprocity = &bsdf.analysis().clone().reciprocity;
    let passing =
        reciprocity.iter().find(|found| found.mode == ScatteringMode::Transmission).unwrap();
    assert!(passing.mean < 1e-12, "{passing:?}");
}

/// A few boxes of the twelfth level in a file of a thousand bytes: 4096 boxes a side when it is
/// turned round.
#[test]
fn deep_trees_are_turned_round_too() {
    let mut values = "{ 0.5 }".to_owned();
    for level in 0..12_u32 {
        let child = |n: u32| match n {
            n if n == [7, 0, 6, 1][level as usize % 4] => values.clone(),
            n => format!("{{ 0.{n} }}"),
        };
        values = format!("{{ {} }}", (0..8).map(child).collect::<String>());
    }
    let read = read(&file("TensorTree3", &tree("Transmission Back", &values)));
    let [front, back] = Side::ALL.map(|side| scattering(&read, side, ScatteringMode::Transmission));
    let energy = &read.bsdf.analysis().clone().energy;
    let passed = [0, 1].map(|side: usize| energy[side].diffuse[1]);
    assert!(passed[0] > 0.1 && (passed[0] / passed[1] - 1.0).abs() < 1e-12, "{passed:?}");
    for (a, b) in [(3.0, 80.0), (45.0, 45.0), (70.0, 20.0)] {
        let (a, b) = (direction(a, 33.0), direction(b, 217.0));
        assert_eq!(front.evaluate(a, b), back.evaluate(b, a));
    }
}

#[test]
fn what_is_odd_is_told() {
    let ones = "1 ".repeat(25);
    let material =
        "<Material><Name> a &amp; b </Name><Thickness unit=\"Inch\">2</Thickness></Material>";
    let plain = file("Columns", &(material.to_owned() + &matrix("Reflection Front", &places())));
    let read_plain = read(&plain);
    assert_eq!(read_plain.bsdf.facts().name, "a & b");
    assert_eq!(read_plain.bsdf.facts().thickness_m, Some(0.0508));

    let two = matrix("Reflection Front", &ones) + &matrix("Reflection Front", &places());
    let solar = matrix("Reflection Front", &places()).replace("Visible", "Solar");
    let colour = matrix("Reflection Front", &places()) + &solar.replace("Solar", "CIE-X");
    let other = matrix("Absorptance Front", "1") + &matrix("Reflection Front", &places());
    let negative = places().replace("0.55", "-0.55");
    let cases = [
        (format!("a message\n{plain}"), WarningKind::Foreword),
        (plain.replace("</Optical>", "<Layer/></Optical>"), WarningKind::SeveralLayers),
        (plain.replace("Inch", "mil"), WarningKind::UnknownThickness),
        (file("Columns", &two), WarningKind::RepeatedBlock),
        (file("Columns", &solar), WarningKind::SolarOnly),
        (file("Columns", &colour), WarningKind::ColourLeftOut),
        (file("Columns", &other), WarningKind::UnknownDirection),
        (
            file("Columns", &matrix("Reflection Front", &(places() + " 7"))),
            WarningKind::TrailingValues,
        ),
        (file("Columns", &matrix("Reflection Front", &negative)), WarningKind::NegativeScattering),
        (plain.replace(">2</Thick", ">-2</Thick"), WarningKind::UnknownThickness),
        (file("Columns", &matrix("Reflection Front", &ones)), WarningKind::EnergyNotConserved),
    ];
    for (text, deviation) in cases {
        let read = read(&text);
        let found: Vec<WarningKind> = read.warnings.iter().map(|w| w.kind()).collect();
        assert!(found.contains(&deviation), "{found:?} without {deviation:?}");
        assert!(matches!(
            scattering(&read, Side::Front, ScatteringMode::Reflection),
            Distribution::Klems(_)
        ));
    }
}

#[test]
fn what_is_no_surface_is_refused_with_its_place() {
    let plain = file("Columns", &matrix("Reflection Front", &places()));
    let of_tree = |rank: u32, values: &str| {
        file(&format!("TensorTree{rank}"), &tree("Reflection Front", values))
    };
    let deep = |levels: usize| "{".repeat(levels) + "1";
    for (text, line, expected) in [
        ("<IESTM33-22/>".to_owned(), 1, "WindowElement"),
        (plain.replace("0.55", "1e9"), 2, "no more than 100 %"),
        (plain.replace("Layer>", "Coating>"), 1, "the optical layer"),
        (plain.replace("Columns", "Cells"), 1, "Columns, Rows"),
        (plain.replace("<UpperTheta>30", "<UpperTheta>95"), 1, "95, where the one before it ends"),
        (plain.replace(">30<", ">95<"), 1, "ascend to 90 degrees"),
        (plain.replace("<nPhis>4", "<nPhis>4.5"), 1, "a number of patches"),
        (plain.replace("FIVE", "six"), 2, "a basis that the file defines"),
        (plain.replace("0.55", "many"), 26, "a value in 1/sr"),
        (plain.replace(",\n\t0.55", ""), 25, "25: 5 incident by 5 exit patches"),
        (plain.replace("Visible", "NIR"), 2, "WavelengthData with Wavelength Visible"),
        (plain.replace("Reflection", "Absorption"), 2, "a usable block"),
        (of_tree(3, "{ 1 2 3 }"), 2, "1, 8, 64 .. values"),
        (of_tree(4, "{ {1} {2} }"), 2, "{, for each of 16 nodes"),
        (of_tree(3, "1"), 2, "{, for each of 8 nodes"),
        (of_tree(3, "{ 1"), 2, "a value or }"),
        (of_tree(3, &deep(14)), 2, "no more than 12 levels"),
        (of_tree(3, "{ }"), 2, "1, 8, 64 .. values"),
    ] {
        let error = read_bsdf_xml(text.as_bytes()).expect_err(expected);
        let message = error.to_string();
        assert!(message.contains(expected), "{message} for {expected}");
        assert_eq!(error.line(), line, "{message}");
    }
}

/// A wrong number of values, or one that is not a number, is no table.
#[test]
fn tables_are_checked() {
    use quasilux_bsdf::{AngleBasis, BandDefinition};
    let basis = || AngleBasis::new("cap", &[BandDefinition::new(90.0, 2)]).unwrap();
    assert!(KlemsTable::new(basis(), basis(), vec![1.0; 4]).is_some());
    assert!(KlemsTable::new(basis(), basis(), vec![1.0; 3]).is_none());
    assert!(KlemsTable::new(basis(), basis(), vec![1.0, f64::NAN, 1.0, 1.0]).is_none());
    assert!(KlemsTable::new(basis(), basis(), vec![1.0, -1.0, 1.0, 1.0]).is_none());
}

fn messages(read: &Parsed, deviation: WarningKind) -> Vec<String> {
    let meant = read.warnings.iter().filter(|warning| warning.kind() == deviation);
    meant.map(|warning| warning.message()).collect()
}

/// Data of the system count, not those of a layer behind them.
#[test]
fn layers_of_a_system_are_left_out() {
    let of_layer = |number: &str, values: &str| {
        let data = matrix("Reflection Front", values);
        data.replace("<Wavelength>", &format!("<LayerNumber>{number}</LayerNumber><Wavelength>"))
    };
    let (system, layer) = (of_layer("System", &places()), of_layer("1", &"0.2 ".repeat(25)));
    for both in [system.clone() + &layer, layer.clone() + &system] {
        let read = read(&file("Columns", &both));
        let front = scattering(&read, Side::Front, ScatteringMode::Reflection);
        assert_eq!(front.evaluate(DVec3::Z, DVec3::Z)[0], 0.11);
        let found = messages(&read, WarningKind::LayersLeftOut);
        assert!(found.len() == 1 && found[0].starts_with("found LayerNumber \"1\""), "{found:?}");
        assert!(messages(&read, WarningKind::RepeatedBlock).is_empty());
    }
    assert!(messages(&read(&file("Columns", &layer)), WarningKind::LayersLeftOut).is_empty());
}

/// Something passes, so the sheet has two sides; an opaque sample lacks nothing.
#[test]
fn a_missing_reflection_is_told() {
    let [reflected, passed] =
        ["Reflection Front", "Transmission Front"].map(|direction| matrix(direction, &places()));
    let opaque = read(&file("Columns", &reflected));
    assert!(messages(&opaque, WarningKind::MissingReflection).is_empty());
    let found =
        messages(&read(&file("Columns", &(reflected + &passed))), WarningKind::MissingReflection);
    assert!(found.len() == 1 && found[0].starts_with("found no Reflection back;"), "{found:?}");
    let found = messages(&read(&file("Columns", &passed)), WarningKind::MissingReflection);
    assert!(
        found[0].starts_with("found no Reflection front;") && found[0].ends_with("(and 1 more)")
    );
}

#[test]
fn a_basis_that_ends_early_is_told() {
    let whole = file("Columns", &matrix("Reflection Front", &places()));
    assert!(messages(&read(&whole), WarningKind::BasisEndsEarly).is_empty());
    let cut = read(&whole.replace("<UpperTheta>90", "<UpperTheta>80"));
    let found = messages(&cut, WarningKind::BasisEndsEarly);
    assert!(found[0].starts_with("found the basis \"five\" that ends 80.0 degrees"), "{found:?}");
}

/// The same in all patches of a band, whatever differs between bands: such a sheet may be turned.
#[test]
fn a_matrix_without_azimuths_is_isotropic() {
    // Incident patches are columns: the cap, then a band of four; so are exit patches in rows.
    let row = |cap: f64, band: f64| format!("{cap} {band} {band} {band} {band}\n");
    let even = row(0.1, 0.2) + &row(0.3, 0.4).repeat(4);
    for (values, expected) in [
        (even.clone(), true),
        (row(0.1, 0.2) + &row(0.3, 0.4).repeat(3) + &row(0.3, 0.5), false),
        (even.replacen("0.2\n", "0.25\n", 1), false),
        (places(), false),
    ] {
        let read = read(&file("Columns", &matrix("Reflection Front", &values)));
        assert_eq!(read.bsdf.is_isotropic(), expected, "{values}");
    }
}
