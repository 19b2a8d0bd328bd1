//! The sensor points of all sensors in one list.

use crate::control::observer::Snapshot;
use crate::stats::estimates::SensorEstimates;
use glam::DVec3;
use quasilux_scene::sensor::Grid;
use quasilux_scene::{Quantity, Scene, Sensor, SensorShape};

/// One value that a sensor asks for.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Target {
    /// The illuminance at a point.
    Point { position: DVec3, normal: DVec3 },
    /// The mean illuminance over a grid's cell.
    Cell { grid: Grid, cell: usize },
}

/// All targets, sensor by sensor.
pub(crate) fn targets(scene: &Scene) -> Vec<Target> {
    let mut targets = Vec::new();
    for sensor in &scene.sensors {
        match &sensor.shape {
            SensorShape::Grid(grid) if grid.quantity == Quantity::Mean => {
                targets.extend((0..grid.cells()).map(|cell| Target::Cell { grid: *grid, cell }));
            }
            SensorShape::Grid(_) | SensorShape::Points(_) => targets.extend(
                sensor
                    .points()
                    .into_iter()
                    .map(|point| Target::Point { position: point.position, normal: point.normal }),
            ),
        }
    }
    targets
}

/// The figures of each sensor, from those of all targets as if of one sensor.
pub(crate) fn by_sensor(scene: &Scene, all: SensorEstimates) -> Vec<SensorEstimates> {
    if scene.sensors.len() == 1 {
        // A copy of many points would take long, and much memory.
        return vec![all];
    }
    let mut first = 0;
    scene
        .sensors
        .iter()
        .map(|sensor| {
            let own = first..first + sensor.len();
            first = own.end;
            all.part(own)
        })
        .collect()
}

/// The snapshot with these values of all targets.
pub(crate) fn snapshot(scene: &Scene, mut all: impl Iterator<Item = Option<f64>>) -> Snapshot {
    let own = |sensor: &Sensor| all.by_ref().take(sensor.len()).collect();
    Snapshot { illuminance_lx: scene.sensors.iter().map(own).collect() }
}
