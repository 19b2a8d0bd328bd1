//! The false-colour picture of a camera: each pixel in the colour of its luminance, and a legend in
//! cd/m2.

use super::canvas::Canvas;
use super::frame;
use super::layout::Layout;
use super::luminance_scale::LuminanceScale;
use crate::number::{brief, figure_text};
use crate::{CameraReport, Report};

/// Small pictures are enlarged by a whole number, as long as they stay within this many pixels.
const LONG_PX: usize = 1000;

/// The luminances of a camera as a PNG file. Pixels of small pictures are drawn as squares.
#[must_use]
pub fn camera_false_colour_png(camera: &CameraReport, report: &Report) -> Vec<u8> {
    let scale = LuminanceScale::of(&camera.pixels);
    let [width, height] = camera.resolution.map(|n| n as usize);
    let zoom = (LONG_PX / width.max(height)).max(1);
    let layout = Layout::without_axes([zoom * width, zoom * height], &summary(camera));
    let mut canvas = Canvas::new(layout.size[0], layout.size[1]);
    frame::draw_title(&mut canvas, &layout, &camera.name);
    let [left, top] = layout.plot_corner;
    for (i, pixel) in camera.pixels.iter().enumerate() {
        let corner = [left + zoom * (i % width), top + zoom * (i / width)];
        canvas.fill(corner, [zoom; 2], scale.colour(f64::from(pixel.luminance_cd_m2)));
    }
    frame::draw_legend(&mut canvas, &layout, &scale.legend());
    frame::draw_footer(&mut canvas, &layout, report, camera.samples..=camera.samples);
    canvas.to_png()
}

/// The figures under the title, each as one piece of text.
fn summary(camera: &CameraReport) -> Vec<String> {
    let mut pieces = vec![format!("mean {} cd/m²", figure_text(camera.mean_cd_m2).joined())];
    if let Some(maximum) = camera.maximum_cd_m2 {
        pieces.push(format!("maximum {} cd/m²", brief(maximum, 4)));
    }
    if let Some(half_width) = camera.mean_half_width_cd_m2 {
        pieces.push(format!("one pixel ± {} cd/m² on average", brief(half_width, 2)));
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::picture;
    use crate::picture::colour_map;

    fn decoded(png: &[u8]) -> ([usize; 2], Vec<u8>) {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("a frame");
        ([info.width as usize, info.height as usize], pixels)
    }

    /// Dark on the left, bright on the right, the top row brighter.
    #[test]
    fn pixels_are_where_they_belong() {
        let report = picture([30, 20], |x, y| if y == 0 { 200.0 } else { 1.0 + f64::from(x) });
        let camera = &report.cameras[0];
        let (size, pixels) = decoded(&camera_false_colour_png(camera, &report));
        let layout = Layout::without_axes([990, 660], &summary(camera));
        assert_eq!(size, layout.size);
        let at = |x: usize, y: usize| {
            let [left, top] = layout.plot_corner;
            let index = 3 * ((top + y) * size[0] + left + x);
            [pixels[index], pixels[index + 1], pixels[index + 2]]
        };
        let scale = LuminanceScale::of(&camera.pixels);
        assert_eq!([at(0, 0), at(989, 32)], [colour_map::colour(1.0); 2]);
        assert_eq!([at(0, 33), at(32, 659)], [scale.colour(1.0); 2]);
        assert_eq!(at(989, 33), scale.colour(30.0));
    }

    #[test]
    fn odd_pictures_do_not_break() {
        for resolution in [[1, 1], [1, 700], [1500, 1], [3, 2]] {
            for luminance in [0.0, 1e-9, 3.0, 1e9] {
                let report = picture(resolution, |_, _| luminance);
                let (size, _) = decoded(&camera_false_colour_png(&report.cameras[0], &report));
                assert!(size[0] >= 500 && size[1] > 100, "{size:?}");
            }
        }
    }
}
