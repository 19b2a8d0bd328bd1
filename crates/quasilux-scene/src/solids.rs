//! Closed objects of a mesh, and which points they contain.
//!
//! A solid is a connected set of triangles in which every edge belongs to an even number of them,
//! so that the parity of crossings along a ray tells inside from outside (Jordan's theorem modulo
//! 2). Connection is through shared edges; vertices at the same position are one vertex of the
//! mesh.

use crate::Mesh;
use glam::DVec3;

/// Meshes of more triangles are not searched for solids.
const MAX_TRIANGLES: usize = 2_000_000;

/// Directions in no special position: another is tried where a ray grazes an edge.
const DIRECTIONS: [DVec3; 6] = [
    DVec3::new(0.367_119, 0.281_737, 0.886_471),
    DVec3::new(-0.519_283, 0.742_911, 0.422_369),
    DVec3::new(0.631_957, -0.318_403, -0.706_553),
    DVec3::new(-0.223_607, -0.907_341, 0.356_011),
    DVec3::new(0.881_113, 0.457_979, -0.118_051),
    DVec3::new(-0.713_287, 0.115_931, -0.691_213),
];

/// Volumes below this share of the product of their edges are taken as zero.
const GRAZING: f64 = 1e-12;

/// A closed object.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// Its triangles, in ascending order.
    pub triangles: Vec<u32>,
    low: DVec3,
    high: DVec3,
}

/// The solids that some triangles of a mesh, in ascending order, make by themselves.
#[must_use]
pub(crate) fn solids_among(mesh: &Mesh, triangles: &[u32]) -> Vec<Solid> {
    let corners = |&triangle: &u32| mesh.triangles[triangle as usize];
    let part = Mesh {
        positions: mesh.positions.clone(),
        triangles: triangles.iter().map(corners).collect(),
        ..Mesh::default()
    };
    let mut solids = solids_of(&part);
    let numbers = solids.iter_mut().flat_map(|solid| &mut solid.triangles);
    numbers.for_each(|number| *number = triangles[*number as usize]);
    solids
}

/// All solids of a mesh, in the order of their first triangles.
#[must_use]
pub fn solids_of(mesh: &Mesh) -> Vec<Solid> {
    let count = mesh.triangles.len();
    if count > MAX_TRIANGLES {
        return Vec::new();
    }
    let Forest { mut parent, is_open } = Forest::new(mesh);
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); count];
    let mut closed = vec![true; count];
    for (triangle, is_open) in is_open.into_iter().enumerate() {
        let root = root(&mut parent, triangle);
        members[root].push(triangle as u32);
        closed[root] &= !is_open;
    }
    let mut solids: Vec<Solid> = members
        .into_iter()
        .zip(closed)
        .filter(|(triangles, closed)| *closed && triangles.len() >= 4)
        .map(|(triangles, _)| Solid::new(mesh, triangles))
        .collect();
    solids.sort_by_key(|solid| solid.triangles[0]);
    solids
}

/// Trees of triangles that share edges.
struct Forest {
    /// The parent of each triangle; a root is its own.
    parent: Vec<usize>,
    /// Which triangles have an edge that an odd number of triangles share.
    is_open: Vec<bool>,
}

impl Forest {
    fn new(mesh: &Mesh) -> Self {
        let mut edges: Vec<(u32, u32, u32)> = Vec::with_capacity(3 * mesh.triangles.len());
        for (triangle, &[a, b, c]) in (0..).zip(&mesh.triangles) {
            edges.extend([(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b), triangle)));
        }
        edges.sort_unstable();
        let mut parent: Vec<usize> = (0..mesh.triangles.len()).collect();
        let mut is_open = vec![false; mesh.triangles.len()];
        for sharers in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let first = sharers[0].2 as usize;
            is_open[first] |= sharers.len() % 2 == 1;
            for &(_, _, other) in &sharers[1..] {
                let (a, b) = (root(&mut parent, first), root(&mut parent, other as usize));
                parent[a.max(b)] = a.min(b);
            }
        }
        Self { parent, is_open }
    }
}

/// The root of a tree, halving the path to it (Tarjan and van Leeuwen 1984).
fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
}

impl Solid {
    fn new(mesh: &Mesh, triangles: Vec<u32>) -> Self {
        let corners = triangles.iter().flat_map(|&t| mesh.corners(t));
        let everything = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = corners.fold(everything, |(low, high), p| (low.min(p), high.max(p)));
        Self { triangles, low, high }
    }

    /// The edges of the box around the solid, in m.
    #[must_use]
    pub fn edges_m(&self) -> DVec3 {
        self.high - self.low
    }

