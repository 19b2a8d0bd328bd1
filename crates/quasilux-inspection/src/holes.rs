//! Holes in a room: light that leaves, and the edges around the way that it takes.
//!
//! A scene counts as a room where most directions from its lit places meet a surface. Openings that
//! a lamp shines or a camera looks through from outside are meant, and all of them under a sky. A
//! hole's border is a loop of edges that belong to one triangle each, and that leaving rays go
//! through.

use crate::finding::{Check, Findings};
use crate::names;
use crate::probe::sphere_direction;
use crate::survey::Survey;
use crate::survey::position_of;
use glam::{DVec2, DVec3};
use quasilux_scene::Mesh;

/// Places that cameras see which rays leave from.
const PLACES: usize = 64;
/// Rays from each.
const DIRECTIONS: u32 = 96;
/// Of level directions in a convex room, fewer than half lead to one flat wall, and nearly all to
/// any; likewise most directions upward and downward lead to ceiling and floor.
const MOST: f64 = 0.5;
const NEARLY_ALL: f64 = 0.9;
/// Elevations of level directions, as tangents: a floor is below them.
const ELEVATIONS: [f64; 2] = [0.02, 0.06];
/// Tangents from the vertical of directions upward and downward.
const SLANTS: [f64; 2] = [0.2, 0.6];
/// Azimuths of both.
const AZIMUTHS: u32 = 12;
/// Less than this share is no hole, and what has no border edges less than the other no gap: models
/// are not closed, and the other one is the tolerance that runs have by default.
const MIN_LEAVING: f64 = 2e-4;
const MIN_LEAVING_BY_GAPS: f64 = 0.01;
/// Pairs of loops and rays that are looked at.
const MAX_PIERCINGS: usize = 10_000_000;
/// Edges of a loop.
const MAX_LOOP: usize = 4096;
/// Holes that are listed.
const MAX_LISTED: usize = 3;

/// A ray that meets nothing.
struct EscapingRay {
    from: DVec3,
    direction: DVec3,
}

/// What rays from lit places meet.
#[derive(Default)]
struct Surroundings {
    rays: usize,
    leaving: Vec<EscapingRay>,
    level: Side,
    up: Side,
    down: Side,
}

/// Rays to one side: all, and those that meet something.
#[derive(Clone, Copy, Default)]
struct Side {
    rays: usize,
    met: usize,
}

/// A loop of border edges.
struct Hole {
    corners: Vec<DVec3>,
    pierced: usize,
}

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    if survey.probe.scene.environment.is_some() {
        return;
    }
    let surroundings = surroundings(survey);
    let leaving = surroundings.leaving.len() as f64 / surroundings.rays.max(1) as f64;
    if leaving < MIN_LEAVING || !surroundings.is_room() || is_looked_through(survey) {
        return;
    }
    let mesh = &survey.probe.scene.mesh;
    let holes = holes(mesh, &surroundings.leaving);
    let share = format!("{:.2} % of directions from lit places lead out", 100.0 * leaving);
    let cure = "add the missing surface, or a dark one: the light that leaves is lost";
    let place = findings.places.scene;
    for hole in holes.iter().take(MAX_LISTED) {
        let message = format!(
            "the geometry has a hole of {:.2} m² between {} and {}, edged by {}: {share}",
            hole.area_m2(),
            names::position(hole.corners.iter().copied().fold(DVec3::INFINITY, DVec3::min)),
            names::position(hole.corners.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max)),
            names::count(hole.corners.len(), "edge", "edges"),
        );
        findings.add(Check::Hole, place, message, cure).at(hole.centre());
    }
    if holes.is_empty() && leaving >= MIN_LEAVING_BY_GAPS {
        let at = exit(survey, &surroundings.leaving[0]);
        let message = format!(
            "the geometry has gaps between its surfaces, near {}: {share}",
            names::position(at)
        );
        findings.add(Check::Hole, place, message, cure).at(at);
    }
}

/// Rays from places that get light.
fn surroundings(survey: &Survey<'_>) -> Surroundings {
    let sensors = survey.lit_points().map(|point| survey.before(&point));
    let of_cameras = survey.camera_vertices.iter().flatten();
    let cameras = of_cameras.step_by(8).take(PLACES).map(|vertex| vertex.position);
    let mut surroundings = Surroundings::default();
    for from in sensors.chain(cameras) {
        surroundings.look_around(survey, from);
        for i in 0..DIRECTIONS {
            let direction = sphere_direction(i, DIRECTIONS);
            let met = survey.probe.meets(from, direction);
            surroundings.rays += 1;
            if !met {
                surroundings.leaving.push(EscapingRay { from, direction });
            }
        }
    }
    surroundings
}

