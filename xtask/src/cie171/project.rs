//! Project files and cases as text.

use super::factors::Point;
use std::fmt::Write;

/// A project: what it shows, its geometry, materials with reflectances, light and sensors.
pub(super) struct Project {
    pub(super) what: String,
    pub(super) geometry: Vec<String>,
    pub(super) materials: Vec<Material>,
    /// A table of the project file, its header included.
    pub(super) light: String,
    pub(super) sensors: Vec<Sensor>,
    pub(super) tolerance: Tolerance,
}

/// A diffuse material.
pub(super) struct Material {
    pub(super) name: &'static str,
    pub(super) reflectance: f64,
}

/// Half-width over value, and of what.
pub(super) enum Tolerance {
    Points(f64),
    /// Of points some of which no light reaches.
    DarkPoints(f64),
    Summary(f64),
}

/// What is looked at, on a surface: the project has it a hair before that.
pub(super) enum Sensor {
    Points {
        name: &'static str,
        places: Vec<Point>,
        normal: Point,
    },
    /// Means over the cells of a rectangle.
    Means {
        name: &'static str,
        origin: Point,
        u: Point,
        v: Point,
        counts: [u32; 2],
        normal: Point,
    },
}

/// A case: a project with what it must give.
pub(super) struct Case {
    /// Without ending, of the case's file.
    pub(super) file: String,
    pub(super) name: String,
    pub(super) source: &'static str,
    /// Without ending, of the project's file.
    pub(super) project: String,
    pub(super) estimators: &'static [&'static str],
    pub(super) expect: Vec<Expectation>,
}

/// One value, or the same for all points of a sensor, or one for each.
pub(super) struct Expectation {
    /// One or, for a flux, several.
    pub(super) sensors: Vec<&'static str>,
    pub(super) figure: &'static str,
    /// Of an indirect flux: what comes straight from the lights.
    pub(super) direct_lm: Option<f64>,
    pub(super) point: Option<usize>,
    pub(super) value: Value,
    pub(super) why: String,
}

/// What is expected.
pub(super) enum Value {
    One(f64),
    /// Of each point.
    Each(Vec<f64>),
}

#[cfg(test)]
impl Value {
    pub(super) fn one(&self) -> f64 {
        match self {
            Self::One(value) => *value,
            Self::Each(values) => panic!("{values:?} is not one value"),
        }
    }
}

/// Allowed beyond the interval.
const TOLERANCE: f64 = 0.003;
/// How far sensors stand before the surface that they belong to.
const HAIR_M: f64 = 1e-5;

impl Project {
    pub(super) fn text(&self) -> String {
        let mut text = format!(
            "# {}.\n# Written by `cargo xtask cie171`.\n\n[scene]\ngeometry = {:?}\n",
            self.what, self.geometry
        );
        for Material { name, reflectance } in &self.materials {
            write!(text, "\n[materials.{name}]\nreflectance = {reflectance}\n")
                .expect("strings grow");
        }
        write!(text, "\n{}", self.light).expect("strings grow");
        for sensor in &self.sensors {
            text.push_str(&sensor.text());
        }
        let tolerance = match self.tolerance {
            Tolerance::Points(rel_tol) => format!("rel_tol = {rel_tol}\n"),
            Tolerance::DarkPoints(rel_tol) => format!("rel_tol = {rel_tol}\nabs_tol = 0.001\n"),
            Tolerance::Summary(rel_tol) => {
                format!("rel_tol = {rel_tol}\ntolerance_on = \"summary\"\n")
            }
        };
        text + "\n[simulation]\n" + &tolerance
    }
}

impl Sensor {
    fn text(&self) -> String {
        match self {
            Self::Points { name, places, normal } => format!(
                "\n[[sensors]]\nname = \"{name}\"\nkind = \"points\"\npoints = [\n{}]\nnormals = \
                 [\n{}]\n",
                places
                    .iter()
                    .map(|at| format!("    {:?},\n", before(*at, *normal)))
                    .collect::<String>(),
                format!("    {normal:?},\n").repeat(places.len()),
            ),
            Self::Means { name, origin, u, v, counts, normal } => format!(
                "\n[[sensors]]\nname = \"{name}\"\nkind = \"grid\"\norigin = {origin:?}\nu = \
                 {u:?}\nv = {v:?}\n\
                 counts = {counts:?}\nnormal = {normal:?}\nquantity = \"mean\"\n",
                origin = before(*origin, *normal),
            ),
        }
    }
}

impl Case {
    pub(super) fn text(&self) -> String {
        let Self { name, source, project, estimators, .. } = self;
        let mut head = format!(
            "# Written by `cargo xtask cie171`.\nname = \"{name}\"\nsource = \"{source}\"\n\
             project = \"../scenes/{project}.toml\"\nestimators = {estimators:?}\n"
        );
        if estimators.contains(&"bidirectional") {
            head += "rel_tol = { bidirectional = 0.01 }\n";
        }
        head + &self.expect.iter().map(Expectation::text).collect::<String>()
    }
}

impl Expectation {
    /// Illuminances of all points of a sensor.
    pub(super) fn of_points(sensor: &'static str, values: Vec<f64>, why: &str) -> Self {
        Self {
            sensors: vec![sensor],
            figure: "illuminance_lx",
            direct_lm: None,
            point: None,
            value: Value::Each(values),
            why: why.to_owned(),
        }
    }

    fn text(&self) -> String {
        let sensor = match self.sensors.as_slice() {
            [one] => format!("sensor = \"{one}\""),
            several => format!("sensors = {several:?}"),
        };
        let direct = self.direct_lm.map_or_else(String::new, |lm| format!("direct_lm = {lm}\n"));
        let point = self.point.map_or_else(String::new, |point| format!("point = {point}\n"));
        let value = match &self.value {
            Value::One(value) => format!("value = {}", six_digits(*value)),
            Value::Each(values) => {
                let values = values.iter().map(|value| six_digits(*value));
                format!("values = [{}]", values.collect::<Vec<_>>().join(", "))
            }
        };
        format!(
            "\n[[expect]]\n{sensor}\nfigure = \"{}\"\n{direct}{point}{value}\ntolerance_rel = \
             {TOLERANCE}\nwhy = \"{}\"\n",
            self.figure, self.why
        )
    }
}

/// A hair before a place on a surface.
fn before(at: Point, normal: Point) -> Point {
    [0, 1, 2].map(|axis| at[axis] + HAIR_M * normal[axis])
}

/// Six significant digits.
fn six_digits(value: f64) -> String {
    let digits: f64 = format!("{value:.5e}").parse().expect("what was just written");
    digits.to_string()
}
