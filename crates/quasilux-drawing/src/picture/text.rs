//! Lines of text on a canvas: glyphs of the bundled fonts side by side.
//!
//! Each character is drawn as its own glyph, [its advance](Glyph::advance_em) after the one
//! before, from left to right. There is no kerning, no ligature, no reordering and no
//! normalisation: scripts that need shaping (Arabic, the Indic ones) or run from right to left
//! are not drawn as they are written, and a combining mark stands over the character before it
//! without fitting to it. Characters that the fonts do not have are drawn as U+FFFD, visibly.

use super::canvas::{Canvas, Segment};
use super::colour_map::Colour;
use crate::font::{self, CAPITAL_EM, Glyph};
use glam::DVec2;

/// Width of the halo's pen in pixels: half of it lies outside the glyphs.
const HALO_PX: f64 = 6.0;

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
    pub(crate) colour: Colour,
    pub(crate) align: Align,
    /// Direction of the base line in pixels of the canvas, a unit vector.
    pub(crate) direction: DVec2,
}

impl TextStyle {
    /// Level text of a height.
    pub(crate) fn new(capital_px: f64, colour: Colour, align: Align) -> Self {
        Self { capital_px, colour, align, direction: DVec2::X }
    }
}

/// Width of a line of text in pixels: from its beginning to where a next glyph would stand.
pub(crate) fn width_px(text: &str, capital_px: f64) -> f64 {
    font::width_em(text) * capital_px / CAPITAL_EM
}

/// Draws a line of text; `at` is the point of the base line that `style.align` names.
pub(crate) fn draw(canvas: &mut Canvas, text: &str, at: DVec2, style: TextStyle) {
    canvas.fill_outline(&outline(text, at, style), style.colour);
}

/// As [`draw`], on a halo that sets the text off from what it covers.
pub(crate) fn draw_on(canvas: &mut Canvas, text: &str, at: DVec2, style: TextStyle, halo: Colour) {
    let pieces = outline(text, at, style);
    canvas.stroke(&pieces, HALO_PX, halo);
    canvas.fill_outline(&pieces, style.colour);
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

/// The outlines of a line of text in pixels of the canvas.
fn outline(text: &str, at: DVec2, style: TextStyle) -> Vec<Segment> {
    let em_px = style.capital_px / CAPITAL_EM;
    let right = style.direction * em_px;
    let up = DVec2::new(right.y, -right.x);
    let share = match style.align {
        Align::Left => 0.0,
        Align::Centre => 0.5,
        Align::Right => 1.0,
    };
    let mut x_em = -share * font::width_em(text);
    let mut pieces = Vec::new();
    for glyph in text.chars().map(Glyph::of) {
        let place = |p: DVec2| at + right * (p.x + x_em) + up * p.y;
        pieces.extend(glyph.outline_em().into_iter().map(|[a, b]| [place(a), place(b)]));
        x_em += glyph.advance_em();
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 6] =
        ["workplane 2", "机の上", "рабочая плоскость", "작업면", "Ράβδος", "\u{5d0}\u{1f4a1}"];

    /// The first and the last column with ink of a text drawn from x = 50.
    fn inked_columns(text: &str, capital_px: f64) -> [f64; 2] {
        let mut canvas = Canvas::new(800, 100);
        let style = TextStyle::new(capital_px, [0; 3], Align::Left);
        draw(&mut canvas, text, DVec2::new(50.0, 60.5), style);
        let inked = |x: &usize| (0..100).any(|y| canvas.at(*x, y) != [255; 3]);
        let columns: Vec<usize> = (0..800).filter(inked).collect();
        [columns[0] as f64, columns[columns.len() - 1] as f64 + 1.0]
    }

    /// The ink of each name fills its measured width but for the side bearings, below a tenth of an
    /// em each.
    #[test]
    fn the_measured_width_is_the_drawn_width() {
        for capital_px in [9.0, 11.0, 20.0] {
            for name in NAMES {
                let [first, last] = inked_columns(name, capital_px);
                let end = 50.0 + width_px(name, capital_px);
                let bearing_px = 0.1 * capital_px / CAPITAL_EM + 1.0;
                assert!((50.0 - 1.0..50.0 + bearing_px).contains(&first), "{name} at {first}");
                assert!((end - bearing_px..end + 1.0).contains(&last), "{name} to {last} of {end}");
            }
        }
    }

    #[test]
    fn a_missing_glyph_is_drawn_as_the_replacement() {
        let pixels = |text| {
            let mut canvas = Canvas::new(60, 40);
            let style = TextStyle::new(20.0, [0; 3], Align::Centre);
            draw(&mut canvas, text, DVec2::new(30.0, 30.5), style);
            canvas.to_png()
        };
        assert_eq!(pixels("\u{1f4a1}"), pixels("\u{fffd}"));
        assert_ne!(pixels("\u{1f4a1}"), pixels(" "));
        assert_ne!(pixels("机"), pixels("\u{fffd}"));
    }

    /// A text that runs upward has the ink of the level one, turned: its pixels sum up to as much.
    #[test]
    fn turned_text_has_as_much_ink() {
        let ink = |direction| {
            let mut canvas = Canvas::new(200, 200);
            let mut style = TextStyle::new(12.0, [0; 3], Align::Centre);
            style.direction = direction;
            draw(&mut canvas, "Ράβδος 机の上", DVec2::splat(100.0), style);
            let pixels = (0..200 * 200).map(|i| canvas.at(i % 200, i / 200)[0]);
            pixels.map(|grey| 255.0 - f64::from(grey)).sum::<f64>()
        };
        let level = ink(DVec2::X);
        for direction in [DVec2::NEG_Y, DVec2::new(0.6, -0.8)] {
            assert!((ink(direction) / level - 1.0).abs() < 0.01);
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
