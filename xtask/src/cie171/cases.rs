//! Cases 5.2 to 5.8 of the standard, but for glass (5.5).

use super::factors::{Point, configuration_factor, solid_angle_sr};
use super::geometry::{BOX, CUBE_M, FACES, PANEL, ROOM_M};
use super::luminaire;
use super::project::{Case, Expectation, Material, Project, Sensor, Tolerance, Value};
use std::f64::consts::PI;

/// Of the panel of case 5.3.
const PANEL_CD_M2: f64 = 1000.0;
/// Of the sources of cases 5.4 and 5.8.
const FLUX_LM: f64 = 10_000.0;
/// Of the lit surface of cases 5.6 and 5.7, so that what it sends to a point is in % of what falls
/// on it and is reflected.
const SENT_LX: f64 = 100.0;
/// Of the floor of case 5.6, and of the wall of case 5.7.
const FLOOR: f64 = 0.3;
const WALL: f64 = 0.6;
/// Where the luminaires of these cases are: in the middle of the ceiling, and between box and wall.
const ABOVE_FLOOR: Point = [2.0, 2.0, 3.0];
const BEFORE_WALL: Point = [2.0, 2.8, 1.5];
/// Reflectances of case 5.8, which the standard takes in steps from 0 to 0.95, with their part of
/// file names.
const CUBES: [(f64, &str); 4] = [(0.05, "05"), (0.3, "30"), (0.7, "70"), (0.95, "95")];

/// Corners of floor and far wall.
const FLOOR_CORNERS: [Point; 4] =
    [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [0.0, 4.0, 0.0]];

/// Lights the floor of case 5.6 evenly; its corners stand at 43.3 degrees.
pub(super) fn floor_luminaire() -> String {
    luminaire::even_file(SENT_LX / FLOOR, ABOVE_FLOOR[2], 45)
}

/// Lights the wall y = 4 of case 5.7 evenly; its corners stand at 64.4 degrees.
pub(super) fn wall_luminaire() -> String {
    luminaire::even_file(SENT_LX / WALL, ROOM_M[1] - BEFORE_WALL[1], 66)
}

/// A project and its file's name without the ending.
pub(super) struct NamedProject {
    pub(super) name: String,
    pub(super) project: Project,
}

/// All projects.
pub(super) fn projects() -> Vec<NamedProject> {
    let named = |number: &str, project| NamedProject { name: format!("cie171_{number}"), project };
    let mut projects = vec![
        named("5_2", point_light()),
        named("5_3", area_light()),
        named("5_4", flux()),
        named("5_6", diffuse_reflection()),
        named("5_7", obstruction()),
    ];
    for (reflectance, label) in CUBES {
        projects.push(named(&format!("5_8_{label}"), cube(reflectance)));
    }
    projects
}

/// All cases.
pub(super) fn cases() -> Vec<Case> {
    let cubes = CUBES.map(|(reflectance, label)| cube_case(reflectance, label));
    room_cases().into_iter().chain(cubes).collect()
}

/// Estimators of sensors at points, which paths find, and of means, which photons find as well.
const OF_POINTS: &[&str] = &["path", "bidirectional"];
const OF_MEANS: &[&str] = &["path", "photon"];
const CONTOUR_INTEGRAL: &str = "closed form: contour integral of Lambert (1760)";

/// Cases 5.2 to 5.7.
fn room_cases() -> [Case; 5] {
    let in_room = |number, name, source, expect| case(number, name, OF_POINTS, source, expect);
    [
        in_room(
            "5_2",
            "5.2 point light",
            "closed form: E = I cos / d^2, I = 1000 cd cos gamma",
            points(&plane_places(), "floor", "illuminance_lx", "I h / d^3", under_point_light_lx),
        ),
        in_room("5_3", "5.3 area light", CONTOUR_INTEGRAL, under_panel()),
        case("5_4", "5.4 flux", OF_MEANS, "closed form: flux = sum of illuminance x area", {
            let faces = FACES.iter().enumerate();
            let means = faces.map(|(face, name)| face_average(face, name));
            means.chain([all_flux(FLUX_LM)]).collect()
        }),
        in_room("5_6", "5.6 diffuse reflection", CONTOUR_INTEGRAL, over_lit_floor()),
        in_room("5_7", "5.7 obstruction", CONTOUR_INTEGRAL, behind_box()),
    ]
}