impl Side {
    fn add(&mut self, met: bool) {
        self.rays += 1;
        self.met += usize::from(met);
    }

    /// The share of rays that meet something.
    fn closed(self) -> f64 {
        self.met as f64 / self.rays.max(1) as f64
    }
}

impl Surroundings {
    /// Looks to all sides.
    fn look_around(&mut self, survey: &Survey<'_>, from: DVec3) {
        let meets = |direction: DVec3| survey.probe.meets(from, direction.normalize());
        for azimuth in 0..AZIMUTHS {
            let turn = std::f64::consts::TAU * f64::from(azimuth) / f64::from(AZIMUTHS);
            let (sine, cosine) = libm::sincos(turn);
            let across = DVec3::new(cosine, sine, 0.0);
            for elevation in ELEVATIONS {
                self.level.add(meets(across + DVec3::Z * elevation));
            }
            for slant in SLANTS {
                self.up.add(meets(across * slant + DVec3::Z));
                self.down.add(meets(across * slant - DVec3::Z));
            }
        }
    }

    /// Whether no more than one of walls, floor and ceiling can be missing.
    fn is_room(&self) -> bool {
        let [level, up, down] = [self.level, self.up, self.down].map(Side::closed);
        level > MOST && up > MOST && down > MOST || level > NEARLY_ALL && up.max(down) > MOST
    }
}

/// Whether a camera or a lamp whose light arrives stands outside: then it is through the hole.
fn is_looked_through(survey: &Survey<'_>) -> bool {
    let scene = survey.probe.scene;
    let [low, high] = scene.mesh.bounds().unwrap_or_default();
    let is_beyond = |at: DVec3| at.cmplt(low).any() || at.cmpgt(high).any();
    let mut lamps = scene.lights.iter().zip(&survey.reaches).filter(|(_, reaches)| **reaches);
    let shines_in = lamps.any(|(lamp, _)| position_of(lamp).is_some_and(is_beyond));
    let looks_in = |(camera, seen): (&quasilux_scene::Camera, &Vec<_>)| {
        is_beyond(camera.position) && survey.is_lit(seen)
    };
    shines_in || scene.cameras.iter().zip(&survey.camera_vertices).any(looks_in)
}

/// Where a ray leaves the box around the geometry.
fn exit(survey: &Survey<'_>, ray: &EscapingRay) -> DVec3 {
    let [low, high] = survey.probe.scene.mesh.bounds().unwrap_or_default();
    let end_m = (0..3)
        .map(|axis| {
            let wall = if ray.direction[axis] > 0.0 { high[axis] } else { low[axis] };
            (wall - ray.from[axis]) / ray.direction[axis]
        })
        .filter(|t| t.is_finite())
        .fold(f64::INFINITY, f64::min);
    ray.from + ray.direction * if end_m.is_finite() { end_m.max(0.0) } else { 0.0 }
}

/// Loops of border edges that leaving rays go through, those of most rays first.
fn holes(mesh: &Mesh, leaving: &[EscapingRay]) -> Vec<Hole> {
    let mut holes: Vec<Hole> = loops(&border(mesh))
        .into_iter()
        .map(|corners| {
            let corners = corners.iter().map(|&v| mesh.positions[v as usize]).collect();
            Hole { corners, pierced: 0 }
        })
        .collect();
    // Every triangle of a mesh without shared corners is a loop of its own.
    let stride = (holes.len() * leaving.len()).div_ceil(MAX_PIERCINGS).max(1);
    for hole in &mut holes {
        let rays = leaving.iter().step_by(stride);
        hole.pierced = rays.filter(|ray| hole.is_pierced(ray)).count();
    }
    holes.retain(|hole| hole.pierced > 0);
    holes.sort_by_key(|hole| std::cmp::Reverse(hole.pierced));
    holes
}

