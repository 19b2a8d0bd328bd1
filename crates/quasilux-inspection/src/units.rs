//! Units of length: whether the geometry and the positions of a project fit each other and the
//! people in it.

use crate::finding::{Check, Findings};
use crate::names;
use crate::survey::position_of;
use glam::DVec3;
use quasilux_scene::{LengthUnit, Places, Scene, SensorShape};

/// Rooms are no higher, in m: the highest atria have 180 m, nearly all rooms below 30 m.
const MAX_HEIGHT_M: f64 = 60.0;
/// The height of most rooms in m.
const USUAL_HEIGHT_M: f64 = 3.0;
/// Usual rooms have half to twice that height: the logarithm of 2.
const USUAL_OFF: f64 = std::f64::consts::LN_2;
/// Geometry is larger than this, in m: a model of a desk lamp is.
const MIN_SIZE_M: f64 = 0.05;
/// Positions that fill less than this share of each edge of the geometry may be of another unit.
const SMALL_SHARE: f64 = 0.36;
/// The highest lamp hangs in the upper half of a room.
const LAMP_HEIGHT: [f64; 2] = [0.5, 1.02];
/// Positions may stand this share of the size outside the geometry.
const MARGIN: f64 = 0.01;

/// A box.
#[derive(Clone, Copy)]
pub(crate) struct Extent {
    pub(crate) low: DVec3,
    pub(crate) high: DVec3,
}

impl Extent {
    pub(crate) fn new(points: &[DVec3]) -> Option<Self> {
        let first = *points.first()?;
        let grown = |it: Self, p: &DVec3| Self { low: it.low.min(*p), high: it.high.max(*p) };
        Some(points.iter().fold(Self { low: first, high: first }, grown))
    }

    pub(crate) fn edges(&self) -> DVec3 {
        self.high - self.low
    }

    fn scaled(&self, factor: f64) -> Self {
        Self { low: self.low * factor, high: self.high * factor }
    }

    /// Whether a point is in the box or just outside.
    pub(crate) fn holds(&self, point: DVec3) -> bool {
        let margin = DVec3::splat(MARGIN * self.edges().length());
        point.cmpge(self.low - margin).all() && point.cmple(self.high + margin).all()
    }

    /// The share of points that it holds.
    pub(crate) fn share_of(&self, points: &[DVec3]) -> f64 {
        let held = points.iter().filter(|point| self.holds(**point)).count();
        held as f64 / points.len().max(1) as f64
    }
}

/// The box around the geometry.
pub(crate) fn geometry(scene: &Scene) -> Option<Extent> {
    scene.mesh.bounds().map(|[low, high]| Extent { low, high })
}

/// Where the project file puts things: lamps, the corners of sensors, cameras that are near.
pub(crate) fn positions(scene: &Scene) -> Vec<DVec3> {
    let lamps = scene.lights.iter().filter_map(position_of);
    let sensors = scene.sensors.iter().flat_map(|sensor| match &sensor.shape {
        SensorShape::Points(points) => points.iter().map(|point| point.position).collect(),
        SensorShape::Grid(grid) => {
            vec![
                grid.origin,
                grid.origin + grid.u,
                grid.origin + grid.v,
                grid.origin + grid.u + grid.v,
            ]
        }
    });
    let cameras = scene.cameras.iter().map(|camera| camera.position);
    lamps.chain(sensors).chain(cameras).collect()
}

/// What stands at a position.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Thing {
    /// Lamps hang in the upper half of a room.
    Lamp,
    /// Sensors and cameras may be at any height.
    Other,
}

/// Positions that another unit may put inside the geometry.
struct Explained<'a> {
    geometry: Extent,
    positions: &'a [DVec3],
    /// Of the highest lamp of them, if one is.
    lamp_height_m: Option<f64>,
}

