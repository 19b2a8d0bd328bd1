//! One luminaire without symmetry over a black floor: E = I(C, gamma) cos / d^2 at 20 points.
//!
//! The reference reads the table below by hand-written bilinear interpolation; it shares no code
//! with the program.

use crate::support::{Folder, number, parsed};
use std::f64::consts::PI;

const C_STEP_DEG: f64 = 60.0;
const GAMMA_STEP_DEG: f64 = 15.0;
/// The values below are to be multiplied by this: multiplier times ballast factor.
const FACTOR: f64 = 1.5 * 0.8;
/// Candelas at gamma = 0, 15, ..., 90 degrees, for C = 0, 60, ..., 360 degrees.
const CANDELAS: [[f64; 7]; 7] = [
    [900.0, 870.0, 910.0, 640.0, 500.0, 260.0, 90.0],
    [900.0, 930.0, 780.0, 810.0, 430.0, 330.0, 60.0],
    [900.0, 760.0, 690.0, 450.0, 370.0, 150.0, 110.0],
    [900.0, 810.0, 520.0, 380.0, 410.0, 190.0, 40.0],
    [900.0, 700.0, 590.0, 560.0, 220.0, 240.0, 70.0],
    [900.0, 960.0, 840.0, 500.0, 480.0, 120.0, 130.0],
    [900.0, 870.0, 910.0, 640.0, 500.0, 260.0, 90.0],
];
const FLOOR_OBJ: &str =
    "o floor\nusemtl black\nv -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n";
/// Height of the sensor points.
const Z_M: f64 = 0.25;

type Vector = [f64; 3];

/// As the project file names it.
struct Placement {
    position: Vector,
    aim: Vector,
    c0: Vector,
    rotation_deg: f64,
}

#[test]
fn straight_down() {
    check(
        "direct_straight",
        &Placement {
            position: [0.3, -0.2, 3.0],
            aim: [0.0, 0.0, -1.0],
            c0: [1.0, 0.0, 0.0],
            rotation_deg: 0.0,
        },
    );
}

/// The same table as TM-33: the same result to the last bit.
#[test]
fn tm33_is_like_ies() {
    let placement = Placement {
        position: [0.3, -0.2, 3.0],
        aim: [0.5, -0.9, -3.0],
        c0: [1.0, 0.0, 0.0],
        rotation_deg: 0.0,
    };
    let folder = Folder::new("direct_tm33");
    folder.write("floor.obj", FLOOR_OBJ);
    folder.write("lamp.ies", ies());
    folder.write("lamp.xml", tm33());
    let results = ["lamp.ies", "lamp.xml"].map(|lamp| {
        folder.write("project.toml", project(&placement).replace("lamp.ies", lamp));
        let document = parsed(&folder.document("project.toml", &format!("out-{lamp}"), &[], 0));
        document["sensors"].clone()
    });
    assert!(results[0].is_array());
    assert_eq!(results[0], results[1]);
}

#[test]
fn tilted_and_turned() {
    check(
        "direct_tilted",
        &Placement {
            position: [-0.4, 0.6, 3.5],
            aim: [0.5, -0.9, -3.0],
            c0: [1.0, 2.0, 0.7],
            rotation_deg: 200.0,
        },
    );
}

fn check(name: &str, placement: &Placement) {
    let folder = Folder::new(name);
    folder.write("floor.obj", FLOOR_OBJ);
    folder.write("lamp.ies", ies());
    folder.write("project.toml", project(placement));
    for estimator in ["path", "bidirectional"] {
        let document = folder.document("project.toml", estimator, &["--estimator", estimator], 0);
        let document = parsed(&document);
        for (i, point) in points().into_iter().enumerate() {
            let expected = expected_lx(placement, point);
            assert!(expected > 1.0, "point {i} tells nothing: {expected} lx");
            for key in ["illuminance_lx", "direct_lx"] {
                let got = number(&document, &format!("/sensors/0/points/{i}/{key}"));
                assert!(
                    (got / expected - 1.0).abs() < 1e-6,
                    "{estimator}, point {i}, {key}: {got}, not {expected}"
                );
            }
        }
    }
}

