//! Grids with a number of points that is probably not meant.

use crate::finding::{Check, Findings};
use crate::names;
use quasilux_scene::{Scene, SensorShape};

/// A hall of a hectare has as many at EN 12464-1's spacing only hundreds of times over.
const MANY: usize = 100_000;

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
            let cure = "expected a wider spacing, or edges in m";
            findings.add(Check::GridSize, place, message, cure).at(middle);
        } else if grid.cells() == 1 {
            let message = format!("the {size} has a single point");
            let cure = "expected a spacing below its edges, or kind = \"points\"";
            findings.add(Check::GridSize, place, message, cure).at(middle);
        }
    }
}
