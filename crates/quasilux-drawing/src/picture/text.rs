//! Text on a canvas, from stroked glyphs.

use super::canvas::{Canvas, Segment};
use super::colour_map::Colour;
use super::glyphs::{GLYPHS, MISSING};
use glam::DVec2;

/// Height of a capital in glyph units.
const CAPITAL_UNITS: f64 = 9.0;
/// Clear space between two glyphs in glyph units.
const SPACING_UNITS: f64 = 2.6;
/// Straight pieces for each quadratic piece of a curve.
const PIECES: usize = 6;

/// Where the reference point lies in a line of text.
#[derive(Clone, Copy)]
pub(crate) enum Align {
    Left,
    Centre,
    Right,
}

/// How a line of text is drawn.
#[derive(Clone, Copy)]
pub(crate) struct TextStyle {
    /// Height of a capital in pixels.
    pub(crate) capital_px: f64,
    /// Thickness of the strokes in pixels.
    pub(crate) stroke_px: f64,
    pub(crate) colour: Colour,
    pub(crate) align: Align,
    /// Direction of the base line in pixels of the canvas, a unit vector.
    pub(crate) direction: DVec2,
}

impl TextStyle {
    /// Level text of a height.
    pub(crate) fn new(capital_px: f64, colour: Colour, align: Align) -> Self {
        let stroke_px = (0.13 * capital_px).max(1.15);
        Self { capital_px, stroke_px, colour, align, direction: DVec2::X }
    }
}

/// Width of a line of text in pixels.
pub(crate) fn width_px(text: &str, capital_px: f64) -> f64 {
    let units: f64 = text.chars().map(|c| f64::from(glyph(c).0) + SPACING_UNITS).sum();
    (units - SPACING_UNITS).max(0.0) * capital_px / CAPITAL_UNITS
}

/// Draws a line of text; `at` is the point of the base line that `style.align` names.
pub(crate) fn draw(canvas: &mut Canvas, text: &str, at: DVec2, style: TextStyle) {
    canvas.stroke(&outline(text, at, style), style.stroke_px, style.colour);
}

/// As [`draw`], on a halo that sets the text off from what it covers.
pub(crate) fn draw_on(canvas: &mut Canvas, text: &str, at: DVec2, style: TextStyle, halo: Colour) {
    let segments = outline(text, at, style);
    canvas.stroke(&segments, style.stroke_px + 4.0, halo);
    canvas.stroke(&segments, style.stroke_px, style.colour);
}

/// A text cut to a width, with dots at its end where something is missing.
pub(crate) fn fitted(text: &str, capital_px: f64, most_px: f64) -> String {
    if width_px(text, capital_px) <= most_px {
        return text.to_owned();
    }
    let mut kept: Vec<char> = text.chars().collect();
    while kept.pop().is_some() {
        let shorter: String = kept.iter().collect::<String>() + "...";
        if width_px(&shorter, capital_px) <= most_px {
            return shorter;
        }
    }
    String::new()
}

fn outline(text: &str, at: DVec2, style: TextStyle) -> Vec<Segment> {
    let unit_px = style.capital_px / CAPITAL_UNITS;
    let right = style.direction;
    let up = DVec2::new(right.y, -right.x);
    let shift_px = match style.align {
        Align::Left => 0.0,
        Align::Centre => 0.5,
        Align::Right => 1.0,
    } * width_px(text, style.capital_px);
    let mut segments = Vec::new();
    let mut x = 0.0;
    for c in text.chars() {
        let (width, strokes) = glyph(c);
        for stroke in strokes.split_whitespace() {
            let points: Vec<DVec2> = flattened(stroke)
                .into_iter()
                .map(|p| at + right * ((p.x + x) * unit_px - shift_px) + up * (p.y * unit_px))
                .collect();
            segments.extend(points.windows(2).map(|w| [w[0], w[1]]));
        }
        x += f64::from(width) + SPACING_UNITS;
    }
    segments
}

fn glyph(c: char) -> (u8, &'static str) {
    GLYPHS.iter().find(|g| g.0 == c).map_or(MISSING, |&(_, width, strokes)| (width, strokes))
}

/// The points of a stroke in glyph units, curves cut into straight pieces.
fn flattened(stroke: &str) -> Vec<DVec2> {
    let polygon = |text: &str| -> Vec<DVec2> {
        text.as_bytes()
            .chunks(2)
            .map(|xy| DVec2::new(coordinate(xy[0]), coordinate(xy[1])))
            .collect()
    };
    if let Some(curve) = stroke.strip_prefix('~') {
        let controls = polygon(curve);
        let (inner, last) = (&controls[1..controls.len() - 1], controls[controls.len() - 1]);
        let mut points = vec![controls[0]];
        for (i, &control) in inner.iter().enumerate() {
            let end = inner.get(i + 1).map_or(last, |next| (control + next) / 2.0);
            bend(&mut points, control, end);
        }
        points
    } else if let Some(closed) = stroke.strip_prefix('o') {
        let controls = polygon(closed);
        let between =
            |i: usize| (controls[i % controls.len()] + controls[(i + 1) % controls.len()]) / 2.0;
        let mut points = vec![between(0)];
        for i in 1..=controls.len() {
            bend(&mut points, controls[i % controls.len()], between(i));
        }
        points
    } else {
        polygon(stroke)
    }
}

/// Appends a quadratic curve from the last of `points` to `end`.
fn bend(points: &mut Vec<DVec2>, control: DVec2, end: DVec2) {
    let start = points[points.len() - 1];
    points.extend((1..=PIECES).map(|i| {
        let t = i as f64 / PIECES as f64;
        start.lerp(control, t).lerp(control.lerp(end, t), t)
    }));
}

fn coordinate(c: u8) -> f64 {
    match c {
        b'0'..=b'9' => f64::from(c - b'0'),
        _ => -f64::from(c - b'a' + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_glyph_stays_in_its_box() {
        for (c, width, strokes) in GLYPHS.iter().copied().chain([('\0', MISSING.0, MISSING.1)]) {
            for stroke in strokes.split_whitespace() {
                let digits = stroke.trim_start_matches(['~', 'o']);
                assert!(digits.len() >= 4 && digits.len().is_multiple_of(2), "{c}");
                assert!(digits.bytes().all(|b| matches!(b, b'0'..=b'9' | b'a'..=b'c')), "{c}");
                for p in flattened(stroke) {
                    assert!((0.0..=f64::from(width)).contains(&p.x), "{c} is too wide");
                    assert!((-3.0..=9.0).contains(&p.y), "{c} is too high");
                }
            }
        }
    }

    #[test]
    fn ascii_is_complete_and_glyphs_are_unique() {
        for c in ' '..='~' {
            assert_eq!(GLYPHS.iter().filter(|g| g.0 == c).count(), 1, "{c}");
        }
    }

    #[test]
    fn texts_are_cut_to_width() {
        let cut = fitted("a long name of a sensor", 10.0, 100.0);
        assert!(cut.ends_with("...") && width_px(&cut, 10.0) <= 100.0);
        assert_eq!(fitted("short", 10.0, 100.0), "short");
        assert_eq!(fitted("short", 10.0, 1.0), "");
    }
}