/// Case 5.8 with one reflectance.
fn cube_case(reflectance: f64, label: &str) -> Case {
    let all_lm = FLUX_LM / (1.0 - reflectance);
    let expect = vec![all_flux(all_lm), reflected_flux(reflectance * all_lm)];
    let name = format!("5.8 reflectance {reflectance}");
    let source = "closed form: flux / (1 - reflectance)";
    case(&format!("5_8_{label}"), &name, OF_MEANS, source, expect)
}

fn case(
    number: &str,
    name: &str,
    estimators: &'static [&'static str],
    source: &'static str,
    expect: Vec<Expectation>,
) -> Case {
    Case {
        file: format!("cie171_{number}"),
        name: format!("CIE 171:2006, {name}"),
        source,
        project: format!("cie171_{number}"),
        estimators,
        expect,
    }
}

/// Illuminance on the floor at a place of case 5.2, whose light has 1000 cd times the cosine.
fn under_point_light_lx(at: Point) -> f64 {
    let h = ROOM_M[2];
    let squared = (at[0] - 2.0) * (at[0] - 2.0) + (at[1] - 2.0) * (at[1] - 2.0) + h * h;
    1000.0 * h * h / (squared * squared)
}

/// Direct light of the panel of case 5.3.
fn under_panel() -> Vec<Expectation> {
    let value =
        |normal| move |at: Point| PI * PANEL_CD_M2 * configuration_factor(at, normal, &PANEL);
    let wall = wall_places(&WALL_A_TO_F_M);
    let mut expect = points(&wall, "wall", "illuminance_lx", FACTOR, value(FORWARD));
    let floor = floor_places(&FLOOR_G_TO_N_M);
    expect.extend(points(&floor, "floor", "illuminance_lx", FACTOR, value(UP)));
    expect
}

/// Light from the floor of case 5.6.
fn over_lit_floor() -> Vec<Expectation> {
    let value =
        |normal| move |at: Point| SENT_LX * configuration_factor(at, normal, &FLOOR_CORNERS);
    let mut expect = vec![lit("floor", SENT_LX / FLOOR)];
    let wall = wall_places(&WALL_B_TO_F_M);
    expect.extend(points(&wall, "wall", "indirect_lx", FACTOR, value(FORWARD)));
    let ceiling = ceiling_places(&CEILING_G_TO_J_M);
    expect.extend(points(&ceiling, "ceiling", "indirect_lx", FACTOR, value(DOWN)));
    expect
}

/// Light from the wall of case 5.7 over its box.
fn behind_box() -> Vec<Expectation> {
    let value =
        |normal| move |at: Point| SENT_LX * configuration_factor(at, normal, &seen_over_box(at));
    let mut expect = vec![lit("back", SENT_LX / WALL)];
    let wall = wall_places(&WALL_A_TO_F_M);
    expect.extend(points(&wall, "wall", "indirect_lx", FACTOR, value(FORWARD)));
    let floor = floor_places(&FLOOR_G_TO_K_M);
    expect.extend(points(&floor, "floor", "indirect_lx", FACTOR, value(UP)));
    expect
}

const UP: Point = [0.0, 0.0, 1.0];
const DOWN: Point = [0.0, 0.0, -1.0];
const FORWARD: Point = [0.0, 1.0, 0.0];
const FACTOR: &str = "configuration factor of what sends light here";

