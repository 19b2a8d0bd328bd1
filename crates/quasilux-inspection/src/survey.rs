//! Walks of light from the lamps and from what asks for it, and whether they meet.
//!
//! A vertex is a place on a surface that light of a lamp comes to, or that a sensor or camera gets
//! light from, over some diffuse reflections. Light of a lamp reaches a sensor where a vertex of
//! one sees a vertex of the other. That it was found is certain; that it was not is an opinion, and
//! counts only beside other evidence.

use crate::probe::{Probe, Surface, cosine_direction, sphere_direction, square};
use glam::DVec3;
use quasilux_sampling::Discrete;
use quasilux_sampling::warp::sample_triangle;
use quasilux_scene::light::{AreaLight, Luminaire};
use quasilux_scene::{Light, Mesh, SensorPoint};

/// Walks from each lamp, at most and at least, and from all together.
const LAMP_WALKS: [u32; 2] = [8, 64];
const ALL_LAMP_WALKS: u32 = 4096;
/// Sensor points that are looked at in all, evenly over sensors.
const SENSOR_POINTS: usize = 512;
/// Places of each camera's picture; this many more are tried where these show nothing.
const CAMERA_WALKS: u32 = 64;
const FINE_CAMERA_WALKS: u32 = 4096;
/// Reflections of a walk.
const BOUNCES: u32 = 6;
/// Pairs that are tried for one answer.
const MAX_PAIRS: usize = 2048;
/// Lit sensor points that are looked around from.
const LIT_POINTS: usize = 64;
/// Lamps that are asked whether they shine straight on a place.
const MAX_LAMPS_ASKED: usize = 64;
/// Directions in which the sky is looked for.
const SKY_DIRECTIONS: u32 = 32;
/// A place from which this many directions meet nothing is not in a room: behind a large flat
/// surface it is a half, in front of a missing wall less than a third.
const OPEN_SHARE: f64 = 0.35;
/// From a place in a room with windows this many do, at most.
const ROOM_SHARE: f64 = 0.1;

/// A place that light passes, with the side that it comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex {
    pub(crate) position: DVec3,
    /// Light comes and goes on this side; `None` for places that know no side.
    pub(crate) normal: Option<DVec3>,
    /// Whether no light goes on from here.
    pub(crate) is_black: bool,
}

/// A sensor point that is looked at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked {
    pub(crate) sensor: usize,
    pub(crate) point: SensorPoint,
}

/// What is known of the ways of light.
pub(crate) struct Survey<'a> {
    pub(crate) probe: &'a Probe<'a>,
    pub(crate) asked: Vec<Asked>,
    /// What each asked point gets light from.
    pub(crate) asked_vertices: Vec<Vec<Vertex>>,
    /// What each camera gets light from.
    pub(crate) camera_vertices: Vec<Vec<Vertex>>,
    /// The asked points themselves, and what cameras get light from.
    pub(crate) receivers: Vec<Vertex>,
    /// What any asked point or camera gets light from.
    pub(crate) eyes: Vec<Vertex>,
    /// Some of what all lamps send light to.
    pub(crate) lit: Vec<Vertex>,
    /// Whether light of each lamp was found to reach a sensor or camera.
    pub(crate) reaches: Vec<bool>,
    /// Whether light of any lamp was found to come to each asked point.
    pub(crate) is_lit: Vec<bool>,
    /// Whether lit sensor points are in the open, so that a place under the sky is nothing odd.
    pub(crate) is_open: bool,
}

