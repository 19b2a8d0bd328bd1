//! Many rays at once have the answers of each alone, to the last bit.

use crate::meshes::{NamedMesh, Numbers, Triangles, ball, hard_meshes};
use crate::rays::unit;
use glam::DVec3;
use quasilux_bvh::{Hit, Ray, RayQuery, SimdLevel, TriangleBvh};

/// Runs of rays at each mesh, and rays of a run.
const RUNS: usize = 240;
const LONGEST: usize = 200;

/// How the rays of a run belong together.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// From one point, in directions within so much of each other.
    Diverging(f64),
    /// In one direction, from points within so much of the mesh's size.
    Parallel(f64),
    /// From points within so much of the mesh's size, each toward the same point.
    Converging(f64),
    /// From one point toward corners, middles of edges and points on edges of neighbouring
    /// triangles.
    TowardEdges,
    /// As it comes.
    Mixed,
}

const KINDS: [Kind; 10] = [
    Kind::Diverging(1e-3),
    Kind::Diverging(0.05),
    Kind::Diverging(0.3),
    Kind::Parallel(1e-3),
    Kind::Parallel(0.1),
    Kind::Converging(0.02),
    Kind::Converging(0.1),
    Kind::TowardEdges,
    Kind::Mixed,
    Kind::Diverging(0.0),
];

fn rays(mesh: &Triangles, kind: Kind, count: usize, numbers: &mut Numbers) -> Vec<Ray> {
    let points = mesh.iter().flatten().copied();
    let low = points.clone().reduce(DVec3::min).unwrap();
    let size = points.reduce(DVec3::max).unwrap() - low;
    let origin = low + size * numbers.point(-0.3, 1.3);
    let first = (numbers.next() * mesh.len() as f64) as usize;
    let toward = |p: DVec3, q: DVec3| Ray::new(p, unit(q - p));
    let target = mesh[first].iter().sum::<DVec3>() / 3.0;
    let middle = toward(origin, target).direction;
    let aside = |numbers: &mut Numbers| size.max_element() * numbers.point(-0.5, 0.5);
    (0..count)
        .map(|i| match kind {
            Kind::Diverging(width) => {
                Ray::new(origin, (middle + numbers.direction() * width).normalize())
            }
            Kind::Parallel(width) => Ray::new(origin + aside(numbers) * width, middle),
            Kind::Converging(width) => toward(origin + aside(numbers) * width, target),
            Kind::TowardEdges => {
                let [a, b, c] = mesh[(first + i / 4) % mesh.len()];
                let along = numbers.next();
                toward(origin, [a, 0.5 * (a + b), b + (c - b) * along, a + (c - a) * along][i % 4])
            }
            Kind::Mixed => match i % 40 {
                0..30 => Ray::new(origin, (middle + numbers.direction() * 0.01).normalize()),
                30..38 => Ray::new(origin + aside(numbers) * 100.0, numbers.direction()),
                _ => Ray::new(low + size * numbers.point(0.0, 1.0), DVec3::NEG_Z),
            },
        })
        .collect()
}

#[test]
fn runs_are_answered_as_ray_by_ray() {
    let numbers = &mut Numbers(41);
    let mut meshes = hard_meshes(numbers, 3);
    let mesh = ball(DVec3::new(1.0, 2.0, 3.0), 2.0, 5);
    meshes.push(NamedMesh { name: "fine ball", mesh });
    for NamedMesh { name, mesh } in meshes {
        let build = |simd| TriangleBvh::build_for(mesh.clone(), simd);
        let bvhs: Vec<_> = SimdLevel::all().into_iter().map(build).collect();
        let mut found = 0;
        for run in 0..RUNS {
            let kind = KINDS[run % KINDS.len()];
            let count = 1 + (numbers.next() * LONGEST as f64) as usize;
            let rays = rays(&mesh, kind, count, numbers);
            let shots = shots(&bvhs[0], &rays, run, numbers);
            let alone: Vec<Option<Hit>> =
                shots.iter().map(|shot| bvhs[0].closest_hit(&shot.ray, &shot.excluded)).collect();
            let occluded: Vec<bool> = alone.iter().map(Option::is_some).collect();
            found += alone.iter().flatten().count();
            for bvh in &bvhs {
                let mut hits = vec![None; shots.len()];
                bvh.closest_hit_batch(&shots, &mut hits);
                assert_eq!(hits, alone, "{name}, run {run}, {kind:?}");
                let mut blocked = vec![false; shots.len()];
                bvh.occluded_batch(&shots, &mut blocked);
                assert_eq!(blocked, occluded, "{name}, run {run}, {kind:?}");
            }
        }
        assert!(
            found > 5 * RUNS || name == "one point",
            "{name}: the test shot past nearly everything ({found} hits)"
        );
    }
}

