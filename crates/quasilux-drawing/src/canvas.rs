//! A small canvas: rectangles, lines and filled outlines with smooth edges. Pixel (0, 0) is at the
//! top left, and its centre is at (0.5, 0.5).

use crate::font::Segment;
use crate::style::Colour;
use ab_glyph_rasterizer::{Rasterizer, point};
use glam::DVec2;

/// An sRGB picture being drawn.
pub(crate) struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<Colour>,
    clip: Clip,
}

/// The pixels that can be drawn: the first ones, and those behind the last ones.
#[derive(Clone, Copy)]
pub(crate) struct Clip {
    from: [usize; 2],
    to: [usize; 2],
}

impl Canvas {
    /// A white canvas.
    pub(crate) fn new(width: usize, height: usize) -> Self {
        let clip = Clip { from: [0, 0], to: [width, height] };
        Self { width, height, pixels: vec![[255; 3]; width * height], clip }
    }

    /// Restricts drawing to the pixels from `from` to `to`, the ends excluded, and returns the
    /// restriction before.
    pub(crate) fn clip(&mut self, from: [usize; 2], to: [usize; 2]) -> Clip {
        let before = self.clip;
        self.clip = Clip {
            from: [0, 1].map(|axis| from[axis].max(before.from[axis])),
            to: [0, 1].map(|axis| to[axis].min(before.to[axis])),
        };
        before
    }

    /// Takes back a restriction.
    pub(crate) fn restore(&mut self, before: Clip) {
        self.clip = before;
    }

    /// Sets a pixel; outside the canvas nothing happens.
    pub(crate) fn set(&mut self, x: usize, y: usize, colour: Colour) {
        let Clip { from, to } = self.clip;
        if (from[0]..to[0]).contains(&x) && (from[1]..to[1]).contains(&y) {
            self.pixels[y * self.width + x] = colour;
        }
    }

    /// Draws lines of a width with round ends. Where they cross each other nothing is drawn twice,
    /// so their joints do not show.
    pub(crate) fn stroke(&mut self, segments: &[Segment], width: f64, colour: Colour) {
        let radius = 0.5 * width;
        let reach = radius + 1.0;
        let Some(([x0, y0], [w, h])) = self.box_around(segments, reach) else {
            return;
        };
        let mut coverage = vec![0.0_f64; w * h];
        for segment in segments {
            let Some(([left, top], [columns, rows])) =
                self.box_around(std::slice::from_ref(segment), reach)
            else {
                continue;
            };
            for y in top..top + rows {
                let band = band(segment, y as f64 + 0.5, reach);
                for x in columns_within(band, [left, left + columns]) {
                    let centre = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
                    let inside = radius + 0.5 - distance(centre, segment);
                    let here = &mut coverage[(y - y0) * w + (x - x0)];
                    *here = here.max(inside.min(width).clamp(0.0, 1.0));
                }
            }
        }
        for (i, &share) in coverage.iter().enumerate().filter(|(_, share)| **share > 0.0) {
            let pixel = &mut self.pixels[(y0 + i / w) * self.width + x0 + i % w];
            *pixel = mix(*pixel, colour, share);
        }
    }

    /// Fills closed outlines where their winding number is not zero; a pixel at the edge takes the
    /// colour by the share of its area inside.
    pub(crate) fn fill_outline(&mut self, pieces: &[Segment], colour: Colour) {
        let Some(([x0, y0], [w, h])) = self.box_around(pieces, 1.0) else {
            return;
        };
        let corner = DVec2::new(x0 as f64, y0 as f64);
        // What lies outside moves to the border; a piece that crosses the border bends.
        let last = DVec2::new(w as f64, h as f64);
        let inside = |p: DVec2| {
            let p = (p - corner).clamp(DVec2::ZERO, last);
            point(p.x as f32, p.y as f32)
        };
        let mut raster = Rasterizer::new(w, h);
        pieces.iter().for_each(|[a, b]| raster.draw_line(inside(*a), inside(*b)));
        raster.for_each_pixel(|i, share| {
            if share > 0.0 {
                let pixel = &mut self.pixels[(y0 + i / w) * self.width + x0 + i % w];
                *pixel = mix(*pixel, colour, f64::from(share.min(1.0)));
            }
        });
    }

    /// The colour of a pixel.
    #[cfg(test)]
    pub(crate) fn at(&self, x: usize, y: usize) -> Colour {
        self.pixels[y * self.width + x]
    }

    /// The picture as a PNG file.
    pub(crate) fn to_png(&self) -> Vec<u8> {
        srgb_png([self.width as u32, self.height as u32], self.pixels.as_flattened())
    }

