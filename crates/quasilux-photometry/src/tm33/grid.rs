//! Intensities by pairs of angles, in any order, to a table.

use super::fields::{named, note_foreign, number, optional_count, word};
use crate::angles::gamma_rad;
use crate::candela::{check_closing, intensity_cd};
use crate::ies::{CPlanes, HvAngles, c_planes};
use crate::warning::{WarningKind, Warnings};
use crate::{Grid, PhotometricType, Symmetry};
use quasilux_text::xml::Element;
use quasilux_text::{Number, ParseError, Position, Token, quoted};

/// One `IntData`.
struct Point {
    horizontal: Number,
    vertical: Number,
    intensity_cd: f64,
    at: Position,
}

/// The grid of an element `LuminousIntensity`; `factor` candela are one written candela.
pub(super) fn read(
    data: &Element<'_>,
    photometric_type: PhotometricType,
    factor: f64,
    warnings: &mut Warnings,
) -> Result<Grid, ParseError> {
    let mut points = Vec::new();
    for name in ["IntData", "IntensityData"] {
        for element in data.all(name) {
            note_foreign(element, "IntData", warnings);
            points.push(point(element, factor, warnings)?);
        }
    }
    if points.is_empty() {
        let found = format!("{} without intensities", data.name);
        return Err(ParseError::new(data.at, found, "elements IntData, one for each direction"));
    }
    points.sort_by(|a, b| {
        let by_horizontal = a.horizontal.value.total_cmp(&b.horizontal.value);
        by_horizontal.then(a.vertical.value.total_cmp(&b.vertical.value))
    });
    let horizontal = distinct(points.iter().map(|point| point.horizontal));
    let mut vertical: Vec<Number> = points.iter().map(|point| point.vertical).collect();
    vertical.sort_by(|a, b| a.value.total_cmp(&b.value));
    let vertical = distinct(vertical.into_iter());
    if let [single] = vertical[..] {
        let found = format!("all intensities at v = {}", single.value);
        return Err(ParseError::new(single.at, found, "two or more vertical angles v"));
    }
    check_complete(&points, &horizontal, &vertical)?;
    check_counts(data, [points.len(), horizontal.len(), vertical.len()], warnings)?;

    let (rows, columns) = (vertical.len(), horizontal.len());
    let values: Vec<f64> = (0..rows * columns)
        .map(|index| points[index % columns * rows + index / columns].intensity_cd)
        .collect();
    let grid = match photometric_type {
        PhotometricType::C => {
            let theta_rad = gamma_rad(&vertical, warnings)?;
            let CPlanes { phi_rad, symmetry } = c_planes(&horizontal, warnings)?;
            check_symmetry(data, symmetry, &horizontal, warnings)?;
            Grid { theta_rad, phi_rad, symmetry, values }
        }
        a_or_b => HvAngles::check(a_or_b, &horizontal, &vertical, warnings)?.grid(columns, &values),
    };
    check_closing(&grid, horizontal[columns - 1].at, warnings);
    Ok(grid)
}

fn point(element: &Element<'_>, factor: f64, warnings: &mut Warnings) -> Result<Point, ParseError> {
    let mut angle = |names: [&str; 3]| {
        let attribute = element.attributes.iter().find(|a| names.contains(&a.name.as_str()));
        let Some(attribute) = attribute else {
            let found = format!("{} without an angle {}", element.name, names[0]);
            return Err(ParseError::new(element.at, found, "the angles h and v in degrees"));
        };
        if attribute.name != names[0] {
            let found = format_args!("the attribute {}", quoted(&attribute.name)).to_string();
            let expected = format_args!("{} (read as that)", names[0]).to_string();
            warnings.push(WarningKind::ForeignElement, element.at, found, expected);
        }
        let angle = Token { text: attribute.value.trim(), at: element.at }.number(names[0])?;
        // Adding zero turns -0 into 0.
        Ok(Number { value: angle.value + 0.0, at: angle.at })
    };
    let horizontal = angle(["h", "horz", "horizontal"])?;
    let vertical = angle(["v", "vert", "vertical"])?;
    let intensity_cd = intensity_cd(number(element)?, factor, warnings)?;
    Ok(Point { horizontal, vertical, intensity_cd, at: element.at })
}

