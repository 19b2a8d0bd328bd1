//! The pictures: what a camera sees of the light of this many bounces.

use super::{Effort, PIXEL_REPLICATES, room};
use quasilux_report::picture::{SeriesPicture, series_png};
use quasilux_transport::{CameraEstimates, Interval, Settings, simulate};

/// One picture.
pub(super) struct Picture {
    /// Bounces after which light is cut.
    pub(super) cut: Option<u32>,
    pub(super) resolution: [u32; 2],
    pub(super) taken: CameraEstimates,
    pub(super) mean_cd_m2: Interval,
}

impl Picture {
    pub(super) fn take(cut: Option<u32>, effort: &Effort) -> Self {
        let settings = Settings {
            max_bounces: cut,
            replicates: PIXEL_REPLICATES,
            max_samples: Some(effort.pixel_paths),
            seed: effort.seed,
            ..Settings::default()
        };
        let mut estimates = simulate(&room::seen(effort.resolution), &settings, &mut ());
        let mean_cd_m2 = estimates.picture_mean(0);
        Self { cut, resolution: effort.resolution, taken: estimates.cameras.remove(0), mean_cd_m2 }
    }

    /// `n = 2`, or that nothing is cut.
    pub(super) fn label(&self) -> String {
        self.cut.map_or("all light".to_owned(), |cut| format!("n = {cut}"))
    }
}

/// All in one PNG file, under the exposure of the last.
pub(super) fn side_by_side(pictures: &[Picture]) -> Vec<u8> {
    let labels: Vec<String> = pictures.iter().map(Picture::label).collect();
    let series = pictures.iter().zip(&labels);
    let series: Vec<SeriesPicture<'_>> = series
        .map(|(picture, label)| SeriesPicture { label, pixels: &picture.taken.pixels })
        .collect();
    let exposure = pictures.last().map_or(&[][..], |picture| &picture.taken.pixels);
    series_png(pictures[0].resolution, &series, exposure)
}