/// The rays, some short of or just beyond what they hit, some that cannot hit that or another
/// triangle.
fn shots(bvh: &TriangleBvh, rays: &[Ray], run: usize, numbers: &mut Numbers) -> Vec<RayQuery> {
    let shot = |(i, &ray): (usize, &Ray)| {
        let hit = bvh.closest_hit(&ray, &[]);
        let distance = hit.map_or(f64::INFINITY, |hit| hit.distance);
        let t_max = match (run / KINDS.len() % 4, i % 4) {
            (0 | 1, _) => f64::INFINITY,
            (2, 0) => distance,
            (2, 1) => distance.next_up(),
            (2, 2) => distance * 2.0 * numbers.next(),
            _ => distance * 1.5,
        };
        let any = (numbers.next() * bvh.len() as f64) as u32;
        let nearest = hit.map_or(RayQuery::NONE, |hit| hit.triangle);
        let excluded = match (run / KINDS.len() % 3, i % 3) {
            (0, _) => [RayQuery::NONE; 2],
            (1, 0) => [nearest, any],
            (1, _) => [any, RayQuery::NONE],
            _ => [any, nearest],
        };
        RayQuery { ray: ray.up_to(t_max), excluded }
    };
    rays.iter().enumerate().map(shot).collect()
}

#[test]
fn no_ray_of_a_run_leaves_a_closed_mesh() {
    let numbers = &mut Numbers(42);
    for (centre, radius) in [(DVec3::ZERO, 1.0), (DVec3::new(1e4, -2e4, 5e3), 2.0)] {
        let mesh = ball(centre, radius, 5);
        for simd in SimdLevel::all() {
            let bvh = TriangleBvh::build_for(mesh.clone(), simd);
            for part in mesh.chunks(20) {
                let origin = centre + numbers.direction() * (0.5 * radius);
                let shots: Vec<RayQuery> = part
                    .iter()
                    .flat_map(|&[a, b, c]| {
                        let along_edge = a + (b - a) * numbers.next();
                        [a, 0.5 * (a + b), along_edge, (a + b + c) / 3.0]
                    })
                    .map(|target| RayQuery {
                        ray: Ray::new(origin, (target - origin).normalize()),
                        excluded: [RayQuery::NONE; 2],
                    })
                    .collect();
                let mut hits = vec![None; shots.len()];
                bvh.closest_hit_batch(&shots, &mut hits);
                let leak = hits.iter().position(Option::is_none);
                assert_eq!(leak, None, "{:?}", leak.map(|i| shots[i]));
                let mut occluded = vec![false; shots.len()];
                bvh.occluded_batch(&shots, &mut occluded);
                assert!(occluded.iter().all(|&occluded| occluded));
            }
        }
    }
}

#[test]
fn no_rays_are_no_trouble() {
    let bvh = TriangleBvh::build(Vec::new());
    bvh.closest_hit_batch(&[], &mut []);
    let shot = RayQuery { ray: Ray::new(DVec3::ZERO, DVec3::Z), excluded: [RayQuery::NONE; 2] };
    let mut hits = [None; 20];
    bvh.closest_hit_batch(&[shot; 20], &mut hits);
    assert_eq!(hits, [None; 20]);
}
