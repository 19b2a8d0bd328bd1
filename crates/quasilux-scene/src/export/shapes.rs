//! Surfaces that stand for luminous openings: those that Radiance samples evenly.

use super::Exported;
use super::lights::POINT_RADIUS_M;
use super::webs::shines;
use super::words::Words;
use crate::light::Luminaire;
use glam::DVec3;
use quasilux_photometry::{Axis, Solid};
use std::f64::consts::{PI, TAU};

/// Half a gap in m between the sides of a sheet that shines to both.
const GAP_M: f64 = 0.0005;
/// Rectangles of an ellipse and sides of a cylinder: Radiance samples rectangles evenly, and few
/// other shapes.
const PARTS: u32 = 24;

/// The shape that stands for a luminous opening.
pub(super) struct Shape {
    /// The function that makes radiances of intensities, and its arguments.
    pub(super) function: &'static str,
    pub(super) areas_m2: Vec<f64>,
    pub(super) surfaces: Vec<Surface>,
}

/// A surface in the frame of the luminaire, in m from its centre.
pub(super) enum Surface {
    Sphere {
        radius_m: f64,
    },
    Polygon {
        corners: Vec<DVec3>,
    },
    /// A disk that looks up (1) or down (-1).
    Ring {
        height_m: f64,
        side: f64,
        radius_m: f64,
    },
}

impl Shape {
    pub(super) fn new(light: &Luminaire, name: &str, exported: &mut Exported) -> Self {
        let size = light.shape.size_m();
        let is_round = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.max(b);
        match light.shape.solid() {
            _ if light.shape.is_point() => Self {
                function: "q_point",
                areas_m2: vec![PI * POINT_RADIUS_M * POINT_RADIUS_M],
                surfaces: vec![Surface::Sphere { radius_m: POINT_RADIUS_M }],
            },
            Solid::Cuboid if size.z <= 0.0 && size.x > 0.0 && size.y > 0.0 => {
                let rectangle = Sheet::Polygons(vec![rectangle([0.0, 0.0], [size.x, size.y])]);
                Self::sheet(light, rectangle, size.x * size.y)
            }
            Solid::Cylinder(Axis::Z) if size.z <= 0.0 => {
                let area_m2 = PI * 0.25 * size.x * size.y;
                if is_round(size.x, size.y) {
                    Self::sheet(light, Sheet::Disk { radius_m: 0.5 * size.x }, area_m2)
                } else {
                    Self::sheet(light, Sheet::Polygons(strips(size)), area_m2)
                }
            }
            Solid::Cylinder(Axis::Z) if is_round(size.x, size.y) => Self::tube(size),
            Solid::Ellipsoid if is_round(size.x, size.y) && is_round(size.x, size.z) => {
                let radius_m = 0.5 * size.x;
                Self {
                    function: "q_point",
                    areas_m2: vec![PI * radius_m * radius_m],
                    surfaces: vec![Surface::Sphere { radius_m }],
                }
            }
            Solid::Cuboid => Self::cuboid(size),
            Solid::Cylinder(_) | Solid::Ellipsoid => {
                let what = light.shape.name();
                exported.note(format!("{name}: a box of its size stands for its {what}"));
                Self::cuboid(size)
            }
        }
    }

    /// A sheet that shines to the sides that intensities are on.
    fn sheet(light: &Luminaire, sheet: Sheet, area_m2: f64) -> Self {
        let (up, down) = (shines(&light.photometry, 1.0), shines(&light.photometry, -1.0));
        let gap_m = if up && down { GAP_M } else { 0.0 };
        let sides = [(up, 1.0), (down, -1.0)].into_iter().filter(|(shines, _)| *shines);
        let surfaces = sides.flat_map(|(_, side)| sheet.surfaces(side, gap_m)).collect();
        Self { function: "q_flat", areas_m2: vec![area_m2], surfaces }
    }

    /// An upright cylinder: sides as wide as a circle is seen on average, and both ends.
    fn tube(size: DVec3) -> Self {
        let (half_m, radius_m) = (0.5 * size.z, 0.5 * size.x);
        let part = TAU / f64::from(PARTS);
        let around_m = 0.5 * part * radius_m / libm::sin(0.5 * part);
        let corner = |number: u32, height_m: f64| {
            let (y, x) = libm::sincos(part * f64::from(number));
            DVec3::new(around_m * x, around_m * y, height_m)
        };
        let side = |number: u32| Surface::Polygon {
            corners: vec![
                corner(number, -half_m),
                corner(number + 1, -half_m),
                corner(number + 1, half_m),
                corner(number, half_m),
            ],
        };
        let mut surfaces: Vec<Surface> = (0..PARTS).map(side).collect();
        surfaces.extend([1.0, -1.0].map(|side| Surface::Ring {
            height_m: half_m * side,
            side,
            radius_m,
        }));
        let areas_m2 = vec![size.x * size.z, PI * radius_m * radius_m];
        Self { function: "q_tube", areas_m2, surfaces }
    }