impl Explained<'_> {
    /// Whether all are inside once they are this many times as far from the origin, and the lamp in
    /// the upper half of the room.
    fn by(&self, factor: f64) -> bool {
        let Self { geometry, positions, lamp_height_m } = self;
        let share = |height: f64| (height * factor - geometry.low.z) / geometry.edges().z;
        let hangs = |height: f64| (LAMP_HEIGHT[0]..=LAMP_HEIGHT[1]).contains(&share(height));
        positions.iter().all(|position| geometry.holds(*position * factor))
            && lamp_height_m.is_none_or(hangs)
    }
}

/// What to do about a position that is far outside, and would be inside in another unit; `None`
/// where none explains it.
pub(crate) fn cure(
    scene: &Scene,
    places: &Places,
    position: DVec3,
    thing: Thing,
) -> Option<String> {
    let geometry = geometry(scene)?;
    let nearest = position.clamp(geometry.low, geometry.high);
    if position.distance(nearest) < geometry.edges().length() {
        return None;
    }
    let lamp_height_m = (thing == Thing::Lamp).then_some(position.z);
    let explained = Explained { geometry, positions: &[position], lamp_height_m };
    let from = places.position_unit;
    let fits = |to: &LengthUnit| *to != from && explained.by(to.metres() / from.metres());
    let to = LengthUnit::ALL.into_iter().find(fits)?;
    Some(format!(
        "its position would be inside in {}: if it is meant so, say position_units = \"{}\" in \
         [scene] for all positions, or give this one in {}",
        in_words(to),
        to.name(),
        in_words(from)
    ))
}

/// The unit of positions, or of geometry files, with which all lamps and points stand inside, the
/// highest lamp in the upper half of a room; where several do, the one whose room is nearest to
/// usual ones. `None` where no other unit explains it.
pub(crate) fn cure_of_all(scene: &Scene, places: &Places) -> Option<String> {
    let geometry = geometry(scene)?;
    let positions = positions(scene);
    let heights_m = scene.lights.iter().filter_map(position_of).map(|at| at.z);
    let lamp_height_m = Some(heights_m.reduce(f64::max)?);
    let height_m = geometry.edges().z;
    let explained = Explained { geometry, positions: &positions, lamp_height_m };
    let keys = [("position_units", places.position_unit), ("units", places.unit)];
    let candidates = keys.into_iter().flat_map(|it| LengthUnit::ALL.map(|to| (it, to)));
    let fitting = candidates.filter_map(|((key, from), to)| {
        let ratio = to.metres() / from.metres();
        // Larger geometry is as if positions were smaller.
        let (factor, height_m) = match key {
            "units" => (1.0 / ratio, height_m * ratio),
            _ => (ratio, height_m),
        };
        let off = off_usual(height_m, LengthUnit::Metre);
        (to != from && explained.by(factor)).then_some((off, key, from, to))
    });
    let (_, key, from, to) = fitting.min_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(format!(
        "all of them would be inside with {} in place of {}: if it is meant so, say {key} = \"{}\" \
         in [scene]",
        in_words(to),
        in_words(from),
        to.name()
    ))
}

/// A unit in running text.
fn in_words(unit: LengthUnit) -> &'static str {
    match unit {
        LengthUnit::Metre => "metres",
        LengthUnit::Centimetre => "centimetres",
        LengthUnit::Millimetre => "millimetres",
        LengthUnit::Inch => "inches",
        LengthUnit::Foot => "feet",
    }
}