impl<'a> Survey<'a> {
    pub(crate) fn new(probe: &'a Probe<'a>) -> Self {
        let scene = probe.scene;
        let asked = asked_points(probe);
        let walk_from = |(i, asked): (usize, &Asked)| {
            let SensorPoint { position, normal } = asked.point;
            let start = Vertex::facing(position + normal * probe.hair_m, normal);
            walk(probe, start, i as u32)
        };
        let asked_vertices: Vec<_> = asked.iter().enumerate().map(walk_from).collect();
        let camera_vertices: Vec<_> =
            (0..scene.cameras.len()).map(|camera| seen_by_camera(probe, camera)).collect();
        let [least, most] = LAMP_WALKS;
        let walks = (ALL_LAMP_WALKS / scene.lights.len().max(1) as u32).clamp(least, most);
        let cameras = || camera_vertices.iter().flatten().copied();
        let points = asked_vertices.iter().filter_map(|vertices| vertices.first().copied());
        let mut survey = Self {
            probe,
            receivers: points.chain(cameras()).collect(),
            eyes: asked_vertices.iter().flatten().copied().chain(cameras()).collect(),
            lit: Vec::new(),
            asked,
            asked_vertices,
            camera_vertices,
            reaches: Vec::new(),
            is_lit: Vec::new(),
            is_open: false,
        };
        // Of each lamp as many of its places as all lamps have room for, or of each this many lamps
        // one. All places of many lamps would take more memory than the lamps.
        let each = (MAX_PAIRS / scene.lights.len().max(1)).max(1);
        let stride = scene.lights.len().div_ceil(MAX_PAIRS).max(1);
        for (number, lamp) in scene.lights.iter().enumerate() {
            let lit = lit_by(probe, lamp, walks);
            let reaches = survey.shines(lamp, &survey.eyes) || survey.meet(&lit, &survey.eyes);
            survey.reaches.push(reaches);
            if number % stride == 0 {
                let step = lit.len().div_ceil(each).max(1);
                survey.lit.extend(lit.into_iter().step_by(step));
            }
        }
        let is_lit = |vertices: &Vec<Vertex>| survey.is_lit(vertices);
        survey.is_lit = survey.asked_vertices.iter().map(is_lit).collect();
        survey.is_open = survey.is_open();
        survey
    }

    /// Whether a vertex of one list sees a vertex of the other; of many pairs some are tried.
    pub(crate) fn meet(&self, some: &[Vertex], others: &[Vertex]) -> bool {
        let pairs = some.len() * others.len();
        if pairs <= MAX_PAIRS {
            return some.iter().any(|a| others.iter().any(|b| self.exchange(a, b)));
        }
        let pick = |share: f64, from: &[Vertex]| from[(share * from.len() as f64) as usize];
        (0..MAX_PAIRS as u32).any(|i| {
            let [u, v] = square(i);
            self.exchange(&pick(u, some), &pick(v, others))
        })
    }

    /// Whether a lamp shines straight on one of the vertices.
    pub(crate) fn shines(&self, lamp: &Light, vertices: &[Vertex]) -> bool {
        let stride = vertices.len().div_ceil(MAX_PAIRS).max(1);
        let shines_on = |vertex: &Vertex| {
            let place = shining_place(lamp, vertex.position);
            place.is_some_and(|place| self.exchange(&place, vertex))
        };
        vertices.iter().step_by(stride).any(shines_on)
    }

    /// Whether light goes from one vertex to the other.
    pub(crate) fn exchange(&self, a: &Vertex, b: &Vertex) -> bool {
        a.is_before(b.position)
            && b.is_before(a.position)
            && self.probe.sees(a.position, b.position)
    }

    /// Whether light of any lamp was found to come to these vertices.
    pub(crate) fn is_lit(&self, vertices: &[Vertex]) -> bool {
        self.any_shines(vertices) || self.meet(&self.lit, vertices)
    }

    /// Whether any lamp shines straight on one of the vertices.
    pub(crate) fn any_shines(&self, vertices: &[Vertex]) -> bool {
        let lamps = &self.probe.scene.lights;
        let stride = lamps.len().div_ceil(MAX_LAMPS_ASKED).max(1);
        lamps.iter().step_by(stride).any(|lamp| self.shines(lamp, vertices))
    }

    /// Whether most of the lit sensor points see the sky.
    fn is_open(&self) -> bool {
        let open: Vec<bool> =
            self.lit_points().map(|point| self.is_in_the_open(self.before(&point))).collect();
        2 * open.iter().filter(|open| **open).count() > open.len()
    }

    /// Some of the asked points that light was found to come to, of all sensors.
    pub(crate) fn lit_points(&self) -> impl Iterator<Item = SensorPoint> {
        let stride = self.asked.len().div_ceil(LIT_POINTS).max(1);
        let asked = self.asked.iter().zip(&self.is_lit).step_by(stride);
        asked.filter(|(_, is_lit)| **is_lit).map(|(asked, _)| asked.point)
    }

    /// A hair in front of a sensor point.
    pub(crate) fn before(&self, point: &SensorPoint) -> DVec3 {
        point.position + point.normal * self.probe.hair_m
    }