    /// Its smallest extent along level directions, in m, some 1 % of its length too large at most.
    #[must_use]
    pub fn width_m(&self, mesh: &Mesh) -> f64 {
        const DIRECTIONS: u32 = 180;
        let extent_m = |i: u32| {
            let (sine, cosine) =
                libm::sincos(std::f64::consts::PI * f64::from(i) / f64::from(DIRECTIONS));
            let corners = self.triangles.iter().flat_map(|&triangle| mesh.corners(triangle));
            let along = corners.map(|at| cosine * at.x + sine * at.y);
            let [low, high] = along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
                [low.min(at), high.max(at)]
            });
            high - low
        };
        (0..DIRECTIONS).map(extent_m).fold(f64::INFINITY, f64::min)
    }

    /// The diagonal of that box, in m.
    #[must_use]
    pub fn size_m(&self) -> f64 {
        self.edges_m().length()
    }

    /// Whether the point is in the box around the solid.
    #[must_use]
    pub fn may_contain(&self, point: DVec3) -> bool {
        point.cmpgt(self.low).all() && point.cmplt(self.high).all()
    }

    /// Whether the point is inside; a point that no direction decides, as on an edge, is not.
    #[must_use]
    pub fn contains(&self, mesh: &Mesh, point: DVec3) -> bool {
        self.may_contain(point)
            && DIRECTIONS
                .iter()
                .find_map(|&direction| self.is_odd_along(mesh, point, direction))
                .unwrap_or(false)
    }

    /// Whether the ray crosses an odd number of triangles; `None` where it grazes an edge.
    fn is_odd_along(&self, mesh: &Mesh, point: DVec3, direction: DVec3) -> Option<bool> {
        let mut odd = false;
        for &triangle in &self.triangles {
            let corners = mesh.corners(triangle).map(|corner| corner - point);
            odd ^= crosses(corners, direction)?;
        }
        Some(odd)
    }
}

/// Whether the ray from the origin along `direction` crosses the triangle; `None` where it passes
/// too near to an edge to tell.
fn crosses([a, b, c]: [DVec3; 3], direction: DVec3) -> Option<bool> {
    // The side on which the ray passes an edge is the sign of the volume that they span.
    let side = |p: DVec3, q: DVec3| {
        let volume = direction.dot(p.cross(q));
        let grazes = volume.abs() <= GRAZING * p.length() * q.length();
        if grazes { 0.0 } else { volume.signum() }
    };
    let sides = [side(a, b), side(b, c), side(c, a)];
    if sides.contains(&1.0) && sides.contains(&-1.0) {
        return Some(false);
    }
    if sides.contains(&0.0) {
        return None;
    }
    let normal = (b - a).cross(c - a);
    Some(a.dot(normal) * direction.dot(normal) > 0.0)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Adds the twelve triangles of a box.
    pub(crate) fn add_box(mesh: &mut Mesh, low: DVec3, high: DVec3) {
        let first = mesh.positions.len() as u32;
        for i in 0..8 {
            let pick = |bit: usize, axis: usize| {
                if i >> bit & 1 == 1 { high[axis] } else { low[axis] }
            };
            mesh.positions.push(DVec3::new(pick(0, 0), pick(1, 1), pick(2, 2)));
        }
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        for [a, b, c, d] in quads.map(|quad: [u32; 4]| quad.map(|v| first + v)) {
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
            mesh.material_of.extend([0, 0]);
            mesh.object_of.extend([0, 0]);
        }
    }

    #[test]
    fn a_box_contains_its_inside_only() {
        let mut mesh = Mesh::default();
        add_box(&mut mesh, DVec3::ZERO, DVec3::new(1.0, 2.0, 3.0));
        let solids = solids_of(&mesh);
        assert_eq!(solids.len(), 1);
        // A grid of points, most of which see corners and edges in line with others.
        for i in -2..=6 {
            for j in -2..=10 {
                for k in -2..=14 {
                    let point = DVec3::new(f64::from(i), f64::from(j), f64::from(k)) / 4.0;
                    if [0, 4].contains(&i) || [0, 8].contains(&j) || [0, 12].contains(&k) {
                        continue;
                    }
                    let inside = (1..4).contains(&i) && (1..8).contains(&j) && (1..12).contains(&k);
                    assert_eq!(solids[0].contains(&mesh, point), inside, "{point}");
                }
            }
        }
    }

    #[test]
    fn a_box_without_a_triangle_is_no_solid() {
        let mut mesh = Mesh::default();
        add_box(&mut mesh, DVec3::ZERO, DVec3::ONE);
        add_box(&mut mesh, DVec3::ONE * 2.0, DVec3::ONE * 3.0);
        mesh.triangles.remove(5);
        let solids = solids_of(&mesh);
        assert_eq!(solids.len(), 1);
        assert_eq!(solids[0].triangles, (11..23).collect::<Vec<u32>>());
    }

    #[test]
    fn every_direction_agrees_inside_a_box() {
        let mut mesh = Mesh::default();
        add_box(&mut mesh, -DVec3::ONE, DVec3::ONE);
        let solid = &solids_of(&mesh)[0];
        for direction in DIRECTIONS {
            let inside = solid.is_odd_along(&mesh, DVec3::new(0.1, 0.2, 0.3), direction);
            assert_eq!(inside, Some(true), "{direction}");
            let outside = solid.is_odd_along(&mesh, DVec3::new(1.1, 0.2, 0.3), direction);
            assert_eq!(outside, Some(false), "{direction}");
        }
    }
}
