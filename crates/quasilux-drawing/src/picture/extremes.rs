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

/// A cell with its text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Extreme {
    /// The cell's number.
    pub(super) cell: usize,
    pub(super) text: String,
}

/// The first cells with the smallest and the largest value; none where all values are equal.
pub(super) fn extremes(values: &[Option<f64>], number: impl Fn(f64) -> String) -> Vec<Extreme> {
    let known = || values.iter().enumerate().filter_map(|(cell, value)| Some((cell, (*value)?)));
    let least = known().reduce(|best, next| if next.1 < best.1 { next } else { best });
    let most = known().reduce(|best, next| if next.1 > best.1 { next } else { best });
    match (least, most) {
        (Some((low_cell, low)), Some((high_cell, high))) if low < high => vec![
            Extreme { cell: low_cell, text: format!("min {}", number(low)) },
            Extreme { cell: high_cell, text: format!("max {}", number(high)) },
        ],
        _ => Vec::new(),
    }
}

/// The mark of an extreme: a ring at a cell's centre, and the text beside it where there is room.
pub(super) struct Mark {
    centre: DVec2,
    colour: Colour,
    text: String,
    frame: Option<Frame>,
}

impl Mark {
    /// Takes the place of a mark.
    pub(super) fn place(labels: &mut Labels, centre: DVec2, colour: Colour, text: &str) -> Self {
        let size = DVec2::new(width_px(text, TEXT_PX), capital_px(TEXT_PX)) + 2.0 * PAD_PX;
        labels.take(Box::around(centre, DVec2::splat(RING_PX + 1.0)));
        let place = labels.beside(centre, DVec2::splat(RING_PX + 1.0), size);
        let frame = place.map(|place| Frame {
            corner_px: (place.centre() - 0.5 * size).to_array(),
            size_px: size.to_array(),
        });
        Self { centre, colour, text: text.to_owned(), frame }
    }

    pub(super) fn draw(&self, drawing: &mut Drawing) {
        let ink = ink_on(self.colour);
        let centre = self.centre.to_array();
        drawing.disk(centre, RING_PX, ink);
        drawing.disk(centre, RING_PX - 1.6, self.colour);
        drawing.disk(centre, 1.6, ink);
        let Some(frame) = self.frame else {
            return;
        };
        drawing.fill(frame, WHITE);
        drawing.outline(frame, Stroke::solid([0x40; 3], 1.0));
        let [x, y] = frame.at([0.5, 0.5]);
        let style = TextStyle::new(TEXT_PX, [0x16; 3], Anchor::Middle);
        drawing.text([x, y + 0.5 * capital_px(TEXT_PX)], style, &self.text);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_at_the_right_cells() {
        let values = [Some(5.0), None, Some(2.0), Some(9.0), Some(2.0), Some(9.0)];
        let found = extremes(&values, |value| value.to_string());
        let expected = [(2, "min 2"), (3, "max 9")]
            .map(|(cell, text)| Extreme { cell, text: text.to_owned() });
        assert_eq!(found, expected);
        assert!(extremes(&[Some(3.0), None, Some(3.0)], |value| value.to_string()).is_empty());
        assert!(extremes(&[None], |value| value.to_string()).is_empty());
    }
}