/// Twenty points on a spiral: all azimuths, from below the luminaire to 4 m aside.
fn points() -> Vec<Vector> {
    (0..20)
        .map(|i| {
            let (radius_m, turn_rad) = (0.2 * f64::from(i) + 0.07, 2.4 * f64::from(i));
            [radius_m * libm::cos(turn_rad), radius_m * libm::sin(turn_rad), Z_M]
        })
        .collect()
}

fn expected_lx(placement: &Placement, point: Vector) -> f64 {
    let to_point: Vector = std::array::from_fn(|i| point[i] - placement.position[i]);
    let distance_m = dot(to_point, to_point).sqrt();
    let direction = to_point.map(|x| x / distance_m);
    let aim = unit(placement.aim);
    let along = dot(placement.c0, aim);
    let c0 = unit(std::array::from_fn(|i| placement.c0[i] - along * aim[i]));
    let c90 = cross(aim.map(|x| -x), c0);
    let gamma_deg = libm::acos(dot(direction, aim)) * 180.0 / PI;
    let unturned_deg = libm::atan2(dot(direction, c90), dot(direction, c0)) * 180.0 / PI;
    let c_deg = (unturned_deg - placement.rotation_deg).rem_euclid(360.0);
    let cos = -direction[2];
    intensity_cd(c_deg, gamma_deg) * cos / (distance_m * distance_m)
}

fn intensity_cd(c_deg: f64, gamma_deg: f64) -> f64 {
    let (c, gamma) = (c_deg / C_STEP_DEG, gamma_deg / GAMMA_STEP_DEG);
    let (row, column) = ((c as usize).min(5), (gamma as usize).min(5));
    let (s, t) = (c - row as f64, gamma - column as f64);
    let at = |i: usize, j: usize| CANDELAS[row + i][column + j];
    let near = at(0, 0) * (1.0 - t) + at(0, 1) * t;
    let far = at(1, 0) * (1.0 - t) + at(1, 1) * t;
    FACTOR * (near * (1.0 - s) + far * s)
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Vector) -> Vector {
    let length = dot(a, a).sqrt();
    a.map(|x| x / length)
}

/// The table as LM-63-2002 has it; absolute photometry.
fn ies() -> String {
    let angles = |step_deg: f64| {
        let angles = (0..7).map(|i| (f64::from(i) * step_deg).to_string());
        angles.collect::<Vec<_>>().join(" ")
    };
    let mut text = format!(
        "IESNA:LM-63-2002\n[TEST] made-up\n[TESTLAB] none\n[ISSUEDATE] 1-JAN-2026\n[MANUFAC] \
         none\nTILT=NONE\n1 -1 1.5 7 7 1 2 0 0 0\n0.8 1 30\n{}\n{}\n",
        angles(GAMMA_STEP_DEG),
        angles(C_STEP_DEG)
    );
    for row in CANDELAS {
        text += &row.map(|candela| candela.to_string()).join(" ");
        text.push('\n');
    }
    text
}

fn project(placement: &Placement) -> String {
    let Placement { position, aim, c0, rotation_deg } = placement;
    let points = points();
    let normals = vec![[0, 0, 1]; points.len()];
    format!(
        "[scene]\ngeometry = [\"floor.obj\"]\n[materials.black]\nreflectance = 0\n[[luminaires]]\n\
         photometry = \"lamp.ies\"\nposition = {position:?}\naim = {aim:?}\nc0 = {c0:?}\n\
         rotation_deg = {rotation_deg}\n[[sensors]]\nname = \"points\"\nkind = \"points\"\n\
         points = \
         {points:?}\nnormals = {normals:?}\n"
    )
}

fn tm33() -> String {
    let mut points = String::new();
    for (plane, values) in CANDELAS.iter().enumerate() {
        for (angle, value) in values.iter().enumerate() {
            let (h, v) = (C_STEP_DEG * plane as f64, GAMMA_STEP_DEG * angle as f64);
            points += &format!("<IntData h=\"{h}\" v=\"{v}\">{value}</IntData>\n");
        }
    }
    format!(
        "<IESTM33-22><Emitter><Quantity>1</Quantity><LuminousData><LuminousIntensity>\n\
         <Multiplier>{FACTOR}</Multiplier>\n{points}\
         </LuminousIntensity></LuminousData></Emitter></IESTM33-22>\n"
    )
}
