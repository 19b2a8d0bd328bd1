//! From the dimensions of a file to the shape that shines.

use crate::corpus::{name, published_files, published_files_of};
use glam::DVec3;
use quasilux_photometry::{
    IesStandard, LuminousOpening, LuminousShape, Standard, WarningKind, read_ies, read_ldt,
    write_ies, write_ldt,
};

fn shape(edition: IesStandard, [width_m, length_m, height_m]: [f64; 3]) -> LuminousShape {
    let opening = LuminousOpening { width_m, length_m, height_m };
    LuminousShape::from_opening(Standard::Lm63(edition), &opening)
}

/// Width, length and height; what 1986, 1995 and 2002 make of them; extents along x, y, z in 2002.
#[test]
fn signs_mean_what_the_edition_says() {
    let vertical = "vertical elliptical cylinder";
    let horizontal = "horizontal elliptical cylinder";
    let table = [
        ([0.0, 0.0, 0.0], ["point"; 3], [0.0, 0.0, 0.0]),
        ([0.0, 2.0, 0.0], ["line"; 3], [2.0, 0.0, 0.0]),
        ([1.0, 2.0, 0.0], ["rectangle"; 3], [2.0, 1.0, 0.0]),
        ([1.0, 0.0, 3.0], ["rectangle"; 3], [0.0, 1.0, 3.0]),
        ([1.0, 2.0, 3.0], ["box"; 3], [2.0, 1.0, 3.0]),
        ([-1.0, 0.0, 0.0], ["disk"; 3], [1.0, 1.0, 0.0]),
        ([-1.0, 0.0, 3.0], ["vertical cylinder"; 3], [1.0, 1.0, 3.0]),
        ([-1.0, 0.0, -1.0], ["upright disk", "sphere", "upright disk"], [0.0, 1.0, 1.0]),
        ([-1.0, 0.0, -3.0], ["upright ellipse"; 3], [0.0, 1.0, 3.0]),
        ([-1.0, 2.0, 0.0], ["ellipse"; 3], [2.0, 1.0, 0.0]),
        ([-1.0, 2.0, 3.0], ["ellipsoid", vertical, vertical], [2.0, 1.0, 3.0]),
        ([1.0, -2.0, 3.0], [vertical; 3], [2.0, 1.0, 3.0]),
        ([0.0, 2.0, -1.0], ["horizontal cylinder"; 3], [2.0, 1.0, 1.0]),
        ([2.0, 0.0, -1.0], ["horizontal cylinder"; 3], [1.0, 2.0, 1.0]),
        (
            [-1.0, 2.0, -1.0],
            ["horizontal cylinder", "ellipsoid", "horizontal cylinder"],
            [2.0, 1.0, 1.0],
        ),
        ([-1.0, 2.0, -3.0], [horizontal, "ellipsoid", horizontal], [2.0, 1.0, 3.0]),
        (
            [2.0, -1.0, -1.0],
            ["horizontal cylinder", "ellipsoid", "horizontal cylinder"],
            [1.0, 2.0, 1.0],
        ),
        ([-1.0, -1.0, 0.0], ["disk"; 3], [1.0, 1.0, 0.0]),
        ([-1.0, -2.0, 0.0], ["ellipse"; 3], [2.0, 1.0, 0.0]),
        ([-1.0, -1.0, 3.0], ["vertical cylinder"; 3], [1.0, 1.0, 3.0]),
        ([-1.0, -2.0, 3.0], [vertical; 3], [2.0, 1.0, 3.0]),
        ([-1.0, -1.0, -1.0], ["sphere"; 3], [1.0, 1.0, 1.0]),
        ([-1.0, -2.0, -3.0], ["ellipsoid"; 3], [2.0, 1.0, 3.0]),
        ([0.0, -1.0, 0.0], ["point"; 3], [0.0, 0.0, 0.0]),
        ([0.0, 0.0, -1.0], ["point"; 3], [0.0, 0.0, 0.0]),
        ([-1.0, f64::NAN, 0.0], ["disk"; 3], [1.0, 1.0, 0.0]),
    ];
    for (dimensions, names, size) in table {
        for (edition, column) in IesStandard::ALL.into_iter().zip([0, 0, 1, 2, 2]) {
            let found = shape(edition, dimensions).name();
            assert_eq!(found, names[column], "{dimensions:?} in {edition:?}");
        }
        let found = shape(IesStandard::Lm63Of2002, dimensions).size_m();
        assert_eq!(found, DVec3::from_array(size), "{dimensions:?}");
    }
}

