//! Each warp three times: Jacobian against the density, round trip, frequencies.

use std::f64::consts::{FRAC_1_PI, TAU};

use quasilux_sampling::warp::{
    invert_cosine_hemisphere, invert_disk, invert_normal, invert_triangle,
    invert_uniform_hemisphere, invert_uniform_sphere, pdf_cosine_hemisphere, pdf_disk, pdf_normal,
    pdf_triangle, pdf_uniform_hemisphere, pdf_uniform_sphere, sample_cosine_hemisphere,
    sample_disk, sample_normal, sample_triangle, sample_uniform_hemisphere, sample_uniform_sphere,
};

use crate::support::{assert_uniform, cell, random};

/// A warp into space; plane points have z = 0, and triangles are those with the corners (1, 0, 0),
/// (0, 1, 0), (0, 0, 0).
struct Warp {
    name: &'static str,
    sample: fn([f64; 2]) -> [f64; 3],
    pdf: fn([f64; 3]) -> f64,
    invert: fn([f64; 3]) -> [f64; 2],
    /// Two numbers that are uniform on the unit square, computed without the warp from closed forms
    /// of cumulative probabilities.
    uniform: fn([f64; 3]) -> [f64; 2],
}

const WARPS: [Warp; 5] = [
    Warp {
        name: "disk",
        sample: |u| plane(sample_disk(u)),
        pdf: |p| pdf_disk([p[0], p[1]]),
        invert: |p| invert_disk([p[0], p[1]]),
        uniform: |p| [p[0] * p[0] + p[1] * p[1], turns(p)],
    },
    Warp {
        name: "cosine hemisphere",
        sample: sample_cosine_hemisphere,
        pdf: pdf_cosine_hemisphere,
        invert: invert_cosine_hemisphere,
        uniform: |p| [p[2] * p[2], turns(p)],
    },
    Warp {
        name: "uniform hemisphere",
        sample: sample_uniform_hemisphere,
        pdf: pdf_uniform_hemisphere,
        invert: invert_uniform_hemisphere,
        uniform: |p| [p[2], turns(p)],
    },
    Warp {
        name: "uniform sphere",
        sample: sample_uniform_sphere,
        pdf: pdf_uniform_sphere,
        invert: invert_uniform_sphere,
        uniform: |p| [0.5 * (1.0 + p[2]), turns(p)],
    },
    Warp {
        name: "triangle",
        sample: |u| {
            let [x, y, _] = sample_triangle(u);
            [x, y, 0.0]
        },
        pdf: |_| pdf_triangle(0.5),
        invert: |p| invert_triangle([p[0], p[1], 1.0 - p[0] - p[1]]),
        uniform: |p| {
            let width = p[0] + p[1];
            [width * width, p[1] / width]
        },
    },
];

fn plane([x, y]: [f64; 2]) -> [f64; 3] {
    [x, y, 0.0]
}

