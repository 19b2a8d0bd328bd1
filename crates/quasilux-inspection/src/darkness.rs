//! Why sensor points are dark at which a run found no light.

use crate::finding::{Check, Finding, Findings};
use crate::names;
use crate::probe::{Probe, cosine_direction, square};
use crate::survey::{Survey, Vertex, shining_places, walk};
use glam::DVec3;
use quasilux_bvh::TriangleBvh;
use quasilux_scene::solids::{Solid, solids_of};
use quasilux_scene::{Places, Scene, SensorPoint};

/// Points of one sensor that are asked why.
const MAX_POINTS: usize = 64;
/// Walks from each, and directions that it looks in.
const WALKS: u32 = 16;
const DIRECTIONS: u32 = 64;
/// Lamps that are asked what stands between them and the point.
const MAX_LAMPS: usize = 64;
/// Lit places that are looked for in bodies.
const MAX_LIT: usize = 64;

/// The points of one sensor at which no light was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DarkPoints {
    /// Number of the sensor.
    pub sensor: usize,
    /// Numbers of its points.
    pub points: Vec<usize>,
}

/// Why a point is dark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cause<'a> {
    /// Light comes there, yet the run found none.
    Unfound,
    /// Nothing is before it.
    SeesNothing,
    /// A surface of this object stands between it and the lamp that is nearest.
    Blocked { object: &'a str },
    /// No lamp shines toward it, and nothing that it sees is lit.
    NoLampBefore,
}

/// Says of sensor points at which a run found no light why that may be: one finding for each sensor
/// and cause, with the first such point.
///
/// `found` is what [`inspect`](crate::inspect) found; sensors that it names, outside the geometry
/// or covered, are passed over, and so are points in closed bodies, which loaders tell. `hierarchy`
/// is over the triangles of the scene's mesh, in their order.
///
/// # Panics
/// If the hierarchy has another number of triangles than the scene, or a sensor or point is none of
/// the scene's.
#[must_use]
pub fn explain_darkness(
    scene: &Scene,
    places: &Places,
    hierarchy: &TriangleBvh,
    dark: &[DarkPoints],
    found: &[Finding],
) -> Vec<Finding> {
    assert_eq!(hierarchy.len(), scene.mesh.triangles.len(), "hierarchy of another scene");
    let is_named = |sensor: usize| {
        let of_sensors = |check| matches!(check, Check::SensorOutside | Check::SensorCovered);
        found.iter().any(|it| of_sensors(it.check) && it.place == Some(places.sensors[sensor]))
    };
    let unnamed: Vec<&DarkPoints> =
        dark.iter().filter(|it| !it.points.is_empty() && !is_named(it.sensor)).collect();
    let mut findings = Findings::new(places);
    if unnamed.is_empty() {
        return findings.found;
    }
    let probe = Probe::new(scene, hierarchy);
    let survey = Survey::new(&probe);
    // What lamps light and sends light on.
    let bright: Vec<Vertex> = survey.lit.iter().filter(|it| !it.is_black).copied().collect();
    let dark_bodies = dark_bodies(&survey);
    for dark in unnamed {
        let sensor = &scene.sensors[dark.sensor];
        let stride = dark.points.len().div_ceil(MAX_POINTS);
        let ask = |&point: &usize| {
            let at = sensor.point(point);
            let is_in_body = dark_bodies.iter().any(|it| it.contains(&scene.mesh, at.position));
            (!is_in_body).then(|| Asked { point, cause: cause(&survey, &bright, &at) })
        };
        let asked: Vec<Asked<'_>> = dark.points.iter().step_by(stride).filter_map(ask).collect();
        report(scene, dark, &asked, &mut findings);
    }
    findings.found
}

/// Closed bodies that no light gets into; a room is one that light is in.
fn dark_bodies(survey: &Survey<'_>) -> Vec<Solid> {
    let scene = survey.probe.scene;
    let stride = survey.lit.len().div_ceil(MAX_LIT).max(1);
    let holds_light = |solid: &Solid| {
        let mut lit = survey.lit.iter().step_by(stride);
        lit.any(|vertex| solid.contains(&scene.mesh, vertex.position))
    };
    let bodies = solids_of(&scene.mesh).into_iter();
    bodies.filter(|solid| !solid.transmits(scene) && !holds_light(solid)).collect()
}

