//! Luminaires, as ies2rad makes them: a shape that shines by a table of intensities over the area
//! that it shows in each direction.

use super::lights::POINT_RADIUS_M;
use super::words::{Primitive, Words};
use super::{Exported, LM_PER_W};
use crate::light::Luminaire;
use glam::{DMat3, DVec3};
use quasilux_photometry::{Axis, Photometry, Solid};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::sync::Arc;

/// Functions of the tables, in the frame of the luminaire: nadir along -z, C0 along +x. A ray looks
/// at the shape along D, so that light leaves along -D.
pub(super) const FUNCTIONS: &str = "\
{ Functions of light sources and skies that quasilux exports. }
q_deg : 180/PI;
q_turn(a) : if(a, a, a + 360);
{ Angles of a luminaire: gamma from nadir, C from +x towards +y, in degrees. }
q_gamma = q_deg * Acos(Dz);
q_c = q_turn(q_deg * atan2(-Dy, -Dx));
{ Intensities to radiances: over the area that is seen, of a sphere, a sheet, a box, tubes. }
q_point(v) = v / A1;
q_flat(v) = v / (A1 * abs(Dz));
q_box(v) = v / (A1 * abs(Dx) + A2 * abs(Dy) + A3 * abs(Dz));
q_tube(v) = v / (A1 * sqrt(max(0, 1 - Dz*Dz)) + A2 * abs(Dz));
{ Angles of a sky: altitude, and from +x towards +y, in degrees. }
q_altitude = q_deg * Asin(Dz);
q_around = q_turn(q_deg * atan2(Dy, Dx));
q_sky(v) = v;
";

/// Steps of the tables from nadir to zenith, and around.
const GAMMA_STEPS: u32 = 360;
const C_STEPS: u32 = 180;
/// Half a gap in m between the sides of a sheet that shines to both.
const GAP_M: f64 = 0.0005;
/// Corners of a polygon for an ellipse.
const CORNERS: u32 = 96;

/// Tables that are there, by the photometry that they are of.
pub(super) type Tables = Vec<(Arc<Photometry>, String)>;

/// Writes a luminaire and, where it is the first of its photometry, the table.
pub(super) fn write(
    light: &Luminaire,
    number: usize,
    tables: &mut Tables,
    words: &mut Words,
    exported: &mut Exported,
) {
    let name = format!("luminaire{number}");
    let table = table_of(&light.photometry, tables, exported);
    let shape = Shape::new(light, &name, exported);
    let pattern = format!("{name}.d");
    let texts = [shape.function, &table, "quasilux.cal", "q_gamma", "q_c"];
    let mut texts: Vec<String> = texts.map(str::to_owned).to_vec();
    texts.push(turned(light.world_from_luminaire));
    let (kind, numbers) = ("brightdata", shape.areas_m2.as_slice());
    words.add(Primitive { modifier: "void", kind, name: &pattern, texts: &texts, numbers });
    words.of_numbers(&pattern, "light", &name, &[light.dimming / LM_PER_W; 3]);
    for (part, surface) in shape.surfaces.iter().enumerate() {
        surface.write(light, &name, &format!("{name}.{part}"), words);
    }
}

/// The name of the table of a photometry.
fn table_of(photometry: &Arc<Photometry>, tables: &mut Tables, exported: &mut Exported) -> String {
    let known = tables.iter().find(|(known, _)| Arc::ptr_eq(known, photometry));
    if let Some((_, name)) = known {
        return name.clone();
    }
    let name = format!("web{}.dat", tables.len());
    exported.add(&name, intensities(photometry));
    tables.push((Arc::clone(photometry), name.clone()));
    name
}

/// Intensities in cd by gamma and C, in the format of Radiance's data files.
fn intensities(photometry: &Photometry) -> String {
    let mut text = format!("2\n0 180 {}\n0 360 {}\n", GAMMA_STEPS + 1, C_STEPS + 1);
    for gamma in 0..=GAMMA_STEPS {
        let (sin, cos) = libm::sincos(f64::from(gamma) / f64::from(GAMMA_STEPS) * PI);
        for c in 0..=C_STEPS {
            let (y, x) = libm::sincos(f64::from(c % C_STEPS) / f64::from(C_STEPS) * TAU);
            let direction = DVec3::new(sin * x, sin * y, -cos);
            let intensity_cd = photometry.intensity_cd(direction);
            let separator = if c == C_STEPS { '\n' } else { ' ' };
            write!(text, "{intensity_cd:.7e}{separator}").expect("strings grow");
        }
    }
    text
}

