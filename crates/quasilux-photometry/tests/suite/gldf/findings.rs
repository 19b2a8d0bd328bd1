//! What is told: turns, openings, contradictions, facts.

use super::{close, container, kinds, only, read, refused};
use crate::container::{fixed, ies, ldt, packed, product, simple, simple_product, variant};
use quasilux_photometry::{
    ContainerFact, DVec3, GldfLuminaire, LuminousShape, WarningKind, refused_format,
};

fn fact<'r>(read: &'r GldfLuminaire, name: &str) -> Option<&'r str> {
    let is_it = |fact: &&ContainerFact| fact.name == name;
    read.facts.iter().find(is_it).map(|fact| fact.value.as_str())
}

#[test]
fn a_rotation_turns_the_luminaire_and_is_told() {
    let turned = |rotation: &str| {
        read(&simple("b.ies", &ies(1, 1000.0), &format!("<Rotation>{rotation}</Rotation>")), &[])
    };
    let none = turned("<X>0</X><Y>360</Y><Z>0</Z><G0>0</G0>");
    assert_eq!(kinds(&none), []);
    let luminaire = turned("<X>0</X><Y>0</Y><Z>0</Z><G0>90</G0>");
    let turn = luminaire.luminaire_from_photometry;
    // More light along C0 of the file: C90 of the luminaire.
    assert!((turn * DVec3::X - DVec3::Y).length() < 1e-12);
    let told = only(&luminaire.warnings, WarningKind::EmitterTurned);
    assert!(told.contains("X 0, Y 0, Z 0, G0 90 degrees"), "{told}");
    assert_eq!(fact(&luminaire, "rotation"), Some("X 0, Y 0, Z 0, G0 90 degrees"));
    let up = turned("<X>180</X>").luminaire_from_photometry;
    assert!((up * DVec3::NEG_Z - DVec3::Z).length() < 1e-12);
    refused(&simple("b.ies", &ies(1, 1000.0), "<Rotation><X>left</X></Rotation>"), &[]);
}

fn with_geometry(content: &str, emitter: &str, rotation: &str) -> Vec<u8> {
    let more = format!("<Rotation>{rotation}</Rotation>");
    let definitions = crate::container::photometries(&["b.ies"])
        + &format!(
            "<Emitters><Emitter id=\"e\">{}</Emitter></Emitters><Geometries><SimpleGeometry \
             id=\"g\"><Cuboid><Width>200</Width><Length>1600</Length><Height>60</Height></Cuboid>\
             {emitter}</SimpleGeometry></Geometries>",
            fixed("b.ies", &more, "")
        );
    let variants = "<Variant id=\"v\"><Name>V</Name><Geometry><SimpleGeometryReference \
        geometryId=\"g\" emitterId=\"e\"/></Geometry></Variant>";
    packed(&product(&definitions, variants), "b.ies", content)
}

#[test]
fn a_simple_geometry_gives_the_opening() {
    const RECTANGLE: &str = "<RectangularEmitter><Width>60</Width><Length>1500</Length>\
        </RectangularEmitter><C-Heights><C0>10</C0><C90>0</C90><C180>12</C180><C270>0</C270>\
        </C-Heights>";
    const CIRCLE: &str = "<CircularEmitter><Diameter>300</Diameter></CircularEmitter>";
    let point = ies(1, 1000.0).replace("0.1 1.2 0", "0 0 0");
    let shape = |bytes: &[u8]| -> LuminousShape { read(bytes, &[]).photometry.facts().shape() };
    // Widths along C0-C180, lengths along C90-C270.
    let box_m = shape(&with_geometry(&point, RECTANGLE, ""));
    assert!((box_m.size_m() - DVec3::new(0.06, 1.5, 0.012)).length() < 1e-12, "{box_m:?}");
    // In the frame of a photometry that is turned by 90 degrees they change places.
    let turned = shape(&with_geometry(&point, RECTANGLE, "<G0>90</G0>"));
    assert!((turned.size_m() - DVec3::new(1.5, 0.06, 0.012)).length() < 1e-12, "{turned:?}");
    let disk = shape(&with_geometry(&point, CIRCLE, "<X>180</X>"));
    assert_eq!((disk.name(), disk.size_m().x), ("disk", 0.3));
    // Heights that differ by side are told, and equal ones are not.
    let luminaire = read(&with_geometry(&point, RECTANGLE, ""), &[]);
    let told = only(&luminaire.warnings, WarningKind::ContainerOpening);
    assert!(told.contains("10, 0, 12, 0 mm; expected the same on all sides (12 mm"), "{told}");
    let flat = RECTANGLE.split_once("<C-H").unwrap().0;
    assert_eq!(kinds(&read(&with_geometry(&point, flat, ""), &[])), []);
    let below = RECTANGLE.replace(">0<", ">-5<");
    close(shape(&with_geometry(&point, &below, "")).size_m().z, 0.012);
    // An opening without a length is told too.
    let short = flat.replace("<Length>1500</Length>", "");
    let luminaire = read(&with_geometry(&point, &short, ""), &[]);
    assert!(luminaire.photometry.facts().shape().is_point());
    let told = only(&luminaire.warnings, WarningKind::MissingElement);
    assert!(told.contains("RectangularEmitter without its Length"), "{told}");
    // It counts before the opening of the file, which is told.
    let other = read(&with_geometry(&ies(1, 1000.0), flat, ""), &[]);
    close(other.photometry.facts().shape().size_m().y, 1.5);
    let told = only(&other.warnings, WarningKind::ContainerOpening);
    assert!(told.contains("a luminous rectangle of 0.060 x 1.500 x 0.000 m"), "{told}");
    let aslant = read(&with_geometry(&point, flat, "<Y>30</Y>"), &[]);
    assert!(aslant.photometry.facts().shape().is_point());
    assert_eq!(kinds(&aslant), [WarningKind::EmitterTurned, WarningKind::ContainerOpening]);
}