#[test]
fn signs_of_another_edition_are_warned_of() {
    let deviations = |first_line: &str, dimensions: &str| -> Vec<WarningKind> {
        let text = format!(
            "{first_line}\nTILT=NONE\n1 -1 1 2 1 1 2 {dimensions}\n1 1 10\n0 180\n0\n100 100\n"
        );
        let read = read_ies(text.as_bytes()).unwrap();
        read.warnings.iter().map(|warning| warning.kind()).collect()
    };
    let (other, unknown) = (WarningKind::OpeningOfOtherEdition, WarningKind::UnknownOpening);
    assert_eq!(deviations("IESNA:LM-63-2002", "-1 -1 0"), []);
    assert_eq!(deviations("IESNA:LM-63-2002", "-1 0 0"), [other]);
    assert_eq!(deviations("IESNA:LM-63-2002", "0 -1 0"), [unknown]);
    assert_eq!(deviations("IESNA:LM-63-1995", "-1 0 -1"), []);
    assert_eq!(deviations("IESNA:LM-63-1995", "-1 -1 0"), [other]);
    assert_eq!(deviations("IESNA91", "-1 0 0"), []);
    assert_eq!(deviations("IESNA91", "1 1 0"), []);
}

/// Published test files whose names say the shape of their opening.
#[test]
fn published_openings_are_what_their_names_say() {
    let Some(files) = published_files() else {
        return;
    };
    let expected = [
        ("pv-point_opening", "point", [0.0, 0.0, 0.0]),
        ("pv-rectangular_opening", "rectangle", [0.34, 0.12, 0.0]),
        ("pv-round_opening_with_height", "vertical cylinder", [0.12, 0.12, 0.34]),
        ("pv-sphere_opening", "sphere", [0.12, 0.12, 0.12]),
        ("pv-horizontal_cylinder_opening_along_length", "horizontal cylinder", [0.12, 0.34, 0.34]),
        ("pv-ellipse_opening_along_length", "vertical elliptical cylinder", [0.34, 0.12, 0.56]),
        ("pv-ellipse_opening_along_width", "vertical elliptical cylinder", [0.34, 0.12, 0.56]),
        ("pv-ellipsoid_opening_along_length", "ellipsoid", [0.34, 0.12, 0.56]),
        ("pv-ellipsoid_opening_along_width", "ellipsoid", [0.34, 0.12, 0.56]),
    ];
    let mut found = 0;
    for file in files {
        let bytes = std::fs::read(&file).unwrap();
        let stem = name(&file).trim_end_matches(".ies").to_owned();
        let Some((_, shape_name, size)) = expected.iter().find(|(name, ..)| *name == stem) else {
            continue;
        };
        let shape = read_ies(&bytes).unwrap().photometry.facts().shape();
        assert_eq!(shape.name(), *shape_name, "{stem}");
        assert!((shape.size_m() - DVec3::from_array(*size)).length() < 1e-12, "{stem}");
        found += 1;
    }
    assert_eq!(found, expected.len());
}

/// Round or rectangular, with or without luminous sides: nothing else is in the format.
#[test]
fn published_eulumdat_openings_are_of_four_kinds() {
    let Some(files) = published_files_of("ldt") else {
        return;
    };
    let mut solid = 0;
    for file in files {
        let Ok(read) = read_ldt(&std::fs::read(&file).unwrap()) else {
            continue;
        };
        let shape = read.photometry.facts().shape();
        let known = ["point", "line", "rectangle", "box", "disk", "vertical cylinder"];
        assert!(known.contains(&shape.name()), "{}: {}", name(&file), shape.name());
        solid += usize::from(shape.is_solid());
    }
    assert!(solid > 0);
}

/// A sphere of 1995 has other signs in 2002; EULUMDAT has disks by their own.
#[test]
fn writers_give_a_shape_the_signs_of_the_edition() {
    for dimensions in ["-1 0 -1", "-1 0 0", "0 2 -1", "-1 2 3", "-1 2 -3", "1 2 3", "0 2 0"] {
        let text = format!(
            "IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 2 1 1 2 {dimensions}\n1 1 10\n0 180\n0\n100 100\n"
        );
        let read = read_ies(text.as_bytes()).unwrap().photometry;
        let shape = read.facts().shape();
        let again = write_ies(&read, IesStandard::Lm63Of2002);
        let again = read_ies(again.text.as_bytes()).unwrap();
        assert_eq!(again.photometry.facts().shape(), shape, "{dimensions}");
        assert!(again.warnings.is_empty(), "{dimensions}: {:?}", again.warnings);
        let back = write_ies(&again.photometry, IesStandard::Lm63Of1995);
        let back = read_ies(back.text.as_bytes()).unwrap().photometry;
        assert_eq!(back.facts().shape(), shape, "{dimensions}");
        let ldt = read_ldt(write_ldt(&read).text.as_bytes()).unwrap().photometry;
        let is_kept = ["disk", "box", "line"].contains(&shape.name());
        assert_eq!(ldt.facts().shape() == shape, is_kept, "{dimensions}");
    }
}