/// Edges that belong to a single triangle, each as its two vertices in ascending order.
fn border(mesh: &Mesh) -> Vec<[u32; 2]> {
    let mut edges: Vec<u64> = Vec::with_capacity(3 * mesh.triangles.len());
    for &[a, b, c] in &mesh.triangles {
        edges.extend(
            [(a, b), (b, c), (c, a)].map(|(a, b)| u64::from(a.min(b)) << 32 | u64::from(a.max(b))),
        );
    }
    edges.sort_unstable();
    let single = edges.chunk_by(|a, b| a == b).filter(|sharers| sharers.len() == 1);
    single.map(|edge| [(edge[0] >> 32) as u32, edge[0] as u32]).collect()
}

/// Border edges joined to loops; where several meet in a vertex the first one is followed.
fn loops(border: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut ends: Vec<[u32; 2]> = border.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
    ends.sort_unstable();
    let mut is_used = vec![false; ends.len()];
    let mut loops = Vec::new();
    for start in 0..ends.len() {
        if is_used[start] {
            continue;
        }
        let [first, mut here] = ends[start];
        let mut corners = vec![first];
        let mut from = first;
        take(&ends, &mut is_used, [first, here]);
        while here != first && corners.len() < MAX_LOOP {
            corners.push(here);
            let begin = ends.partition_point(|end| end[0] < here);
            let onward = (begin..ends.len())
                .take_while(|&k| ends[k][0] == here)
                .find(|&k| !is_used[k] && ends[k][1] != from);
            let Some(next) = onward.map(|k| ends[k][1]) else { break };
            take(&ends, &mut is_used, [here, next]);
            (from, here) = (here, next);
        }
        if here == first && corners.len() >= 3 {
            loops.push(corners);
        }
    }
    loops
}

/// Marks an edge as used, in both directions.
fn take(ends: &[[u32; 2]], is_used: &mut [bool], [a, b]: [u32; 2]) {
    for end in [[a, b], [b, a]] {
        if let Ok(at) = ends.binary_search(&end) {
            is_used[at] = true;
        }
    }
}

impl Hole {
    fn centre(&self) -> DVec3 {
        self.corners.iter().copied().sum::<DVec3>() / self.corners.len() as f64
    }

    /// Half of the sum of cross products along the loop (Newell's method).
    fn area_vector(&self) -> DVec3 {
        let centre = self.centre();
        let next = self.corners.iter().cycle().skip(1);
        let crosses = self.corners.iter().zip(next).map(|(&a, &b)| (a - centre).cross(b - centre));
        0.5 * crosses.sum::<DVec3>()
    }

    fn area_m2(&self) -> f64 {
        self.area_vector().length()
    }

    /// Whether a ray goes through the loop, which is taken as flat.
    fn is_pierced(&self, ray: &EscapingRay) -> bool {
        let Some(normal) = self.area_vector().try_normalize() else { return false };
        let distance_m = (self.centre() - ray.from).dot(normal) / ray.direction.dot(normal);
        if !(distance_m.is_finite() && distance_m > 0.0) {
            return false;
        }
        let (u, v) = normal.any_orthonormal_pair();
        let flat = |p: DVec3| DVec2::new(p.dot(u), p.dot(v));
        let at = flat(ray.from + ray.direction * distance_m);
        let mut is_inside = false;
        let next = self.corners.iter().cycle().skip(1);
        for (&a, &b) in self.corners.iter().zip(next) {
            let (a, b) = (flat(a), flat(b));
            if (a.y > at.y) != (b.y > at.y) {
                let crossing = a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x);
                is_inside ^= crossing > at.x;
            }
        }
        is_inside
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_with_a_square_hole_has_two_loops() {
        let mut mesh = Mesh::default();
        for half in [2.0, 1.0] {
            for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                mesh.positions.push(DVec3::new(x * half, y * half, 0.0));
            }
        }
        for k in 0..4_u32 {
            let next = (k + 1) % 4;
            mesh.triangles.extend([[k, next, 4 + next], [k, 4 + next, 4 + k]]);
        }
        let found = loops(&border(&mesh));
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4]);
        let ray = |x: f64| EscapingRay { from: DVec3::new(x, 0.1, -1.0), direction: DVec3::Z };
        let holes = holes(&mesh, &[ray(0.2), ray(0.3), ray(5.0)]);
        assert_eq!(holes.len(), 2);
        assert!(holes.iter().all(|hole| hole.pierced == 2));
        assert!(
            (holes[1].area_m2() - 4.0).abs() < 1e-12 || (holes[0].area_m2() - 4.0).abs() < 1e-12
        );
    }
}
