//! `[[sensors]]`: grids and single points.

use super::document::{Section, Value};
use super::grid::{cells_along, en12464_cell_m};
use super::keys::{DIRECTION, Key, POSITION, optional, required};
use super::names::Names;
use crate::{Grid, LoadError, Quantity, Sensor, SensorPoint, SensorShape};
use glam::DVec3;
use quasilux_text::Position;

const NAME: Key =
    required("name", "text", "Also the name of its result files; no other sensor or camera has it");
const KIND: Key = required("kind", "`\"grid\"` or `\"points\"`", "Which of the two it is");
pub(super) const GRID_KEYS: [Key; 11] = [
    NAME,
    KIND,
    required("origin", POSITION, "A corner of the rectangle"),
    required("u", POSITION, "The edge from `origin` along which points are counted first"),
    required("v", POSITION, "The other edge from `origin`, square to `u`"),
    optional(
        "spacing",
        "m, above 0",
        "from `counts` or `rule`",
        "Longest edge of a cell; one of `spacing`, `counts` and `rule`",
    ),
    optional(
        "counts",
        "`[nu, nv]`, at least 1 each",
        "from `spacing` or `rule`",
        "Cells along `u` and `v`; all grids of a project have at most 1e7",
    ),
    optional(
        "rule",
        "`\"en12464\"`",
        "from `spacing` or `counts`",
        "Cells no larger than EN 12464-1 allows for this rectangle",
    ),
    optional(
        "normal",
        DIRECTION,
        "`u` x `v`",
        "The side from which light counts, as the cosine to it; not in the plane of the grid",
    ),
    optional(
        "quantity",
        "`\"centre\"` or `\"mean\"`",
        "`\"centre\"`",
        "The illuminance at the centre of each cell, or the mean over it",
    ),
    optional(
        "target_lx",
        "lx, above 0",
        "none",
        "The illuminance that is wanted: pictures show its line",
    ),
];
pub(super) const POINTS_KEYS: [Key; 5] = [
    NAME,
    KIND,
    required("points", "`[[x, y, z], ...]` in m", "Where the points are"),
    required(
        "normals",
        "directions `[[x, y, z], ...]`",
        "One for each point: the side from which light counts",
    ),
    optional(
        "areas",
        "numbers above 0",
        "all alike",
        "One for each point: the area that it stands for, in any unit; shares of the area over a \
         year (sDA, ASE) count points by it",
    ),
];

/// Most cells that all grids of a project may have together.
const MAX_CELLS: f64 = 1e7;

/// One sensor, and where its parts are.
#[derive(Clone, Debug)]
pub(crate) struct SensorEntry {
    pub(crate) place: Position,
    /// The place of each point of a `points` sensor; empty for a grid.
    pub(crate) point_places: Vec<Position>,
    /// The area that each point of a `points` sensor stands for; empty where all are alike.
    pub(crate) areas: Vec<f64>,
    pub(crate) sensor: Sensor,
}

pub(super) fn read(root: &Section<'_>, names: &mut Names) -> Result<Vec<SensorEntry>, LoadError> {
    let mut entries: Vec<SensorEntry> = Vec::new();
    let mut cells = 0.0;
    for section in root.tables("sensors")? {
        let kind = section.require("kind", "\"grid\" or \"points\"")?;
        let kind = kind.name(&["grid", "points"], &["cylindrical", "mesh", "surface"])?;
        section.only(if kind == "grid" { &GRID_KEYS } else { &POINTS_KEYS }, &[])?;
        let name = names.of_sensor(&section)?;
        let place = section.place();
        entries.push(if kind == "grid" {
            let shape = SensorShape::Grid(grid(&section, &mut cells)?);
            let sensor = Sensor { name, shape };
            SensorEntry { place, point_places: Vec::new(), areas: Vec::new(), sensor }
        } else {
            let PlacedPoints { points, places: point_places } = points(&section)?;
            let areas = areas(&section, points.len())?;
            let shape = SensorShape::Points(points);
            SensorEntry { place, point_places, areas, sensor: Sensor { name, shape } }
        });
    }
    Ok(entries)
}