/// Options of `xform` that turn the frame of the luminaire into the world's: about z, y and z.
fn turned(world_from_luminaire: DMat3) -> String {
    let axis = world_from_luminaire.z_axis;
    let tilt = libm::atan2(libm::hypot(axis.x, axis.y), axis.z);
    let (first, last) = if libm::sin(tilt).abs() < 1e-12 {
        // Up or down: one angle says all.
        let x = world_from_luminaire.x_axis * libm::cos(tilt).signum();
        (0.0, libm::atan2(x.y, x.x))
    } else {
        let (x, y) = (world_from_luminaire.x_axis.z, world_from_luminaire.y_axis.z);
        (libm::atan2(y, -x), libm::atan2(axis.y, axis.x))
    };
    let [first, tilt, last] = [first, tilt, last].map(f64::to_degrees);
    format!("-rz {first} -ry {tilt} -rz {last}")
}

/// The shape that stands for a luminous opening.
struct Shape {
    /// The function that makes radiances of intensities, and its arguments.
    function: &'static str,
    areas_m2: Vec<f64>,
    surfaces: Vec<Surface>,
}

/// A surface in the frame of the luminaire, in m from its centre.
enum Surface {
    Sphere { radius_m: f64 },
    Polygon { corners: Vec<DVec3> },
    Tube { half_m: f64, radius_m: f64 },
    Ring { height_m: f64, radius_m: f64 },
}

impl Shape {
    fn new(light: &Luminaire, name: &str, exported: &mut Exported) -> Self {
        let size = light.shape.size_m();
        let is_round = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.max(b);
        match light.shape.solid() {
            _ if light.shape.is_point() => Self {
                function: "q_point",
                areas_m2: vec![PI * POINT_RADIUS_M * POINT_RADIUS_M],
                surfaces: vec![Surface::Sphere { radius_m: POINT_RADIUS_M }],
            },
            Solid::Cuboid if size.z <= 0.0 && size.x > 0.0 && size.y > 0.0 => {
                Self::sheet(light, &corners_of_rectangle(size), size.x * size.y)
            }
            Solid::Cylinder(Axis::Z) if size.z <= 0.0 => {
                Self::sheet(light, &corners_of_ellipse(size), area_of_ellipse_m2(size))
            }
            Solid::Cylinder(Axis::Z) if is_round(size.x, size.y) => Self::tube(size),
            Solid::Cuboid => Self::cuboid(size),
            Solid::Cylinder(_) | Solid::Ellipsoid => {
                let what = light.shape.name();
                exported.note(format!("{name}: a box of its size stands for its {what}"));
                Self::cuboid(size)
            }
        }
    }

    /// A sheet that shines to the sides that intensities are on.
    fn sheet(light: &Luminaire, corners: &[DVec3], area_m2: f64) -> Self {
        let shines = |up: f64| {
            let tilts = (0..180).map(|step| libm::sincos((f64::from(step) + 0.5) * PI / 360.0));
            let mut directions = tilts.flat_map(|(sin, cos)| {
                (0..36).map(move |turn| {
                    let (y, x) = libm::sincos(f64::from(turn) * TAU / 36.0);
                    DVec3::new(sin * x, sin * y, up * cos)
                })
            });
            directions.any(|direction| light.photometry.intensity_cd(direction) > 0.0)
        };
        let (up, down) = (shines(1.0), shines(-1.0));
        let gap = DVec3::Z * if up && down { GAP_M } else { 0.0 };
        let mut surfaces = Vec::new();
        if up {
            let corners = corners.iter().map(|corner| *corner + gap).collect();
            surfaces.push(Surface::Polygon { corners });
        }
        if down {
            let corners = corners.iter().rev().map(|corner| *corner - gap).collect();
            surfaces.push(Surface::Polygon { corners });
        }
        Self { function: "q_flat", areas_m2: vec![area_m2], surfaces }
    }

