//! Grids with a number of points that is probably not meant.

use crate::finding::{Check, Findings};
use crate::names;
use crate::survey::Survey;
use glam::DVec3;
use quasilux_scene::{Scene, SensorShape};

/// A hall of a hectare has as many at EN 12464-1's spacing only hundreds of times over.
const MANY: usize = 100_000;

/// What looks down lies below a ceiling, a table or a soffit, no further away than this, in m.
const UNDER_M: f64 = 0.3;
/// Grids on a ceiling are looked at from so far below it, in m.
const ON_CEILING_M: f64 = 1e-3;
/// The cosine of normals that point straight down, as far as one can see.
const DOWN: f64 = 0.99;

pub(crate) fn check(scene: &Scene, findings: &mut Findings<'_>) {
    for (number, sensor) in scene.sensors.iter().enumerate() {
        let SensorShape::Grid(grid) = &sensor.shape else { continue };
        let [columns, rows] = grid.counts;
        let [u, v] = [grid.u, grid.v].map(|edge| names::length(edge.length()));
        let size = format!("grid \"{}\" of {u} by {v}", sensor.name);
        let place = findings.places.sensors[number];
        let middle = grid.origin + 0.5 * (grid.u + grid.v);
        if grid.cells() > MANY {
            let message = format!("the {size} has {columns} x {rows} = {} points", grid.cells());
            let cure = "widen its spacing, or give its edges in m";
            findings.add(Check::GridSize, place, message, cure).at(middle);
        } else if grid.cells() == 1 {
            let message = format!("the {size} has a single point");
            let cure = "set a spacing below its edges, or kind = \"points\"";
            findings.add(Check::GridSize, place, message, cure).at(middle);
        }
    }
}

/// Tells horizontal grids that look down in the middle of a room: the normal of a grid without one
/// is that of u and v.
pub(crate) fn check_normals(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    for (number, sensor) in survey.probe.scene.sensors.iter().enumerate() {
        let SensorShape::Grid(grid) = &sensor.shape else { continue };
        let middle = grid.origin + 0.5 * (grid.u + grid.v);
        let from = middle - DVec3::Z * ON_CEILING_M;
        let above = survey.probe.first(from, DVec3::Z).map(|above| above.distance_m);
        // A single cell is no workplane.
        if grid.cells() == 1
            || grid.normal.z > -DOWN
            || above.is_some_and(|above_m| above_m <= UNDER_M)
        {
            continue;
        }
        let message = format!(
            "the grid \"{}\" looks down, though nothing is close above it: it measures the light \
             from below",
            sensor.name
        );
        let cure = "set normal = [0, 0, 1], or swap u and v";
        let place = findings.places.sensors[number];
        findings.add(Check::GridLooksDown, place, message, cure).at(middle);
    }
}
