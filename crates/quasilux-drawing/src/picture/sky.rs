//! The false-colour picture of a sky: the hemisphere above as a disk, with the compass around it.
//!
//! The distance from the middle is proportional to the angle from the zenith. Directions lie as on
//! a map, north up and east to the right; who lies on his back sees east on the left.

use super::caption::Caption;
use super::frame;
use super::layout::{self, Layout};
use super::luminance_scale::LuminanceScale;
use crate::drawing::{Drawing, Frame};
use crate::style::{Anchor, Dash, GREY, INK, Stroke, TextStyle, WHITE};

/// Width and height of the disk with its letters.
const PLOT_PX: usize = 760;
/// From the middle to the horizon.
const RADIUS_PX: f64 = 338.0;
/// From the horizon to the middle of the letters.
const LETTERS_PX: f64 = 21.0;
/// Font sizes of compass letters and of degrees.
const LETTER_PX: f64 = 22.0;
const DEGREES_PX: f64 = 12.6;
/// Altitudes with a ring.
const RINGS_DEG: [f64; 2] = [30.0, 60.0];
/// Azimuths of the labels of rings.
const RING_LABELS_DEG: f64 = 0.0;
/// More than any sky has.
const MAX_CD_M2: f64 = 1e30;
/// Corners of a ring.
const CORNERS: u32 = 240;

/// A sky to be drawn in false colours.
pub struct SkyPicture<'a> {
    /// The words around the picture.
    pub caption: Caption<'a>,
    /// The luminance in cd/m2 by altitude (0 to 90) and azimuth (clockwise from north) in degrees.
    pub luminance_cd_m2: &'a dyn Fn([f64; 2]) -> f64,
    /// Altitude and azimuth of the sun in degrees; not drawn below the horizon.
    pub sun_deg: Option<[f64; 2]>,
    /// Cells along the diameter of the disk: few make a small SVG file.
    pub cells: usize,
}

/// Draws a sky in false colours.
#[must_use]
pub fn sky(picture: &SkyPicture<'_>) -> Drawing {
    let cells = Cells::new(picture);
    let scale = LuminanceScale::new(&cells.inside());
    let layout = Layout::without_axes([PLOT_PX; 2], &picture.caption);
    let mut drawing = frame::titled(&layout, picture.caption.title);
    let corner = layout.plot().corner_px;
    let middle = corner.map(|x| x + 0.5 * PLOT_PX as f64);
    let disk = Frame {
        corner_px: middle.map(|x| x - RADIUS_PX - cells.margin_px()),
        size_px: [2.0 * (RADIUS_PX + cells.margin_px()); 2],
    };
    let colour =
        |cell: &Option<f32>| cell.map_or(WHITE, |luminance| scale.colour(f64::from(luminance)));
    drawing.cells(disk, cells.side + 2, cells.luminances.iter().map(colour).collect());
    draw_rings(&mut drawing, middle);
    draw_compass(&mut drawing, middle);
    if let Some([altitude_deg, azimuth_deg]) = picture.sun_deg.filter(|[up, _]| *up >= 0.0) {
        draw_sun(&mut drawing, place(middle, radius_px(altitude_deg), azimuth_deg));
    }
    frame::draw_legend(&mut drawing, &layout, &scale.legend());
    frame::draw_footer(&mut drawing, &layout);
    drawing
}

/// Luminances of square cells around the disk, row by row, with a margin of one cell.
struct Cells {
    side: usize,
    /// `None` for cells that do not reach the disk.
    luminances: Vec<Option<f32>>,
}

