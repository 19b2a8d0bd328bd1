//! The marks of the smallest and the largest value of a grid.

use super::colour_map::ink_on;
use super::layout::capital_px;
use super::plan::{Box, Labels};
use crate::drawing::{Drawing, Frame};
use crate::style::{Anchor, Colour, Stroke, TextStyle, WHITE};
use crate::text::width_px;
use glam::DVec2;

/// Font size of the texts.
const TEXT_PX: f64 = 14.0;
/// Radius of the ring around a cell's centre.
const RING_PX: f64 = 5.0;
/// Clear space in a text's box.
const PAD_PX: f64 = 3.0;
/// Font size of the words at cells that have their number.
const TAG_PX: f64 = 11.5;
/// Height of their box.
const TAG_HIGH_PX: f64 = 13.0;

/// A cell with what it is, and its number.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Extreme {
    /// The cell's index.
    pub(super) cell: usize,
    pub(super) word: &'static str,
    pub(super) number: String,
}

/// The first cells with the smallest and the largest value; none where all values are equal.
pub(super) fn extremes(values: &[Option<f64>], number: impl Fn(f64) -> String) -> Vec<Extreme> {
    let known = || values.iter().enumerate().filter_map(|(cell, value)| Some((cell, (*value)?)));
    let least = known().reduce(|best, next| if next.1 < best.1 { next } else { best });
    let most = known().reduce(|best, next| if next.1 > best.1 { next } else { best });
    match (least, most) {
        (Some((low_cell, low)), Some((high_cell, high))) if low < high => vec![
            Extreme { cell: low_cell, word: "min", number: number(low) },
            Extreme { cell: high_cell, word: "max", number: number(high) },
        ],
        _ => Vec::new(),
    }
}

/// The mark of an extreme.
pub(super) struct Mark {
    colour: Colour,
    text: String,
    shape: Shape,
}

/// The number of a cell, and the border to be drawn around it.
pub(super) struct Bordered {
    pub(super) number: Box,
    pub(super) border: Box,
}

enum Shape {
    /// A ring at a cell's centre, and a text with the number beside it where there is room.
    Ring { centre: DVec2, text: Option<Frame> },
    /// A border around the number of a cell, with a word on its upper edge.
    Border { border: Frame, word: Box },
}

impl Mark {
    /// Width of the border of a cell.
    pub(super) const BORDER_PX: f64 = 2.0;

    /// Takes the place of a mark at a cell without a number.
    pub(super) fn ring(labels: &mut Labels, centre: DVec2, colour: Colour, of: &Extreme) -> Self {
        let text = format!("{} {}", of.word, of.number);
        let size = DVec2::new(width_px(&text, TEXT_PX), capital_px(TEXT_PX)) + 2.0 * PAD_PX;
        labels.take(Box::around(centre, DVec2::splat(RING_PX + 1.0)));
        let place = labels.beside(centre, DVec2::splat(RING_PX + 1.0), size);
        let place = place.map(|place| around(place.centre(), size));
        Self { colour, text, shape: Shape::Ring { centre, text: place } }
    }

    /// Takes the place of a mark around the number of a cell, which stays clear of the word.
    pub(super) fn border(labels: &mut Labels, at: Bordered, colour: Colour, of: &Extreme) -> Self {
        let half = 0.5 * DVec2::new(width_px(of.word, TAG_PX) + 2.0 * PAD_PX, TAG_HIGH_PX);
        let y = at.border.low.y.min(at.number.low.y - half.y);
        let word = Box::around(DVec2::new(at.number.centre().x, y), half);
        labels.take(at.border);
        labels.take(word);
        let shape = Shape::Border { border: at.border.frame(), word };
        Self { colour, text: of.word.to_owned(), shape }
    }

    /// Whether its word covers some of a box.
    pub(super) fn covers(&self, other: &Box) -> bool {
        matches!(&self.shape, Shape::Border { word, .. } if word.overlaps(other))
    }

    pub(super) fn draw(&self, drawing: &mut Drawing) {
        let ink = ink_on(self.colour);
        match self.shape {
            Shape::Ring { centre, text } => {
                let centre = centre.to_array();
                drawing.disk(centre, RING_PX, ink);
                drawing.disk(centre, RING_PX - 1.6, self.colour);
                drawing.disk(centre, 1.6, ink);
                if let Some(frame) = text {
                    self.draw_text(drawing, frame, TEXT_PX);
                }
            }
            Shape::Border { border, word } => {
                let halo = if ink == WHITE { [0x30; 3] } else { WHITE };
                drawing.outline(border, Stroke::solid(halo, 2.0 * Self::BORDER_PX));
                drawing.outline(border, Stroke::solid(ink, Self::BORDER_PX));
                self.draw_text(drawing, word.frame(), TAG_PX);
            }
        }
    }

    fn draw_text(&self, drawing: &mut Drawing, frame: Frame, size_px: f64) {
        drawing.fill(frame, WHITE);
        drawing.outline(frame, Stroke::solid([0x40; 3], 1.0));
        let [x, y] = frame.at([0.5, 0.5]);
        let style = TextStyle::new(size_px, [0x16; 3], Anchor::Middle);
        drawing.text([x, y + 0.5 * capital_px(size_px)], style, &self.text);
    }
}

fn around(centre: DVec2, size: DVec2) -> Frame {
    Frame { corner_px: (centre - 0.5 * size).to_array(), size_px: size.to_array() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_at_the_right_cells() {
        let values = [Some(5.0), None, Some(2.0), Some(9.0), Some(2.0), Some(9.0)];
        let found = extremes(&values, |value| value.to_string());
        let expected = [(2, "min", "2"), (3, "max", "9")].map(|(cell, word, number)| Extreme {
            cell,
            word,
            number: number.to_owned(),
        });
        assert_eq!(found, expected);
        assert!(extremes(&[Some(3.0), None, Some(3.0)], |value| value.to_string()).is_empty());
        assert!(extremes(&[None], |value| value.to_string()).is_empty());
    }
}
