//! What stands above a diagram: a title, and a smaller line below it.

use super::legend::WIDER;
use crate::drawing::Drawing;
use crate::style::{Anchor, Colour, GREY, INK, TextStyle};
use crate::text::{fits_at, wrapped};

/// Font sizes of the title and of the line below, the largest that fits is taken.
const SIZES_PX: [[f64; 3]; 2] = [[16.0, 14.0, 12.0], [12.0, 11.0, 10.0]];
/// Base lines of both, where each is one line.
const BASES_PX: [f64; 2] = [26.0, 46.0];
const COLOURS: [Colour; 2] = [INK, GREY];
const MAX_LINES: usize = 4;

/// A title and what stands below it, in lines of a width.
pub(super) struct Head {
    parts: [Part; 2],
}

struct Part {
    size_px: f64,
    lines: Vec<String>,
}

impl Head {
    pub(super) fn within(width_px: f64, texts: [&str; 2]) -> Self {
        let most_px = width_px / WIDER;
        let part = |k: usize| {
            let size_px = fits_at(texts[k], &SIZES_PX[k], most_px);
            Part { size_px, lines: wrapped(texts[k], size_px, most_px, MAX_LINES) }
        };
        Self { parts: [part(0), part(1)] }
    }

    /// Height that more than one line of each takes.
    pub(super) fn more_px(&self) -> f64 {
        self.parts.iter().map(Part::more_px).sum()
    }

    pub(super) fn draw(&self, drawing: &mut Drawing, left: f64) {
        let mut above_px = 0.0;
        for ((part, base_px), colour) in self.parts.iter().zip(BASES_PX).zip(COLOURS) {
            let style = TextStyle::new(part.size_px, colour, Anchor::Start);
            for (k, line) in part.lines.iter().enumerate() {
                let y = base_px + above_px + k as f64 * part.line_px();
                drawing.text([left, y], style, line);
            }
            above_px += part.more_px();
        }
    }
}

impl Part {
    fn line_px(&self) -> f64 {
        (1.25 * self.size_px).round()
    }

    fn more_px(&self) -> f64 {
        self.line_px() * self.lines.len().saturating_sub(1) as f64
    }
}
