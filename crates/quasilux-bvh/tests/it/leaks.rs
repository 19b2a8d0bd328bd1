//! No ray leaves a closed mesh, not even through its edges and vertices, however nearly along its
//! surface, alone or in a batch.

use crate::meshes::{Numbers, Triangles, ball, prism};
use crate::rays::unit;
use glam::DVec3;
use quasilux_bvh::{Ray, RayQuery, TriangleBvh};

/// Scales of meshes, from a micrometre to more than planets.
const SCALES: [f64; 6] = [1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9];

/// How far off zero they are, in their scales.
const OFFSETS: [DVec3; 3] =
    [DVec3::ZERO, DVec3::new(0.1, -20.0, 3.0), DVec3::new(4e6, -5e6, 333.3)];

/// The unit cube, closed, each side a grid of this many squares a side, its vertices shared to the
/// last bit.
fn room(side: usize) -> Triangles {
    let at = |i: usize| i as f64 / side as f64;
    let mut triangles = Vec::new();
    for (axis, level) in (0..6).map(|wall| (wall / 2, (wall % 2) as f64)) {
        let corner = |i: usize, j: usize| {
            let mut p = DVec3::splat(level);
            p[(axis + 1) % 3] = at(i);
            p[(axis + 2) % 3] = at(j);
            p
        };
        for (i, j) in (0..side).flat_map(|i| (0..side).map(move |j| (i, j))) {
            let (a, c) = (corner(i, j), corner(i + 1, j + 1));
            triangles.extend([[a, corner(i + 1, j), c], [a, c, corner(i, j + 1)]]);
        }
    }
    triangles
}

/// Rays from points inside toward vertices, edges and insides of all triangles.
fn rays_from(mesh: &Triangles, inside: &[DVec3], numbers: &mut Numbers) -> Vec<Ray> {
    let mut rays = Vec::new();
    for (i, &[a, b, c]) in mesh.iter().enumerate() {
        let origin = inside[i % inside.len()];
        let on_edge = |p: DVec3, q: DVec3, at: f64| p + (q - p) * at;
        for target in [
            a,
            on_edge(a, b, 0.5),
            on_edge(b, c, numbers.next()),
            on_edge(c, a, 1e-9),
            (a + b + c) / 3.0,
            a + (b - a) * (1.0 - 1e-12) + (c - a) * 1e-13,
        ] {
            rays.push(Ray::new(origin, unit(target - origin)));
        }
    }
    rays
}

/// How many of the rays meet nothing, one by one, in a batch, and blocked by nothing.
fn leaks(bvh: &TriangleBvh, rays: &[Ray]) -> [usize; 4] {
    let shots: Vec<RayQuery> =
        rays.iter().map(|&ray| RayQuery { ray, excluded: [RayQuery::NONE; 2] }).collect();
    let (mut hits, mut occluded) = (vec![None; rays.len()], vec![false; rays.len()]);
    bvh.closest_hit_batch(&shots, &mut hits);
    bvh.occluded_batch(&shots, &mut occluded);
    [
        rays.iter().filter(|ray| bvh.closest_hit(ray, &[]).is_none()).count(),
        rays.iter().filter(|ray| !bvh.is_occluded(ray, &[])).count(),
        hits.iter().filter(|hit| hit.is_none()).count(),
        occluded.iter().filter(|&&occluded| !occluded).count(),
    ]
}

/// Scaled and moved, with points of its inside.
fn assert_closed(name: &str, mesh: &Triangles, inside: &[DVec3], numbers: &mut Numbers) {
    for scale in SCALES {
        for offset in OFFSETS {
            let place = |p: &DVec3| (*p + offset) * scale;
            let mesh: Triangles = mesh.iter().map(|t| t.each_ref().map(place)).collect();
            let inside: Vec<DVec3> = inside.iter().map(place).collect();
            let bvh = TriangleBvh::build(mesh.clone());
            let leaks = leaks(&bvh, &rays_from(&mesh, &inside, numbers));
            assert_eq!(leaks, [0; 4], "{name} leaks at {offset} times {scale}");
        }
    }
}

#[test]
fn balls_are_closed() {
    let numbers = &mut Numbers(3);
    let inside: Vec<DVec3> = (0..50).map(|_| 0.5 * numbers.direction()).collect();
    assert_closed("ball", &ball(DVec3::ZERO, 1.0, 4), &inside, numbers);
}

#[test]
fn boxes_and_rooms_are_closed() {
    let numbers = &mut Numbers(4);
    for side in [1, 2, 7] {
        let mut inside: Vec<DVec3> = (0..20).map(|_| numbers.point(0.01, 0.99)).collect();
        // In the planes of grid lines, so that rays run through edges and vertices in a row.
        inside.extend([0.5, 1.0 / 7.0, 3.0 / 7.0].map(|x| DVec3::new(x, 0.5, x)));
        assert_closed("room", &room(side), &inside, numbers);
    }
}

#[test]
fn a_prism_of_slivers_is_closed() {
    let numbers = &mut Numbers(5);
    let mesh = prism(numbers, 300);
    let inside: Vec<DVec3> =
        (0..20).map(|_| DVec3::new(0.2, 0.1, 1.5) + 0.2 * numbers.direction()).collect();
    assert_closed("prism", &mesh, &inside, numbers);
}

/// Just above the floor of a long corridor, and almost along it.
#[test]
fn no_ray_slips_through_at_a_grazing_angle() {
    let numbers = &mut Numbers(6);
    let corridor: Triangles =
        room(5).into_iter().map(|t| t.map(|p| p * DVec3::new(1000.0, 3.0, 3.0))).collect();
    let bvh = TriangleBvh::build(corridor);
    let mut rays = Vec::new();
    for height in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        for _ in 0..400 {
            let origin = DVec3::new(1.0, 1.0 + numbers.next(), height);
            let end = numbers.point(0.0, 1.0) * DVec3::new(900.0, 1.0, 0.0);
            rays.push(Ray::new(origin, unit(origin.with_x(2.0).with_z(0.0) + end - origin)));
            rays.push(Ray::new(origin, unit(end.with_z(height) - origin.with_y(0.0))));
        }
    }
    assert_eq!(leaks(&bvh, &rays), [0; 4]);
    let floor_hits = rays.iter().step_by(2).filter(|ray| {
        bvh.closest_hit(ray, &[]).is_some_and(|hit| ray.at(hit.distance).z.abs() < 1e-9)
    });
    assert!(floor_hits.count() > 1900, "rays at the floor meet the floor");
}

/// That a leak would be seen.
#[test]
fn a_mesh_with_a_hole_leaks() {
    let numbers = &mut Numbers(3);
    let mesh = ball(DVec3::ZERO, 1.0, 4);
    let rays = rays_from(&mesh, &[DVec3::splat(0.1)], numbers);
    let bvh = TriangleBvh::build(mesh[1..].to_vec());
    let [one, two, three, four] = leaks(&bvh, &rays);
    // The rays inside of the triangle; those at its edges and vertices meet the neighbours.
    assert!(one >= 1 && [two, three, four] == [one; 3], "{one}, {two}, {three}, {four}");
}
