//! Silhouettes of luminous shapes: areas and samples, against a plain sum over the surface.

use crate::tables::Generator;
use glam::DVec3;
use quasilux_photometry::{Axis, LuminousShape, Solid, SurfacePoint};
use quasilux_stats::{CellCount, chi_square_test, sidak, sphere_jacobian};
use std::f64::consts::{PI, TAU};

/// Steps along each coordinate of a surface.
const STEPS: usize = 400;
/// Of the whole family of chi-square tests.
const SIGNIFICANCE: f64 = 1e-3;
const SAMPLES: u32 = 1 << 18;

/// Half extents along x, y, z.
const HALF_M: DVec3 = DVec3::new(0.5, 0.3, 0.2);

fn solids() -> Vec<LuminousShape> {
    let cylinder = |axis| Solid::Cylinder(axis);
    [Solid::Cuboid, cylinder(Axis::X), cylinder(Axis::Y), cylinder(Axis::Z), Solid::Ellipsoid]
        .map(|solid| LuminousShape::new(solid, 2.0 * HALF_M))
        .to_vec()
}

fn flats() -> Vec<LuminousShape> {
    let across = |axis: usize| {
        let mut size_m = 2.0 * HALF_M;
        size_m[axis] = 0.0;
        size_m
    };
    let rectangles = (0..3).map(|axis| LuminousShape::new(Solid::Cuboid, across(axis)));
    let ellipses = [Axis::X, Axis::Y, Axis::Z].into_iter().enumerate();
    let ellipses = ellipses.map(|(i, axis)| LuminousShape::new(Solid::Cylinder(axis), across(i)));
    rectangles.chain(ellipses).collect()
}

/// Along axes, slanted, and nearly across.
fn directions() -> Vec<DVec3> {
    [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.6, -0.48, 0.64], [0.8, 0.5, -1e-3]]
        .map(|direction| DVec3::from_array(direction).normalize())
        .to_vec()
}

/// Positions with outward normal times area, from parametrisations of their own.
fn elements(shape: &LuminousShape) -> Vec<(DVec3, DVec3)> {
    let middles = || (0..STEPS).map(|i| (i as f64 + 0.5) / STEPS as f64);
    let grid = || middles().flat_map(move |u| middles().map(move |v| (u, v)));
    let part = 1.0 / (STEPS * STEPS) as f64;
    let mut found = Vec::new();
    match shape.solid() {
        Solid::Cuboid => {
            for (axis, side) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut normal = DVec3::ZERO;
                normal[axis] = side * 4.0 * HALF_M[j] * HALF_M[k] * part;
                for (u, v) in grid() {
                    let mut position = DVec3::ZERO;
                    position[axis] = side * HALF_M[axis];
                    position[j] = (2.0 * u - 1.0) * HALF_M[j];
                    position[k] = (2.0 * v - 1.0) * HALF_M[k];
                    found.push((position, normal));
                }
            }
        }
        Solid::Cylinder(axis) => {
            let axis = axis as usize;
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            for (u, v) in grid() {
                let (sin, cos) = libm::sincos(TAU * u);
                let mut position = DVec3::ZERO;
                position[axis] = (2.0 * v - 1.0) * HALF_M[axis];
                position[j] = HALF_M[j] * cos;
                position[k] = HALF_M[k] * sin;
                let mut normal = DVec3::ZERO;
                normal[j] = HALF_M[k] * cos;
                normal[k] = HALF_M[j] * sin;
                found.push((position, normal * (TAU * 2.0 * HALF_M[axis] * part)));
                for side in [1.0, -1.0] {
                    let mut end = DVec3::ZERO;
                    end[axis] = side * HALF_M[axis];
                    end[j] = position[j] * v;
                    end[k] = position[k] * v;
                    let mut normal = DVec3::ZERO;
                    normal[axis] = side * HALF_M[j] * HALF_M[k] * TAU * v * part;
                    found.push((end, normal));
                }
            }
        }
        Solid::Ellipsoid => {
            let product = HALF_M.x * HALF_M.y * HALF_M.z;
            for (u, v) in grid() {
                let (sin, cos) = libm::sincos(TAU * u);
                let z = 2.0 * v - 1.0;
                let across = (1.0 - z * z).sqrt();
                let s = DVec3::new(across * cos, across * sin, z);
                found.push((s * HALF_M, s / HALF_M * (product * 4.0 * PI * part)));
            }
        }
    }
    found
}