    /// A box; lines and upright sheets are 1 mm thick.
    fn cuboid(size: DVec3) -> Self {
        let size = size.max(DVec3::splat(2.0 * POINT_RADIUS_M));
        let half = 0.5 * size;
        let mut surfaces = Vec::new();
        for (axis, across, along) in [
            (DVec3::X, DVec3::Y, DVec3::Z),
            (DVec3::Y, DVec3::Z, DVec3::X),
            (DVec3::Z, DVec3::X, DVec3::Y),
        ] {
            for side in [1.0, -1.0] {
                // Counter-clockwise seen from outside.
                let corner =
                    |[u, v]: [f64; 2]| (axis * side + across * u * side + along * v) * half;
                let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner);
                surfaces.push(Surface::Polygon { corners: corners.to_vec() });
            }
        }
        let areas_m2 = vec![size.y * size.z, size.x * size.z, size.x * size.y];
        Self { function: "q_box", areas_m2, surfaces }
    }
}

/// A flat shape about the origin.
enum Sheet {
    Disk {
        radius_m: f64,
    },
    /// Each counter-clockwise seen from above.
    Polygons(Vec<[DVec3; 4]>),
}

impl Sheet {
    /// The side that looks up (1) or down (-1), so far from the middle.
    fn surfaces(&self, side: f64, gap_m: f64) -> Vec<Surface> {
        let shift = DVec3::Z * (side * gap_m);
        match self {
            Self::Disk { radius_m } => {
                vec![Surface::Ring { height_m: side * gap_m, side, radius_m: *radius_m }]
            }
            Self::Polygons(polygons) => polygons
                .iter()
                .map(|corners| {
                    let mut corners = corners.map(|corner| corner + shift).to_vec();
                    if side < 0.0 {
                        corners.reverse();
                    }
                    Surface::Polygon { corners }
                })
                .collect(),
        }
    }
}

/// A rectangle about a place.
fn rectangle([x, y]: [f64; 2], [width, length]: [f64; 2]) -> [DVec3; 4] {
    [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]
        .map(|[u, v]| DVec3::new(x + u * width, y + v * length, 0.0))
}

/// Rectangles across the x axis for an ellipse, each of the area of the ellipse there.
fn strips(size: DVec3) -> Vec<[DVec3; 4]> {
    let width = 2.0 / f64::from(PARTS);
    // Area of the unit disk to the left of x.
    let area = |x: f64| x * libm::sqrt((1.0 - x * x).max(0.0)) + libm::asin(x);
    let strip = |number: u32| {
        let (from, to) = (width * f64::from(number) - 1.0, width * f64::from(number + 1) - 1.0);
        let length = (area(to.min(1.0)) - area(from)) / width;
        let middle = 0.5 * (from + to) * 0.5 * size.x;
        rectangle([middle, 0.0], [width * 0.5 * size.x, length * 0.5 * size.y])
    };
    (0..PARTS).map(strip).collect()
}

impl Surface {
    pub(super) fn write(&self, light: &Luminaire, modifier: &str, name: &str, words: &mut Words) {
        let world = |local: DVec3| light.position + light.world_from_luminaire * local;
        let up = light.world_from_luminaire * DVec3::Z;
        match self {
            Self::Sphere { radius_m } => {
                let [x, y, z] = light.position.to_array();
                words.of_numbers(modifier, "sphere", name, &[x, y, z, *radius_m]);
            }
            Self::Polygon { corners } => {
                let corners: Vec<DVec3> = corners.iter().map(|corner| world(*corner)).collect();
                words.polygon(modifier, name, &corners);
            }
            Self::Ring { height_m, side, radius_m } => {
                let (centre, normal) = (world(DVec3::Z * *height_m), up * *side);
                let numbers = [&centre.to_array()[..], &normal.to_array(), &[0.0, *radius_m]];
                words.of_numbers(modifier, "ring", name, &numbers.concat());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ray that looks at a box meets the front of its sides.
    #[test]
    fn boxes_face_outward() {
        let shape = Shape::cuboid(DVec3::new(0.5, 0.3, 0.2));
        let mut area_m2 = 0.0;
        for surface in &shape.surfaces {
            let Surface::Polygon { corners } = surface else { panic!("a side") };
            let [a, b, c, d] = corners.as_slice() else { panic!("four corners") };
            let across = (*b - *a).cross(*d - *a);
            assert!(across.dot(*a) > 0.0 && (*c - *a).dot(across).abs() < 1e-15);
            area_m2 += across.length();
        }
        assert!((area_m2 - 2.0 * shape.areas_m2.iter().sum::<f64>()).abs() < 1e-12);
    }

    /// Strips have the area of the ellipse, sides of a cylinder the mean width of a circle.
    #[test]
    fn parts_have_the_size_of_what_they_stand_for() {
        let polygon = |corners: &[DVec3]| {
            let pairs = (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
            0.5 * pairs.map(|(a, b)| a.cross(b)).sum::<DVec3>().length()
        };
        let area_m2: f64 = strips(DVec3::new(0.4, 0.2, 0.0)).iter().map(|it| polygon(it)).sum();
        assert!((area_m2 / (PI * 0.2 * 0.1) - 1.0).abs() < 1e-12, "{area_m2}");
        let shape = Shape::tube(DVec3::new(0.4, 0.4, 0.5));
        let around_m: f64 = shape
            .surfaces
            .iter()
            .filter_map(|surface| match surface {
                Surface::Polygon { corners } => Some((corners[1] - corners[0]).length()),
                Surface::Sphere { .. } | Surface::Ring { .. } => None,
            })
            .sum();
        // Cauchy: the mean width of a convex outline is its length over pi.
        assert!((around_m / PI - 0.4).abs() < 1e-12, "{around_m}");
    }
}
