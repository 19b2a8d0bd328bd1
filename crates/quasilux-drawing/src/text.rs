//! Lines of text: their runs, widths and outlines.
//!
//! Each character is drawn as its own glyph, [its advance](Glyph::advance_em) after the one
//! before, from left to right. There is no kerning, no ligature, no reordering and no
//! normalisation: scripts that need shaping (Arabic, the Indic ones) or run from right to left
//! are not drawn as they are written, and a combining mark stands over the character before it
//! without fitting to it. Characters that the fonts do not have are drawn as U+FFFD, visibly.
//! `^{..}` raises the characters between the braces.

use crate::font::{Glyph, Segment, width_em};
use crate::style::{Anchor, TextStyle};
use glam::DVec2;

/// Width of the halo's pen: half of it lies outside the letters.
pub(crate) const HALO_PX: f64 = 6.0;
/// Size of raised letters, and height of their base line in em of the text around them.
pub(crate) const RAISED_SCALE: f64 = 0.72;
pub(crate) const RAISED_EM: f64 = 0.36;

/// Characters of a line that stand on one base line.
pub(crate) struct Run<'a> {
    pub(crate) text: &'a str,
    pub(crate) is_raised: bool,
}

/// The runs of a line, none of them empty.
pub(crate) fn runs(text: &str) -> impl Iterator<Item = Run<'_>> {
    let mut pieces = text.split("^{");
    let first = Run { text: pieces.next().unwrap_or(""), is_raised: false };
    let others = pieces.flat_map(|piece| {
        let (power, rest) = piece.split_once('}').unwrap_or((piece, ""));
        [Run { text: power, is_raised: true }, Run { text: rest, is_raised: false }]
    });
    std::iter::once(first).chain(others).filter(|run| !run.text.is_empty())
}

/// Width of a line of text: from its beginning to where a next glyph would stand.
pub(crate) fn width_px(text: &str, size_px: f64) -> f64 {
    runs(text).map(|run| width_em(run.text) * run.scale()).sum::<f64>() * size_px
}

/// The text, or as much of its beginning with an ellipsis as has room.
pub(crate) fn fitted(text: &str, size_px: f64, most_px: f64) -> String {
    if width_px(text, size_px) <= most_px {
        return text.to_owned();
    }
    cut_off(text, size_px, most_px)
}

/// As much of the beginning of a text as has room with an ellipsis.
fn cut_off(text: &str, size_px: f64, most_px: f64) -> String {
    let mut kept = text.to_owned();
    loop {
        let shorter = format!("{}\u{2026}", kept.trim_end());
        if width_px(&shorter, size_px) <= most_px {
            return shorter;
        }
        if kept.pop().is_none() {
            return String::new();
        }
    }
}

/// The text in at most `most_lines` lines of a width, broken between words, and words that are too
/// long for a line between characters. What has no room there ends with an ellipsis.
pub(crate) fn wrapped(text: &str, size_px: f64, most_px: f64, most_lines: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        if let Some(last) = lines.last_mut() {
            let longer = format!("{last} {word}");
            if width_px(&longer, size_px) <= most_px {
                *last = longer;
                continue;
            }
        }
        let mut rest = word;
        while !rest.is_empty() {
            let room = |end: &usize| width_px(&rest[..*end], size_px) <= most_px;
            let ends = rest.char_indices().map(|(at, char)| at + char.len_utf8());
            let first = rest.chars().next().map_or(0, char::len_utf8);
            let end = ends.take_while(room).last().unwrap_or(first);
            lines.push(rest[..end].to_owned());
            rest = &rest[end..];
        }
    }
    if lines.len() > most_lines {
        lines.truncate(most_lines);
        if let Some(last) = lines.last_mut() {
            *last = cut_off(last, size_px, most_px);
        }
    }
    lines
}

/// The first of some font sizes at which a line of text has room, or the last one.
pub(crate) fn fits_at(text: &str, sizes_px: &[f64], most_px: f64) -> f64 {
    let fits = |px: &f64| width_px(text, *px) <= most_px;
    sizes_px.iter().copied().find(fits).or(sizes_px.last().copied()).unwrap_or_default()
}

/// The outlines of a line of text whose place is `at`, enlarged by `scale`.
pub(crate) fn outline(text: &str, at: DVec2, style: &TextStyle, scale: f64) -> Vec<Segment> {
    let right = DVec2::from(style.direction) * style.size_px * scale;
    let up = DVec2::new(right.y, -right.x);
    let share = match style.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => 0.5,
        Anchor::End => 1.0,
    };
    let mut x_em = -share * width_px(text, 1.0);
    let mut pieces = Vec::new();
    for run in runs(text) {
        let scale = run.scale();
        let y_em = if run.is_raised { RAISED_EM } else { 0.0 };
        for glyph in run.text.chars().map(Glyph::new) {
            let place = |p: DVec2| at + right * (p.x * scale + x_em) + up * (p.y * scale + y_em);
            pieces.extend(glyph.outline_em().into_iter().map(|[a, b]| [place(a), place(b)]));
            x_em += glyph.advance_em() * scale;
        }
    }
    pieces
}