/// The sum errs by less than 1e-4; finds areas wrong by 1e-3.
#[test]
fn projected_areas_are_sums_over_the_surface() {
    for shape in solids() {
        let elements = elements(&shape);
        for toward in directions() {
            let sum: f64 = elements.iter().map(|(_, normal)| normal.dot(toward).max(0.0)).sum();
            let ratio = shape.projected_area_m2(toward) / sum;
            assert!((ratio - 1.0).abs() < 1e-3, "{}: {ratio} along {toward}", shape.name());
        }
    }
}

/// Seen along z, flat shapes have their area, and seen along a slope its cosine.
#[test]
fn flat_shapes_project_by_their_cosine() {
    let toward = directions()[3];
    for shape in flats() {
        let axis = (0..3).find(|&axis| shape.size_m()[axis] == 0.0).unwrap();
        let [a, b] = [HALF_M[(axis + 1) % 3], HALF_M[(axis + 2) % 3]];
        let area_m2 = if shape.solid() == Solid::Cuboid { 4.0 * a * b } else { PI * a * b };
        let ratio = shape.projected_area_m2(toward) / (area_m2 * toward[axis].abs());
        assert!((ratio - 1.0).abs() < 1e-14, "{}: {ratio}", shape.name());
        let point = shape.sample_silhouette(toward, [0.3, 0.8]);
        assert!(point.normal.dot(toward) > 0.0);
        let edge_on = shape.pdf_silhouette(toward.any_orthonormal_vector(), &point);
        assert!((edge_on * area_m2 - 1.0).abs() < 1e-14, "{}", shape.name());
    }
}

#[test]
fn samples_lie_on_the_side_that_is_seen() {
    for shape in solids().into_iter().chain(flats()) {
        for toward in directions() {
            let mut generator = Generator(1);
            for _ in 0..2000 {
                let u = [generator.uniform(), generator.uniform()];
                let point = shape.sample_silhouette(toward, u);
                assert!((point.normal.length() - 1.0).abs() < 1e-12);
                assert!(is_on(&shape, &point), "{}: {point:?}", shape.name());
                assert!(point.normal.dot(toward) >= -1e-9, "{}: {point:?}", shape.name());
                let back = shape.invert_silhouette(toward, &point);
                let error = (back[0] - u[0]).abs().max((back[1] - u[1]).abs());
                assert!(error < 1e-9, "{}: {u:?} became {back:?}", shape.name());
            }
        }
    }
}

/// Central differences of half-width 1e-6; finds a density that is wrong by 1e-4. Places near
/// the rim of a silhouette, where its derivative is infinite, and on kinks are left out.
#[test]
fn density_is_the_inverse_of_the_jacobian() {
    for shape in solids().into_iter().chain(flats()) {
        for toward in directions() {
            let mut generator = Generator(2);
            let mut compared = 0;
            for _ in 0..1000 {
                let u = [generator.uniform(), generator.uniform()].map(|u| 0.01 + 0.98 * u);
                let place = |u| shape.sample_silhouette(toward, u);
                let point = place(u);
                let step = 1e-6;
                // A place across a kink from its neighbours has a second difference.
                let [low, high] =
                    [-10.0, 10.0].map(|by| place([u[0] + by * step, u[1] + by * step]).position_m);
                let is_smooth = (low + high - 2.0 * point.position_m).length() < 1e-8;
                if !is_smooth || shape.is_solid() && point.normal.dot(toward) < 0.05 {
                    continue;
                }
                let stretch = sphere_jacobian(|u| place(u).position_m.to_array(), u, step);
                let product = stretch * shape.pdf_silhouette(toward, &point);
                assert!((product - 1.0).abs() < 1e-4, "{}: {product} at {u:?}", shape.name());
                compared += 1;
            }
            assert!(compared > 500, "{}: only {compared} places", shape.name());
        }
    }
}

