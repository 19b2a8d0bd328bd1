//! The numbers of the cells of a grid.

use super::layout::capital_px;
use super::plan::Box;
use crate::number::{among_others, shared_place};
use crate::text::width_px;
use glam::DVec2;

/// Font sizes tried for the numbers, the largest that fits is taken.
const NUMBER_PX: [f64; 4] = [16.8, 14.0, 12.6, 11.2];
/// Clear space beside and above a number in its cell in pixels.
const MARGINS_PX: DVec2 = DVec2::new(6.5, 3.5);
/// Clear space around a number to other texts.
const CLEAR_PX: f64 = 2.0;

/// A number for each cell, of one size.
pub(super) struct Numbers {
    pub(super) texts: Vec<String>,
    pub(super) size_px: f64,
}

impl Numbers {
    /// The numbers of some values, where all of them fit into cells of a size.
    pub(super) fn fitting(values: &[Option<f64>], cell_px: DVec2) -> Option<Self> {
        let place = shared_place(values.iter().copied().flatten());
        let number = |x: f64| among_others(x, place);
        let text = |value: &Option<f64>| value.map_or_else(|| "-".into(), number);
        let texts: Vec<String> = values.iter().map(text).collect();
        let room = cell_px - 2.0 * MARGINS_PX;
        let fits = |px: &f64| {
            capital_px(*px) <= room.y && texts.iter().all(|n| width_px(n, *px) <= room.x)
        };
        let size_px = NUMBER_PX.into_iter().find(fits)?;
        Some(Self { texts, size_px })
    }

    /// What the number of a cell with this centre covers.
    pub(super) fn covered(&self, cell: usize, centre: DVec2) -> Box {
        let size = DVec2::new(width_px(&self.texts[cell], self.size_px), capital_px(self.size_px));
        Box::around(centre, 0.5 * size + CLEAR_PX)
    }
}