impl Cells {
    fn new(picture: &SkyPicture<'_>) -> Self {
        let side = picture.cells.max(1);
        let step = 2.0 / side as f64;
        let centre = |i: usize| (i as f64 - 0.5) * step - 1.0;
        let luminance = |row: usize, column: usize| {
            let [x, y] = [centre(column), -centre(row)];
            let distance = libm::hypot(x, y);
            // Cells at the edge have the luminance of the horizon; the outline covers their steps.
            (distance < 1.0 + step).then(|| {
                let altitude_deg = 90.0 * (1.0 - distance).max(0.0);
                let azimuth_deg = libm::atan2(x, y).to_degrees().rem_euclid(360.0);
                let luminance = (picture.luminance_cd_m2)([altitude_deg, azimuth_deg]);
                // What is no number is dark.
                if luminance >= 0.0 { luminance.min(MAX_CD_M2) as f32 } else { 0.0 }
            })
        };
        let rows = (0..side + 2).flat_map(|row| (0..side + 2).map(move |column| (row, column)));
        Self { side, luminances: rows.map(|(row, column)| luminance(row, column)).collect() }
    }

    /// How much the cells reach out of the disk.
    fn margin_px(&self) -> f64 {
        2.0 * RADIUS_PX / self.side as f64
    }

    fn inside(&self) -> Vec<f32> {
        self.luminances.iter().flatten().copied().collect()
    }
}

/// The distance from the middle of an altitude.
fn radius_px(altitude_deg: f64) -> f64 {
    RADIUS_PX * (1.0 - altitude_deg / 90.0)
}

/// A place at a distance from the middle, at an azimuth.
fn place([x, y]: [f64; 2], radius_px: f64, azimuth_deg: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(azimuth_deg.to_radians());
    [x + radius_px * sin, y - radius_px * cos]
}

fn circle(middle: [f64; 2], radius_px: f64) -> Vec<[f64; 2]> {
    let corner =
        |i: u32| place(middle, radius_px, 360.0 * f64::from(i % CORNERS) / f64::from(CORNERS));
    (0..=CORNERS).map(corner).collect()
}

/// Hides the steps of the cells at the horizon, and draws it and the rings of equal altitude.
fn draw_rings(drawing: &mut Drawing, middle: [f64; 2]) {
    const HIDING_PX: f64 = 10.0;
    let hidden = circle(middle, RADIUS_PX + 0.5 * HIDING_PX);
    drawing.line(&hidden, Stroke::solid(WHITE, HIDING_PX));
    drawing.line(&circle(middle, RADIUS_PX), Stroke::solid(INK, 1.4));
    for altitude_deg in RINGS_DEG {
        let ring = circle(middle, radius_px(altitude_deg));
        drawing.line(&ring, Stroke::solid(WHITE, 1.6));
        drawing.line(&ring, Stroke { colour: INK, width_px: 0.9, dash: Dash::Dashed });
        let style = TextStyle::new(DEGREES_PX, INK, Anchor::Middle);
        let [x, y] = place(middle, radius_px(altitude_deg), RING_LABELS_DEG);
        let base = y + 0.5 * layout::capital_px(DEGREES_PX);
        let label = format!("{altitude_deg}\u{b0}");
        drawing.text([x, base], TextStyle { halo: Some(WHITE), ..style }, &label);
    }
}

/// Ticks every ten degrees, letters at the four directions and degrees between them.
fn draw_compass(drawing: &mut Drawing, middle: [f64; 2]) {
    for tick in 0..36 {
        let azimuth_deg = 10.0 * f64::from(tick);
        let length_px = if tick % 3 == 0 { 8.0 } else { 4.0 };
        let ends = [RADIUS_PX, RADIUS_PX + length_px];
        let line = ends.map(|radius| place(middle, radius, azimuth_deg));
        drawing.line(&line, Stroke::solid(GREY, 1.0));
        if tick % 3 != 0 {
            continue;
        }
        let letter = ["N", "E", "S", "W"].get(tick as usize / 9).filter(|_| tick % 9 == 0);
        let (text, size_px, colour) = match letter {
            Some(letter) => ((*letter).to_owned(), LETTER_PX, INK),
            None => (format!("{azimuth_deg}\u{b0}"), DEGREES_PX, GREY),
        };
        let [x, y] = place(middle, RADIUS_PX + LETTERS_PX, azimuth_deg);
        let base = y + 0.5 * layout::capital_px(size_px);
        drawing.text([x, base], TextStyle::new(size_px, colour, Anchor::Middle), &text);
    }
}

