//! The mirror octant of Voloboy, Dmitriev and Kopylov (2003), table 3, as a case in `validation/`:
//! an eighth of a diffuse sphere in flat facets, between three mirrors, with the source as it is
//! reconstructed from the paper's values.

use crate::generated::{self, File};
use std::fmt::Write;
use std::path::Path;
use xtask::workspace::Failure;

type Point = [f64; 3];

/// Facets along an edge; they are 1e-4 of the radius away from the sphere.
const FACETS: usize = 32;
const INTENSITY_CD: f64 = 83.331125;
const REFLECTANCE: f64 = 0.5;
/// The source stands at this in x, y and z.
const SOURCE_M: f64 = 0.2107928;
/// Sensors stand just within the facets.
const SENSOR_RADIUS_M: f64 = 0.999;
/// Directions of the sensors from the middle: the paper's place first.
const DIRECTIONS: [Point; 3] = [[1.0, 1.0, 1.0], [3.0, 2.0, 1.0], [1.0, 5.0, 4.0]];

/// Name below `validation/` and content of each generated file.
fn files() -> [File; 3] {
    [
        ("scenes/octant.obj".to_owned(), geometry()),
        ("scenes/octant.toml".to_owned(), project()),
        ("cases/octant.toml".to_owned(), case()),
    ]
}

/// Writes the generated files.
pub(crate) fn write(root: &Path) -> Result<(), Failure> {
    generated::write(&root.join("validation"), &files())
}

/// A triangle's grid drawn onto the sphere, and three fans to its middle.
fn geometry() -> String {
    let mut text = "# Written by `cargo xtask octant`; metres\no octant\nv 0 0 0\n".to_owned();
    let grid = || (0..=FACETS).flat_map(|i| (0..=FACETS - i).map(move |j| [i, j]));
    for [i, j] in grid() {
        let [x, y, z] = unit([i, j, FACETS - i - j].map(|k| k as f64));
        writeln!(text, "v {x} {y} {z}").expect("strings grow");
    }
    let number = |[i, j]: [usize; 2]| 2 + i * (2 * FACETS + 3 - i) / 2 + j;
    let mut faces = |material: &str, corners: Vec<[usize; 3]>| {
        writeln!(text, "usemtl {material}").expect("strings grow");
        for [a, b, c] in corners {
            writeln!(text, "f {a} {b} {c}").expect("strings grow");
        }
    };
    let cells = || (0..FACETS).flat_map(|i| (0..FACETS - i).map(move |j| [i, j]));
    let upright = cells().map(|[i, j]| [[i, j], [i, j + 1], [i + 1, j]].map(number));
    let turned = cells()
        .filter(|[i, j]| i + j + 1 < FACETS)
        .map(|[i, j]| [[i + 1, j], [i, j + 1], [i + 1, j + 1]].map(number));
    faces("sphere", upright.chain(turned).collect());
    let edges: [fn(usize) -> [usize; 2]; 3] = [|k| [0, k], |k| [k, 0], |k| [k, FACETS - k]];
    for edge in edges {
        let fan = (0..FACETS).map(|k| [1, number(edge(k)), number(edge(k + 1))]);
        faces("mirror", fan.collect());
    }
    text
}

fn project() -> String {
    let sensors = DIRECTIONS.map(|direction| unit(direction).map(|x| x * SENSOR_RADIUS_M));
    let normals = DIRECTIONS.map(|direction| unit(direction).map(|x| -x));
    let list = |points: [Point; 3]| points.map(|point| format!("    {point:?},\n")).concat();
    format!(
        "# An eighth of a diffuse sphere between three mirrors.\n# Written by `cargo xtask \
         octant`.\n\n\
         [scene]\ngeometry = [\"octant.obj\"]\n\n[materials.sphere]\nreflectance = \
         {REFLECTANCE}\n\n\
         [materials.mirror]\nkind = \"mirror\"\nreflectance = 1.0\n\n[[lights]]\nkind = \
         \"point\"\n\
         position = {:?}\nintensity_cd = {INTENSITY_CD}\n\n[[sensors]]\nname = \"sphere\"\nkind = \
         \"points\"\n\
         points = [\n{}]\nnormals = [\n{}]\n\n[simulation]\nrel_tol = 0.001\n",
        [SOURCE_M; 3],
        list(sensors),
        list(normals),
    )
}

fn case() -> String {
    let mut text = "# Written by `cargo xtask octant`.\nname = \"mirror octant\"\n\
        source = \"Voloboy, Dmitriev, Kopylov (2003), table 3; closed form: eight images, and 8 I \
        a / (1 - a) indirect\"\n\
        project = \"../scenes/octant.toml\"\n\
        estimators = [\"path\", \"bidirectional\"]\n\
        rel_tol = { bidirectional = 0.01 }\n"
        .to_owned();
    for (point, direction) in DIRECTIONS.into_iter().enumerate() {
        let at = unit(direction).map(|x| x * SENSOR_RADIUS_M);
        let direct_lx = images_lx(at, unit(direction).map(|x| -x));
        let indirect_lx = 8.0 * INTENSITY_CD * REFLECTANCE / (1.0 - REFLECTANCE);
        write!(
            text,
            "\n[[expect]]\nsensor = \"sphere\"\nfigure = \"illuminance_lx\"\npoint = \
             {point}\nvalue = {:.3}\n\
             tolerance_rel = 0.003\nwhy = \"light of eight images + 8 I a / (1 - a)\"\n",
            direct_lx + indirect_lx
        )
        .expect("strings grow");
    }
    text
}

/// What the source and its seven images in the mirrors give, by the inverse square law.
fn images_lx(at: Point, n: Point) -> f64 {
    let image = |number: usize| {
        let sign = |axis: usize| if number >> axis & 1 == 1 { -SOURCE_M } else { SOURCE_M };
        let toward = [0, 1, 2].map(|axis| sign(axis) - at[axis]);
        let squared = dot(toward, toward);
        INTENSITY_CD * dot(n, toward).max(0.0) / (squared * libm::sqrt(squared))
    };
    (0..8).map(image).sum()
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn unit(a: Point) -> Point {
    let length = libm::sqrt(dot(a, a));
    a.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use xtask::workspace::root as workspace_root;

    #[test]
    fn the_committed_files_are_what_the_generator_writes() {
        let folder = workspace_root().join("validation");
        generated::assert_committed(&folder, &files(), "octant");
    }

    /// The paper's 1353.247 lx, of which 666.649 lx are indirect, on the sphere itself.
    #[test]
    fn the_source_gives_the_values_of_the_paper() {
        let direct_lx = images_lx(unit([1.0; 3]), unit([-1.0; 3]));
        assert!((direct_lx - (1353.247 - 666.649)).abs() < 1e-3, "{direct_lx}");
        assert!((8.0 * INTENSITY_CD - 666.649).abs() < 1e-9);
    }
}
