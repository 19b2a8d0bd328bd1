//! Boxes with openings, that rooms are made of.

use super::room::{Lookout, Parallelogram, Room, Surface};
use glam::DVec3;

/// A side of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    LowX,
    HighX,
    LowY,
    HighY,
    LowZ,
    HighZ,
}

/// A rectangular hole in a side: its corners along the two other axes, in the order x, y, z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opening {
    pub(super) side: Side,
    pub(super) low: [f64; 2],
    pub(super) high: [f64; 2],
}

/// A box along the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
}

impl Side {
    pub(super) const ALL: [Self; 6] =
        [Self::LowX, Self::HighX, Self::LowY, Self::HighY, Self::LowZ, Self::HighZ];

    fn axis(self) -> usize {
        match self {
            Self::LowX | Self::HighX => 0,
            Self::LowY | Self::HighY => 1,
            Self::LowZ | Self::HighZ => 2,
        }
    }

    fn is_high(self) -> bool {
        matches!(self, Self::HighX | Self::HighY | Self::HighZ)
    }

    /// The two other axes, ascending.
    fn others(self) -> [usize; 2] {
        [[1, 2], [0, 2], [0, 1]][self.axis()]
    }
}

impl Opening {
    /// All of a side.
    pub(super) fn all(side: Side) -> Self {
        Self { side, low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] }
    }

    /// The hole as a parallelogram in a plane of the side's axis.
    pub(super) fn at(&self, plane_m: f64) -> Parallelogram {
        let [i, j] = self.side.others();
        let mut corner = DVec3::ZERO;
        corner[self.side.axis()] = plane_m;
        (corner[i], corner[j]) = (self.low[0], self.low[1]);
        let (mut u, mut v) = (DVec3::ZERO, DVec3::ZERO);
        u[i] = self.high[0] - self.low[0];
        v[j] = self.high[1] - self.low[1];
        Parallelogram { corner, u, v }
    }

    /// The hole carried through a wall between two planes of its axis.
    pub(super) fn tunnel(&self, from_m: f64, to_m: f64) -> Block {
        let [i, j] = self.side.others();
        let (mut low, mut high) = (DVec3::splat(from_m), DVec3::splat(to_m));
        (low[i], low[j]) = (self.low[0], self.low[1]);
        (high[i], high[j]) = (self.high[0], self.high[1]);
        Block { low, high }
    }

    /// The same with a margin along both axes, cut to a block.
    pub(super) fn widened(&self, margins_m: [f64; 2], block: Block) -> Self {
        let others = self.side.others();
        let cut = |k: usize, value: f64| value.clamp(block.low[others[k]], block.high[others[k]]);
        let low = [0, 1].map(|k| cut(k, self.low[k] - margins_m[k]));
        let high = [0, 1].map(|k| cut(k, self.high[k] + margins_m[k]));
        Self { side: self.side, low, high }
    }

    /// Where light of a point that comes through the hole in `plane_m` lands in a plane of the same
    /// axis, cut to a box.
    pub(super) fn spot(&self, light: DVec3, plane_m: f64, on_m: f64, block: Block) -> Self {
        let axis = self.side.axis();
        let [i, j] = self.side.others();
        let scale = (on_m - light[axis]) / (plane_m - light[axis]);
        let cast = |k: usize, value: f64| {
            let there = light[k] + scale * (value - light[k]);
            there.clamp(block.low[k], block.high[k])
        };
        let low = [cast(i, self.low[0]), cast(j, self.low[1])];
        let high = [cast(i, self.high[0]), cast(j, self.high[1])];
        Self { side: self.side, low, high }
    }
}

impl Block {
    pub(super) fn new(low: [f64; 3], high: [f64; 3]) -> Self {
        Self { low: DVec3::from_array(low), high: DVec3::from_array(high) }
    }

    /// Without a margin along all sides.
    pub(super) fn inset(&self, margin_m: f64) -> Self {
        Self { low: self.low + margin_m, high: self.high - margin_m }
    }

    fn plane_m(&self, side: Side) -> f64 {
        let corner = if side.is_high() { self.high } else { self.low };
        corner[side.axis()]
    }
}

impl Room {
    /// Adds a box as seen from within, cut out at the openings.
    pub(super) fn add_shell(&mut self, block: Block, surface: Surface, openings: &[Opening]) {
        for side in Side::ALL {
            let own = openings.iter().filter(|opening| opening.side == side);
            let holes: Vec<Opening> = own.copied().collect();
            self.add_side(block, side, surface, &holes);
        }
    }

    /// Adds the four sides of a tunnel, open along an axis.
    pub(super) fn add_tunnel(&mut self, block: Block, axis: usize, surface: Surface) {
        let sides = Side::ALL.into_iter().filter(|side| side.axis() != axis);
        sides.for_each(|side| self.add_side(block, side, surface, &[]));
    }

    /// Adds a solid box.
    pub(super) fn add_solid(&mut self, block: Block, surface: Surface) {
        let first = self.faces.len();
        self.add_shell(block, surface, &[]);
        self.faces[first..].iter_mut().for_each(|face| face.corners.reverse());
    }

    /// Adds one side, its front inward, cut out at the holes.
    pub(super) fn add_side(
        &mut self,
        block: Block,
        side: Side,
        surface: Surface,
        holes: &[Opening],
    ) {
        let others = side.others();
        let cuts = [0, 1].map(|k| {
            let [low, high] = [block.low[others[k]], block.high[others[k]]];
            let ends = holes.iter().flat_map(|hole| [hole.low[k], hole.high[k]]);
            let within = ends.filter(|&cut| cut > low && cut < high);
            let mut cuts: Vec<f64> = within.chain([low, high]).collect();
            cuts.sort_by(f64::total_cmp);
            cuts.dedup();
            cuts
        });
        for a in cuts[0].windows(2) {
            for b in cuts[1].windows(2) {
                let middle = [f64::midpoint(a[0], a[1]), f64::midpoint(b[0], b[1])];
                let is_in = |hole: &Opening| {
                    (0..2).all(|k| hole.low[k] < middle[k] && middle[k] < hole.high[k])
                };
                if holes.iter().any(is_in) {
                    continue;
                }
                let cell = Opening { side, low: [a[0], b[0]], high: [a[1], b[1]] };
                self.add_inward(cell.at(block.plane_m(side)), side, surface);
            }
        }
    }

    /// Adds one side, its front outward.
    pub(super) fn add_outer_side(&mut self, block: Block, side: Side, surface: Surface) {
        let first = self.faces.len();
        self.add_side(block, side, surface, &[]);
        self.faces[first..].iter_mut().for_each(|face| face.corners.reverse());
    }

    fn add_inward(&mut self, mut cell: Parallelogram, side: Side, surface: Surface) {
        let points_up = cell.u.cross(cell.v)[side.axis()] > 0.0;
        if points_up == side.is_high() {
            std::mem::swap(&mut cell.u, &mut cell.v);
        }
        self.add_face(cell, surface);
    }

    /// Adds places to look at from within a block; those that were cut to nothing are left out.
    pub(super) fn add_hints(
        &mut self,
        from: Block,
        shapes: impl IntoIterator<Item = Parallelogram>,
    ) {
        let has_area = |shape: &Parallelogram| shape.u.cross(shape.v).length() > 1e-12;
        let Block { low, high } = from;
        let hint = |shape| Lookout { shape, low, high };
        self.hints.extend(shapes.into_iter().filter(has_area).map(hint));
    }
}
