//! About what emitting facets give to a place, in single precision, eight facets at once.
//!
//! A facet weighs luminance times solid angle times the mean cosine of its corners: within some
//! percent where all of it is before the side that asks. Nothing is said to be dark for rounding
//! alone: weights only say how often a facet is asked, doubles what it gives.

use super::selection::{Asking, LANES};
use crate::world::Facet;
use glam::{DVec3, Vec3};
use std::f32::consts::TAU;

/// Margin for rounding, as a fraction of the scene's extent: facets this near to dark are not
/// called dark. Also the least cosine that counts.
const ROUNDING: f32 = 1e-5;
/// No luminance, over that of the brightest, and no solid angle in sr counts less, so that no
/// product of them becomes 0.
const FAINTEST: f32 = 1e-12;

/// One value of each facet.
type Lanes = [f32; LANES];

/// All emitting facets.
pub(super) struct CoarseFacets {
    facets: usize,
    blocks: Vec<Block>,
    /// Coordinates are single from here.
    origin: DVec3,
    rounding_m: f32,
}

/// Facets that are weighed together; past the last one lanes have no luminance.
struct Block {
    corners: [[Lanes; 3]; 3],
    n: [Lanes; 3],
    twice_areas_m2: Lanes,
    /// Over that of the brightest.
    luminances: Lanes,
}

impl CoarseFacets {
    pub(super) fn new<'f>(
        facets: impl ExactSizeIterator<Item = &'f Facet> + Clone,
        bounds: Option<[DVec3; 2]>,
    ) -> Self {
        let [low, high] = bounds.unwrap_or_default();
        let origin = 0.5 * (low + high);
        let luminances = facets.clone().map(|facet| facet.emitted_cd_m2);
        let brightest_cd_m2 = luminances.fold(0.0, f64::max);
        let count = facets.len();
        let mut blocks = Vec::with_capacity(count.div_ceil(LANES));
        for (number, facet) in facets.enumerate() {
            let lane = number % LANES;
            if lane == 0 {
                blocks.push(Block::DARK);
            }
            let Some(block) = blocks.last_mut() else { continue };
            for (own, corner) in block.corners.iter_mut().zip(facet.corners()) {
                set(own, lane, corner - origin);
            }
            set(&mut block.n, lane, facet.front_normal);
            block.twice_areas_m2[lane] = 2.0 * facet.area_m2() as f32;
            let luminance = facet.emitted_cd_m2 / brightest_cd_m2;
            block.luminances[lane] = (luminance as f32).max(FAINTEST);
        }
        let rounding_m = ROUNDING * (high - low).max_element() as f32;
        Self { facets: count, blocks, origin, rounding_m }
    }

    /// Of each facet about what it gives to a place unshadowed, up to a factor; 0 only where all of
    /// it is behind the side that asks, or the place behind it.
    pub(super) fn weights(&self, place: Asking) -> impl Iterator<Item = f64> {
        let position = (place.position - self.origin).as_vec3();
        let side = place.side.map(|n| n.as_vec3());
        let weigh = move |block: &Block| block.weights(position, side, self.rounding_m);
        self.blocks.iter().flat_map(weigh).map(f64::from).take(self.facets)
    }
}

fn set(lanes: &mut [Lanes; 3], lane: usize, value: DVec3) {
    for (axis, value) in lanes.iter_mut().zip(value.as_vec3().to_array()) {
        axis[lane] = value;
    }
}

impl Block {
    const DARK: Self = Self {
        corners: [[[0.0; LANES]; 3]; 3],
        n: [[0.0; LANES]; 3],
        twice_areas_m2: [0.0; LANES],
        luminances: [0.0; LANES],
    };

    fn weights(&self, position: Vec3, side: Option<Vec3>, rounding_m: f32) -> Lanes {
        let n = side.unwrap_or(Vec3::ZERO);
        let least_cos = if side.is_some() { ROUNDING } else { 1.0 };
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = &self.corners;
        let [nx, ny, nz] = &self.n;
        let mut weights = [0.0; LANES];
        for lane in 0..LANES {
            let way = |x: &Lanes, y: &Lanes, z: &Lanes| {
                [x[lane] - position.x, y[lane] - position.y, z[lane] - position.z]
            };
            let (a, b, c) = (way(ax, ay, az), way(bx, by, bz), way(cx, cy, cz));
            let height_m = -dot([nx[lane], ny[lane], nz[lane]], a);
            let n = [n.x, n.y, n.z];
            let highest_m = larger(larger(dot(n, a), dot(n, b)), dot(n, c));
            let (per_a, per_b, per_c) = (per_length(a), per_length(b), per_length(c));
            let (a, b, c) = (scaled(a, per_a), scaled(b, per_b), scaled(c, per_c));
            let spanned = self.twice_areas_m2[lane] * height_m.abs() * (per_a * per_b * per_c);
            let denominator = 1.0 + dot(a, b) + dot(b, c) + dot(c, a);
            let solid_angle_sr = about_solid_angle_sr(spanned, denominator);
            let (a, b, c) = (dot(n, a), dot(n, b), dot(n, c));
            let cos = (larger(a, 0.0) + larger(b, 0.0) + larger(c, 0.0)) * (1.0 / 3.0);
            let lit = larger(solid_angle_sr, FAINTEST) * larger(cos, least_cos);
            let weight = self.luminances[lane] * lit;
            let lit = if height_m < -rounding_m { 0.0 } else { weight };
            weights[lane] = if highest_m < -rounding_m { 0.0 } else { lit };
        }
        weights
    }
}

/// `4 atan(y / (sqrt(x^2 + y^2) + x))`, within a percent: `atan(t) = t / (1 + 0.28 t^2)` up to 1
/// (S. Rajan et al., "Efficient approximations for the arctangent function", IEEE Signal Process.
/// Mag. 23(3), 2006). The formula is that of `seen_triangle`.
#[inline(always)]
fn about_solid_angle_sr(y: f32, x: f32) -> f32 {
    let x = (x * x + y * y).sqrt() + x;
    let tangent = smaller(x, y) / larger(larger(x, y), f32::MIN_POSITIVE);
    let small = 4.0 * tangent / (1.0 + 0.28 * tangent * tangent);
    if y <= x { small } else { TAU - small }
}

#[inline(always)]
fn per_length([x, y, z]: [f32; 3]) -> f32 {
    1.0 / larger(x * x + y * y + z * z, f32::MIN_POSITIVE).sqrt()
}

#[inline(always)]
fn scaled([x, y, z]: [f32; 3], scale: f32) -> [f32; 3] {
    [x * scale, y * scale, z * scale]
}

#[inline(always)]
fn dot([ax, ay, az]: [f32; 3], [bx, by, bz]: [f32; 3]) -> f32 {
    ax * bx + ay * by + az * bz
}

#[inline(always)]
fn smaller(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// Without a care for NaN, as processors have it for lanes.
#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
