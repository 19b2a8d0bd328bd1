//! Luminaires: surfaces whose light has a distribution, as intensities of their own.
//!
//! Surfaces of one material shine together where their correction is that of a body or a sheet:
//! sides of a box, a cylinder with its ends, or two faces back to back.

use super::definitions::Definition;
use super::look::luminance_cd_m2;
use super::pattern::{Arguments, Distribution, Grouping};
use super::shapes::Shape;
use super::web::{Budget, Cone, Emitter};
use glam::DVec3;
use quasilux_photometry::{
    IesStandard, Keyword, LuminaireFacts, LuminousOpening, PhotometricType, Photometry,
    SphericalTable, Standard, Tilt, write_ies,
};
use std::collections::HashSet;
use std::ops::Range;
use std::sync::Arc;

/// A luminaire at its place.
#[derive(Clone, Debug)]
pub(crate) struct Lamp {
    /// The name of its material.
    pub(crate) name: String,
    /// The middle of what shines, in the unit of the scene.
    pub(crate) position: DVec3,
    /// Directions of gamma = 0 and of the half-plane C0.
    pub(crate) aim: DVec3,
    pub(crate) c0: DVec3,
    /// Whether its opening is more than a point.
    pub(crate) is_area: bool,
    /// A photometric file (LM-63).
    pub(crate) ies: Arc<str>,
}

/// Shapes that are apart by less than this part of their size touch.
const TOUCH: f64 = 0.05;
/// The least distance, in the unit of the scene, that does not part them.
const TOUCH_M: f64 = 0.002;
/// Extents below this are none.
const THIN_M: f64 = 0.0015;
/// Most sides of a body.
const MAX_SIDES: usize = 6;
/// Faces turn toward one side where the cosine between their normals is above this.
const SAME_SIDE: f64 = 0.999;
/// Most characters of all photometric files of a scene.
const MAX_TEXTS: usize = 1 << 29;

/// Corners of a box along the axes.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    min: DVec3,
    max: DVec3,
}

impl Bounds {
    /// In a frame of these columns.
    fn from_shape(shape: &Shape, axes: [DVec3; 3]) -> Self {
        let along = |point: DVec3| DVec3::from_array(axes.map(|axis| axis.dot(point)));
        let disc = |normal: DVec3, radius: f64| {
            let reach = |axis: DVec3| radius * axis.cross(normal).length();
            DVec3::from_array(axes.map(reach))
        };
        let around = |point: DVec3, reach: DVec3| {
            let point = along(point);
            Self { min: point - reach, max: point + reach }
        };
        match shape {
            Shape::Polygon(corners) => {
                let all = corners.iter().map(|&corner| around(corner, DVec3::ZERO));
                all.reduce(Self::with).unwrap_or(around(DVec3::ZERO, DVec3::ZERO))
            }
            Shape::Sphere { centre, radius, .. } => around(*centre, DVec3::splat(*radius)),
            Shape::Ring { centre, normal, outer_radius, .. } => {
                around(*centre, disc(*normal, *outer_radius))
            }
            Shape::Cone { from, to, from_radius, to_radius, .. } => {
                let axis = (*to - *from).normalize_or_zero();
                around(*from, disc(axis, *from_radius)).with(around(*to, disc(axis, *to_radius)))
            }
            Shape::Source { .. } => around(DVec3::ZERO, DVec3::ZERO),
        }
    }

