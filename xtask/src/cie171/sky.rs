//! The luminances of the CIE skies and their integrals, for references: written after the standard
//! once more, and not with the code that they are to check.

use super::factors::{Point, dot, minus};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::OnceLock;

/// How many types of sky there are; the last is the traditional overcast one.
pub(super) const SKIES: usize = 16;
/// Where the sun of all daylight cases stands.
pub(super) const SUN_ALTITUDE_DEG: u32 = 60;

/// a to e of types 1 to 15 (CIE S 011/E:2003).
const TYPES: [[f64; 5]; 15] = [
    [4.0, -0.7, 0.0, -1.0, 0.0],
    [4.0, -0.7, 2.0, -1.5, 0.15],
    [1.1, -0.8, 0.0, -1.0, 0.0],
    [1.1, -0.8, 2.0, -1.5, 0.15],
    [0.0, -1.0, 0.0, -1.0, 0.0],
    [0.0, -1.0, 2.0, -1.5, 0.15],
    [0.0, -1.0, 5.0, -2.5, 0.3],
    [0.0, -1.0, 10.0, -3.0, 0.45],
    [-1.0, -0.55, 2.0, -1.5, 0.15],
    [-1.0, -0.55, 5.0, -2.5, 0.3],
    [-1.0, -0.55, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 10.0, -3.0, 0.45],
    [-1.0, -0.32, 16.0, -3.0, 0.3],
    [-1.0, -0.15, 16.0, -3.0, 0.3],
    [-1.0, -0.15, 24.0, -2.8, 0.15],
];

/// Squares along each edge of the hemisphere whose midpoints make the horizontal illuminance.
const CELLS: usize = 800;
/// Panels along each edge of an opening, with [`NODES`] places each.
const PANELS: usize = 10;
/// Gauss and Legendre on [0, 1], order 8: places and weights of the lower half.
const NODES: [[f64; 2]; 4] = [
    [0.019_855_071_751_231_856, 0.050_614_268_145_188_13],
    [0.101_666_761_293_186_64, 0.111_190_517_226_687_24],
    [0.237_233_795_041_835_5, 0.156_853_322_938_943_65],
    [0.408_282_678_752_175_1, 0.181_341_891_689_180_98],
];

/// What a place sees.
pub(super) struct View {
    pub(super) at: Point,
    pub(super) normal: Point,
    /// Type of the sky.
    pub(super) sky: usize,
    pub(super) sun_azimuth_deg: f64,
    /// Reflectance of the ground.
    pub(super) ground: f64,
    pub(super) is_glazed: bool,
}

impl View {
    /// The illuminance through a rectangle along x and another axis, where 100 lx fall on a plane
    /// outside.
    pub(super) fn through(&self, [low, high]: [Point; 2], axis: usize) -> f64 {
        let across = 3 - axis;
        let [width, height] = [high[0] - low[0], high[axis] - low[axis]];
        let mut sum = 0.0;
        for [x, weight_x] in places() {
            for [y, weight_y] in places() {
                let mut point = low;
                point[0] += width * x;
                point[axis] += height * y;
                let way = minus(point, self.at);
                let squared = dot(way, way);
                let direction = way.map(|x| x / libm::sqrt(squared));
                let cos = dot(direction, self.normal);
                let through = direction[across].abs();
                let glass = if self.is_glazed { glass(through) } else { 1.0 };
                let seen = glass * cos.max(0.0) * through / squared;
                sum += weight_x * weight_y * seen * self.luminance_cd_m2(direction);
            }
        }
        sum * width * height
    }

    fn luminance_cd_m2(&self, direction: Point) -> f64 {
        if direction[2] < 0.0 {
            return 100.0 * self.ground / PI;
        }
        let zenith = f64::from(90 - SUN_ALTITUDE_DEG).to_radians();
        let azimuth = self.sun_azimuth_deg.to_radians();
        let sun = [
            libm::sin(zenith) * libm::sin(azimuth),
            libm::sin(zenith) * libm::cos(azimuth),
            libm::cos(zenith),
        ];
        100.0 * relative(self.sky, direction[2], dot(direction, sun)) / horizontal(self.sky)
    }
}

/// Places along a panelled edge of length 1, and their weights.
fn places() -> impl Iterator<Item = [f64; 2]> {
    let both = |[x, w]: [f64; 2]| [[x, w], [1.0 - x, w]];
    let of_panel = move |panel: usize| {
        let nodes = NODES.into_iter().flat_map(both);
        nodes.map(move |[x, w]| [(panel as f64 + x) / PANELS as f64, w / PANELS as f64])
    };
    (0..PANELS).flat_map(of_panel)
}

/// Relative luminance by the cosines of the angles from the zenith and from the sun.
fn relative(sky: usize, cos_zenith: f64, cos_sun: f64) -> f64 {
    let Some([a, b, c, d, e]) = TYPES.get(sky - 1) else { return 1.0 + 2.0 * cos_zenith };
    let phi = 1.0 + a * libm::exp(b / cos_zenith);
    let chi = libm::acos(cos_sun.clamp(-1.0, 1.0));
    let f = 1.0 + c * (libm::exp(d * chi) - libm::exp(d * FRAC_PI_2)) + e * cos_sun * cos_sun;
    phi * f
}

/// The horizontal illuminance of relative luminances, by midpoints even over the projected solid
/// angle.
fn horizontal(sky: usize) -> f64 {
    static ALL: [OnceLock<f64>; SKIES] = [const { OnceLock::new() }; SKIES];
    *ALL[sky - 1].get_or_init(|| {
        let zenith = f64::from(90 - SUN_ALTITUDE_DEG).to_radians();
        let mut sum = 0.0;
        for i in 0..CELLS {
            let squared = (i as f64 + 0.5) / CELLS as f64;
            let (sine, cosine) = (libm::sqrt(squared), libm::sqrt(1.0 - squared));
            for j in 0..CELLS {
                let azimuth = TAU * (j as f64 + 0.5) / CELLS as f64;
                let along = sine * libm::sin(zenith) * libm::cos(azimuth);
                sum += relative(sky, cosine, along + cosine * libm::cos(zenith));
            }
        }
        PI * sum / (CELLS * CELLS) as f64
    })
}

/// The transmittance of the standard's clear glass of 6 mm by the cosine of incidence (case 5.5).
fn glass(cos: f64) -> f64 {
    let powers = [-0.028378, 3.156075, -3.058376, -1.428919, 4.014235, -1.775827];
    powers.iter().rev().fold(0.0, |sum, factor| sum * cos + factor).max(0.0)
}

/// The same by the angle; nothing comes through along the pane.
pub(super) fn glass_at_deg(deg: usize) -> f64 {
    if deg == 90 { 0.0 } else { glass(libm::cos((deg as f64).to_radians())) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values that the standard prints, of 0, 40, 60 and 80 degrees.
    #[test]
    fn glass_is_that_of_the_standard() {
        for (deg, expected) in [(0, 0.8788), (40, 0.8661), (60, 0.8018), (80, 0.4233)] {
            assert!((glass_at_deg(deg) - expected).abs() < 5e-4, "{deg}: {}", glass_at_deg(deg));
        }
    }

    /// The uniform and the traditional sky have closed forms.
    #[test]
    fn illuminances_have_their_closed_form() {
        assert!((horizontal(5) / PI - 1.0).abs() < 1e-12);
        assert!((horizontal(16) / (7.0 * PI / 3.0) - 1.0).abs() < 1e-5);
    }
}