fn described(file: &str, content: &str, description: &str) -> GldfLuminaire {
    let reference = format!("<PhotometryFileReference fileId=\"f-{file}\"/>");
    let described =
        format!("{reference}<DescriptivePhotometry>{description}</DescriptivePhotometry>");
    let product = simple_product(file, "").replace(&reference, &described);
    read(&packed(&product, file, content), &[])
}

#[test]
fn figures_that_contradict_the_photometry_are_told() {
    // I0 (1 - 2 gamma / pi): flux below gamma is 1 - 2/pi sin gamma - (1 - 2 gamma / pi) cos gamma
    // over 1 - 2/pi: 0.49, 0.78, 0.95 of it in the cones of the CIE flux code.
    let inside = |gamma: f64| {
        let x = 2.0 / std::f64::consts::PI;
        let (sin, cos) = libm::sincos(gamma);
        (1.0 - x * sin - (1.0 - x * gamma) * cos) / (1.0 - x)
    };
    let code = [0.75, 0.5, 0.25].map(|cosine| 100.0 * inside(libm::acos(cosine)));
    let [a, b, c] = code.map(f64::round);
    let right = format!(
        "<LightOutputRatio>1</LightOutputRatio><LuminousEfficacy>50</LuminousEfficacy>\
         <DownwardFluxFraction>1.0</DownwardFluxFraction><CIE-FluxCode>{a} {b} {c} 100 100\
         </CIE-FluxCode><UGR-4H8H-70-50-20-LQ><X>99</X><Y>1</Y></UGR-4H8H-70-50-20-LQ>"
    );
    assert_eq!(kinds(&described("a.ldt", &ldt(1, 1000.0), &right)), []);
    // The fifth figure is that of lamps: absolute photometry has none.
    let half = right.replace("100 100<", "100 50<");
    assert_eq!(kinds(&described("a.ldt", &ldt(-1, 1000.0), &half)), []);
    let differs = WarningKind::DescriptionDiffers;
    assert_eq!(kinds(&described("a.ldt", &ldt(1, 1000.0), &half)), [differs]);
    for (wrong, said) in [
        ("<LightOutputRatio>0.75</LightOutputRatio>", "LightOutputRatio 0.75; expected 1.000"),
        ("<DownwardFluxFraction>0.5</DownwardFluxFraction>", "DownwardFluxFraction 0.5; expected"),
        ("<UpwardLightOutputRatio>0.1</UpwardLightOutputRatio>", "UpwardLightOutputRatio 0.1"),
        ("<LuminousEfficacy>110</LuminousEfficacy>", "110.0 lm/W; expected 50.0 lm/W"),
        ("<CIE-FluxCode>60 90 99 100 100</CIE-FluxCode>", "\"60 90 99 100 100\"; expected"),
        ("<CIE-FluxCode>narrow</CIE-FluxCode>", "\"narrow\"; expected five numbers"),
    ] {
        let luminaire = described("a.ldt", &ldt(1, 1000.0), wrong);
        let told = only(&luminaire.warnings, differs);
        assert!(told.contains(said), "{told}");
    }
}