    fn with(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// Distances that do not part them.
    fn gap(&self, other: &Self) -> DVec3 {
        let size = self.size().length().max(other.size().length());
        DVec3::splat((TOUCH * size).max(TOUCH_M))
    }

    fn is_near(&self, other: &Self) -> bool {
        let gap = self.gap(other);
        (self.min - other.min).abs().cmple(gap).all()
            && (self.max - other.max).abs().cmple(gap).all()
    }

    fn touches(&self, other: &Self) -> bool {
        let gap = self.gap(other);
        (self.min - gap).cmple(other.max).all() && (other.min - gap).cmple(self.max).all()
    }
}

/// The direction that a flat shape faces.
fn facing(shape: &Shape) -> Option<DVec3> {
    match shape {
        Shape::Polygon(corners) => {
            let across = |pair: &[DVec3]| (pair[0] - corners[0]).cross(pair[1] - corners[0]);
            corners.windows(2).map(across).sum::<DVec3>().try_normalize()
        }
        Shape::Ring { normal, .. } => Some(*normal),
        _ => None,
    }
}

/// Shapes that follow each other and shine together, as indices.
pub(super) fn groups(shapes: &[&Shape], grouping: Grouping) -> Vec<Range<usize>> {
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let bounds: Vec<Bounds> = shapes.iter().map(|shape| Bounds::from_shape(shape, axes)).collect();
    let mut groups = Vec::new();
    let mut start = 0;
    while start < shapes.len() {
        let length = match grouping {
            Grouping::Apart => 1,
            Grouping::Sheet => {
                let is_sheet = start + 1 < shapes.len()
                    && are_back_to_back(shapes[start], shapes[start + 1])
                    && bounds[start].is_near(&bounds[start + 1]);
                if is_sheet { 2 } else { 1 }
            }
            Grouping::Body => {
                let most = sides(&shapes[start..]);
                let is_one = |length: &usize| are_connected(&bounds[start..start + length]);
                (1..=most).rev().find(is_one).unwrap_or(1)
            }
        };
        groups.push(start..start + length);
        start += length;
    }
    groups
}

/// The number of shapes at the front that may be sides of one body.
fn sides(shapes: &[&Shape]) -> usize {
    let most = shapes.len().min(MAX_SIDES);
    let is_other = |&at: &usize| shapes[..at].iter().all(|other| are_two_sides(other, shapes[at]));
    (0..most).take_while(is_other).count()
}

/// Whether one comes from each of a few to each by those that touch.
fn are_connected(bounds: &[Bounds]) -> bool {
    let mut reached = vec![0];
    let mut next = 0;
    while let Some(&from) = reached.get(next) {
        let near = |to: &usize| bounds[from].touches(&bounds[*to]);
        let others = (0..bounds.len()).filter(|to| !reached.contains(to)).filter(near);
        let others: Vec<usize> = others.collect();
        reached.extend(others);
        next += 1;
    }
    reached.len() == bounds.len()
}

fn are_back_to_back(a: &Shape, b: &Shape) -> bool {
    facing(a).zip(facing(b)).is_some_and(|(a, b)| a.dot(b) < -SAME_SIDE)
}

/// Whether both may be sides of one body.
fn are_two_sides(a: &Shape, b: &Shape) -> bool {
    match (facing(a), facing(b)) {
        (Some(a), Some(b)) => a.dot(b) < SAME_SIDE,
        (None, None) => false,
        _ => true,
    }
}

/// Photometric files so far, and what they may take.
#[derive(Debug, Default)]
pub(super) struct Tables {
    pub(super) budget: Budget,
    texts: HashSet<Arc<str>>,
    characters: usize,
}

impl Tables {
    /// A text that equal ones share.
    fn share(&mut self, text: String) -> Result<Arc<str>, String> {
        if let Some(known) = self.texts.get(text.as_str()) {
            return Ok(Arc::clone(known));
        }
        self.characters += text.len();
        if self.characters > MAX_TEXTS {
            self.budget.is_spent = true;
            return Err("up to here the scene has too many tables of intensities; expected fewer"
                .to_owned());
        }
        let text: Arc<str> = text.into();
        self.texts.insert(Arc::clone(&text));
        Ok(text)
    }
}

/// A material with a distribution.
pub(super) struct Source<'d> {
    pub(super) definition: &'d Definition,
    pub(super) distribution: Option<Distribution>,
    /// Factor of a lamp that hangs at this tilt.
    pub(super) tilt_factor: f64,
}

impl Source<'_> {
    fn radiance(&self) -> Result<[f64; 3], String> {
        let reals = self.definition.primitive.reals.as_slice();
        let radiance = reals.first_chunk().copied();
        let is_fine = |it: &[f64; 3]| it.iter().all(|channel| (0.0..=1e9).contains(channel));
        radiance.filter(is_fine).ok_or_else(|| "its radiances are none".to_owned())
    }

    /// Directions of a spotlight.
    fn cone(&self) -> Result<Option<Cone>, String> {
        let Definition { primitive, frame, .. } = self.definition;
        if &*primitive.kind != "spotlight" {
            return Ok(None);
        }
        let [_, _, _, angle_deg, x, y, z] = *primitive.reals.as_slice() else {
            return Err("it has other than 7 real arguments".to_owned());
        };
        let axis = (frame.turn * DVec3::new(x, y, z)).try_normalize();
        let axis = axis.filter(|_| angle_deg > 0.0 && angle_deg <= 360.0);
        let axis = axis.ok_or_else(|| "it has no direction, or no angle".to_owned())?;
        Ok(Some(Cone { axis, half_deg: 0.5 * angle_deg }))
    }

    /// The luminaire that these surfaces are; `None` where they give no light.
    pub(super) fn lamp(
        &self,
        name: &str,
        shapes: &[&Shape],
        tables: &mut Tables,
    ) -> Result<Option<Lamp>, String> {
        let luminance = self.tilt_factor * luminance_cd_m2(self.radiance()?);
        let emitter = Emitter::new(shapes, luminance, self.distribution.clone(), self.cone()?);
        let emitter = emitter.ok_or_else(|| "a part of it shines inward".to_owned())?;
        let turn = emitter.world_from_luminaire;
        let table = SphericalTable::new(emitter.grid(&mut tables.budget)?);
        let table = table.map_err(|error| error.to_string())?;
        let axes = [turn.x_axis, turn.y_axis, turn.z_axis];
        let all = shapes.iter().map(|shape| Bounds::from_shape(shape, axes));
        let Some(bounds) = all.reduce(Bounds::with) else { return Ok(None) };
        let opening = opening(shapes, &bounds, turn.z_axis);
        let is_area = opening != LuminousOpening::default();
        let photometry = Photometry::new(table, facts(name, opening));
        if photometry.flux_lm() <= 0.0 {
            return Ok(None);
        }
        Ok(Some(Lamp {
            name: name.to_owned(),
            position: turn * (0.5 * (bounds.min + bounds.max)),
            aim: -turn.z_axis,
            c0: turn.x_axis,
            is_area,
            ies: tables.share(write_ies(&photometry, IesStandard::Lm63Of2002).text)?,
        }))
    }
}