/// First: counts of a uniform distribution over the silhouette do not fit one that is 2 % brighter
/// on half of it. Then 2^18 samples, seed 3, 64 cells each, 0.1 % for the family.
#[test]
fn samples_are_uniform_over_the_silhouette() {
    let level = sidak(SIGNIFICANCE, solids().len() * directions().len());
    for shape in solids() {
        let elements = elements(&shape);
        for toward in directions() {
            let found = probability(&shape, &elements, toward, 1.0);
            assert!(found > level, "{} along {toward}: {found:e}", shape.name());
        }
        let wrong = probability(&shape, &elements, directions()[3], 1.04);
        assert!(wrong < level, "{}: a wrong density passed", shape.name());
    }
}

/// That counts in cells by position come from a density that is `more` times as high on one half of
/// the silhouette.
fn probability(
    shape: &LuminousShape,
    elements: &[(DVec3, DVec3)],
    toward: DVec3,
    more: f64,
) -> f64 {
    let mut cells = vec![CellCount { observed: 0, expected: 0.0 }; 64];
    let aside = toward.any_orthonormal_vector();
    for (position, normal) in elements {
        let brighter = if position.dot(aside) > 0.0 { more } else { 1.0 };
        cells[cell(*position)].expected += brighter * normal.dot(toward).max(0.0);
    }
    let sum: f64 = cells.iter().map(|cell| cell.expected).sum();
    cells.iter_mut().for_each(|cell| cell.expected *= f64::from(SAMPLES) / sum);
    let mut generator = Generator(3);
    for _ in 0..SAMPLES {
        let u = [generator.uniform(), generator.uniform()];
        cells[cell(shape.sample_silhouette(toward, u).position_m)].observed += 1;
    }
    chi_square_test(&cells)
}

/// Four parts along each axis, their borders off the surface's own.
fn cell(position: DVec3) -> usize {
    let part = |axis: usize| {
        let share = position[axis] / HALF_M[axis];
        [-0.45, 0.0, 0.55].iter().filter(|border| share > **border).count()
    };
    part(0) * 16 + part(1) * 4 + part(2)
}

fn is_on(shape: &LuminousShape, point: &SurfacePoint) -> bool {
    let half_m = 0.5 * shape.size_m();
    let share = |axis: usize| {
        if half_m[axis] > 0.0 { point.position_m[axis] / half_m[axis] } else { 1.0 }
    };
    let is_flat_at = |axis: usize| half_m[axis] > 0.0 || point.position_m[axis] == 0.0;
    let largest = |axes: &[usize]| axes.iter().map(|&axis| share(axis).abs()).fold(0.0, f64::max);
    let error = match shape.solid() {
        Solid::Cuboid => largest(&[0, 1, 2]) - 1.0,
        Solid::Cylinder(axis) => {
            let axis = axis as usize;
            let (x, y) = (share((axis + 1) % 3), share((axis + 2) % 3));
            (x * x + y * y).sqrt().max(share(axis).abs()) - 1.0
        }
        Solid::Ellipsoid => DVec3::from_array([0, 1, 2].map(share)).length() - 1.0,
    };
    error.abs() < 1e-12 && (0..3).all(is_flat_at)
}

#[test]
fn lines_and_points_are_sampled_too() {
    let line = LuminousShape::new(Solid::Cuboid, DVec3::Y);
    let point = line.sample_silhouette(DVec3::Z, [0.75, 0.1]);
    assert_eq!((point.position_m, point.normal), (DVec3::Y * 0.25, DVec3::ZERO));
    assert_eq!(line.pdf_silhouette(DVec3::Z, &point), 1.0);
    assert_eq!(line.invert_silhouette(DVec3::Z, &point)[0], 0.75);
    assert_eq!(line.projected_area_m2(DVec3::Z), 0.0);
    let point = LuminousShape::POINT.sample_silhouette(DVec3::Z, [0.75, 0.1]);
    assert_eq!(point.position_m, DVec3::ZERO);
    assert!(LuminousShape::POINT.is_point() && !line.is_point() && !line.is_solid());
}