impl Run<'_> {
    /// Size of its letters in em.
    fn scale(&self) -> f64 {
        if self.is_raised { RAISED_SCALE } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [&str; 6] =
        ["workplane 2", "机の上", "рабочая плоскость", "작업면", "Ράβδος", "\u{5d0}\u{1f4a1}"];

    /// The ends of the ink of a text drawn from x = 50.
    fn ends(text: &str, size_px: f64) -> [f64; 2] {
        let style = TextStyle::new(size_px, [0; 3], Anchor::Start);
        let pieces = outline(text, DVec2::new(50.0, 60.5), &style, 1.0);
        let x = || pieces.iter().flatten().map(|p| p.x);
        [x().fold(f64::INFINITY, f64::min), x().fold(0.0, f64::max)]
    }

    /// The ink of each name fills its measured width but for the side bearings, below a tenth of an
    /// em each.
    #[test]
    fn the_measured_width_is_the_drawn_width() {
        for size_px in [12.0, 15.0, 28.0] {
            for name in NAMES {
                let [first, last] = ends(name, size_px);
                let end = 50.0 + width_px(name, size_px);
                let bearing_px = 0.1 * size_px + 1.0;
                assert!((50.0 - 1.0..50.0 + bearing_px).contains(&first), "{name} at {first}");
                assert!((end - bearing_px..end + 1.0).contains(&last), "{name} to {last} of {end}");
            }
        }
    }

    #[test]
    fn a_missing_glyph_is_drawn_as_the_replacement() {
        let style = TextStyle::new(20.0, [0; 3], Anchor::Middle);
        let drawn = |text| outline(text, DVec2::ZERO, &style, 1.0);
        assert_eq!(drawn("\u{1f4a1}"), drawn("\u{fffd}"));
        assert_ne!(drawn("\u{1f4a1}"), drawn(" "));
        assert_ne!(drawn("机"), drawn("\u{fffd}"));
    }

    /// Turned text is the level one, turned about its place.
    #[test]
    fn turned_text_is_as_large() {
        let pieces = |direction| {
            let style = TextStyle { direction, ..TextStyle::plain(Anchor::Middle) };
            outline("Ράβδος 机の上", DVec2::splat(100.0), &style, 2.0)
        };
        let level = pieces([1.0, 0.0]);
        for [right, down] in [[0.0, -1.0], [0.6, -0.8]] {
            for (a, b) in level.iter().flatten().zip(pieces([right, down]).iter().flatten()) {
                let turned = DVec2::new(right, down).rotate(*a - 100.0) + 100.0;
                assert!(turned.distance(*b) < 1e-9);
            }
        }
    }

    #[test]
    fn raised_letters_are_smaller_and_higher() {
        let texts: Vec<(&str, bool)> =
            runs("N^{-1} and 2^{a").map(|run| (run.text, run.is_raised)).collect();
        assert_eq!(texts, [("N", false), ("-1", true), (" and 2", false), ("a", true)]);
        let sum = width_px("N", 10.0) + RAISED_SCALE * width_px("-1", 10.0);
        assert!((width_px("N^{-1}", 10.0) - sum).abs() < 1e-9);
    }

    #[test]
    fn texts_wrap_and_lose_nothing() {
        let text = "METAL ENCLOSURE, WHITE PAINTED REFLECTOR, a_name_without_any_space_in_it";
        for most_px in [60.0, 100.0, 150.0, 400.0] {
            let lines = wrapped(text, 14.0, most_px, 40);
            assert!(lines.iter().all(|line| width_px(line, 14.0) <= most_px), "{lines:?}");
            let letters = |text: &str| text.replace(' ', "");
            assert_eq!(letters(&lines.concat()), letters(text));
        }
        let cut = wrapped(text, 14.0, 150.0, 2);
        assert!(cut.len() == 2 && cut[1].ends_with('\u{2026}') && !cut[0].contains('\u{2026}'));
        assert!(cut.iter().all(|line| width_px(line, 14.0) <= 150.0));
        assert!(wrapped(" ", 14.0, 100.0, 3).is_empty());
        assert_eq!(wrapped("wide", 14.0, 1.0, 9).len(), 4);
    }

    #[test]
    fn texts_are_cut_to_width() {
        let cut = fitted("a long name of a sensor", 14.0, 100.0);
        assert!(cut.ends_with('\u{2026}') && width_px(&cut, 14.0) <= 100.0);
        assert_eq!(fitted("short", 14.0, 100.0), "short");
        assert_eq!(fitted("short", 14.0, 1.0), "");
    }
}
