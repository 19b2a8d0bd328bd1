//! cargo run --release -p quasilux-bvh --example sky_visibility
//!
//! The share of the upper hemisphere that points of a street see between two walls, by one batch of
//! occlusion rays a point. Compares with the exact view in the street's cross-section.

use quasilux_bvh::{DVec3, Ray, RayQuery, TriangleBvh};

const HEIGHT_M: f64 = 10.0;
const HALF_WIDTH_M: f64 = 5.0;
const RAYS: usize = 1 << 14;

/// A wall along y, long enough to count as endless.
fn wall(x: f64) -> [[DVec3; 3]; 2] {
    const FAR_M: f64 = 1e5;
    let [a, b] = [-FAR_M, FAR_M].map(|y| DVec3::new(x, y, 0.0));
    let up = DVec3::Z * HEIGHT_M;
    [[a, b, b + up], [a, b + up, a + up]]
}

/// Directions of equal solid angle: a Fibonacci lattice over the upper hemisphere.
fn directions() -> impl Iterator<Item = DVec3> {
    let golden_angle = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    (0..RAYS).map(move |i| {
        let z = (i as f64 + 0.5) / RAYS as f64;
        let (radius, phi) = ((1.0 - z * z).sqrt(), golden_angle * i as f64);
        DVec3::new(radius * libm::cos(phi), radius * libm::sin(phi), z)
    })
}

fn main() {
    let bvh = TriangleBvh::build([wall(-HALF_WIDTH_M), wall(HALF_WIDTH_M)].concat());
    println!("{:>6}  {:>8}  {:>8}", "x in m", "traced", "exact");
    for x in [0.0, 1.0, 2.0, 3.0, 4.0] {
        let origin = DVec3::new(x, 0.0, 0.0);
        let shot = |direction| RayQuery {
            ray: Ray::new(origin, direction),
            excluded: [RayQuery::NONE; 2],
        };
        let shots: Vec<RayQuery> = directions().map(shot).collect();
        let mut occluded = vec![false; shots.len()];
        bvh.occluded_batch(&shots, &mut occluded);
        let seen = occluded.iter().filter(|occluded| !**occluded).count();
        // A wedge between two planes through a line takes its angle over pi of the hemisphere.
        let angle =
            libm::atan((HALF_WIDTH_M - x) / HEIGHT_M) + libm::atan((HALF_WIDTH_M + x) / HEIGHT_M);
        let exact = angle / std::f64::consts::PI;
        println!("{x:>6}  {:>8.4}  {exact:>8.4}", seen as f64 / RAYS as f64);
    }
}
