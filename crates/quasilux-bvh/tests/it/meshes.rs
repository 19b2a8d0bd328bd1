//! Meshes that are hard on a ray kernel, and a generator of test numbers.

use glam::DVec3;

pub(crate) type Triangles = Vec<[DVec3; 3]>;

/// A mesh, and its name in messages.
pub(crate) struct NamedMesh {
    pub(crate) name: &'static str,
    pub(crate) mesh: Triangles,
}

/// The meshes, smallest with `size` 1, each with its name.
pub(crate) fn hard_meshes(numbers: &mut Numbers, size: usize) -> Vec<NamedMesh> {
    let far = DVec3::new(4.0e5, -5.0e6, 300.0);
    let mut huge_and_tiny = ball(DVec3::new(0.3, 0.2, 0.1), 1e-4, 2);
    huge_and_tiny.push([
        DVec3::new(-1e3, -1e3, -1.0),
        DVec3::new(1e3, -1e3, -1.0),
        DVec3::new(0.0, 2e3, -1.0),
    ]);
    let mut huger_and_tinier = soup(numbers, 50 * size);
    huger_and_tinier.extend(scaled(soup(numbers, 20), 1e9));
    let meshes = [
        ("soup", soup(numbers, 200 * size)),
        ("slivers", slivers(numbers, 100 * size)),
        ("needles", needles(numbers, 100 * size)),
        ("without area", without_area(numbers, 40 * size)),
        ("flat and coincident", flat_and_coincident(numbers, 40)),
        ("tilted plane", tilted_plane(8)),
        ("copies", copies(&soup(numbers, 30 * size), 4)),
        ("prism of slivers", prism(numbers, 60)),
        ("ball", ball(DVec3::ZERO, 1.0, 2)),
        ("far soup", shifted(soup(numbers, 100 * size), far)),
        ("far needles", shifted(needles(numbers, 100 * size), far)),
        ("far ball", shifted(ball(DVec3::ZERO, 3.0, 2), far)),
        ("huge and tiny", huge_and_tiny),
        ("huger and tinier", huger_and_tinier),
        ("of 1e290 m", scaled(soup(numbers, 100 * size), 1e290)),
        ("of 1e-160 m", scaled(soup(numbers, 20 * size), 1e-160)),
        ("of 1e-300 m", scaled(soup(numbers, 20 * size), 1e-300)),
        ("of 1e-318 m", scaled(ball(DVec3::ZERO, 1.0, 1), 1e-318)),
        ("one triangle", vec![[DVec3::ZERO, DVec3::X, DVec3::Y]]),
        ("one point", vec![[DVec3::splat(0.1); 3]]),
    ];
    meshes.into_iter().map(|(name, mesh)| NamedMesh { name, mesh }).collect()
}

fn shifted(mesh: Triangles, by: DVec3) -> Triangles {
    mesh.into_iter().map(|t| t.map(|p| p + by)).collect()
}

fn scaled(mesh: Triangles, by: f64) -> Triangles {
    mesh.into_iter().map(|t| t.map(|p| p * by)).collect()
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

/// Triangles as narrow as double precision has them, and narrower.
pub(crate) fn needles(numbers: &mut Numbers, count: usize) -> Triangles {
    (0..count)
        .map(|i| {
            let width = [1e-8, 1e-11, 1e-14, 1e-16, 1e-300][i % 5];
            let (p, q) = (numbers.point(-1.0, 1.0), numbers.point(-1.0, 1.0));
            let middle = p + (q - p) * numbers.next() + numbers.direction() * width;
            [p, if i.is_multiple_of(2) { q } else { middle }, q + numbers.direction() * width]
        })
        .collect()
}

/// Points, lines, and corners on a line but for rounding, among triangles.
pub(crate) fn without_area(numbers: &mut Numbers, count: usize) -> Triangles {
    let mut triangles = soup(numbers, count);
    for i in 0..count {
        let (p, q) = (numbers.point(-1.0, 1.0), numbers.point(-1.0, 1.0));
        let mut lines = [[p, p, p], [p, q, p], [p, q, q], [p, q, p + (q - p) * numbers.next()]];
        lines[3].rotate_left(i % 3);
        triangles.push(lines[i % 4]);
    }
    triangles
}

/// A plane that is not along the axes, its corners off it by rounding.
pub(crate) fn tilted_plane(side: usize) -> Triangles {
    let (x, y) = (DVec3::new(0.3, 0.1, -0.2), DVec3::new(0.1, -0.7, 0.4));
    let corner = |i: usize, j: usize| DVec3::splat(0.1) + x * i as f64 + y * j as f64;
    let squares = (0..side).flat_map(|i| (0..side).map(move |j| (i, j)));
    let halves = squares.flat_map(|(i, j)| {
        let (a, c) = (corner(i, j), corner(i + 1, j + 1));
        [[a, corner(i + 1, j), c], [a, c, corner(i, j + 1)]]
    });
    halves.collect()
}

/// Each triangle this many times, in all orders of corners.
pub(crate) fn copies(mesh: &Triangles, times: usize) -> Triangles {
    let copies = (0..times)
        .flat_map(|i| mesh.iter().map(move |&[a, b, c]| [[a, b, c], [b, c, a], [a, c, b]][i % 3]));
    copies.collect()
}

/// A closed prism over a polygon with corners as close as double precision has them, its
/// triangles long slivers, its vertices shared to the last bit.
pub(crate) fn prism(numbers: &mut Numbers, corners: usize) -> Triangles {
    let mut tangents: Vec<f64> = (0..corners / 3).map(|_| 4.0 * numbers.next() - 2.0).collect();
    for i in 0..2 * corners / 3 {
        tangents.push(tangents[i] + [1e-15, 1e-12, 1e-8, 1e-5][i % 4] * numbers.next());
    }
    tangents.sort_by(f64::total_cmp);
    let at = |i: usize, z: f64| {
        // A circle, by half-angles' tangents.
        let t = tangents[i % tangents.len()];
        DVec3::new((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t), z)
    };
    let mut triangles = Vec::new();
    for i in 0..tangents.len() {
        let [a, b, c, d] = [at(i, 0.0), at(i + 1, 0.0), at(i + 1, 3.0), at(i, 3.0)];
        triangles.extend([[a, b, c], [a, c, d], [at(0, 0.0), b, a], [at(0, 3.0), d, c]]);
    }
    triangles
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