const WALL_A_TO_F_M: [f64; 6] = [2.75, 2.25, 1.75, 1.25, 0.75, 0.25];
const WALL_B_TO_F_M: [f64; 5] = [0.75, 1.25, 1.75, 2.25, 2.75];
const FLOOR_G_TO_N_M: [f64; 8] = [0.25, 0.75, 1.25, 1.75, 2.25, 2.75, 3.25, 3.75];
const FLOOR_G_TO_K_M: [f64; 5] = [0.25, 0.75, 1.25, 1.75, 2.25];
const CEILING_G_TO_J_M: [f64; 4] = [0.25, 0.75, 1.25, 1.75];

/// Places on the wall y = 0 above the middle of its foot.
fn wall_places(heights_m: &[f64]) -> Vec<Point> {
    heights_m.iter().map(|z| [2.0, 0.0, *z]).collect()
}

/// Places on the floor's centre line.
fn floor_places(along_m: &[f64]) -> Vec<Point> {
    along_m.iter().map(|y| [2.0, *y, 0.0]).collect()
}

/// Places on the ceiling's centre line.
fn ceiling_places(along_m: &[f64]) -> Vec<Point> {
    along_m.iter().map(|y| [2.0, *y, ROOM_M[2]]).collect()
}

/// A to J of case 5.2, from the foot of the light to half a metre before a corner.
fn plane_places() -> Vec<Point> {
    let steps = (0..4).flat_map(|row| (row..4).map(move |column| [column, row]));
    steps.map(|[x, y]| [2.0 + 0.5 * f64::from(x), 2.0 + 0.5 * f64::from(y), 0.0]).collect()
}

/// An expectation for each place.
fn points(
    places: &[Point],
    sensor: &'static str,
    figure: &'static str,
    why: &str,
    value: impl Fn(Point) -> f64,
) -> Vec<Expectation> {
    let expectation = |(point, at): (usize, &Point)| Expectation {
        sensors: vec![sensor],
        figure,
        direct_lm: None,
        point: Some(point),
        value: Value::One(value(*at)),
        why: why.to_owned(),
    };
    places.iter().enumerate().map(expectation).collect()
}

/// The surface that sends light is lit evenly.
fn lit(sensor: &'static str, value: f64) -> Expectation {
    let why = "the luminaire lights it evenly".to_owned();
    Expectation {
        sensors: vec![sensor],
        figure: "direct_lx",
        direct_lm: None,
        point: None,
        value: Value::One(value),
        why,
    }
}

/// What lands on all faces together.
fn all_flux(value: f64) -> Expectation {
    let why = "the source's flux, and what is reflected of it again and again".to_owned();
    Expectation {
        sensors: FACES.to_vec(),
        figure: "flux_lm",
        direct_lm: None,
        point: None,
        value: Value::One(value),
        why,
    }
}

/// The same without what comes straight from the source.
fn reflected_flux(value: f64) -> Expectation {
    let why =
        "what is reflected again and again: flux x reflectance / (1 - reflectance)".to_owned();
    let (figure, direct_lm) = ("indirect_flux_lm", Some(FLUX_LM));
    Expectation {
        sensors: FACES.to_vec(),
        figure,
        direct_lm,
        point: None,
        value: Value::One(value),
        why,
    }
}

/// The mean over a face of the black room with an isotropic source in its middle.
fn face_average(face: usize, name: &'static str) -> Expectation {
    let axis = face / 2;
    let half = ROOM_M.map(|side| 0.5 * side);
    let (a, b) = (half[(axis + 1) % 3], half[(axis + 2) % 3]);
    let share = solid_angle_sr([a, b], half[axis]) / (4.0 * PI);
    Expectation {
        sensors: vec![name],
        figure: "average_lx",
        direct_lm: None,
        point: None,
        value: Value::One(FLUX_LM * share / (4.0 * a * b)),
        why: "flux x solid angle / 4 pi / area".to_owned(),
    }
}