fn turns(p: [f64; 3]) -> f64 {
    (libm::atan2(p[1], p[0]) / TAU).rem_euclid(1.0)
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn norm(a: [f64; 3]) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// 1 / pdf is the area into which the warp stretches the unit of area; central differences.
#[test]
fn densities_are_inverse_jacobians() {
    const H: f64 = 1e-5;
    for warp in &WARPS {
        let points = random(1);
        for index in 0..10_000 {
            let [a, b] = [0, 1].map(|d| 0.01 + 0.98 * points.coordinate(index, d));
            let on_fold = (a - b).abs() < 2.0 * H || (a + b - 1.0).abs() < 2.0 * H;
            if on_fold {
                continue;
            }
            let along_a = difference((warp.sample)([a + H, b]), (warp.sample)([a - H, b]));
            let along_b = difference((warp.sample)([a, b + H]), (warp.sample)([a, b - H]));
            let jacobian = norm(cross(along_a, along_b)) / (4.0 * H * H);
            let product = jacobian * (warp.pdf)((warp.sample)([a, b]));
            assert!((product - 1.0).abs() < 1e-5, "{} at {a}, {b}: {product}", warp.name);
        }
    }
}

/// Also on the edges of the square: samples are finite, of positive density, and stay inside.
#[test]
fn inversion_undoes_sampling() {
    let below_one = 1.0 - f64::EPSILON / 2.0;
    let edges = [0.0, f64::from_bits(1), 1e-9, 0.25, 0.5, 0.75, below_one];
    let points = random(2);
    let inside = (0..10_000).map(|index| [0, 1].map(|d| points.coordinate(index, d)));
    let on_edges = edges.iter().flat_map(|a| edges.iter().flat_map(move |b| [[*a, *b], [*b, *a]]));
    for warp in &WARPS {
        for u in inside.clone().chain(on_edges.clone()) {
            let sample = (warp.sample)(u);
            assert!((warp.pdf)(sample) > 0.0, "{}: {sample:?} from {u:?}", warp.name);
            let back = (warp.invert)(sample);
            assert!(back.iter().all(|u| (0.0..1.0).contains(u)), "{}: {back:?}", warp.name);
            let again = (warp.sample)(back);
            let distance = norm(difference(again, sample));
            assert!(distance < 3e-8, "{}: {sample:?} became {again:?}", warp.name);
            if u.iter().all(|u| (1e-6..1.0 - 1e-6).contains(u)) {
                let worst = (back[0] - u[0]).abs().max((back[1] - u[1]).abs());
                assert!(worst < 1e-9, "{}: {u:?} became {back:?}", warp.name);
            }
        }
    }
}

/// 16 x 16 cells of equal probability, 2^20 samples: finds densities that are off by 2 % in half of
/// the cells.
#[test]
fn frequencies_are_those_of_the_density() {
    for warp in &WARPS {
        let points = random(3);
        let mut counts = [0; 256];
        for index in 0..1 << 20 {
            let sample = (warp.sample)([points.coordinate(index, 0), points.coordinate(index, 1)]);
            let [a, b] = (warp.uniform)(sample).map(|u| u.clamp(0.0, 1.0 - 1e-16));
            counts[16 * cell(a, 16) + cell(b, 16)] += 1;
        }
        assert_uniform(&counts, warp.name);
    }
}

#[test]
fn directions_have_unit_length() {
    let points = random(4);
    for warp in WARPS.iter().filter(|warp| warp.name.contains("sphere")) {
        for index in 0..10_000 {
            let direction = (warp.sample)([0, 1].map(|d| points.coordinate(index, d)));
            assert!((norm(direction) - 1.0).abs() < 4.0 * f64::EPSILON, "{}", warp.name);
        }
    }
}

/// No tear: points of the square within 1e-7 have samples within 1e-6, but at the pole and the rim,
/// where a square root steepens the map. Opposite edges of the azimuth meet.
#[test]
fn maps_are_continuous() {
    let points = random(5);
    for warp in &WARPS {
        for index in 0..10_000 {
            let [a, b] = [0, 1].map(|d| 0.05 + 0.9 * points.coordinate(index, d));
            for [a, b] in [[a, b], [a, a], [a, 1.0 - a]] {
                let here = (warp.sample)([a, b]);
                for there in [[a + 7e-8, b], [a, b + 7e-8], [a - 7e-8, b + 7e-8]] {
                    let step = norm(difference((warp.sample)(there), here));
                    assert!(step < 1e-6, "{}: a step of {step:e} at {a}, {b}", warp.name);
                }
            }
        }
    }
}

/// The derivative of the map is 1 / pdf, and inversion undoes it, also far out; the quantiles are
/// those that bisection of the distribution function finds.
#[test]
fn normal_numbers_are_quantiles() {
    const H: f64 = 1e-7;
    let points = random(6);
    for index in 0..10_000 {
        let u = 1e-4 + 0.9998 * points.coordinate(index, 0);
        let slope = (sample_normal(u + H) - sample_normal(u - H)) / (2.0 * H);
        let product = slope * pdf_normal(sample_normal(u));
        assert!((product - 1.0).abs() < 1e-5, "{u}: {product}");
    }
    let small = (1..54).map(|k| libm::ldexp(1.0, -k));
    let both = small.flat_map(|u| [u, 1.0 - u]);
    for u in both.chain((0..10_000).map(|index| points.coordinate(index, 1))) {
        let x = sample_normal(u);
        assert!((invert_normal(x) - u).abs() <= 1e-13 * u, "{u} became {}", invert_normal(x));
        let tail = u.min(1.0 - u);
        let quantile = quasilux_stats::normal_quantile(tail);
        assert!((x.abs() - quantile.abs()).abs() < 1e-13 * (1.0 + quantile.abs()), "{u}: {x}");
    }
    assert_eq!(sample_normal(0.5), 0.0);
    assert!((-8.3..-8.2).contains(&sample_normal(0.0)));
    assert!((8.1..8.3).contains(&sample_normal(1.0 - f64::EPSILON / 2.0)));
}

/// Outside their supports densities are 0.
#[test]
fn densities_know_their_support() {
    assert_eq!(pdf_disk([0.8, 0.8]), 0.0);
    assert_eq!(pdf_cosine_hemisphere([0.0, 0.6, -0.8]), 0.0);
    assert_eq!(pdf_uniform_hemisphere([0.0, 0.6, -0.8]), 0.0);
    assert_eq!(pdf_cosine_hemisphere([0.0, 0.0, 1.0]), FRAC_1_PI);
}
