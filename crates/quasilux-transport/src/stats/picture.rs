//! What cameras see: luminances of pixels, and how well a picture is known.

use std::sync::Arc;

/// The picture of one camera.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraEstimates {
    /// The pixels, row by row from the top left corner; none where the run was stopped before the
    /// first pass over the picture was complete.
    pub pixels: Arc<[Pixel]>,
    /// Mean luminance of the picture in cd/m^2, one value a replicate.
    pub replicate_mean_cd_m2: Vec<f64>,
    /// The part of the mean luminance, in cd/m^2 at most, that may come by ways on which no sample
    /// lay, with [`UNSEEN_CONFIDENCE`](crate::unseen::UNSEEN_CONFIDENCE); `None` of plain paths.
    pub unseen_mean_cd_m2: Option<f64>,
    /// The part of the mean luminance, in cd/m^2, that photons brought: what lies within the radius
    /// of a disc around the places that pixels show has the mean over that disc.
    pub merged_mean_cd_m2: f64,
    /// The radius of these discs in m, less beside walls; `None` where no photons count.
    pub disc_radius_m: Option<f64>,
    /// Paths of each pixel in each replicate; 0 where there are no pixels.
    pub samples: u64,
    /// The half-width that was wanted, as [`Self::relative_half_width`] tells it; `None` where a
    /// number of paths was.
    pub rel_tol: Option<f64>,
    /// Whether it got what was wanted.
    pub is_done: bool,
}

/// The mean over a pixel, which is a square of the picture plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pixel {
    /// Linear RGB in cd/m^2, mean over the replicates.
    pub rgb_cd_m2: [f32; 3],
    /// Luminance in cd/m^2, mean over the replicates.
    pub luminance_cd_m2: f32,
    /// Half the width of the luminance's interval, at the nominal confidence; `None` where there
    /// are fewer than two replicates, or where light was looked for and none found.
    pub half_width_cd_m2: Option<f32>,
    /// Luminance at most that may come by ways on which no sample lay, with
    /// [`UNSEEN_CONFIDENCE`](crate::unseen::UNSEEN_CONFIDENCE), infinite where nothing is known;
    /// `None` of plain paths.
    pub unseen_cd_m2: Option<f32>,
}

impl CameraEstimates {
    /// Half the width of the interval of a pixel, mean over all pixels that have one, over the mean
    /// luminance of the picture; `None` where most pixels have none, or nothing is known.
    #[must_use]
    pub fn relative_half_width(&self) -> Option<f64> {
        let half_widths = || self.pixels.iter().filter_map(|pixel| pixel.half_width_cd_m2);
        let known = half_widths().count();
        if known == 0 || 2 * known < self.pixels.len() {
            return None;
        }
        let mean = half_widths().map(f64::from).sum::<f64>() / known as f64;
        let replicates = self.replicate_mean_cd_m2.len() as f64;
        let luminance_cd_m2 = self.replicate_mean_cd_m2.iter().sum::<f64>() / replicates;
        // Black all over, and known to be so.
        let share = if mean == 0.0 { 0.0 } else { mean / luminance_cd_m2 };
        Some(share).filter(|share| share.is_finite() && *share >= 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(pixels: &[(f32, Option<f32>)]) -> CameraEstimates {
        let pixel = |&(luminance_cd_m2, half_width_cd_m2): &(f32, Option<f32>)| Pixel {
            rgb_cd_m2: [luminance_cd_m2; 3],
            luminance_cd_m2,
            half_width_cd_m2,
            unseen_cd_m2: None,
        };
        CameraEstimates {
            pixels: pixels.iter().map(pixel).collect(),
            replicate_mean_cd_m2: vec![9.0, 11.0],
            unseen_mean_cd_m2: None,
            merged_mean_cd_m2: 0.0,
            disc_radius_m: None,
            samples: 1,
            rel_tol: None,
            is_done: true,
        }
    }

    #[test]
    fn half_widths_are_told_by_the_mean_of_the_picture() {
        let known = picture(&[(10.0, Some(0.25)), (10.0, Some(0.75))]);
        assert_eq!(known.relative_half_width(), Some(0.05));
        let mostly = picture(&[(10.0, Some(0.5)), (0.0, None)]);
        assert_eq!(mostly.relative_half_width(), Some(0.05));
        let hardly = picture(&[(10.0, Some(0.5)), (0.0, None), (0.0, None)]);
        assert_eq!(hardly.relative_half_width(), None);
        assert_eq!(picture(&[]).relative_half_width(), None);
    }
}
