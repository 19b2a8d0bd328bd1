//! Meshes that are hard on a builder: nothing tells their triangles apart, or one is unlike all
//! others.

use crate::meshes::{NamedMesh, Numbers, Triangles};
use glam::DVec3;

/// The meshes, each of `count` triangles, with their names.
pub(crate) fn degenerate_meshes(numbers: &mut Numbers, count: usize) -> Vec<NamedMesh> {
    let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let scaled = |size: f64| face.map(|p| size * (p - DVec3::new(0.5, 0.5, 0.0)));
    let mut all = |make: &dyn Fn(&mut Numbers, usize) -> [DVec3; 3]| -> Triangles {
        (0..count).map(|i| make(numbers, i)).collect()
    };
    let share = |i: usize| (i + 1) as f64 / count as f64;
    let tiny = |at: DVec3| face.map(|p| at + 1e-6 * p);
    let mut huge = all(&|numbers, _| tiny(numbers.point(-1e-3, 1e-3)));
    huge[count / 2] = face.map(|p| 1e3 * (p - DVec3::splat(0.3)));
    let meshes = [
        ("identical", all(&|_, _| face)),
        ("same centre", all(&|_, i| scaled(share(i)))),
        ("same centre, geometric", all(&|_, i| scaled(power(0.5, i % 900)))),
        ("points at one place", all(&|_, _| [DVec3::ONE; 3])),
        ("points", all(&|numbers, _| [numbers.point(-1.0, 1.0); 3])),
        (
            "lines",
            all(&|numbers, _| {
                let (a, b) = (numbers.point(-1.0, 1.0), numbers.point(-1.0, 1.0));
                [a, b, a + (b - a) * 0.5]
            }),
        ),
        ("one huge among tiny ones", huge),
        (
            "coplanar",
            all(&|numbers, _| {
                let at = numbers.point(-1.0, 1.0) * DVec3::new(1.0, 1.0, 0.0);
                face.map(|p| at + 1e-2 * p)
            }),
        ),
        (
            "long parallel slivers",
            all(&|numbers, i| {
                let at = DVec3::new(share(i), numbers.next(), 0.0);
                [at, at + DVec3::new(1e3, 1e3, 1e3), at + DVec3::new(1e-9, 0.0, 0.0)]
            }),
        ),
        ("geometric row", all(&|_, i| tiny(DVec3::X * power(0.5, i % 60)).map(|p| p * 0.999))),
    ];
    meshes.into_iter().map(|(name, mesh)| NamedMesh { name, mesh }).collect()
}

/// A power with a whole exponent.
fn power(base: f64, exponent: usize) -> f64 {
    (0..exponent).fold(1.0, |product, _| product * base)
}
