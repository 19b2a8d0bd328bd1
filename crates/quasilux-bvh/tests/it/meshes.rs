//! Meshes that are hard on a ray kernel, and a generator of test numbers.

use glam::DVec3;
use quasilux_bvh::Ray;

pub(crate) type Triangles = Vec<[DVec3; 3]>;

/// A ray at a mesh, its first part, and what it shall not hit.
#[derive(Clone, Debug)]
pub(crate) struct HardQuery {
    pub(crate) ray: Ray,
    pub(crate) short: Ray,
    pub(crate) excluded: Vec<u32>,
}

/// The meshes, smallest with `size` 1, each with its name.
pub(crate) fn hard_meshes(numbers: &mut Numbers, size: usize) -> Vec<(&'static str, Triangles)> {
    let far = DVec3::new(4.0e5, -5.0e6, 300.0);
    let shifted = |mesh: Triangles, by: DVec3| -> Triangles {
        mesh.into_iter().map(|t| t.map(|p| p + by)).collect()
    };
    let mut huge_and_tiny = ball(DVec3::new(0.3, 0.2, 0.1), 1e-4, 2);
    huge_and_tiny.push([
        DVec3::new(-1e3, -1e3, -1.0),
        DVec3::new(1e3, -1e3, -1.0),
        DVec3::new(0.0, 2e3, -1.0),
    ]);
    vec![
        ("soup", soup(numbers, 200 * size)),
        ("slivers", slivers(numbers, 100 * size)),
        ("flat and coincident", flat_and_coincident(numbers, 40)),
        ("ball", ball(DVec3::ZERO, 1.0, 2)),
        ("far soup", shifted(soup(numbers, 100 * size), far)),
        ("far ball", shifted(ball(DVec3::ZERO, 3.0, 2), far)),
        ("huge and tiny", huge_and_tiny),
        ("one triangle", vec![[DVec3::ZERO, DVec3::X, DVec3::Y]]),
    ]
}

/// Rays from inside and just outside, from triangles and from far away, in random directions, along
/// axes and toward corners.
pub(crate) fn hard_query(mesh: &Triangles, number: usize, numbers: &mut Numbers) -> HardQuery {
    let points = mesh.iter().flatten().copied();
    let low = points.clone().reduce(DVec3::min).unwrap();
    let size = points.reduce(DVec3::max).unwrap() - low;
    let any = |numbers: &mut Numbers| (numbers.next() * mesh.len() as f64) as usize;
    let origin = match number % 16 {
        0..12 => low + size * numbers.point(-0.2, 1.2),
        12..14 => {
            let [a, b, c] = mesh[any(numbers)];
            a + (b - a) * (0.5 * numbers.next()) + (c - a) * (0.5 * numbers.next())
        }
        _ => low + size * numbers.point(-100.0, 100.0),
    };
    let direction = match number % 3 {
        0 => numbers.direction(),
        1 => DVec3::AXES[number / 3 % 3] * if number.is_multiple_of(2) { 1.0 } else { -1.0 },
        _ => {
            let corner = mesh[any(numbers)][number % 3];
            if corner == origin { DVec3::X } else { (corner - origin).normalize() }
        }
    };
    let excluded = (0..number % 5).map(|_| any(numbers) as u32).collect();
    let ray = Ray::new(origin, direction);
    HardQuery { ray, short: ray.up_to(size.length() * numbers.next()), excluded }
}

/// Numbers in [0, 1) from a counter (Steele, Lea and Flood 2014, SplitMix64).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn point(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next()) * (high - low) + DVec3::splat(low)
    }

    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let p = self.point(-1.0, 1.0);
            if p.length() > 0.01 && p.length() < 1.0 {
                return p.normalize();
            }
        }
    }
}

/// Triangles of all sizes at random places in the unit cube about the origin.
pub(crate) fn soup(numbers: &mut Numbers, count: usize) -> Triangles {
    (0..count)
        .map(|i| {
            let size = [1.0, 0.1, 0.001, 1e-6][i % 4];
            let p = numbers.point(-1.0, 1.0);
            [p, p + numbers.direction() * size, p + numbers.direction() * size]
        })
        .collect()
}

/// Long thin triangles, some of them a million times longer than wide.
pub(crate) fn slivers(numbers: &mut Numbers, count: usize) -> Triangles {
    (0..count)
        .map(|i| {
            let width = [1e-2, 1e-4, 1e-6][i % 3];
            let (p, q) = (numbers.point(-1.0, 1.0), numbers.point(-1.0, 1.0));
            [p, q, q + numbers.direction() * width]
        })
        .collect()
}

/// Axis-aligned flat squares, many of them coincident.
pub(crate) fn flat_and_coincident(numbers: &mut Numbers, count: usize) -> Triangles {
    (0..count)
        .flat_map(|_| {
            let level = (numbers.next() * 4.0).floor() * 0.25;
            let axis = (numbers.next() * 3.0) as usize;
            let corner = |a: f64, b: f64| {
                let mut p = [0.0; 3];
                p[axis] = level;
                p[(axis + 1) % 3] = a;
                p[(axis + 2) % 3] = b;
                DVec3::from_array(p)
            };
            let [a, b, c, d] = [corner(0., 0.), corner(1., 0.), corner(1., 1.), corner(0., 1.)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// A closed ball of `8 * 4^level` triangles, its vertices shared to the last bit.
pub(crate) fn ball(centre: DVec3, radius: f64, level: u32) -> Triangles {
    let mut triangles = Vec::new();
    for signs in 0..8 {
        let sign = |bit: u32| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
        triangles.push([DVec3::X * sign(0), DVec3::Y * sign(1), DVec3::Z * sign(2)]);
    }
    for _ in 0..level {
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let middle = |p: DVec3, q: DVec3| (p + q).normalize();
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    triangles.into_iter().map(|t| t.map(|p| centre + p * radius)).collect()
}
