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
#[derive(Clone, Copy)]
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
        "it would be inside if its position were in {}: set position_units = \"{}\" in [scene] if \
         all \
         positions are, or give this one in {}",
        in_words(to),
        to.name(),
        in_words(from)
    ))
}

/// The unit of positions, or of geometry files, with which all lamps and points stand inside, the
/// highest lamp in the upper half of a room, or all lamps below something (`is_roofed`), where a
/// house beside it is higher; where several do, the one whose room is nearest to usual ones. `None`
/// where no other unit explains it.
pub(crate) fn cure_of_all(
    scene: &Scene,
    places: &Places,
    is_roofed: impl Fn(DVec3) -> bool,
) -> Option<String> {
    let geometry = geometry(scene)?;
    let lamps: Vec<DVec3> = scene.lights.iter().filter_map(position_of).collect();
    let positions = positions(scene);
    let lamp_height_m = Some(lamps.iter().map(|at| at.z).reduce(f64::max)?);
    let height_m = geometry.edges().z;
    let explained = Explained { geometry, positions: &positions, lamp_height_m };
    let inside = Explained { lamp_height_m: None, ..explained };
    let keys = [("position_units", places.position_unit), ("units", places.unit)];
    let readings = keys.into_iter().flat_map(|(key, from)| {
        let others = LengthUnit::ALL.into_iter().filter(move |to| *to != from);
        others.map(move |to| Reading::new(key, from, to))
    });
    let readings: Vec<Reading> = readings.collect();
    let off = |reading: &&Reading| off_usual(height_m * reading.growth, LengthUnit::Metre);
    let hung = readings.iter().filter(|reading| explained.by(reading.factor));
    let roofed = readings.iter().filter(|reading| {
        let Reading { factor, .. } = reading;
        inside.by(*factor) && lamps.iter().all(|lamp| is_roofed(*lamp * *factor))
    });
    let Reading { key, from, to, .. } = hung
        .min_by(|a, b| off(a).total_cmp(&off(b)))
        // Whatever shrinks positions enough puts them around the origin.
        .or_else(|| roofed.max_by(|a, b| a.factor.total_cmp(&b.factor)))?;
    Some(format!(
        "all of them would be inside with {} in place of {}: set {key} = \"{}\" in [scene] if \
         that is \
         meant",
        in_words(*to),
        in_words(*from),
        to.name()
    ))
}

/// Another unit of positions, or of geometry files.
struct Reading {
    key: &'static str,
    from: LengthUnit,
    to: LengthUnit,
    /// How much further from the origin positions would be, for a geometry that stays.
    factor: f64,
    /// How much larger the geometry would be.
    growth: f64,
}

impl Reading {
    fn new(key: &'static str, from: LengthUnit, to: LengthUnit) -> Self {
        let ratio = to.metres() / from.metres();
        // Larger geometry is as if positions were smaller.
        let [factor, growth] = if key == "units" { [1.0 / ratio, ratio] } else { [ratio, 1.0] };
        Self { key, from, to, factor, growth }
    }
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
            "set units = \"{}\" in [scene] if its files are in {}",
            unit.name(),
            in_words(unit)
        );
        findings.add(Check::Units, place, message, cure);
    } else if edges.z > MAX_HEIGHT_M {
        let message = format!("{size}, more than any room");
        let cure = match unit_around(&geometry, &positions) {
            Some(unit) => cure_of_units(&[unit], false),
            None => cure_of_height(scene, &geometry, &positions),
        };
        findings.add(Check::Units, place, message, cure);
    } else if edges.length() < MIN_SIZE_M {
        let message = format!("{size}, less than any room");
        let cure = "set units in [scene] to the unit of its files";
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

/// The unit in which a geometry that is higher than any room is the smallest one around all
/// positions as they are. Feet would be around those in the middle of a building.
fn unit_around(geometry: &Extent, positions: &[DVec3]) -> Option<LengthUnit> {
    let units = [LengthUnit::Millimetre, LengthUnit::Centimetre, LengthUnit::Inch];
    let is_around = |unit: &LengthUnit| {
        let scaled = geometry.scaled(unit.metres());
        scaled.edges().z <= MAX_HEIGHT_M && scaled.share_of(positions) == 1.0
    };
    units.into_iter().find(is_around).filter(|_| !positions.is_empty())
}

/// What to say of a geometry that is higher than any room; positions may be in the same unit.
///
/// Low rooms in centimetres are high ones in inches, and of rooms at random one in eight was
/// both: the cure has all units that make a usual room, the nearest first. Beside a higher house
/// lamps tell how high the room is: twice as far above the lowest point as they hang, at most.
fn cure_of_height(scene: &Scene, geometry: &Extent, positions: &[DVec3]) -> String {
    let both = geometry.share_of(positions) > 0.5;
    let highest_m = scene.lights.iter().filter_map(position_of).map(|at| at.z).reduce(f64::max);
    let lowest_m = positions.iter().map(|at| at.z).reduce(f64::min);
    let hangs = highest_m.zip(lowest_m).map(|(high, low)| 2.0 * (high - low));
    let hangs = hangs.filter(|hangs| both && *hangs > 0.0).unwrap_or(f64::INFINITY);
    let height = geometry.edges().z.min(hangs);
    let usual = LengthUnit::ALL.into_iter().filter(|unit| off_usual(height, *unit) < USUAL_OFF);
    let mut units: Vec<LengthUnit> = usual.collect();
    units.sort_by(|a, b| off_usual(height, *a).total_cmp(&off_usual(height, *b)));
    if units.is_empty() {
        units.extend(nearest_to_usual(height, LengthUnit::ALL.into_iter()));
    }
    cure_of_units(&units, both)
}

/// What to say where geometry files are in one of these units, and perhaps positions.
fn cure_of_units(units: &[LengthUnit], both: bool) -> String {
    let words: Vec<&str> = units.iter().map(|unit| in_words(*unit)).collect();
    let names: Vec<String> = units.iter().map(|unit| format!("\"{}\"", unit.name())).collect();
    let name = names.join(" or ");
    let also = if both { format!(", and position_units = {name}") } else { String::new() };
    format!("set units = {name}{also} in [scene] if its files are in {}", words.join(" or in "))
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