fn draw_sun(drawing: &mut Drawing, at: [f64; 2]) {
    for (radius_px, colour) in [(10.0, INK), (8.6, WHITE), (5.6, SUN_INK)] {
        drawing.disk(at, radius_px, colour);
    }
    let style = TextStyle { halo: Some(WHITE), ..TextStyle::new(15.5, INK, Anchor::Start) };
    let base = at[1] + 0.5 * layout::capital_px(15.5);
    drawing.text([at[0] + 16.0, base], style, "sun");
}

/// The sun's own colour, which the scale has not.
const SUN_INK: crate::style::Colour = [0xd5, 0x3e, 0x00];

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(luminance_cd_m2: &dyn Fn([f64; 2]) -> f64, sun_deg: Option<[f64; 2]>) -> Drawing {
        let caption = Caption { title: "sky", ..Caption::default() };
        sky(&SkyPicture { caption, luminance_cd_m2, sun_deg, cells: 120 })
    }

    fn decoded(drawing: &Drawing) -> (usize, Vec<u8>) {
        let png = drawing.to_png(1.0);
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        let info = reader.next_frame(&mut pixels).expect("a frame");
        (info.width as usize, pixels)
    }

    /// Each quarter of the sky has a luminance of its own.
    #[test]
    fn directions_lie_as_on_a_map() {
        let quarter = |azimuth: f64| ((azimuth + 45.0) / 90.0).floor() as usize % 4;
        let values = [1000.0, 2000.0, 5000.0, 10_000.0];
        let drawing = drawn(&|[_, azimuth]| values[quarter(azimuth)], None);
        let (width, pixels) = decoded(&drawing);
        let corner = Layout::without_axes([PLOT_PX; 2], &Caption::default()).plot().corner_px;
        let middle = corner.map(|x| x + 0.5 * PLOT_PX as f64);
        let scale = LuminanceScale::new(&values.map(|value| value as f32));
        for azimuth_deg in [20.0, 75.0, 100.0, 170.0, 200.0, 250.0, 290.0, 340.0] {
            let [x, y] = place(middle, radius_px(45.0), azimuth_deg).map(|x| x as usize);
            let found = &pixels[3 * (y * width + x)..][..3];
            assert_eq!(found, scale.colour(values[quarter(azimuth_deg)]), "{azimuth_deg}");
        }
        // Outside of the letters it is white.
        let [x, y] = corner.map(|x| x as usize + 20);
        assert_eq!(pixels[3 * (y * width + x)..][..3], WHITE);
    }

    #[test]
    fn the_sun_is_drawn_where_it_is_up() {
        let texts = |sun_deg| drawn(&|_| 1000.0, sun_deg).to_svg();
        assert!(texts(Some([40.0, 150.0])).contains(">sun<"));
        assert!(!texts(Some([-1.0, 150.0])).contains(">sun<"));
        assert!(!texts(None).contains(">sun<"));
        for letter in [">N<", ">E<", ">S<", ">W<", ">30\u{b0}<", ">cd/m\u{b2}<"] {
            assert!(texts(None).contains(letter), "{letter}");
        }
    }

    #[test]
    fn odd_skies_do_not_break() {
        for luminance in [0.0, f64::NAN, f64::INFINITY, 1e-30, 1e30] {
            let drawing = drawn(&|[up, _]| if up > 45.0 { luminance } else { 1.0 }, None);
            assert!(decoded(&drawing).0 > 500);
            assert!(decoded(&drawn(&|_| luminance, None)).0 > 500);
        }
    }
}
