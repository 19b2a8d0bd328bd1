//! Points for rtrace, views for rpict.

use super::words::{list, number};
use super::{Exported, Scene};
use crate::{Camera, Quantity, Sensor, SensorShape};
use std::fmt::Write;

/// Writes a file for each sensor and each camera.
pub(super) fn write(scene: &Scene, exported: &mut Exported) {
    for sensor in &scene.sensors {
        exported.add(&format!("{}.pts", sensor.name), points(sensor));
        if let SensorShape::Grid(grid) = &sensor.shape
            && grid.quantity == Quantity::Mean
        {
            exported.note(format!("sensor \"{}\": means of cells are at centres", sensor.name));
        }
    }
    for camera in &scene.cameras {
        exported.add(&format!("{}.vf", camera.name), view(camera));
    }
}

/// Position and normal, a line a point.
fn points(sensor: &Sensor) -> String {
    let mut text = String::new();
    for number in 0..sensor.len() {
        let point = sensor.point(number);
        let (position, normal) = (point.position.to_array(), point.normal.to_array());
        writeln!(text, "{} {}", list(&position), list(&normal)).expect("strings grow");
    }
    text
}

/// A perspective view.
fn view(camera: &Camera) -> String {
    let position = list(&camera.position.to_array());
    let forward = list(&(camera.target - camera.position).normalize().to_array());
    let up = list(&camera.up.to_array());
    let [width, height] = camera.resolution.map(f64::from);
    let half = libm::tan(0.5 * camera.vertical_fov_rad);
    let across = 2.0 * libm::atan(half * width / height).to_degrees();
    let along = camera.vertical_fov_rad.to_degrees();
    format!(
        "rvu -vtv -vp {position} -vd {forward} -vu {up} -vh {} -vv {} -vo 0 -va 0 -vs 0 -vl 0\n",
        number(across),
        number(along)
    )
}
