//! The false-colour picture of luminances: each pixel in the colour of its luminance, and a legend
//! in cd/m2.

use super::caption::Caption;
use super::frame;
use super::layout::Layout;
use super::luminance_scale::LuminanceScale;
use crate::drawing::Drawing;

/// Small pictures are enlarged by a whole number, as long as they stay within this many pixels.
const LONG_PX: usize = 1000;

/// Luminances to be drawn in false colours.
#[derive(Clone, Copy, Debug)]
pub struct LuminancePicture<'a> {
    /// The words around the picture.
    pub caption: Caption<'a>,
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Luminances in cd/m2, row by row from the top left corner.
    pub luminances_cd_m2: &'a [f32],
}

/// Draws luminances in false colours; pixels of small pictures are squares.
#[must_use]
pub fn luminance(picture: &LuminancePicture<'_>) -> Drawing {
    let scale = LuminanceScale::new(picture.luminances_cd_m2);
    let [width, height] = picture.resolution.map(|n| n as usize);
    let zoom = (LONG_PX / width.max(height)).max(1);
    let layout = Layout::without_axes([zoom * width, zoom * height], &picture.caption);
    let mut drawing = frame::titled(&layout, picture.caption.title);
    let luminances = picture.luminances_cd_m2.iter();
    let colours = luminances.map(|luminance| scale.colour(f64::from(*luminance))).collect();
    drawing.cells(layout.plot(), width, colours);
    frame::draw_legend(&mut drawing, &layout, &scale.legend());
    frame::draw_footer(&mut drawing, &layout);
    drawing
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::colour_map;

    fn decoded(png: &[u8]) -> ([usize; 2], Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("a frame");
        ([info.width as usize, info.height as usize], pixels)
    }

    fn png(resolution: [u32; 2], luminances_cd_m2: &[f32]) -> Vec<u8> {
        let caption = Caption { title: "view", ..Caption::default() };
        luminance(&LuminancePicture { caption, resolution, luminances_cd_m2 }).to_png(1.0)
    }

    /// Dark on the left, bright on the right, the top row brighter.
    #[test]
    fn pixels_are_where_they_belong() {
        let luminance = |i: u16| if i < 30 { 200.0 } else { 1.0 + f32::from(i % 30) };
        let luminances: Vec<f32> = (0..600).map(luminance).collect();
        let (size, pixels) = decoded(&png([30, 20], &luminances));
        let layout = Layout::without_axes([990, 660], &Caption::default());
        assert_eq!(size, layout.size);
        let at = |x: usize, y: usize| {
            let [left, top] = layout.plot_corner;
            let index = 3 * ((top + y) * size[0] + left + x);
            [pixels[index], pixels[index + 1], pixels[index + 2]]
        };
        let scale = LuminanceScale::new(&luminances);
        assert_eq!([at(0, 0), at(989, 32)], [colour_map::colour(1.0); 2]);
        assert_eq!([at(0, 33), at(32, 659)], [scale.colour(1.0); 2]);
        assert_eq!(at(989, 33), scale.colour(30.0));
    }

    #[test]
    fn odd_pictures_do_not_break() {
        for resolution in [[1, 1], [1, 700], [1500, 1], [3, 2]] {
            for luminance in [0.0, 1e-9, 3.0, 1e9] {
                let pixels = (resolution[0] * resolution[1]) as usize;
                let (size, _) = decoded(&png(resolution, &vec![luminance; pixels]));
                assert!(size[0] >= 500 && size[1] > 100, "{size:?}");
            }
        }
    }
}
