//! The results of one camera, and what its files are called.

use crate::figure::Figure;
use quasilux_scene::{Camera, Scene};
use quasilux_transport::{Estimates, Pixel};
use std::sync::Arc;

/// The picture of one camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraReport {
    /// The camera's name.
    pub name: String,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Paths of each pixel in each replicate.
    pub samples: u64,
    /// The pixels, row by row from the top left corner.
    pub pixels: Arc<[Pixel]>,
    /// Mean luminance of the picture in cd/m2.
    pub mean_cd_m2: Figure,
    /// Largest luminance of a pixel in cd/m2; higher than the true one by the pixel's noise.
    pub maximum_cd_m2: Option<f64>,
    /// The part of that mean, in cd/m2 at most, that no sample met, with a confidence of 95 %;
    /// infinite where nothing is known, `None` of plain paths.
    pub mean_unseen_cd_m2: Option<f64>,
    /// The part of that mean in cd/m2 that photons brought, on discs of `disc_radius_m`: it is
    /// known as a mean over them.
    pub mean_merged_cd_m2: f64,
    /// `None` where no photons count.
    pub disc_radius_m: Option<f64>,
    /// Half-width of the interval of a pixel in cd/m2, mean over all that have one.
    pub mean_half_width_cd_m2: Option<f64>,
    /// [`quasilux_transport::CameraEstimates::relative_half_width`].
    pub relative_half_width: Option<f64>,
    /// What was wanted of it; `None` where a number of paths was.
    pub rel_tol: Option<f64>,
    /// Whether the picture is what was wanted.
    pub is_done: bool,
}

/// Names of a camera's files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CameraFiles {
    /// Luminances and colours as numbers.
    pub exr: String,
    /// What it looks like.
    pub png: String,
    /// Luminances in false colours.
    pub false_colour_png: String,
}

impl CameraReport {
    pub(crate) fn new(scene: &Scene, estimates: &Estimates, index: usize) -> Self {
        let camera = &scene.cameras[index];
        let found = &estimates.cameras[index];
        let is_whole = found.pixels.len() == camera.pixels();
        assert!(is_whole || found.samples == 0, "a picture of another camera");
        let luminances = found.pixels.iter().map(|pixel| f64::from(pixel.luminance_cd_m2));
        let half_widths = || found.pixels.iter().filter_map(|pixel| pixel.half_width_cd_m2);
        let known = half_widths().count();
        let sum: f64 = half_widths().map(f64::from).sum();
        Self {
            name: camera.name.clone(),
            resolution: camera.resolution,
            samples: found.samples,
            pixels: Arc::clone(&found.pixels),
            mean_cd_m2: match found.samples {
                0 => Figure::default(),
                _ => estimates.picture_mean(index).into(),
            },
            mean_unseen_cd_m2: found.unseen_mean_cd_m2,
            mean_merged_cd_m2: found.merged_mean_cd_m2,
            disc_radius_m: found.disc_radius_m,
            maximum_cd_m2: luminances.reduce(f64::max).filter(|x| x.is_finite()),
            mean_half_width_cd_m2: (known > 0)
                .then(|| sum / known as f64)
                .filter(|x| x.is_finite()),
            relative_half_width: found.relative_half_width(),
            rel_tol: found.rel_tol,
            is_done: found.is_done,
        }
    }

    /// Names of its files; `None` where there is no picture.
    #[must_use]
    pub fn files(&self) -> Option<CameraFiles> {
        (!self.pixels.is_empty()).then(|| CameraFiles {
            exr: format!("{}.exr", self.name),
            png: format!("{}.png", self.name),
            false_colour_png: format!("{}{}.png", self.name, Camera::FALSE_COLOUR_ENDING),
        })
    }
}