    /// An upright cylinder.
    fn tube(size: DVec3) -> Self {
        let (half_m, radius_m) = (0.5 * size.z, 0.5 * size.x);
        Self {
            function: "q_tube",
            areas_m2: vec![size.x * size.z, PI * radius_m * radius_m],
            surfaces: vec![
                Surface::Tube { half_m, radius_m },
                Surface::Ring { height_m: half_m, radius_m },
                Surface::Ring { height_m: -half_m, radius_m },
            ],
        }
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

/// Counter-clockwise seen from above.
fn corners_of_rectangle(size: DVec3) -> [DVec3; 4] {
    [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]
        .map(|[x, y]| DVec3::new(x * size.x, y * size.y, 0.0))
}

/// A polygon for an ellipse, counter-clockwise seen from above.
fn corners_of_ellipse(size: DVec3) -> Vec<DVec3> {
    let corner = |number: u32| {
        let (y, x) = libm::sincos(f64::from(number) * TAU / f64::from(CORNERS));
        DVec3::new(0.5 * x * size.x, 0.5 * y * size.y, 0.0)
    };
    (0..CORNERS).map(corner).collect()
}

/// The area of that polygon.
fn area_of_ellipse_m2(size: DVec3) -> f64 {
    let corners = f64::from(CORNERS);
    0.125 * corners * libm::sin(TAU / corners) * size.x * size.y
}

impl Surface {
    fn write(&self, light: &Luminaire, modifier: &str, name: &str, words: &mut Words) {
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
            Self::Tube { half_m, radius_m } => {
                let ends = [-*half_m, *half_m].map(|height| world(DVec3::Z * height).to_array());
                let numbers = [&ends[0][..], &ends[1], &[*radius_m]].concat();
                words.of_numbers(modifier, "cylinder", name, &numbers);
            }
            Self::Ring { height_m, radius_m } => {
                let (centre, normal) = (world(DVec3::Z * *height_m), up * height_m.signum());
                let numbers = [&centre.to_array()[..], &normal.to_array(), &[0.0, *radius_m]];
                words.of_numbers(modifier, "ring", name, &numbers.concat());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Placement;

    /// `xform` turns about the fixed axes, one option after the other.
    fn by_options(options: &str) -> DMat3 {
        let words: Vec<&str> = options.split_whitespace().collect();
        words.chunks(2).fold(DMat3::IDENTITY, |before, pair| {
            let angle = pair[1].parse::<f64>().expect("an angle").to_radians();
            let turn = match pair[0] {
                "-ry" => DMat3::from_rotation_y(angle),
                "-rz" => DMat3::from_rotation_z(angle),
                other => panic!("{other}"),
            };
            turn * before
        })
    }

    #[test]
    fn options_turn_as_the_luminaire_is_turned() {
        let axes = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Z, DVec3::Z];
        let mut aims = axes.to_vec();
        aims.extend([DVec3::new(0.3, -0.5, -0.7), DVec3::new(1e-7, 0.0, -1.0)]);
        for aim in aims {
            for c0 in [DVec3::new(0.2, 0.9, 0.1), DVec3::new(-0.8, 0.1, 0.5)] {
                for rotation_rad in [0.0, 1.0, -2.5] {
                    let placement = Placement { aim, c0, rotation_rad };
                    let wanted = placement.world_from_luminaire().expect("no parallel axes");
                    let found = by_options(&turned(wanted));
                    let error = (found - wanted).to_cols_array();
                    assert!(error.iter().all(|it| it.abs() < 1e-6), "{aim} {c0}: {found}");
                }
            }
        }
    }

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

    #[test]
    fn polygons_for_ellipses_have_their_own_area() {
        let size = DVec3::new(0.4, 0.2, 0.0);
        let (corners, area_m2) = (corners_of_ellipse(size), area_of_ellipse_m2(size));
        let doubled: f64 = (0..corners.len())
            .map(|number| corners[number].cross(corners[(number + 1) % corners.len()]).z)
            .sum();
        assert!((0.5 * doubled - area_m2).abs() < 1e-12);
        assert!((area_m2 / (PI * 0.2 * 0.1) - 1.0).abs() < 1e-3);
    }
}
