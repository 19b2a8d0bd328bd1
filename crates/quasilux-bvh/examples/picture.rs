//! cargo run --release -p quasilux-bvh --example picture
//!
//! Draws a sphere of triangles as text: one ray a character, brighter where the surface faces the
//! viewer. Shows how a hit's triangle and barycentric coordinates lead back to the mesh.

use quasilux_bvh::{DVec3, Ray, TriangleBvh};
use std::f64::consts::{PI, TAU};

const COLUMNS: i32 = 64;
const ROWS: i32 = 32;

/// A unit sphere about the origin, in strips of latitude.
fn sphere(strips: usize) -> Vec<[DVec3; 3]> {
    let point = |strip: usize, sector: usize| {
        let (theta, phi) =
            (PI * strip as f64 / strips as f64, TAU * sector as f64 / (2 * strips) as f64);
        DVec3::new(
            libm::sin(theta) * libm::cos(phi),
            libm::sin(theta) * libm::sin(phi),
            libm::cos(theta),
        )
    };
    let cells = (0..strips).flat_map(|i| (0..2 * strips).map(move |j| [i, j]));
    cells
        .flat_map(|[i, j]| {
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

fn main() {
    let mesh = sphere(24);
    let bvh = TriangleBvh::build(mesh.clone());
    for row in 0..ROWS {
        let line = (0..COLUMNS).map(|column| {
            let x = 2.4 * (f64::from(column) + 0.5) / f64::from(COLUMNS) - 1.2;
            let y = 1.2 - 2.4 * (f64::from(row) + 0.5) / f64::from(ROWS);
            let ray = Ray::new(DVec3::new(x, y, 3.0), DVec3::NEG_Z);
            let Some(hit) = bvh.closest_hit(&ray, &[]) else { return ' ' };
            // Interpolates the corners, which on this sphere are their own normals.
            let [a, b, c] = mesh[hit.triangle as usize];
            let [u, v, w] = hit.barycentric;
            let cosine = (a * u + b * v + c * w).normalize().z;
            char::from(b".:-=+*#%@"[((cosine * 9.0) as usize).min(8)])
        });
        println!("{}", line.collect::<String>());
    }
}
