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
    /// Paths of each pixel in each replicate, on average; 0 where there are no pixels.
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
    /// The mean luminance of the picture in cd/m^2.
    #[must_use]
    pub fn mean_cd_m2(&self) -> f64 {
        let means = &self.replicate_mean_cd_m2;
        means.iter().sum::<f64>() / means.len() as f64
    }

    /// Half the width of the interval of a pixel over its luminance, or over the mean luminance of
    /// the picture where that is more: the root of the mean square over all pixels that have one,
    /// so that a few bright spots of which little is known count. `None` where most pixels have
    /// none, or nothing is known.
    #[must_use]
    pub fn relative_half_width(&self) -> Option<f64> {
        let mean_cd_m2 = self.mean_cd_m2();
        let known = self.pixels.iter().filter_map(|pixel| pixel.relative_half_width(mean_cd_m2));
        let known: Vec<f64> = known.collect();
        if known.is_empty() || 2 * known.len() < self.pixels.len() {
            return None;
        }
        Some(mean_square(known).sqrt()).filter(|share| share.is_finite())
    }
}

impl Pixel {
    /// Half the width of the interval over the luminance, or over the mean luminance of the picture
    /// where that is more; `None` where there is no interval.
    #[must_use]
    pub(crate) fn relative_half_width(&self, mean_cd_m2: f64) -> Option<f64> {
        let half_width = f64::from(self.half_width_cd_m2?);
        let luminance_cd_m2 = mean_cd_m2.max(self.luminance_cd_m2.into());
        // Black all over, and known to be so.
        Some(if half_width == 0.0 { 0.0 } else { half_width / luminance_cd_m2 })
    }
}

/// 0 of none.
pub(crate) fn mean_square(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut squares, mut count) = (0.0, 0_u32);
    for value in values {
        squares += value * value;
        count += 1;
    }
    squares / f64::from(count.max(1))
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

    /// The first of two pixels by the picture's mean of 10 cd/m2, the brighter one by its own.
    #[test]
    fn half_widths_are_told_by_the_brighter_of_pixel_and_picture() {
        let known = picture(&[(5.0, Some(0.3)), (20.0, Some(0.8))]);
        let share = (0.5 * (0.03_f64 * 0.03 + 0.04 * 0.04)).sqrt();
        assert!((known.relative_half_width().unwrap() - share).abs() < 1e-6);
        let mostly = picture(&[(10.0, Some(0.5)), (0.0, None)]);
        assert_eq!(mostly.relative_half_width(), Some(0.05));
        let hardly = picture(&[(10.0, Some(0.5)), (0.0, None), (0.0, None)]);
        assert_eq!(hardly.relative_half_width(), None);
        assert_eq!(picture(&[]).relative_half_width(), None);
        assert_eq!(picture(&[(10.0, Some(f32::NAN))]).relative_half_width(), None);
    }

    /// One pixel in a thousand that a photon or a path made bright keeps a picture from being done.
    #[test]
    fn a_bright_spot_counts() {
        let mut pixels = [(10.0, Some(0.2)); 1000];
        pixels[7] = (400.0, Some(850.0));
        assert!(picture(&pixels).relative_half_width() > Some(0.05));
    }
}