/// The opening of a group of shapes, by the signs of LM-63-2002.
fn opening(shapes: &[&Shape], bounds: &Bounds, up: DVec3) -> LuminousOpening {
    let size = bounds.size();
    if size.max_element() < THIN_M {
        return LuminousOpening::default();
    }
    let thick = |extent: f64| if extent < THIN_M { 0.0 } else { micrometres(extent) };
    let [length_m, width_m, height_m] = size.to_array().map(thick);
    let is_upright = |axis: DVec3| axis.cross(up).length() < 1e-6;
    let is_round = |shape: &&Shape| match shape {
        Shape::Ring { normal, .. } => is_upright(*normal),
        Shape::Cone { from, to, .. } => is_upright((*to - *from).normalize_or_zero()),
        Shape::Sphere { .. } => true,
        _ => false,
    };
    if !shapes.iter().all(is_round) || (length_m - width_m).abs() > 1e-3 * length_m {
        return LuminousOpening { width_m, length_m, height_m };
    }
    let is_ball = shapes.iter().all(|shape| matches!(shape, Shape::Sphere { .. }));
    let height_m = if is_ball { -length_m } else { height_m };
    LuminousOpening { width_m: -length_m, length_m: -length_m, height_m }
}

/// A length without the rounding of coordinates.
fn micrometres(length: f64) -> f64 {
    (length * 1e6).round() / 1e6
}

fn facts(name: &str, opening: LuminousOpening) -> LuminaireFacts {
    let keyword = |name: &str, value: &str| Keyword {
        name: name.to_owned(),
        value: value.to_owned(),
        line: 0,
    };
    LuminaireFacts {
        standard: Standard::Lm63(IesStandard::Lm63Of2002),
        photometric_type: PhotometricType::C,
        keywords: vec![
            keyword("TEST", "none"),
            keyword("MANUFAC", "unknown"),
            keyword("LUMINAIRE", &name.replace(char::is_control, " ")),
            keyword("OTHER", "from a scene of Radiance"),
        ],
        tilt: Tilt::None,
        lamp_count: 1.0,
        lumens_per_lamp: None,
        ballast_factor: 1.0,
        ballast_lamp_field: 1.0,
        input_watts: 0.0,
        candela_factor: 1.0,
        opening,
        light_output_ratio: None,
        measurement_tilt_rad: 0.0,
        eulumdat: None,
    }
}

/// Arguments of a pattern that is a distribution of light.
pub(super) fn distribution_of(definition: &Definition) -> Option<Arguments<'_>> {
    Arguments::from_definition(definition).filter(Arguments::is_of_source)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(min: [f64; 2], max: [f64; 2], z: f64) -> Shape {
        let corner = |x, y| DVec3::new(x, y, z);
        Shape::Polygon(vec![
            corner(min[0], min[1]),
            corner(min[0], max[1]),
            corner(max[0], max[1]),
            corner(max[0], min[1]),
        ])
    }

    /// Strips around a cove touch at their ends, and each shines where it is.
    #[test]
    fn strips_shine_where_they_are() {
        let strips = [
            rectangle([0.0, 0.0], [8.0, 0.1], 3.0),
            rectangle([7.9, 0.0], [8.0, 6.0], 3.0),
            rectangle([0.0, 5.9], [8.0, 6.0], 3.0),
            rectangle([0.0, 0.0], [0.1, 6.0], 3.0),
        ];
        let strips: Vec<&Shape> = strips.iter().collect();
        for grouping in [Grouping::Sheet, Grouping::Body, Grouping::Apart] {
            assert_eq!(groups(&strips, grouping).len(), 4);
        }
    }

    #[test]
    fn faces_back_to_back_are_a_sheet() {
        let down = rectangle([0.0, 0.0], [0.4, 0.2], 2.0);
        let Shape::Polygon(mut corners) = rectangle([0.0, 0.0], [0.4, 0.2], 2.001) else {
            panic!("a polygon")
        };
        corners.reverse();
        let up = Shape::Polygon(corners);
        assert_eq!(groups(&[&down, &up, &down], Grouping::Sheet), [0..2, 2..3]);
        assert_eq!(groups(&[&down, &up], Grouping::Apart).len(), 2);
    }

    #[test]
    fn tables_of_a_scene_are_bounded() {
        let mut tables = Tables::default();
        let first = tables.share("a".to_owned()).unwrap();
        assert!(Arc::ptr_eq(&first, &tables.share("a".to_owned()).unwrap()));
        tables.characters = MAX_TEXTS;
        assert!(tables.share("b".to_owned()).is_err() && tables.budget.is_spent);
        let mut budget = Budget::default();
        assert!(budget.spend(1000).is_ok() && budget.spend(usize::MAX).is_err());
    }
}