/// Each angle once, at its first place, of ascending angles.
fn distinct(angles: impl Iterator<Item = Number>) -> Vec<Number> {
    let mut distinct: Vec<Number> = Vec::new();
    for angle in angles {
        match distinct.last() {
            Some(last) if last.value == angle.value => {}
            _ => distinct.push(angle),
        }
    }
    distinct
}

/// Refuses directions that are given twice or not at all, before anything is made of the angles.
fn check_complete(
    points: &[Point],
    horizontal: &[Number],
    vertical: &[Number],
) -> Result<(), ParseError> {
    let same = |pair: &&[Point]| {
        pair[0].horizontal.value == pair[1].horizontal.value
            && pair[0].vertical.value == pair[1].vertical.value
    };
    let name = |h: f64, v: f64| format!("h = {h}, v = {v}");
    if let Some([_, again]) = points.windows(2).find(same) {
        let found = name(again.horizontal.value, again.vertical.value);
        let found = format!("a second intensity at {found}");
        return Err(ParseError::new(again.at, found, "each direction once"));
    }
    // Points ascend as the grid does: the first one off it shows what is missing before.
    for (index, point) in points.iter().enumerate() {
        let row = vertical[index % vertical.len()].value;
        let Some(column) = horizontal.get(index / vertical.len()) else {
            break;
        };
        if point.horizontal.value != column.value || point.vertical.value != row {
            return Err(missing(point.at, &name(column.value, row)));
        }
    }
    if !points.len().is_multiple_of(vertical.len()) {
        let last = &points[points.len() - 1];
        let row = vertical[points.len() % vertical.len()].value;
        return Err(missing(last.at, &name(last.horizontal.value, row)));
    }
    Ok(())
}

fn missing(at: Position, direction: &str) -> ParseError {
    let found = format!("no intensity at {direction}");
    ParseError::new(at, found, "one for each pair of a horizontal and a vertical angle")
}

/// Notes counts that are not those of the intensities: points, horizontal and vertical angles.
fn check_counts(
    data: &Element<'_>,
    counts: [usize; 3],
    warnings: &mut Warnings,
) -> Result<(), ParseError> {
    for (name, count) in ["NumberMeasured", "NumberHorz", "NumberVert"].iter().zip(counts) {
        match optional_count(data, name, warnings)? {
            Some(stated) if stated != count => {
                let at = data.child(name).map_or(data.at, |child| child.text_at);
                let found = format_args!("a {name} of {stated}").to_string();
                let expected = format_args!("{count}, as many as there are").to_string();
                warnings.push(WarningKind::CountDiffers, at, found, expected);
            }
            Some(_) => {}
            None => super::fields::require(data, &[name], warnings),
        }
    }
    Ok(())
}

/// Notes a symmetry that is not that of the planes.
fn check_symmetry(
    data: &Element<'_>,
    symmetry: Symmetry,
    planes: &[Number],
    warnings: &mut Warnings,
) -> Result<(), ParseError> {
    let Some(element) = named(data, &["Symm", "SymmType"], warnings) else {
        return Ok(());
    };
    let across = planes[0].value.rem_euclid(180.0) == 90.0;
    let (name, fits) = match word(element).as_str() {
        "symmnone" => ("Symm_None", matches!(symmetry, Symmetry::None | Symmetry::Open)),
        "symmbi0" => ("Symm_Bi_0", symmetry == Symmetry::Bilateral && !across),
        "symmbi90" => ("Symm_Bi_90", symmetry == Symmetry::Bilateral && across),
        "symmquad" => ("Symm_Quad", symmetry == Symmetry::Quadrant),
        "symmfull" => ("Symm_Full", symmetry == Symmetry::Rotational),
        "symmarbitrary" => ("Symm_Arbitrary", true),
        _ => {
            let expected = "Symm_None, Symm_Bi_0, Symm_Bi_90, Symm_Quad, Symm_Full or \
                            Symm_Arbitrary";
            return Err(ParseError::new(element.text_at, quoted(element.text()), expected));
        }
    };
    if element.text() != name {
        let expected = format_args!("{name} (read as that)").to_string();
        warnings.push(WarningKind::WordSpelling, element.text_at, quoted(element.text()), expected);
    }
    if !fits {
        let (first, last) = (planes[0].value, planes[planes.len() - 1].value);
        let found = format_args!("{name} with planes from {first} to {last}").to_string();
        let expected = "the symmetry that they span (the planes count)";
        warnings.push(WarningKind::SymmetryDiffers, element.text_at, found, expected);
    }
    Ok(())
}
