//! Several pictures of one view side by side, under one exposure, so that they can be compared.

use super::image::Image;
use super::tone_map::Operator;
use crate::drawing::{Drawing, Frame};
use crate::style::{Anchor, INK, TextStyle};
use crate::text::fitted;

/// Font size of a label.
const LABEL_SIZE_PX: f64 = 15.5;
/// Room above each picture for its label, and between pictures and around them.
const LABEL_PX: usize = 26;
const GAP_PX: usize = 8;

/// One image of a series.
#[derive(Clone, Copy, Debug)]
pub struct LabelledImage<'a> {
    /// What stands above it.
    pub label: &'a str,
    /// The image.
    pub image: Image<'a>,
}

/// Draws images of one resolution in a row, each below its label. All have the exposure
/// that [`tone_mapped_png`](super::tone_mapped_png) gives an image with the luminances `exposure`;
/// brighter pixels are white.
#[must_use]
pub fn series(
    [width, height]: [u32; 2],
    pictures: &[LabelledImage<'_>],
    exposure: &[f32],
) -> Drawing {
    let operator = Operator::from_luminances(exposure);
    let [width, height] = [width, height].map(|n| n as usize);
    let size = [GAP_PX + pictures.len() * (width + GAP_PX), height + LABEL_PX + GAP_PX];
    let labels: Vec<&str> = pictures.iter().map(|picture| picture.label).collect();
    let mut drawing = Drawing::new(&labels.join(", "), size.map(|n| n as f64));
    let style = TextStyle::new(LABEL_SIZE_PX, INK, Anchor::Start);
    for (number, picture) in pictures.iter().enumerate() {
        let left = (GAP_PX + number * (width + GAP_PX)) as f64;
        let label = fitted(picture.label, LABEL_SIZE_PX, width as f64);
        drawing.text([left, LABEL_PX as f64 - 7.5], style, &label);
        let frame = Frame {
            corner_px: [left, LABEL_PX as f64],
            size_px: [width, height].map(|n| n as f64),
        };
        drawing.cells(frame, width, operator.all_shown(&picture.image));
    }
    drawing
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same luminance has the same colour in each picture, and more light is lighter.
    #[test]
    fn pictures_share_one_exposure() {
        let (dark, light) = ([1.0, 0.0], [1.0, 9.0]);
        let [dark_rgb, light_rgb] = [dark, light].map(|luminances| luminances.map(|l| [l; 3]));
        let picture = |label, rgb, luminance| LabelledImage {
            label,
            image: Image { resolution: [2, 1], rgb, luminance },
        };
        let pictures = [picture("dark", &dark_rgb, &dark), picture("light", &light_rgb, &light)];
        let png = series([2, 1], &pictures, &light).to_png(1.0);
        let mut reader = png::Decoder::new(std::io::Cursor::new(&png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("a frame");
        let size = [info.width as usize, info.height as usize];
        assert_eq!(size, [GAP_PX + 2 * (2 + GAP_PX), 1 + LABEL_PX + GAP_PX]);
        let at = |x: usize| pixels[3 * (LABEL_PX * size[0] + x)];
        let second = GAP_PX + 2 + GAP_PX;
        assert_eq!(at(GAP_PX), at(second));
        assert_eq!([at(GAP_PX + 1), at(second + 1)], [0, 255]);
        assert!((1..255).contains(&at(GAP_PX)));
    }

    #[test]
    fn no_pictures_and_no_light_do_not_break() {
        assert!(!series([3, 2], &[], &[]).to_png(1.0).is_empty());
        let image = Image { resolution: [3, 2], rgb: &[[0.0; 3]; 6], luminance: &[0.0; 6] };
        let picture = LabelledImage { label: "a label that does not fit", image };
        assert!(!series([3, 2], &[picture], image.luminance).to_png(1.0).is_empty());
    }
}