    /// Whether light of a sky comes straight to a vertex.
    pub(crate) fn sees_the_sky(&self, vertex: &Vertex) -> bool {
        let meets_nothing = |direction: DVec3| {
            direction.z > 0.0 && self.probe.first(vertex.position, direction).is_none()
        };
        self.probe.scene.environment.is_some()
            && (0..SKY_DIRECTIONS).any(|i| {
                meets_nothing(match vertex.normal {
                    Some(normal) => cosine_direction(normal, square(i)),
                    None => sphere_direction(i, SKY_DIRECTIONS),
                })
            })
    }

    /// Whether nothing is met in many directions from here.
    pub(crate) fn is_in_the_open(&self, at: DVec3) -> bool {
        self.probe.escaping_share(at) > OPEN_SHARE
    }

    /// Whether nearly all directions from here meet something.
    pub(crate) fn is_in_a_room(&self, at: DVec3) -> bool {
        self.probe.escaping_share(at) < ROOM_SHARE
    }

    /// Whether a lamp at this place would shine straight on a sensor point or on what it sees.
    pub(crate) fn would_light(&self, position: DVec3) -> bool {
        let place = Vertex::in_air(position);
        // Points and what they see alike: of every other vertex, all would be points.
        let stride = (2 * self.asked_vertices.len() / 256).max(1);
        let some = self.asked_vertices.iter().step_by(stride);
        let mut first_two = some.flat_map(|vertices| vertices.iter().take(2));
        let mut cameras = self.camera_vertices.iter().flatten();
        first_two.any(|vertex| self.exchange(&place, vertex))
            || cameras.any(|vertex| self.exchange(&place, vertex))
    }
}

/// Points of all sensors, each sensor with as many as the others where it has them.
fn asked_points(probe: &Probe<'_>) -> Vec<Asked> {
    let sensors = &probe.scene.sensors;
    let each = (SENSOR_POINTS / sensors.len().max(1)).max(4);
    let points = sensors.iter().enumerate().flat_map(|(number, sensor)| {
        let count = sensor.len();
        let taken = count.min(each);
        // A stride that is no divisor of the rows goes over both edges of a grid.
        (0..taken).map(move |i| Asked { sensor: number, point: sensor.point(i * count / taken) })
    });
    points.collect()
}

/// A vertex and those that a walk over surfaces of any reflectance meets from it.
pub(crate) fn walk(probe: &Probe<'_>, start: Vertex, number: u32) -> Vec<Vertex> {
    let mut vertices = vec![start];
    let mut here = start;
    for bounce in 0..BOUNCES {
        let Some(normal) = here.normal else { break };
        let u = square(number.wrapping_mul(7).wrapping_add(bounce.wrapping_mul(977)));
        let direction = cosine_direction(normal, u);
        let Some(surface) = probe.first(here.position, direction) else { break };
        here = Vertex::on(&surface);
        vertices.push(here);
    }
    vertices
}

fn seen_by_camera(probe: &Probe<'_>, camera: usize) -> Vec<Vertex> {
    let camera = &probe.scene.cameras[camera];
    let (view, [width, height]) = (camera.view(), camera.resolution.map(f64::from));
    let seen = |i: u32| {
        let [u, v] = square(i);
        let surface = probe.first(camera.position, view.direction([u * width, v * height]))?;
        Some(walk(probe, Vertex::on(&surface), i))
    };
    let coarse: Vec<Vertex> = (0..CAMERA_WALKS).filter_map(seen).flatten().collect();
    if !coarse.is_empty() {
        return coarse;
    }
    // A small thing in the middle of nothing.
    let fine = (CAMERA_WALKS..FINE_CAMERA_WALKS).filter_map(seen);
    fine.take(CAMERA_WALKS as usize).flatten().collect()
}

/// What a lamp sends light to; of an area light its own places, too.
fn lit_by(probe: &Probe<'_>, lamp: &Light, walks: u32) -> Vec<Vertex> {
    let along = |from, direction| Some(Vertex::on(&probe.first(from, direction)?));
    let starts: Vec<Option<Vertex>> = match lamp {
        Light::Point(light) => {
            (0..walks).map(|i| along(light.position, sphere_direction(i, walks))).collect()
        }
        Light::Luminaire(light) => {
            (0..walks).map(|i| along(light.position, emitted_direction(light, i)?)).collect()
        }
        Light::Area(light) => {
            let places = EmittingPlaces::new(&probe.scene.mesh, light);
            (0..walks).map(|i| places.place(i, probe.hair_m)).collect()
        }
    };
    let starts: Vec<Vertex> = match starts.iter().any(Option::is_some) {
        true => starts.into_iter().flatten().collect(),
        false => aimed_at(probe, lamp, walks),
    };
    (0..).zip(starts).flat_map(|(i, start)| walk(probe, start, i)).collect()
}