#[test]
fn mountings_maintenance_and_power_are_facts() {
    let source = "<LightSources><FixedLightSource id=\"led\"><Name>LED</Name><RatedInputPower>18\
        </RatedInputPower><ActivePowerTable type=\"Default\"><FluxFactor inputPower=\"0.2\">0.1\
        </FluxFactor></ActivePowerTable><ColorInformation><CorrelatedColorTemperature>3000\
        </CorrelatedColorTemperature></ColorInformation><LightSourceMaintenance lifetime=\"50000\">\
        <LedMaintenanceFactor hours=\"25000\">0.9</LedMaintenanceFactor></LightSourceMaintenance>\
        </FixedLightSource></LightSources>";
    let light = fixed("a.ldt", "<LightSourceReference fixedLightSourceId=\"led\"/>", "");
    let definitions = format!("{source}<Emitters><Emitter id=\"e\">{light}</Emitter></Emitters>");
    let mountings = "<Mountings><Ceiling><Recessed recessedDepth=\"80\"/><Pendant \
        pendantLength=\"1500\"/></Ceiling><Wall mountingHeight=\"2400\"><SurfaceMounted/></Wall>\
        </Mountings><Geometry>";
    let variants = variant("v", "e").replace("<Geometry>", mountings);
    let luminaire = read(&container(&definitions, &variants), &[]);
    for (name, value) in [
        ("variant", "v, Name of v"),
        ("light source", "LED"),
        ("power", "18 W"),
        ("dimming", "flux 0.1 at 0.2 of the power"),
        ("colour", "3000 K"),
        ("maintenance", "LLMF 0.9 at 25000 h, lifetime 50000 h (not applied)"),
        (
            "mounting",
            "ceiling recessed (recessed depth 80 mm), pendant (pendant length 1500 mm), wall \
             (mounting height 2400 mm) surface mounted",
        ),
    ] {
        assert_eq!(fact(&luminaire, name), Some(value));
    }
    close(luminaire.photometry.flux_lm(), 1000.0);
    assert_eq!(luminaire.photometry.facts().input_watts, 18.0);
    assert_eq!(luminaire.photometry.facts().keyword("MANUFAC"), Some("quasilux tests"));
}

#[test]
fn formats_of_single_programs_are_refused_with_advice() {
    for (name, program) in [("a.uld", "DIALux"), ("b/a.ROLF", "Relux"), ("a.rolfz", "Relux")] {
        let refused = refused_format(name).unwrap();
        assert!(refused.contains(program) && refused.contains("ask the maker"), "{refused}");
    }
    assert_eq!(refused_format("a.gldf"), None);
}

#[test]
fn an_output_ratio_of_absolute_photometry_is_not_compared() {
    let ratio = "<LightOutputRatio>0.8</LightOutputRatio>";
    assert_eq!(kinds(&described("b.ies", &ies(1, -1.0), ratio)), []);
    assert_eq!(
        kinds(&described("a.ldt", &ldt(1, 1000.0), ratio)),
        [WarningKind::DescriptionDiffers]
    );
}

#[test]
fn facts_and_warnings_are_bounded() {
    let long = "very long ".repeat(100_000);
    let references = "<EmitterReference/>".repeat(5_000);
    let product = simple_product("a.ldt", &format!("<Name>{long}\u{7f}\u{9b}</Name>"))
        .replace("<Geometry>", &format!("<Geometry>{references}"));
    let luminaire = read(&packed(&product, "a.ldt", &ldt(1, 1000.0)), &[]);
    for fact in &luminaire.facts {
        assert!(fact.value.chars().count() <= 403, "{}", fact.value.len());
        assert!(!fact.value.contains(char::is_control), "{:?}", fact.value);
    }
    assert_eq!(luminaire.warnings.len(), 201);
    let last = luminaire.warnings.last().unwrap().warning.to_string();
    assert!(last.contains("more deviations; expected no more than 200"), "{last}");
    let first = luminaire.warnings[0].warning.to_string();
    assert!(first.contains("EmitterReference without an emitter"), "{first}");
    let many = "<Emitter id=\"x\"/>".repeat(501);
    let definitions = format!("<Emitters>{many}</Emitters>");
    let none = "<Variant id=\"v\"/>";
    let message = refused(&container(&definitions, none), &[]);
    assert!(message.contains("no more than 500 emitters of a product"), "{message}");
}
