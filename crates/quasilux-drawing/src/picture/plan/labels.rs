//! Texts and symbols that keep clear of each other.

use super::thin::clipped;
use crate::drawing::Frame;
use crate::text::width_px;
use glam::DVec2;

/// Height that a line of text takes, in its font size.
const LINE_EM: f64 = 1.1;
/// Clear space around a text.
const CLEAR_PX: f64 = 2.0;
/// More boxes than this are not kept clear of.
const MOST: usize = 4000;

/// An upright rectangle on the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Box {
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
}

/// The places in a frame that are taken.
pub(crate) struct Labels {
    room: Box,
    taken: Vec<Box>,
    /// Lines that are written over only where there is no other place.
    lines: Vec<[DVec2; 2]>,
}

impl Box {
    pub(crate) fn around(centre: DVec2, half: DVec2) -> Self {
        Self { low: centre - half, high: centre + half }
    }

    pub(crate) fn between(a: DVec2, b: DVec2) -> Self {
        Self { low: a.min(b), high: a.max(b) }
    }

    pub(crate) fn grown(&self, by: DVec2) -> Self {
        Self { low: self.low - by, high: self.high + by }
    }

    /// As much of it around its centre as has a size.
    pub(crate) fn within(&self, most: DVec2) -> Self {
        Self::around(self.centre(), 0.5 * (self.high - self.low).min(most))
    }

    pub(crate) fn frame(&self) -> Frame {
        Frame { corner_px: self.low.to_array(), size_px: (self.high - self.low).to_array() }
    }

    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        self.low.cmplt(other.high).all() && other.low.cmplt(self.high).all()
    }

    /// Whether it meets a disk.
    pub(crate) fn meets_disk(&self, centre: DVec2, radius_px: f64) -> bool {
        centre.distance(centre.clamp(self.low, self.high)) < radius_px
    }

    pub(crate) fn centre(&self) -> DVec2 {
        0.5 * (self.low + self.high)
    }
}

impl Labels {
    /// Nothing is taken.
    pub(crate) fn new(frame: Frame) -> Self {
        let low = DVec2::from(frame.corner_px) + 2.0;
        let high = DVec2::from(frame.corner_px) + DVec2::from(frame.size_px) - 2.0;
        Self { room: Box { low, high }, taken: Vec::new(), lines: Vec::new() }
    }

    /// What is taken.
    pub(crate) fn taken(&self) -> &[Box] {
        &self.taken
    }

    /// Takes a place, whatever is there already.
    pub(crate) fn take(&mut self, place: Box) {
        if self.taken.len() < MOST {
            self.taken.push(place);
        }
    }

    /// Has places chosen beside lines rather than on them.
    pub(crate) fn keep_off(&mut self, lines: Vec<[DVec2; 2]>) {
        self.lines = lines;
        self.lines.truncate(MOST);
    }

    /// Takes a free place for a box around something that reaches `reach` from `centre`.
    pub(crate) fn beside(&mut self, centre: DVec2, reach: DVec2, size: DVec2) -> Option<Box> {
        const WAYS: [[f64; 2]; 8] = [
            [1.0, -1.0],
            [1.0, 0.0],
            [-1.0, -1.0],
            [0.0, -1.0],
            [-1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [-1.0, 1.0],
        ];
        if self.taken.len() >= MOST {
            return None;
        }
        let half = 0.5 * size + CLEAR_PX;
        let tried = [0.0, 9.0, 20.0, 34.0].into_iter().flat_map(|further| {
            WAYS.map(|way| {
                let way = DVec2::from(way);
                let turn = if way.x * way.y == 0.0 { 1.0 } else { 0.75 };
                Box::around(centre + way * (turn * (reach + further) + half), half)
            })
        });
        let free = tried.filter(|place| {
            let inside =
                place.low.cmpge(self.room.low).all() && place.high.cmple(self.room.high).all();
            inside && self.taken.iter().all(|other| !other.overlaps(place))
        });
        let free: Vec<Box> = free.collect();
        let is_clear = |place: &&Box| {
            let frame = place.frame();
            !self.lines.iter().any(|ends| clipped(*ends, frame).is_some())
        };
        let free = *free.iter().find(is_clear).or(free.first())?;
        self.take(free);
        Some(free)
    }

    /// Takes a free place for a line of text beside something.
    pub(crate) fn text(
        &mut self,
        centre: DVec2,
        reach: DVec2,
        size_px: f64,
        text: &str,
    ) -> Option<Box> {
        self.beside(centre, reach, DVec2::new(width_px(text, size_px), LINE_EM * size_px))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside a wall a text goes to the other side, and onto it where there is no room else.
    #[test]
    fn labels_keep_off_lines() {
        let place = |size_px: [f64; 2], x: f64| {
            let mut labels = Labels::new(Frame { corner_px: [0.0, 0.0], size_px });
            labels.keep_off(vec![[DVec2::new(150.0, -10.0), DVec2::new(150.0, 500.0)]]);
            labels.text(DVec2::new(x, 100.0), DVec2::splat(5.0), 13.0, "hall").expect("a place")
        };
        assert!(place([300.0, 200.0], 140.0).high.x < 150.0);
        assert!(place([300.0, 200.0], 160.0).low.x > 150.0);
        let narrow = place([170.0, 110.0], 150.0);
        assert!(narrow.low.x < 170.0);
    }

    #[test]
    fn labels_keep_clear_of_each_other() {
        let frame = Frame { corner_px: [0.0, 0.0], size_px: [300.0, 200.0] };
        let mut labels = Labels::new(frame);
        let mut placed = Vec::new();
        for k in 0..200 {
            let centre = DVec2::new(f64::from(k * 37 % 300), f64::from(k * 53 % 200));
            placed.extend(labels.text(centre, DVec2::splat(5.0), 13.0, "12, 14"));
        }
        assert!(placed.len() > 10);
        for (k, one) in placed.iter().enumerate() {
            assert!(one.low.cmpge(DVec2::ZERO).all() && one.high.cmple(frame.size_px.into()).all());
            assert!(placed[..k].iter().all(|other| !other.overlaps(one)), "{one:?}");
        }
    }
}
