//! What rays are shot at.

use glam::{DMat3, DVec3};
use std::process::Command;

/// Triangles, and an inner point to shoot photons from.
pub struct Scene {
    /// What it is called in tables.
    pub name: &'static str,
    /// The corners of each triangle in m.
    pub corners: Vec<[DVec3; 3]>,
    /// The inner point in m.
    pub source: DVec3,
}

impl Scene {
    /// The corners in single precision.
    pub fn narrow(&self) -> Vec<[[f32; 3]; 3]> {
        self.corners.iter().map(|triangle| triangle.map(|p| p.as_vec3().to_array())).collect()
    }
}

/// A furnished kitchen of 57 000 triangles; `None` with `QUASILUX_CORPUS=none`.
///
/// # Panics
/// Where the file is missing, is damaged, or the program `zstd` is missing.
pub fn kitchen() -> Option<Scene> {
    let file = quasilux_corpus::find("scenes/obvhs-kitchen/kitchen.obj.zst")?;
    let output = Command::new("zstd").arg("-dcq").arg(file).output().expect("the program zstd");
    let corners = read_obj(std::str::from_utf8(&output.stdout).expect("OBJ is text"));
    let [low, high] = bounds(&corners).expect("a kitchen has triangles");
    Some(Scene { name: "kitchen", source: 0.5 * (low + high), corners })
}

/// Nine kitchens side by side, each turned by another angle about a slanted axis.
///
/// # Panics
/// Where the kitchen has no triangles.
pub fn kitchens(kitchen: &Scene) -> Scene {
    let [low, high] = bounds(&kitchen.corners).expect("a kitchen has triangles");
    let axis = DVec3::new(0.2, 1.0, 0.3).normalize();
    let step = 0.8 * (high - low).max_element();
    let mut corners = Vec::new();
    for number in 0..9 {
        let turn = DMat3::from_axis_angle(axis, 0.7 * f64::from(number));
        let place = DVec3::new(f64::from(number % 3), 0.0, f64::from(number / 3)) * step;
        let moved = |p: DVec3| turn * (p - kitchen.source) + place;
        corners.extend(kitchen.corners.iter().map(|triangle| triangle.map(moved)));
    }
    Scene { name: "nine kitchens", source: DVec3::new(step, 0.0, step), corners }
}

/// A closed room with 300 balls of 2048 triangles hanging in it.
pub fn balls() -> Scene {
    let mut corners = room(DVec3::ZERO, DVec3::new(10.0, 8.0, 3.0));
    let unit = ball(4);
    let numbers = &mut Numbers(7);
    for _ in 0..300 {
        let radius = 0.05 + 0.3 * numbers.next() * numbers.next();
        let inner = DVec3::new(9.0, 7.0, 2.0);
        let place =
            DVec3::splat(0.5) + inner * DVec3::new(numbers.next(), numbers.next(), numbers.next());
        corners.extend(unit.iter().map(|triangle| triangle.map(|p| place + radius * p)));
    }
    Scene { name: "room of balls", source: DVec3::new(5.0, 4.0, 1.5), corners }
}

/// A closed room over a rough ground of ten million triangles.
pub fn relief() -> Scene {
    const CELLS: usize = 2236;
    let numbers = &mut Numbers(11);
    let heights: Vec<f64> = (0..(CELLS + 1) * (CELLS + 1)).map(|_| numbers.next()).collect();
    let at = |i: usize, j: usize| {
        let (x, y) = (i as f64 / CELLS as f64, j as f64 / CELLS as f64);
        let waves = [(7.0, 0.2), (31.0, 0.05), (127.0, 0.012)];
        let hills: f64 = waves
            .iter()
            .map(|(f, a)| a * (triangle_wave(f * x + y) + triangle_wave(f * y - 0.3 * x)))
            .sum();
        DVec3::new(100.0 * x, 100.0 * y, 10.0 * hills + 0.03 * heights[i * (CELLS + 1) + j])
    };
    let mut corners = room(DVec3::new(-1.0, -1.0, -8.0), DVec3::new(101.0, 101.0, 30.0));
    for i in 0..CELLS {
        for j in 0..CELLS {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            corners.extend([[a, b, c], [a, c, d]]);
        }
    }
    Scene { name: "relief", source: DVec3::new(52.0, 47.0, 15.0), corners }
}

/// Numbers in [0, 1) from a counter (Steele, Lea and Flood 2014, SplitMix64).
pub struct Numbers(pub u64);

impl Numbers {
    /// The next one.
    #[expect(clippy::should_implement_trait, reason = "they have no end")]
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn triangle_wave(x: f64) -> f64 {
    (2.0 * (x - x.floor()) - 1.0).abs()
}

fn bounds(corners: &[[DVec3; 3]]) -> Option<[DVec3; 2]> {
    let points = corners.iter().flatten().copied();
    Some([points.clone().reduce(DVec3::min)?, points.reduce(DVec3::max)?])
}

/// The twelve triangles of a box.
fn room(low: DVec3, high: DVec3) -> Vec<[DVec3; 3]> {
    let corner = |bits: usize| {
        let pick = |axis: usize| if bits >> axis & 1 == 0 { low[axis] } else { high[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    };
    let faces =
        [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let quads = faces.map(|face| face.map(corner));
    quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

/// The unit ball as `8 * 4^level` triangles.
fn ball(level: u32) -> Vec<[DVec3; 3]> {
    let sign = |bits: u32, bit: u32| if bits >> bit & 1 == 0 { 1.0 } else { -1.0 };
    let mut triangles: Vec<_> = (0..8)
        .map(|bits| [DVec3::X * sign(bits, 0), DVec3::Y * sign(bits, 1), DVec3::Z * sign(bits, 2)])
        .collect();
    for _ in 0..level {
        let split = |[a, b, c]: [DVec3; 3]| {
            let middle = |p: DVec3, q: DVec3| (p + q).normalize();
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(split).collect();
    }
    triangles
}

/// The polygons of a Wavefront file as fans of triangles.
pub fn read_obj(text: &str) -> Vec<[DVec3; 3]> {
    let mut points: Vec<DVec3> = Vec::new();
    let mut corners = Vec::new();
    for line in text.lines() {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut next = || words.next().and_then(|word| word.parse().ok()).unwrap_or(0.0);
                points.push(DVec3::new(next(), next(), next()));
            }
            Some("f") => {
                let index =
                    |word: &str| word.split('/').next().and_then(|i| i.parse::<usize>().ok());
                let face: Vec<DVec3> =
                    words.filter_map(index).filter_map(|i| points.get(i - 1).copied()).collect();
                corners.extend((2..face.len()).map(|i| [face[0], face[i - 1], face[i]]));
            }
            _ => {}
        }
    }
    corners
}