fn grid(section: &Section<'_>, cells: &mut f64) -> Result<Grid, LoadError> {
    let vector = |key, expected: &str| section.require(key, expected)?.position_m(expected);
    let origin = vector("origin", "a position [x, y, z] in m")?;
    let u = vector("u", "an edge [x, y, z] in m")?;
    let v = vector("v", "an edge [x, y, z] in m")?;
    let across = u.cross(v);
    if across.length() <= 1e-12 * u.length() * v.length() {
        let message = "the sensor has no area; expected edges u and v that span a rectangle";
        return Err(section.require("v", "an edge")?.error(message));
    }
    if u.dot(v).abs() > 0.01 * u.length() * v.length() {
        let message = "\"v\" is not square to \"u\"; expected the edges of a rectangle";
        return Err(section.require("v", "an edge")?.error(message));
    }
    let plane_normal = across.normalize();
    let quantity = match section.get("quantity") {
        Some(quantity) if quantity.name(&["centre", "center", "mean"], &[])? == "mean" => {
            Quantity::Mean
        }
        _ => Quantity::Centre,
    };
    let target_lx = section.get("target_lx");
    let target_lx = target_lx.map(|lx| lx.number("an illuminance in lx above 0", |lx| lx > 0.0));
    Ok(Grid {
        origin,
        u,
        v,
        counts: counts(section, [u.length(), v.length()], cells)?,
        normal: section.get("normal").map_or(Ok(plane_normal), |n| normal(n, plane_normal))?,
        quantity,
        target_lx: target_lx.transpose()?,
    })
}

fn counts(
    section: &Section<'_>,
    edges_m: [f64; 2],
    cells: &mut f64,
) -> Result<[u32; 2], LoadError> {
    let value = section.exactly_one(&["spacing", "counts", "rule"])?;
    let counts: [f64; 2] = match value.key {
        "spacing" => {
            let spacing_m = value.length_m("a length in m above 0")?;
            edges_m.map(|edge_m| cells_along(edge_m, spacing_m))
        }
        "counts" => {
            let expected = "[nu, nv]: numbers of cells, at least 1 each";
            let numbers = value.array(expected)?;
            let [nu, nv] = numbers.as_slice() else {
                return Err(value.unexpected(expected));
            };
            let count = |n: &Value<'_>| n.integer(expected, 1..=u64::from(u32::MAX));
            [count(nu)? as f64, count(nv)? as f64]
        }
        _ => {
            value.name(&["en12464"], &[])?;
            let cell_m = en12464_cell_m(edges_m);
            edges_m.map(|edge_m| cells_along(edge_m, cell_m))
        }
    };
    *cells += counts[0] * counts[1];
    if *cells > MAX_CELLS {
        return Err(value.error(format!(
            "the grids have {:.3e} cells so far; expected at most {MAX_CELLS:e} in all",
            *cells
        )));
    }
    Ok(counts.map(|n| n as u32))
}

fn normal(value: Value<'_>, plane_normal: DVec3) -> Result<DVec3, LoadError> {
    let normal = direction(value)?;
    if normal.dot(plane_normal).abs() < 1e-6 {
        let message = "\"normal\" lies in the plane of u and v; expected a direction out of it";
        return Err(value.error(message));
    }
    Ok(normal)
}

fn direction(value: Value<'_>) -> Result<DVec3, LoadError> {
    let expected = "a direction [x, y, z] with a length";
    value.vector(expected)?.try_normalize().ok_or_else(|| value.unexpected(expected))
}

/// The areas of so many points, if they are given.
fn areas(section: &Section<'_>, points: usize) -> Result<Vec<f64>, LoadError> {
    let Some(list) = section.get("areas") else { return Ok(Vec::new()) };
    let expected = "areas above 0, at most 1e12, one for each point";
    let areas = list.array(expected)?;
    if areas.len() != points {
        let given = areas.len();
        return Err(list.error(format!("{points} points but {given} areas; expected {expected}")));
    }
    let area = |value: &Value<'_>| value.number(expected, |area| area > 0.0 && area <= 1e12);
    areas.iter().map(area).collect()
}

/// Sensor points, and where the file has them.
struct PlacedPoints {
    points: Vec<SensorPoint>,
    places: Vec<Position>,
}

fn points(section: &Section<'_>) -> Result<PlacedPoints, LoadError> {
    let expected = "positions [[x, y, z], ...] in m";
    let list = section.require("points", expected)?;
    let positions = list.array(expected)?;
    if positions.is_empty() {
        return Err(list.unexpected("at least one position [x, y, z] in m"));
    }
    let expected = "directions [[x, y, z], ...], one for each point";
    let list = section.require("normals", expected)?;
    let normals = list.array(expected)?;
    if normals.len() != positions.len() {
        let (points, given) = (positions.len(), normals.len());
        return Err(list.error(format!("{points} points but {given} normals; expected {expected}")));
    }
    let place = |value: &Value<'_>| value.place();
    let places = positions.iter().map(place).collect();
    let points = positions.into_iter().zip(normals).map(|(position, normal)| {
        let position = position.position_m("a position [x, y, z] in m")?;
        Ok(SensorPoint { position, normal: direction(normal)? })
    });
    Ok(PlacedPoints { points: points.collect::<Result<_, LoadError>>()?, places })
}