/// What a place before the box sees of the wall y = 4 over it: the box reaches from wall to wall,
/// so its two upper edges cut the wall at a height.
fn seen_over_box(at: Point) -> [Point; 4] {
    let [low, high] = BOX;
    let cut = |y: f64| at[2] + (high[2] - at[2]) * (ROOM_M[1] - at[1]) / (y - at[1]);
    let from = cut(low[1]).max(cut(high[1])).clamp(0.0, ROOM_M[2]);
    let (x, y, z) = (ROOM_M[0], ROOM_M[1], ROOM_M[2]);
    [[0.0, y, from], [x, y, from], [x, y, z], [0.0, y, z]]
}

fn point_light() -> Project {
    Project {
        what: "CIE 171:2006, case 5.2: a point light with a cosine distribution above a black \
            floor"
            .to_owned(),
        geometry: vec!["cie171_room.obj".to_owned()],
        materials: faces(|_| 0.0),
        light: luminaire_table("cie171_cosine.ies", ABOVE_FLOOR, DOWN),
        sensors: vec![Sensor::Points { name: "floor", places: plane_places(), normal: UP }],
        tolerance: Tolerance::Points(0.01),
    }
}

fn area_light() -> Project {
    let mut materials = faces(|_| 0.0);
    materials.push(Material { name: "panel", reflectance: 0.0 });
    let light = format!(
        "[[lights]]\nkind = \"area\"\nmaterial = \"panel\"\nluminance_cd_m2 = {PANEL_CD_M2}\n"
    );
    Project {
        what: "CIE 171:2006, case 5.3: a panel of 1 m x 1 m in the ceiling of a black room"
            .to_owned(),
        geometry: vec!["cie171_room.obj".to_owned(), "cie171_panel.obj".to_owned()],
        materials,
        light,
        sensors: vec![wall(&WALL_A_TO_F_M), floor(&FLOOR_G_TO_N_M)],
        tolerance: Tolerance::Points(0.002),
    }
}

fn flux() -> Project {
    Project {
        what: "CIE 171:2006, case 5.4: all light of a lamp lands on the faces of a black room"
            .to_owned(),
        geometry: vec!["cie171_room.obj".to_owned()],
        materials: faces(|_| 0.0),
        light: lamp(ROOM_M),
        sensors: face_means(ROOM_M),
        tolerance: Tolerance::Summary(0.005),
    }
}

fn diffuse_reflection() -> Project {
    let ceiling =
        Sensor::Points { name: "ceiling", places: ceiling_places(&CEILING_G_TO_J_M), normal: DOWN };
    Project {
        what: "CIE 171:2006, case 5.6: light reflected by an evenly lit floor".to_owned(),
        geometry: vec!["cie171_room.obj".to_owned()],
        materials: faces(|face| if face == "floor" { FLOOR } else { 0.0 }),
        light: luminaire_table("cie171_floor.ies", ABOVE_FLOOR, DOWN),
        sensors: vec![floor(&FLOOR_G_TO_N_M), wall(&WALL_B_TO_F_M), ceiling],
        tolerance: Tolerance::Points(0.002),
    }
}

fn obstruction() -> Project {
    let mut materials = faces(|face| if face == "back" { WALL } else { 0.0 });
    materials.push(Material { name: "box", reflectance: 0.0 });
    let places = [0.25, 1.5, 2.75].map(|z| [1.0, ROOM_M[1], z]);
    let back = Sensor::Points { name: "back", places: places.to_vec(), normal: [0.0, -1.0, 0.0] };
    Project {
        what: "CIE 171:2006, case 5.7: light reflected by an evenly lit wall, behind a box"
            .to_owned(),
        geometry: vec!["cie171_room.obj".to_owned(), "cie171_box.obj".to_owned()],
        materials,
        light: luminaire_table("cie171_wall.ies", BEFORE_WALL, FORWARD),
        sensors: vec![back, wall(&WALL_A_TO_F_M), floor(&FLOOR_G_TO_K_M)],
        tolerance: Tolerance::DarkPoints(0.002),
    }
}