/// What a lamp lights that has only small things around it, of some triangles.
fn aimed_at(probe: &Probe<'_>, lamp: &Light, count: u32) -> Vec<Vertex> {
    let mesh = &probe.scene.mesh;
    let stride = mesh.triangles.len().div_ceil(count as usize).max(1);
    let lit = (0..mesh.triangles.len() as u32).step_by(stride).filter_map(|triangle| {
        let [a, b, c] = mesh.corners(triangle);
        let centre = (a + b + c) / 3.0;
        let from = shining_place(lamp, centre)?.position;
        Some(Vertex::on(&probe.first(from, (centre - from).try_normalize()?)?))
    });
    lit.collect()
}

/// The place of a lamp from which it shines toward another; `None` for one that does not, or is a
/// surface.
fn shining_place(lamp: &Light, toward: DVec3) -> Option<Vertex> {
    let (position, is_bright) = match lamp {
        Light::Point(light) => (light.position, light.intensity_cd > 0.0),
        Light::Luminaire(light) => {
            let direction = (toward - light.position).normalize_or_zero();
            (light.position, light.intensity_cd(direction) > 0.0)
        }
        Light::Area(_) => return None,
    };
    is_bright.then_some(Vertex::in_air(position))
}

/// Places of a lamp from which it shines toward another; of one that is a surface some.
pub(crate) fn shining_places(probe: &Probe<'_>, lamp: &Light, toward: DVec3) -> Vec<Vertex> {
    const PLACES: u32 = 4;
    let Light::Area(light) = lamp else { return shining_place(lamp, toward).into_iter().collect() };
    let places = EmittingPlaces::new(&probe.scene.mesh, light);
    let places = (0..PLACES).filter_map(|i| places.place(i, probe.hair_m));
    places.filter(|place| place.is_before(toward)).collect()
}

/// Where a lamp is; `None` for one that is a surface.
pub(crate) fn position_of(lamp: &Light) -> Option<DVec3> {
    match lamp {
        Light::Point(light) => Some(light.position),
        Light::Luminaire(light) => Some(light.position),
        Light::Area(_) => None,
    }
}

/// A direction that a luminaire shines in, by its intensities.
pub(crate) fn emitted_direction(light: &Luminaire, i: u32) -> Option<DVec3> {
    let local = light.photometry.sample_direction(square(i))?;
    Some(light.world_from_luminaire * local)
}

/// Places on the faces of an area light, by area.
struct EmittingPlaces<'m> {
    mesh: &'m Mesh,
    light: &'m AreaLight,
    faces: Option<Discrete>,
}

impl<'m> EmittingPlaces<'m> {
    fn new(mesh: &'m Mesh, light: &'m AreaLight) -> Self {
        let areas_m2: Vec<f64> = light.triangles.iter().map(|&t| mesh.area_m2(t)).collect();
        Self { mesh, light, faces: Discrete::new(&areas_m2) }
    }

    /// Place `i`, a hair in front of its face.
    fn place(&self, i: u32, hair_m: f64) -> Option<Vertex> {
        let [along, across] = square(i);
        let face = self.faces.as_ref()?.sample(along);
        let triangle = self.light.triangles[face.index];
        let barycentric = sample_triangle([face.u_remapped, across]);
        let corners = self.mesh.corners(triangle).into_iter().zip(barycentric);
        let position: DVec3 = corners.map(|(corner, weight)| corner * weight).sum();
        let normal = self.mesh.front_normal(triangle);
        Some(Vertex::facing(position + normal * hair_m, normal))
    }
}

impl Vertex {
    pub(crate) fn on(surface: &Surface) -> Self {
        let Surface { position, normal, is_black, .. } = *surface;
        Self { position, normal: Some(normal), is_black }
    }

    /// A place that light comes from or to on the side of a normal.
    pub(crate) fn facing(position: DVec3, normal: DVec3) -> Self {
        Self { position, normal: Some(normal), is_black: false }
    }

    /// A place in the air.
    pub(crate) fn in_air(position: DVec3) -> Self {
        Self { position, normal: None, is_black: false }
    }

    /// Whether a place lies on the side where light comes and goes.
    pub(crate) fn is_before(&self, place: DVec3) -> bool {
        self.normal.is_none_or(|normal| normal.dot(place - self.position) > 0.0)
    }
}
