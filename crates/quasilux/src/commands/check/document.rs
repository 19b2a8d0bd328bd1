//! The findings as a document for programs, format "quasilux-check/1".

use crate::project::Project;
use quasilux_inspection::Finding;
use quasilux_report::json::{self, FindingEntry};
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    format: &'static str,
    project: &'a str,
    triangles: usize,
    /// Lowest and highest coordinates in m; `null` where there is no geometry.
    bounds_m: Option<[[f64; 3]; 2]>,
    lights: usize,
    flux_lm: f64,
    sensor_points: usize,
    cameras: usize,
    findings: Vec<FindingEntry<'a>>,
    warnings: Vec<String>,
}

pub(super) fn document(project: &Project, findings: &[Finding]) -> String {
    let scene = &project.loaded.scene;
    let bounds = scene.mesh.bounds();
    json::text(&Document {
        format: "quasilux-check/1",
        project: &project.name,
        triangles: scene.mesh.triangles.len(),
        bounds_m: bounds.map(|bounds| bounds.map(|corner| corner.to_array())),
        lights: scene.lights.len(),
        flux_lm: scene.flux_lm(),
        sensor_points: scene.sensors.iter().map(quasilux_scene::Sensor::len).sum(),
        cameras: scene.cameras.len(),
        findings: findings.iter().map(FindingEntry::new).collect(),
        warnings: project.loaded.warnings.iter().map(ToString::to_string).collect(),
    })
}
