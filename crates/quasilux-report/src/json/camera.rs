//! The entry of a camera in the result document.

use super::FigureEntry;
use crate::{CameraFiles, CameraReport};
use serde::Serialize;

#[derive(Serialize)]
pub(super) struct CameraEntry<'a> {
    name: &'a str,
    resolution: [u32; 2],
    samples: u64,
    files: Vec<String>,
    mean_luminance_cd_m2: FigureEntry,
    #[serde(skip_serializing_if = "Option::is_none")]
    mean_unseen_cd_m2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mean_merged_cd_m2: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    disc_radius_m: Option<f64>,
    maximum_luminance_cd_m2: Option<f64>,
    mean_half_width_cd_m2: Option<f64>,
    relative_half_width: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rel_tol: Option<f64>,
    tolerance_reached: bool,
}

impl<'a> CameraEntry<'a> {
    pub(super) fn new(camera: &'a CameraReport) -> Self {
        let names = |files: CameraFiles| vec![files.exr, files.png, files.false_colour_png];
        Self {
            name: &camera.name,
            resolution: camera.resolution,
            samples: camera.samples,
            files: camera.files().map(names).unwrap_or_default(),
            mean_luminance_cd_m2: FigureEntry::new(camera.mean_cd_m2),
            mean_unseen_cd_m2: camera.mean_unseen_cd_m2,
            mean_merged_cd_m2: camera.disc_radius_m.map(|_| camera.mean_merged_cd_m2),
            disc_radius_m: camera.disc_radius_m,
            maximum_luminance_cd_m2: camera.maximum_cd_m2,
            mean_half_width_cd_m2: camera.mean_half_width_cd_m2,
            relative_half_width: camera.relative_half_width,
            rel_tol: camera.rel_tol,
            tolerance_reached: camera.is_done,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::json;
    use crate::example;
    use serde_json::Value;

    #[test]
    fn cameras_have_files_and_figures() {
        let report = example::picture([4, 2], |x, _| if x == 0 { 20.0 } else { 4.0 });
        let document: Value = serde_json::from_str(&json(&report)).expect("valid JSON");
        let camera = serde_json::json!({
            "name": "view",
            "resolution": [4, 2],
            "samples": 16,
            "files": ["view.exr", "view.png", "view-falsecolour.png"],
            "mean_luminance_cd_m2": {"value": 8.0, "half_width": 0.0},
            "mean_unseen_cd_m2": 0.125,
            "mean_merged_cd_m2": 0.5,
            "disc_radius_m": 0.1,
            "maximum_luminance_cd_m2": 20.0,
            "mean_half_width_cd_m2": 0.5,
            "relative_half_width": (0.75 * 0.0625_f64 * 0.0625 + 0.25 * 0.025 * 0.025).sqrt(),
            "tolerance_reached": true,
        });
        assert_eq!(document["cameras"], serde_json::json!([camera]));
    }
}