fn cube(reflectance: f64) -> Project {
    Project {
        what: "CIE 171:2006, case 5.8: a lamp in the middle of a diffuse cube".to_owned(),
        geometry: vec!["cie171_cube.obj".to_owned()],
        materials: faces(|_| reflectance),
        light: lamp(CUBE_M),
        sensors: face_means(CUBE_M),
        // A share of `reflectance` is indirect: half-widths of at most 2 % of it.
        tolerance: Tolerance::Summary(f64::min(0.005, 0.02 * reflectance)),
    }
}

fn faces(reflectance: impl Fn(&str) -> f64) -> Vec<Material> {
    FACES.into_iter().map(|name| Material { name, reflectance: reflectance(name) }).collect()
}

fn wall(heights_m: &[f64]) -> Sensor {
    Sensor::Points { name: "wall", places: wall_places(heights_m), normal: FORWARD }
}

fn floor(along_m: &[f64]) -> Sensor {
    Sensor::Points { name: "floor", places: floor_places(along_m), normal: UP }
}

/// An isotropic source in the middle of a box.
fn lamp(size_m: Point) -> String {
    let at = size_m.map(|side| 0.5 * side);
    let intensity_cd = FLUX_LM / (4.0 * PI);
    format!("[[lights]]\nkind = \"point\"\nposition = {at:?}\nintensity_cd = {intensity_cd}\n")
}

fn luminaire_table(file: &str, position: Point, aim: Point) -> String {
    format!("[[luminaires]]\nphotometry = \"{file}\"\nposition = {position:?}\naim = {aim:?}\n")
}

/// Each face of a box from the origin on in 4 x 4 cells.
fn face_means(size_m: Point) -> Vec<Sensor> {
    let face = |(face, name): (usize, &'static str)| {
        let (axis, is_high) = (face / 2, face % 2 == 1);
        let along = |axis: usize, length: f64| {
            let mut vector = [0.0; 3];
            vector[axis] = length;
            vector
        };
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let at = if is_high { size_m[axis] } else { 0.0 };
        Sensor::Means {
            name,
            origin: along(axis, at),
            u: along(u, size_m[u]),
            v: along(v, size_m[v]),
            counts: [4, 4],
            normal: along(axis, if is_high { -1.0 } else { 1.0 }),
        }
    };
    FACES.into_iter().enumerate().map(face).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The values that the standard prints, to the digits that it has; table 19 (case 5.7) is
    /// printed with errors, so its values are those of the formula elsewhere.
    #[test]
    fn values_are_those_of_the_standard() {
        let printed: [(&str, &str, &[f64]); 7] = [
            (
                "cie171_5_2",
                "floor",
                &[111.11, 105.19, 90.00, 71.11, 99.72, 85.66, 68.05, 74.38, 59.98, 49.38],
            ),
            ("cie171_5_3", "wall", &[32.68, 75.19, 81.32, 69.06, 53.40, 40.00]),
            ("cie171_5_3", "floor", &[61.42, 79.26, 95.67, 105.78, 105.78, 95.67, 79.26, 61.42]),
            ("cie171_5_6", "wall", &[35.90, 27.99, 21.64, 16.72, 12.97]),
            ("cie171_5_6", "ceiling", &[26.80, 30.94, 33.98, 35.57]),
            ("cie171_5_7", "wall", &[16.07, 16.33, 15.40, 13.32, 10.32, 7.08]),
            ("cie171_5_7", "floor", &[3.38, 3.63, 3.01, 0.0, 0.0]),
        ];
        let cases = cases();
        for (file, sensor, values) in printed {
            let case = cases.iter().find(|case| case.file == file).unwrap();
            let own = case.expect.iter().filter(|e| e.sensors == [sensor] && e.point.is_some());
            let got: Vec<f64> = own.map(|expectation| expectation.value.one()).collect();
            assert_eq!(got.len(), values.len(), "{file} {sensor}");
            for (got, printed) in got.iter().zip(values) {
                assert!(
                    (got - printed).abs() < 0.0151,
                    "{file} {sensor}: {got}, printed {printed}"
                );
            }
        }
    }
}
