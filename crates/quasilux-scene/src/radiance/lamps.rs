//! Luminaires: surfaces whose light has a distribution, as intensities of their own.
//!
//! Surfaces of one material that touch each other shine together, such as the faces of a box.

use super::definitions::Definition;
use super::look::luminance_cd_m2;
use super::pattern::{Arguments, Distribution};
use super::shapes::Shape;
use super::web::{Cone, Emitter};
use glam::DVec3;
use quasilux_photometry::{
    IesStandard, Keyword, LuminaireFacts, LuminousOpening, PhotometricType, Photometry,
    SphericalTable, Standard, Tilt, write_ies,
};

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
    pub(crate) ies: String,
}

/// Shapes that are apart by less than this part of their size touch.
const TOUCH: f64 = 0.05;
/// The least distance, in the unit of the scene, that does not part them.
const TOUCH_M: f64 = 0.002;
/// Extents below this are none.
const THIN_M: f64 = 0.0015;
/// Most shapes of one material that are grouped.
const MAX_GROUPED: usize = 2000;

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

    fn touches(&self, other: &Self) -> bool {
        let size = self.size().length().max(other.size().length());
        let gap = DVec3::splat((TOUCH * size).max(TOUCH_M));
        (self.min - gap).cmple(other.max).all() && (other.min - gap).cmple(self.max).all()
    }
}

/// Groups of shapes that touch each other, as indices.
pub(super) fn groups(shapes: &[&Shape]) -> Vec<Vec<usize>> {
    if shapes.len() > MAX_GROUPED {
        return (0..shapes.len()).map(|index| vec![index]).collect();
    }
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let bounds: Vec<Bounds> = shapes.iter().map(|shape| Bounds::from_shape(shape, axes)).collect();
    let mut group_of: Vec<usize> = (0..shapes.len()).collect();
    for a in 0..shapes.len() {
        for b in 0..a {
            let [keep, lose] = [group_of[b], group_of[a]];
            if keep != lose && bounds[a].touches(&bounds[b]) {
                group_of.iter_mut().filter(|it| **it == lose).for_each(|it| *it = keep);
            }
        }
    }
    let mut groups: Vec<Vec<usize>> = vec![Vec::new(); shapes.len()];
    group_of.iter().enumerate().for_each(|(shape, &group)| groups[group].push(shape));
    groups.retain(|group| !group.is_empty());
    groups
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
    pub(super) fn lamp(&self, name: &str, shapes: &[&Shape]) -> Result<Option<Lamp>, String> {
        let luminance = self.tilt_factor * luminance_cd_m2(self.radiance()?);
        let emitter = Emitter::new(shapes, luminance, self.distribution.clone(), self.cone()?);
        let emitter = emitter.ok_or_else(|| "a part of it shines inward".to_owned())?;
        let turn = emitter.world_from_luminaire;
        let table = SphericalTable::new(emitter.grid()?).map_err(|error| error.to_string())?;
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
            ies: write_ies(&photometry, IesStandard::Lm63Of2002).text,
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
