//! `quasilux bsdf`: figures, documents, drawings, and files that cannot be read.

use crate::support::{Folder, Run, number, parsed};
use std::f64::consts::PI;

/// A sheet that reflects 40 % and lets 20 % through, both as Lambert says, over quarter Klems
/// patches.
pub(crate) fn sheet() -> String {
    let block = |direction: &str, share: f64| {
        let row = vec![format!("{:.12}", share / PI); 41].join(", ");
        let rows = vec![row; 41].join(",\n");
        format!(
            "<WavelengthData><LayerNumber>System</LayerNumber>\
             <Wavelength unit=\"Integral\">Visible</Wavelength>\
             <WavelengthDataBlock><WavelengthDataDirection>{direction}</WavelengthDataDirection>\
             <ColumnAngleBasis>LBNL/Klems Quarter</ColumnAngleBasis>\
             <RowAngleBasis>LBNL/Klems Quarter</RowAngleBasis>\
             <ScatteringDataType>BTDF</ScatteringDataType>\
             <ScatteringData>{rows}</ScatteringData></WavelengthDataBlock></WavelengthData>\n"
        )
    };
    let blocks: String = ["Reflection Front", "Reflection Back"]
        .map(|direction| block(direction, 0.4))
        .into_iter()
        .chain(["Transmission Front", "Transmission Back"].map(|direction| block(direction, 0.2)))
        .collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<WindowElement>\n\
         <WindowElementType>System</WindowElementType>\n\
         <Optical><Layer><Material><Name>formula</Name><Manufacturer>none</Manufacturer>\
         <Thickness unit=\"Meter\">0.002</Thickness></Material>\n<DataDefinition>\
         <IncidentDataStructure>Columns</IncidentDataStructure></DataDefinition>\n\
         {blocks}</Layer></Optical>\n\
         </WindowElement>\n"
    )
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(&format!("bsdf-{name}"));
    folder.write("sheet.xml", sheet());
    folder
}

fn bsdf(folder: &Folder, arguments: &[&str], code: i32) -> Run {
    let run = folder.quasilux(&[&["bsdf"], arguments].concat());
    assert_eq!(run.code, Some(code), "{arguments:?}: {}{}", run.stdout, run.stderr);
    run
}

#[test]
fn a_summary_has_the_figures_of_the_formula() {
    let folder = folder("summary");
    let text = bsdf(&folder, &["sheet.xml", "--strict", "--incidence", "45,90"], 0).stdout;
    for words in [
        "sheet.xml\n",
        "surface               formula",
        "WINDOW XML, Klems",
        "2 mm (counts as none)",
        "back, transmission    Klems, 41 incident directions",
        "front, light at 45\u{b0}, 90\u{b0} reflectance 40.00 %, transmittance 20.00 %",
        "back, diffuse light   reflectance 40.00 %, transmittance 20.00 %",
        "front, most scattered 60.00 %",
        "front, transmission: swapped directions differ by 0.00 % in the mean, 0.00 % at worst",
    ] {
        assert!(text.contains(words), "{words:?} in {text}");
    }
}

#[test]
fn a_document_has_all_incidences() {
    let folder = folder("document");
    let document = parsed(&bsdf(&folder, &["--json", "sheet.xml"], 0).stdout);
    assert_eq!(document["format"], "quasilux-bsdf/2");
    let surface = &document["files"][0]["surface"];
    assert_eq!(surface["tables"].as_array().map(Vec::len), Some(4));
    let incidences = surface["tables"][1]["incidences"].as_array().expect("a list");
    assert_eq!(incidences.len(), 41);
    for incidence in incidences {
        assert!((number(incidence, "/share") - 0.2).abs() < 1e-9, "{incidence}");
    }
    assert!((number(surface, "/energy/0/normal_reflectance") - 0.4).abs() < 1e-9);
    let asked = ["--json", "sheet.xml", "--incidence", "45,90"];
    let document = parsed(&bsdf(&folder, &asked, 0).stdout);
    let light = &document["files"][0]["surface"]["energy"][1]["incidences"][0];
    assert_eq!([number(light, "/theta_deg"), number(light, "/phi_deg")], [45.0, 90.0]);
    assert!((number(light, "/reflectance") - 0.4).abs() < 1e-9, "{light}");
    assert!((number(light, "/transmittance") - 0.2).abs() < 1e-9, "{light}");
    assert!(number(surface, "/reciprocity/2/mean_defect") < 1e-9);
}

