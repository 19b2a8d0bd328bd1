//! What cameras see: luminances of pixels.

use std::sync::Arc;

/// The picture of one camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraEstimates {
    /// The pixels, row by row from the top left corner.
    pub pixels: Arc<[Pixel]>,
    /// Mean luminance of the picture in cd/m^2, one value a replicate.
    pub replicate_mean_cd_m2: Vec<f64>,
    /// Paths of each pixel in each replicate.
    pub samples: u64,
}

/// The mean over a pixel, which is a square of the picture plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pixel {
    /// Linear RGB in cd/m^2, mean over the replicates.
    pub rgb_cd_m2: [f32; 3],
    /// Luminance in cd/m^2, mean over the replicates.
    pub luminance_cd_m2: f32,
    /// Half the width of the luminance's interval, at the nominal confidence; `None` where there
    /// are fewer than two replicates, or where light was looked for and none found.
    pub half_width_cd_m2: Option<f32>,
}
