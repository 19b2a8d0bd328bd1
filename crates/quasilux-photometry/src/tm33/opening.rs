//! The luminous opening: the box around all emission areas.
//!
//! Lengths run along C90-C270, which is y, and widths along C0-C180, which is x: the faces towards
//! C0 and C180 have a length, those towards C90 and C270 a width. A single circular area gets the
//! signs that LM-63 gives it.

use super::fields::{number, optional_boolean};
use crate::LuminousOpening;
use crate::warning::{WarningKind, Warnings};
use quasilux_text::ParseError;
use quasilux_text::xml::Element;

/// Metres in a millimetre.
const METRES_PER_MM: f64 = 1e-3;

/// A face of the luminaire, its areas, and the two dimensions that they have.
const FACES: [(&str, &str, [Axis; 2]); 6] = [
    ("TopFace", "TopArea", [Axis::Length, Axis::Width]),
    ("BottomFace", "BottomArea", [Axis::Length, Axis::Width]),
    ("C0Face", "C0Area", [Axis::Length, Axis::Height]),
    ("C90Face", "C90Area", [Axis::Width, Axis::Height]),
    ("C180Face", "C180Area", [Axis::Length, Axis::Height]),
    ("C270Face", "C270Area", [Axis::Width, Axis::Height]),
];

#[derive(Clone, Copy)]
enum Axis {
    Length,
    Width,
    Height,
}

/// What the areas of all emitters span.
#[derive(Default)]
struct Extent {
    /// Least and greatest coordinate in metres along length, width and height.
    ranges_m: [Option<(f64, f64)>; 3],
    areas: usize,
    circles: usize,
}

/// The opening of a file; all zero, which is a point, if it gives none.
pub(super) fn read(
    root: &Element<'_>,
    warnings: &mut Warnings,
) -> Result<LuminousOpening, ParseError> {
    let mut extent = Extent::default();
    for areas in root.all("Emitter").filter_map(|emitter| emitter.child("EmissionAreas")) {
        for (face, area, axes) in FACES {
            for area in areas.all(face).flat_map(|face| face.all(area)) {
                extent.add(area, axes)?;
            }
        }
    }
    if extent.areas > 0 {
        return Ok(extent.opening());
    }
    foreign(root, warnings)
}

impl Extent {
    fn add(&mut self, area: &Element<'_>, axes: [Axis; 2]) -> Result<(), ParseError> {
        for axis in axes {
            let (size, offset) = match axis {
                Axis::Length => ("Length", "LengthOffset"),
                Axis::Width => ("Width", "WidthOffset"),
                Axis::Height => ("Height", "HeightOffset"),
            };
            let half_m = 0.5 * length(area, size)?.unwrap_or(0.0);
            let centre_m = match area.child(offset) {
                Some(element) => number(element)?.value,
                None => 0.0,
            };
            let range = &mut self.ranges_m[axis as usize];
            let (min, max) = range.unwrap_or((f64::INFINITY, f64::NEG_INFINITY));
            *range = Some((min.min(centre_m - half_m), max.max(centre_m + half_m)));
        }
        self.areas += 1;
        self.circles += usize::from(optional_boolean(area, "Circular")? == Some(true));
        Ok(())
    }

    fn opening(&self) -> LuminousOpening {
        let [length_m, width_m, height_m] =
            self.ranges_m.map(|range| range.map_or(0.0, |(min, max)| max - min));
        opening(length_m, width_m, height_m, self.areas == 1 && self.circles == 1)
    }
}

/// `LuminousOpening` of the luminaire, which other writers use, in millimetres.
fn foreign(root: &Element<'_>, warnings: &mut Warnings) -> Result<LuminousOpening, ParseError> {
    let luminaire = root.child("Luminaire");
    let Some(element) = luminaire.and_then(|luminaire| luminaire.child("LuminousOpening")) else {
        return Ok(LuminousOpening::default());
    };
    let expected = "EmissionAreas in the emitter, in m (read, as its writers mean it, in mm)";
    warnings.push(WarningKind::OpeningInMillimetres, element.at, "LuminousOpening", expected);
    let sizes = element.child("Dimensions").unwrap_or(element);
    let diameter = length(sizes, "Diameter")?;
    let length_m = diameter.or(length(sizes, "Length")?).unwrap_or(0.0) * METRES_PER_MM;
    let width_m = length(sizes, "Width")?.map_or(length_m, |width| width * METRES_PER_MM);
    let shape = element.child("Shape").map_or("", Element::text).to_ascii_lowercase();
    let is_round = diameter.is_some() || shape.starts_with("circ");
    Ok(opening(length_m, width_m, 0.0, is_round))
}

/// Negative numbers are diameters, as in LM-63.
fn opening(length_m: f64, width_m: f64, height_m: f64, is_round: bool) -> LuminousOpening {
    let sign = if is_round { -1.0 } else { 1.0 };
    LuminousOpening { width_m: sign * length_m, length_m: sign * width_m, height_m }
}

fn length(parent: &Element<'_>, name: &str) -> Result<Option<f64>, ParseError> {
    let Some(child) = parent.child(name) else {
        return Ok(None);
    };
    let length = number(child)?;
    if length.value < 0.0 {
        return Err(ParseError::new(
            length.at,
            length.value,
            format_args!("a {name} of 0 or more"),
        ));
    }
    Ok(Some(length.value))
}