    /// The pixels within `reach` of the segments: corner and size, `None` where there are none.
    fn box_around(&self, segments: &[Segment], reach: f64) -> Option<([usize; 2], [usize; 2])> {
        let points = || segments.iter().flatten();
        let low = points().copied().reduce(DVec2::min)? - reach;
        let high = points().copied().reduce(DVec2::max)? + reach;
        let Clip { from, to } = self.clip;
        let low = [low.x, low.y].map(|x| x.floor().max(0.0) as usize);
        let high = [high.x, high.y].map(|x| x.ceil().max(0.0) as usize);
        let from = [low[0].max(from[0]), low[1].max(from[1])];
        let to = [high[0].min(to[0]), high[1].min(to[1])];
        (from[0] < to[0] && from[1] < to[1]).then(|| (from, [to[0] - from[0], to[1] - from[1]]))
    }
}

/// A PNG file of sRGB pixels, row by row from the top.
pub(crate) fn srgb_png([width, height]: [u32; 2], pixels: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    let mut writer = encoder.write_header().expect("memory takes a header");
    writer.write_image_data(pixels).expect("memory takes a picture");
    writer.finish().expect("memory takes an end");
    bytes
}

/// The colour between `a` (`t` = 0) and `b` (`t` = 1).
pub(crate) fn mix(a: Colour, b: Colour, t: f64) -> Colour {
    std::array::from_fn(|c| {
        let (a, b) = (f64::from(a[c]), f64::from(b[c]));
        (a + (b - a) * t).round() as u8
    })
}

/// The range of x in which pixel centres of the row at `y` can be within `reach` of a segment.
fn band([a, b]: &Segment, y: f64, reach: f64) -> [f64; 2] {
    let rise = b.y - a.y;
    let share = |edge: f64| (y + edge * reach - a.y) / rise;
    let ends = if rise == 0.0 { [0.0, 1.0] } else { [share(-1.0), share(1.0)] };
    let x = ends.map(|t| a.x + (b.x - a.x) * t.clamp(0.0, 1.0));
    [x[0].min(x[1]) - reach, x[0].max(x[1]) + reach]
}

/// The pixels of a row between two columns whose centres lie in a range.
fn columns_within([low, high]: [f64; 2], [from, to]: [usize; 2]) -> std::ops::Range<usize> {
    (low.floor().max(0.0) as usize).max(from)..(high.ceil().max(0.0) as usize).min(to)
}

/// Distance from a point to a segment.
fn distance(p: DVec2, [a, b]: &Segment) -> f64 {
    let along = *b - *a;
    let squared = along.length_squared();
    let t = if squared > 0.0 { ((p - *a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(*a + along * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_covers_its_area() {
        let mut canvas = Canvas::new(40, 30);
        canvas.stroke(&[[DVec2::new(5.0, 7.3), DVec2::new(31.0, 19.6)]], 3.0, [0; 3]);
        let ink: f64 = canvas.pixels.iter().map(|p| 1.0 - f64::from(p[0]) / 255.0).sum();
        let length = DVec2::new(26.0, 12.3).length();
        let expected = 3.0 * length + std::f64::consts::PI * 1.5 * 1.5;
        assert!((ink / expected - 1.0).abs() < 0.02, "{ink} for {expected}");
    }

    /// A square with a square hole, the hole's outline running the other way round.
    #[test]
    fn an_outline_covers_its_area_less_its_holes() {
        let mut canvas = Canvas::new(40, 30);
        let ring = |low: f64, high: f64, turned: bool| {
            let mut corners = [[low, low], [high, low], [high, high], [low, high]];
            if turned {
                corners.reverse();
            }
            let corners = corners.map(DVec2::from_array);
            (0..4).map(move |k| [corners[k], corners[(k + 1) % 4]])
        };
        let pieces: Vec<Segment> = ring(3.25, 20.5, false).chain(ring(7.0, 11.5, true)).collect();
        canvas.fill_outline(&pieces, [0; 3]);
        let ink: f64 = canvas.pixels.iter().map(|p| 1.0 - f64::from(p[0]) / 255.0).sum();
        let expected = 17.25 * 17.25 - 4.5 * 4.5;
        assert!((ink / expected - 1.0).abs() < 1e-3, "{ink} for {expected}");
        assert_eq!(canvas.at(9, 9), [255; 3]);
    }

    #[test]
    fn what_is_outside_is_not_drawn() {
        let mut canvas = Canvas::new(4, 4);
        let far = DVec2::splat(1e9);
        canvas.stroke(&[[far, far * 2.0], [-far, -far]], 2.0, [0; 3]);
        canvas.stroke(&[], 2.0, [0; 3]);
        canvas.fill_outline(&[[far, far * 2.0], [far * 2.0, far]], [0; 3]);
        canvas.fill_outline(&[[-far, far], [far, -far], [far, far * 2.0]], [255; 3]);
        (3..9).for_each(|x| canvas.set(x, 3, [1; 3]));
        assert_eq!(canvas.pixels.iter().filter(|p| **p != [255; 3]).count(), 1);
    }
}