pub(crate) fn check(scene: &Scene, findings: &mut Findings<'_>) {
    let Some(geometry) = geometry(scene) else { return };
    let positions = positions(scene);
    let edges = geometry.edges();
    let size = format!(
        "the geometry is {} by {} by {} high",
        names::length(edges.x),
        names::length(edges.y),
        names::length(edges.z)
    );
    let place = findings.places.scene;
    if let Some(unit) = smaller_unit_of_geometry(scene, &geometry, &positions) {
        let message = format!("{size}, and all positions of the project are in a corner of it");
        let cure = format!(
            "if its files are in {}, say units = \"{}\" in [scene]",
            in_words(unit),
            unit.name()
        );
        findings.add(Check::Units, place, message, cure);
    } else if edges.z > MAX_HEIGHT_M {
        let message = format!("{size}, more than any room");
        let cure = cure_of_height(edges.z, geometry.share_of(&positions) > 0.5);
        findings.add(Check::Units, place, message, cure);
    } else if edges.length() < MIN_SIZE_M {
        let message = format!("{size}, less than any room");
        let cure = "expected metres: look at units in [scene], and at the unit of its files";
        findings.add(Check::Units, place, message, cure);
    }
}

/// The unit in which the geometry would be as large as the positions say, where it is far larger.
fn smaller_unit_of_geometry(
    scene: &Scene,
    geometry: &Extent,
    positions: &[DVec3],
) -> Option<LengthUnit> {
    let filled = Extent::new(positions)?;
    let share = filled.edges() / geometry.edges().max(DVec3::splat(f64::MIN_POSITIVE));
    if share.max_element() > SMALL_SHARE {
        return None;
    }
    let lamps = scene.lights.iter().filter_map(position_of);
    let highest_m = lamps.map(|position| position.z).reduce(f64::max)?;
    let fits = |unit: &LengthUnit| {
        let scaled = geometry.scaled(unit.metres());
        let height = (highest_m - scaled.low.z) / scaled.edges().z;
        (LAMP_HEIGHT[0]..=LAMP_HEIGHT[1]).contains(&height) && scaled.share_of(positions) == 1.0
    };
    let fitting =
        LengthUnit::ALL.into_iter().filter(|unit| *unit != LengthUnit::Metre && fits(unit));
    nearest_to_usual(geometry.edges().z, fitting)
}

/// What to say of a geometry that is higher than any room; positions may be in the same unit.
///
/// Low rooms in centimetres are high ones in inches, and of rooms at random one in eight was
/// both: the cure has all units that make a usual room, the nearest first.
fn cure_of_height(height: f64, both: bool) -> String {
    let usual = LengthUnit::ALL.into_iter().filter(|unit| off_usual(height, *unit) < USUAL_OFF);
    let mut units: Vec<LengthUnit> = usual.collect();
    units.sort_by(|a, b| off_usual(height, *a).total_cmp(&off_usual(height, *b)));
    if units.is_empty() {
        units.extend(nearest_to_usual(height, LengthUnit::ALL.into_iter()));
    }
    let words: Vec<&str> = units.iter().map(|unit| in_words(*unit)).collect();
    let names: Vec<String> = units.iter().map(|unit| format!("\"{}\"", unit.name())).collect();
    let name = names.join(" or ");
    let also = if both { format!(", and position_units = {name}") } else { String::new() };
    format!("if its files are in {}, say units = {name}{also} in [scene]", words.join(" or in "))
}

/// The unit in which a height is nearest to that of most rooms, by ratio.
fn nearest_to_usual(height: f64, units: impl Iterator<Item = LengthUnit>) -> Option<LengthUnit> {
    units.min_by(|a, b| off_usual(height, *a).total_cmp(&off_usual(height, *b)))
}

/// How far a height is from that of most rooms, as the logarithm of the ratio.
fn off_usual(height: f64, unit: LengthUnit) -> f64 {
    libm::log(height * unit.metres() / USUAL_HEIGHT_M).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_of_rooms_tell_their_unit() {
        let units = [(2700.0, "mm"), (300.0, "cm"), (118.0, "in"), (8500.0, "mm"), (98.4, "in")];
        for (height, name) in units {
            let nearest = nearest_to_usual(height, LengthUnit::ALL.into_iter());
            assert_eq!(nearest.map(LengthUnit::name), Some(name), "{height}");
        }
    }
}
