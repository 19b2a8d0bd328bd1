//! How lines and text look.

use crate::font::Glyph;

/// Okabe and Ito's colours ("Color universal design", 2008), in an order in which neighbours differ
/// in lightness too. Their yellow is left out: it cannot be seen on white.
pub const PALETTE: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

pub(super) const INK: &str = "#222222";
pub(super) const FAINT: &str = "#e4e4e4";
pub(super) const GREY: &str = "#767676";
/// The families that are asked for: Latin ones first, then those of systems and of Noto for the
/// East Asian scripts, from which a viewer takes the letters that the first ones lack.
pub(super) const FONT: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', 'Noto Sans', \
    'Noto Sans CJK JP', 'Noto Sans CJK SC', 'Noto Sans CJK KR', 'Hiragino Sans', 'PingFang SC', \
    'Apple SD Gothic Neo', 'Yu Gothic', 'Microsoft YaHei', 'Malgun Gothic', sans-serif";
/// Width of a small letter in heights: wide enough for the fonts that are asked for.
const LETTER: f64 = 0.56;
/// Width of a capital in heights, as wide as that of any letter but the East Asian ones.
const CAPITAL: f64 = 0.72;
/// Size of ordinary text.
pub(super) const TEXT_PX: f64 = 12.0;

/// Room for a text of small letters in pixels; an East Asian letter is a square.
pub(super) fn room_px(text: &str, size_px: f64) -> f64 {
    text.chars().map(|c| letter_em(c, LETTER)).sum::<f64>() * size_px
}

/// The text, or as much of its beginning with an ellipsis as surely has room.
pub(super) fn shortened(text: &str, size_px: f64, most_px: f64) -> String {
    let most_em = most_px / size_px;
    let ends_em = text.chars().scan(0.0, |end_em, c| {
        *end_em += letter_em(c, CAPITAL);
        Some(*end_em)
    });
    if ends_em.clone().all(|end_em| end_em <= most_em) {
        return text.to_owned();
    }
    let kept = ends_em.take_while(|end_em| *end_em <= most_em - CAPITAL).count();
    let kept: String = text.chars().take(kept).collect();
    format!("{}\u{2026}", kept.trim_end())
}

/// Width of a letter in heights; `other` is that of a letter that is not East Asian.
fn letter_em(c: char, other: f64) -> f64 {
    if Glyph::of(c).is_east_asian() { 1.0 } else { other }
}

/// How a line is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    Solid,
    /// Long dashes.
    Dashed,
    /// Dots.
    Dotted,
    /// Dashes and dots in turn.
    DashDot,
}

impl Dash {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Solid, Self::Dashed, Self::DashDot, Self::Dotted];

    /// Lengths of dashes and gaps, in multiples of the line's width.
    pub(super) const fn lengths(self) -> &'static [f64] {
        match self {
            Self::Solid => &[],
            Self::Dashed => &[5.0, 3.0],
            Self::Dotted => &[1.0, 2.0],
            Self::DashDot => &[6.0, 2.0, 1.0, 2.0],
        }
    }
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// A colour as SVG writes it.
    pub colour: &'static str,
    /// Its width.
    pub width_px: f64,
    /// How it is broken.
    pub dash: Dash,
}

impl Stroke {
    /// An unbroken line.
    #[must_use]
    pub const fn solid(colour: &'static str, width_px: f64) -> Self {
        Self { colour, width_px, dash: Dash::Solid }
    }
}

/// Which part of a text is at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its start.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

impl Anchor {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Middle => "middle",
            Self::End => "end",
        }
    }
}

/// How a text is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextStyle {
    /// Height of the letters, as fonts measure it.
    pub size_px: f64,
    /// A colour as SVG writes it.
    pub colour: &'static str,
    /// Which part is at the text's place.
    pub anchor: Anchor,
    /// Whether it runs upwards.
    pub upwards: bool,
}

impl TextStyle {
    /// Ordinary text.
    #[must_use]
    pub const fn plain(anchor: Anchor) -> Self {
        Self { size_px: TEXT_PX, colour: INK, anchor, upwards: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn east_asian_letters_take_their_room() {
        assert_eq!(room_px("机の上", 10.0), 30.0);
        assert!((room_px("abc", 10.0) - 16.8).abs() < 1e-9);
    }

    #[test]
    fn texts_are_shortened_to_their_room() {
        assert_eq!(shortened("short", 10.0, 40.0), "short");
        assert_eq!(shortened("too long", 10.0, 40.0), "too\u{2026}");
        assert_eq!(shortened("机の上の明かり", 10.0, 40.0), "机の上\u{2026}");
        assert_eq!(shortened("机", 10.0, 5.0), "\u{2026}");
    }
}
