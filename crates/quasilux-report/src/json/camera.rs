//! The entry of a camera in the result document.

use super::FigureEntry;
use crate::CameraReport;
use serde::Serialize;

#[derive(Serialize)]
pub(super) struct CameraEntry<'a> {
    name: &'a str,
    resolution: [u32; 2],
    samples: u64,
    files: [String; 3],
    mean_luminance_cd_m2: FigureEntry,
    maximum_luminance_cd_m2: Option<f64>,
    mean_half_width_cd_m2: Option<f64>,
}

impl<'a> CameraEntry<'a> {
    pub(super) fn new(camera: &'a CameraReport) -> Self {
        let files = camera.files();
        Self {
            name: &camera.name,
            resolution: camera.resolution,
            samples: camera.samples,
            files: [files.exr, files.png, files.false_colour_png],
            mean_luminance_cd_m2: FigureEntry::new(camera.mean_cd_m2),
            maximum_luminance_cd_m2: camera.maximum_cd_m2,
            mean_half_width_cd_m2: camera.mean_half_width_cd_m2,
        }
    }
}