/// A point and its cause.
struct Asked<'a> {
    point: usize,
    cause: Cause<'a>,
}

fn cause<'a>(survey: &Survey<'a>, bright: &[Vertex], point: &SensorPoint) -> Cause<'a> {
    let place = Vertex::facing(survey.before(point), point.normal);
    let is_lit = |number: u32| {
        let mut way = walk(survey.probe, place, number);
        let end = way.iter().position(|vertex| vertex.is_black);
        way.truncate(end.unwrap_or(way.len()));
        survey.any_shines(&way) || survey.meet(bright, &way)
    };
    if (0..WALKS).any(is_lit) {
        return Cause::Unfound;
    }
    if let Some(object) = blocker(survey, &place) {
        return Cause::Blocked { object };
    }
    let direction = |i: u32| cosine_direction(point.normal, square(i));
    let sees = (0..DIRECTIONS).any(|i| survey.probe.meets(place.position, direction(i)));
    if sees { Cause::NoLampBefore } else { Cause::SeesNothing }
}

/// The object that stands between a place and the nearest lamp that shines toward it, the one that
/// is nearest to the place.
fn blocker<'a>(survey: &Survey<'a>, place: &Vertex) -> Option<&'a str> {
    let (probe, scene) = (survey.probe, survey.probe.scene);
    let stride = scene.lights.len().div_ceil(MAX_LAMPS).max(1);
    let lamps = scene.lights.iter().step_by(stride);
    let nearest_m = lamps
        .flat_map(|lamp| shining_places(probe, lamp, place.position))
        .map(|lamp| lamp.position)
        .filter(|lamp| place.is_before(*lamp))
        .min_by(|a, b| {
            let distance_m = |lamp: &DVec3| lamp.distance(place.position);
            distance_m(a).total_cmp(&distance_m(b))
        })?;
    let toward = (nearest_m - place.position).normalize_or_zero();
    let surface = probe.first(place.position, toward)?;
    Some(names::object(&scene.mesh, surface.triangle))
}

/// One finding for each cause of one sensor.
fn report(scene: &Scene, dark: &DarkPoints, asked: &[Asked<'_>], findings: &mut Findings<'_>) {
    let sensor = &scene.sensors[dark.sensor];
    let mut causes: Vec<Cause<'_>> = Vec::new();
    for Asked { cause, .. } in asked {
        if !causes.contains(cause) {
            causes.push(*cause);
        }
    }
    for cause in causes {
        let points: Vec<usize> =
            asked.iter().filter(|it| it.cause == cause).map(|it| it.point).collect();
        let first = sensor.point(points[0]).position;
        let of_which = match dark.points.len() <= MAX_POINTS {
            true => sensor.len().to_string(),
            false => format!("{} dark ones that were looked at, of {}", asked.len(), sensor.len()),
        };
        let count = names::count(points.len(), "point", "points");
        let message = format!(
            "no light was found at {count} of {of_which} of sensor \"{}\", for example at {}: {}",
            sensor.name,
            names::position(first),
            cause.reason()
        );
        let place = findings.places.sensors[dark.sensor];
        findings.add(Check::SensorDark, place, message, cause.cure()).at(first);
    }
}

impl Cause<'_> {
    fn reason(self) -> String {
        match self {
            Self::Unfound => "light gets there, but rarely".to_owned(),
            Self::SeesNothing => "no surface and no lamp is in front of it".to_owned(),
            Self::Blocked { object } => {
                format!(
                    "\"{object}\" stands in front of the nearest lamp, and no surface in sight is \
                     lit"
                )
            }
            Self::NoLampBefore => {
                "no lamp shines toward it, and no surface in sight is lit".to_owned()
            }
        }
    }

    fn cure(self) -> &'static str {
        match self {
            Self::Unfound => "give it more time, or more bounces where max_bounces is set",
            Self::SeesNothing => "turn its normal toward the room",
            Self::Blocked { .. } => {
                "put a lamp on this side of it, or let light through or around it"
            }
            Self::NoLampBefore => "put a lamp on this side of it",
        }
    }
}