#[test]
fn a_drawing_shows_each_side() {
    let folder = folder("drawing");
    bsdf(&folder, &["sheet.xml", "--svg", "lobes.svg", "--incidence", "20"], 0);
    let drawing = folder.read("lobes.svg");
    for words in ["light on the front", "light on the back", "20\u{b0}", "formula"] {
        assert!(drawing.contains(words), "{words}");
    }
}

#[test]
fn what_cannot_be_read_is_refused_by_name() {
    let folder = folder("refused");
    folder.write("words.txt", "not a surface");
    let run = bsdf(&folder, &["words.txt", "sheet.xml"], 2);
    assert!(run.stderr.contains("error: words.txt:1:1: "), "{}", run.stderr);
    assert!(run.stdout.starts_with("sheet.xml\n"), "the other file is reported");
    let replaced = bsdf(&folder, &["sheet.xml", "--svg", "sheet.xml/"], 2);
    assert!(replaced.stderr.contains("sheet.xml"), "{}", replaced.stderr);
    let beside = bsdf(&folder, &["sheet.xml", "--incidence", "95"], 2);
    assert!(beside.stderr.contains("--incidence"), "{}", beside.stderr);
}

/// A translucent wall between a lamp and a sensor, as a table and as the material that it was made
/// from.
#[test]
fn a_project_uses_the_table() {
    let folder = folder("project");
    folder.write(
        "wall.obj",
        "v 0 0 0\nv 0 4 0\nv 0 4 4\nv 0 0 4\nv 2 0 0\nv 2 4 0\nv 2 4 4\nv 2 0 4\n\
         usemtl sheet\nf 1 2 3 4\nusemtl black\nf 8 7 6 5\n",
    );
    let project = |material: &str| {
        format!(
            "[scene]\ngeometry = [\"wall.obj\"]\n[materials.black]\nreflectance = 0\n\
             [materials.sheet]\n{material}\n\
             [[lights]]\nkind = \"point\"\nposition = [-1, 2, 2]\nintensity_cd = 1000\n\
             [[sensors]]\nname = \"probe\"\nkind = \"points\"\npoints = [[1, 2, 2]]\n\
             normals = [[-1, 0, 0]]\n"
        )
    };
    folder.write("table.toml", project("kind = \"bsdf\"\nfile = \"sheet.xml\"\nup = [0, 0, 1]"));
    folder.write("formula.toml", project("reflectance = 0.4\ntransmittance = 0.2"));
    let lux = |name: &str| {
        let run = folder.quasilux(&["run", name, "--json", "--samples", "256", "--quiet"]);
        let point = parsed(&run.stdout)["sensors"][0]["points"][0].clone();
        [number(&point, "/illuminance_lx"), number(&point, "/half_width_lx")]
    };
    let [[table, a], [formula, b]] = ["table.toml", "formula.toml"].map(lux);
    assert!(formula > 1.0 && a + b < 0.05 * formula, "{table} {a}, {formula} {b}");
    assert!((table - formula).abs() < a + b, "{table} {a}, {formula} {b}");

    // No azimuth matters: without "up" the sheet is the same.
    folder.write("any.toml", project("kind = \"bsdf\"\nfile = \"sheet.xml\""));
    let [any, c] = lux("any.toml");
    assert!((any - formula).abs() < c + b, "{any} {c}, {formula} {b}");

    let uneven = sheet().replacen(",\n0.", ",\n0.9", 1);
    folder.write("uneven.xml", uneven);
    folder.write("turned.toml", project("kind = \"bsdf\"\nfile = \"uneven.xml\""));
    let run = folder.quasilux(&["run", "turned.toml"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("turned.toml:7:8: ") && run.stderr.contains("up = "),
        "{}",
        run.stderr
    );
    folder.write("stands.toml", project("kind = \"bsdf\"\nfile = \"sheet.xml\"\nup = [3, 0, 0]"));
    let run = folder.quasilux(&["run", "stands.toml"]);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("stands.toml:8:6: \"up\" is square"), "{}", run.stderr);
}
