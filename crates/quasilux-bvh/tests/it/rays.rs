//! Rays that are hard on a ray kernel, given a mesh.

use crate::meshes::{Numbers, Triangles};
use glam::DVec3;
use quasilux_bvh::{Hit, Ray, RayQuery};

/// A ray at a mesh, its first part, and what it shall not hit.
#[derive(Clone, Debug)]
pub(crate) struct HardQuery {
    pub(crate) ray: Ray,
    pub(crate) short: Ray,
    pub(crate) excluded: Vec<u32>,
}

/// Sizes of batches around those of the groups that a kernel may make.
pub(crate) const BATCHES: [usize; 13] = [0, 1, 7, 8, 9, 23, 24, 25, 63, 64, 65, 1000, 10_000];

/// Rays from inside and just outside, from triangles, from corners and from far away: in random
/// directions, along axes, toward corners and edges, in the planes of triangles or very nearly so,
/// and along edges.
pub(crate) fn hard_query(mesh: &Triangles, number: usize, numbers: &mut Numbers) -> HardQuery {
    let Extent { low, size } = extent(mesh);
    let any = |numbers: &mut Numbers| (numbers.next() * mesh.len() as f64) as usize;
    let [a, b, c] = mesh[any(numbers)];
    let on_plane = |numbers: &mut Numbers, low: f64, high: f64| {
        let p = numbers.point(low, high);
        a + (b - a) * p.x + (c - a) * p.y
    };
    let mut origin = match number % 16 {
        0..10 => low + size * numbers.point(-0.2, 1.2),
        10..12 => on_plane(numbers, 0.0, 0.5),
        12 => a,
        13 => low + size * numbers.point(-1e4, 1e4),
        _ => low + size * numbers.point(-100.0, 100.0),
    };
    let direction = match number % 7 {
        0 => numbers.direction(),
        1 => DVec3::AXES[number / 7 % 3] * if number.is_multiple_of(2) { 1.0 } else { -1.0 },
        2 => unit([a, b, c][number % 3] - origin),
        3 => unit(a + (b - a) * numbers.next() - origin),
        4 => {
            origin = on_plane(numbers, -2.0, 3.0);
            unit(on_plane(numbers, 0.0, 1.0) - origin)
        }
        5 => {
            origin = b + (b - a) * (4.0 * numbers.next() - 2.0);
            unit(if number.is_multiple_of(2) { a - b } else { a - origin })
        }
        _ => {
            const OFF: [f64; 6] = [1e-2, 1e-5, 1e-7, 1e-9, 1e-12, 1e-16];
            let off = numbers.direction() * size * OFF[number / 7 % OFF.len()];
            origin = on_plane(numbers, -2.0, 3.0) + off;
            unit(on_plane(numbers, 0.0, 1.0) - origin)
        }
    };
    let excluded = (0..number % 5).map(|_| any(numbers) as u32).collect();
    let ray = Ray::new(origin, direction);
    HardQuery { ray, short: ray.up_to(size.max_element() * 2.0 * numbers.next()), excluded }
}

/// Runs of rays that stay close together, and hard rays between them, some of them short.
pub(crate) fn hard_shots(mesh: &Triangles, count: usize, numbers: &mut Numbers) -> Vec<RayQuery> {
    let Extent { size, .. } = extent(mesh);
    let mut shots = Vec::with_capacity(count);
    while shots.len() < count {
        let number = (numbers.next() * 1e6) as usize;
        let HardQuery { ray, short, excluded } = hard_query(mesh, number, numbers);
        let length = [1, 1, 3, 20, 90][number % 5].min(count - shots.len());
        let (spread, shift) = ([1e-1, 1e-2, 1e-4, 0.0][number % 4], [0.0, 1e-3][number % 2]);
        for i in 0..length {
            let mut ray = if (number + i).is_multiple_of(3) { short } else { ray };
            if i > 0 {
                ray.direction = unit(ray.direction + numbers.direction() * spread);
                ray.origin += size * numbers.point(-shift, shift);
            }
            let excluded = |at: usize| excluded.get(at).copied().unwrap_or(RayQuery::NONE);
            shots.push(RayQuery { ray, excluded: [excluded(0), excluded(1)] });
        }
    }
    shots
}

/// Everything about a hit, to the last bit.
pub(crate) fn bits(hit: Option<Hit>) -> Option<[u64; 5]> {
    hit.map(|hit| {
        let [u, v, w] = hit.barycentric.map(f64::to_bits);
        [u64::from(hit.triangle), hit.distance.to_bits(), u, v, w]
    })
}

/// The lower corner of the box around a mesh, and its edges.
struct Extent {
    low: DVec3,
    size: DVec3,
}

fn extent(mesh: &Triangles) -> Extent {
    let points = mesh.iter().flatten().copied();
    let low = points.clone().reduce(DVec3::min).unwrap();
    Extent { low, size: points.reduce(DVec3::max).unwrap() - low }
}

/// A unit vector, whatever the scale; that along x where there is none.
pub(crate) fn unit(v: DVec3) -> DVec3 {
    let size = v.abs().max_element();
    let direction = (v / size).normalize_or_zero();
    if size > 0.0 && direction.is_finite() { direction } else { DVec3::X }
}
