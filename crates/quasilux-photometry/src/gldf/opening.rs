//! The luminous opening that a simple geometry gives: a rectangle or disk under the luminaire, with
//! heights by side.
//!
//! It counts before that of the photometric file (GLDF documentation, "Variant",
//! `SimpleGeometryReference`). Widths lie along x, C0-C180, lengths along y, C90-C270, in mm.

use super::GldfError;
use super::figures::{amount, number};
use super::rotation::Turn;
use super::told::Told;
use crate::shape::opening_in;
use crate::{LuminousOpening, LuminousShape, Photometry, Standard, WarningKind};
use glam::DVec3;
use quasilux_text::xml::Element;

/// Metres in a millimetre.
const METRES_PER_MM: f64 = 1e-3;
/// Sizes that differ by less are the same, in m.
const SAME_M: f64 = 1.5e-3;

/// The luminaire with the opening of a simple geometry.
pub(super) fn with_opening(
    photometry: Photometry,
    simple: &Element<'_>,
    turn: &Turn,
    told: &mut Told,
) -> Result<Photometry, GldfError> {
    let Some(opening) = opening(simple, told)? else {
        return Ok(photometry);
    };
    let is_disk = opening.width_m < 0.0;
    let Some(opening) = in_photometry(&opening, turn) else {
        let [shape, kept] = if is_disk {
            ["a disk", "one about the vertical axis"]
        } else {
            ["a rectangle", "one by right angles"]
        };
        let found = format!("{shape} as opening of a photometry with another turn");
        let expected = format!("{kept} (the opening of the photometric file is taken)");
        told.warn(WarningKind::ContainerOpening, simple.at, found, expected);
        return Ok(photometry);
    };
    let mut facts = photometry.facts().clone();
    let shape = LuminousShape::from_opening(Standard::Eulumdat, &opening);
    let known = facts.shape();
    let differs = (known.size_m() - shape.size_m()).abs().max_element() > SAME_M
        || known.is_round() != shape.is_round();
    if !known.is_point() && differs {
        let [found, expected] = [shape, known].map(|shape| described(&shape));
        let expected =
            format!("{expected}, as the photometric file has it (the container's counts)");
        told.warn(WarningKind::ContainerOpening, simple.at, found, expected);
    }
    told.fact("opening", format!("{}, of the simple geometry", described(&shape)));
    facts.opening = opening_in(facts.standard, Standard::Eulumdat, &opening);
    if let Some(eulumdat) = &mut facts.eulumdat {
        eulumdat.opening_heights_m = [opening.height_m; 4];
    }
    let name = photometry.name().to_owned();
    Ok(Photometry::new(photometry.table().clone(), facts).with_name(&name))
}

fn described(shape: &LuminousShape) -> String {
    let DVec3 { x, y, z } = shape.size_m();
    format!("a luminous {} of {x:.3} x {y:.3} x {z:.3} m", shape.name())
}

/// The opening in the frame of the luminaire, with the signs of EULUMDAT.
fn opening(simple: &Element<'_>, told: &mut Told) -> Result<Option<LuminousOpening>, GldfError> {
    let height_m = height_m(simple, told)?;
    let mut size = |element: &Element<'_>, name: &str| {
        let size_m = amount(element, name)?.unwrap_or(0.0) * METRES_PER_MM;
        if size_m == 0.0 {
            let found = format!("{} without its {name}", element.name);
            let expected = "one above 0 mm (the opening of the photometric file is taken)";
            told.warn(WarningKind::MissingElement, element.at, found, expected);
        }
        Ok::<f64, GldfError>(size_m)
    };
    if let Some(rectangle) = simple.child("RectangularEmitter") {
        let (along_x, along_y) = (size(rectangle, "Width")?, size(rectangle, "Length")?);
        let opening = LuminousOpening { width_m: along_y, length_m: along_x, height_m };
        return Ok((along_x > 0.0 && along_y > 0.0).then_some(opening));
    }
    if let Some(circle) = simple.child("CircularEmitter") {
        let diameter_m = size(circle, "Diameter")?;
        let opening = LuminousOpening { width_m: -diameter_m, length_m: -diameter_m, height_m };
        return Ok((diameter_m > 0.0).then_some(opening));
    }
    Ok(None)
}

/// The largest of the heights by side, as for EULUMDAT; negative ones count as 0.
fn height_m(simple: &Element<'_>, told: &mut Told) -> Result<f64, GldfError> {
    let Some(heights) = simple.child("C-Heights") else {
        return Ok(0.0);
    };
    let mut sides_mm = [0.0; 4];
    for (side_mm, name) in sides_mm.iter_mut().zip(["C0", "C90", "C180", "C270"]) {
        *side_mm = number(heights, name)?.unwrap_or(0.0);
    }
    let height_mm = sides_mm.iter().copied().fold(0.0, f64::max);
    if sides_mm.iter().any(|side_mm| *side_mm != height_mm) {
        let [c0, c90, c180, c270] = sides_mm;
        let found = format!("heights by side of {c0}, {c90}, {c180}, {c270} mm");
        let expected = format!("the same on all sides ({height_mm} mm is taken)");
        told.warn(WarningKind::ContainerOpening, heights.at, found, expected);
    }
    Ok(height_mm * METRES_PER_MM)
}

/// The opening in the frame of the photometry; `None` where its sides are along no axis there.
fn in_photometry(opening: &LuminousOpening, turn: &Turn) -> Option<LuminousOpening> {
    let to = turn.luminaire_from_photometry.transpose();
    let is_axis = |v: DVec3| (v.abs().max_element() - 1.0).abs() < 1e-9;
    if !is_axis(to * DVec3::X) || !is_axis(to * DVec3::Z) {
        return None;
    }
    if opening.width_m < 0.0 {
        // Disks and upright cylinders stay so about a vertical axis alone.
        let is_upright = (to * DVec3::Z).z.abs() > 0.5;
        return is_upright.then_some(*opening);
    }
    let LuminousOpening { width_m, length_m, height_m } = *opening;
    let size_m = (to * DVec3::new(length_m, width_m, height_m)).abs();
    Some(LuminousOpening { width_m: size_m.y, length_m: size_m.x, height_m: size_m.z })
}
