//! A binary tree over triangles, by the surface area heuristic.
//!
//! Costs are expected visits of blocks of up to eight triangles, so a side counts its blocks,
//! not its triangles. What is built does not depend on the number of threads: subtrees share
//! nothing, and bins are merged by minima, maxima and sums of integers.

mod bins;
mod clip;
mod grid;
mod reference;
mod spatial;
mod wide;

pub(crate) use wide::{Leaf, WideTree, collapse};

use crate::frame::Frame;
use crate::node::WIDTH;
use bins::ObjectSplit;
use clip::Triangles;
use glam::DVec3;
use reference::{Extent, Reference};
use spatial::SpatialSplit;
use wide::{Binary, Kind, Plan};

/// Below this depth halves have equally many triangles, which bounds the depth.
const BALANCED_BELOW: u32 = 32;

/// Subtrees with more references are built on all threads.
const PARALLEL: usize = 2048;

/// Cost of a child to its parent, in units of a block.
const CHILD_COST: f32 = 0.3;

/// Largest number of copies for each triangle, on average over all.
const MAX_COPIES: f64 = 1.0;

/// A spatial split must cost less than this share of the object split: copies make blocks fuller,
/// which the costs of both halves do not show.
const WORTHWHILE: f32 = 0.98;

/// Spatial splits are tried where the halves of an object split overlap by this share of the whole
/// surface,
const MIN_OVERLAP: f32 = 1e-4;

/// and by this share of the surface of their own box: below, trees do not get better.
const MIN_SHARE: f32 = 0.1;

/// The tree over all triangles, of which there must be some.
pub(crate) fn build(corners: &[[DVec3; 3]], frame: Frame) -> Binary {
    let count = corners.len();
    let mut storage = reference::all(corners, &frame, (count as f64 * MAX_COPIES) as usize);
    let extent = Extent::new(&storage[..count]);
    let least_overlap = MIN_OVERLAP * extent.bounds.half_area();
    let builder = Builder { triangles: Triangles { corners, frame }, least_overlap };
    builder.subtree(Share { storage: &mut storage, count, extent, depth: 0 })
}

struct Builder<'a> {
    triangles: Triangles<'a>,
    /// Half the surface of an overlap that is worth a spatial split.
    least_overlap: f32,
}

/// The references of a subtree.
struct Share<'a> {
    /// The references, then room for copies of them.
    storage: &'a mut [Reference],
    count: usize,
    extent: Extent,
    depth: u32,
}

impl Builder<'_> {
    fn subtree(&self, share: Share<'_>) -> Binary {
        let (count, bounds) = (share.count, share.extent.bounds);
        let [left, right] = match self.halves(share) {
            Ok(halves) => halves,
            Err(share) => {
                let leaf = Leaf::new(share.references().iter().map(Reference::triangle));
                return Binary { bounds, kind: Kind::Leaf(leaf) };
            }
        };
        let (left, right) = if count > PARALLEL {
            rayon::join(|| self.subtree(left), || self.subtree(right))
        } else {
            (self.subtree(left), self.subtree(right))
        };
        let plan = Plan::new(bounds, &left, &right);
        Binary { bounds, kind: Kind::Inner(Box::new([left, right]), plan) }
    }

    /// Both halves of what is worth splitting, or else all of it, at most eight references.
    fn halves<'s>(&self, mut share: Share<'s>) -> Result<[Share<'s>; 2], Share<'s>> {
        let half_area = share.extent.bounds.half_area();
        if half_area < self.least_overlap {
            share.storage = &mut share.storage[..share.count];
        }
        let fits = share.count <= WIDTH;
        if share.count < 2 || (fits && share.depth >= BALANCED_BELOW) {
            return Err(share);
        }
        if share.depth >= BALANCED_BELOW {
            return Ok(share.at_middle());
        }
        let object = ObjectSplit::best(share.references(), &share.extent);
        let spatial = self.spatial_split(&share, object.as_ref());
        let cost = spatial.as_ref().map(|split| split.cost).or(object.map(|split| split.cost));
        if fits && cost.is_none_or(|cost| cost + CHILD_COST * half_area >= half_area) {
            return Err(share);
        }
        match (spatial, object) {
            (Some(split), _) => Ok(self.divide(&split, share)),
            (None, Some(split)) => Ok(share.at(&split)),
            (None, None) => Ok(share.at_middle()),
        }
    }

    /// A spatial split, where that is better than the object split and not too many copies.
    fn spatial_split(
        &self,
        share: &Share<'_>,
        object: Option<&ObjectSplit>,
    ) -> Option<SpatialSplit> {
        let object = object?;
        let [left, right] = object.bounds;
        let overlap = left.intersection(right).half_area();
        let bounds = share.extent.bounds;
        let spare = share.storage.len() - share.count;
        if spare == 0
            || share.count <= WIDTH
            || overlap < self.least_overlap.max(MIN_SHARE * bounds.half_area())
        {
            return None;
        }
        let split = SpatialSplit::best(self.triangles, share.references(), bounds)?;
        let affordable = split.copies(share.count) <= spare;
        (split.cost < WORTHWHILE * object.cost && affordable).then_some(split)
    }

    fn divide<'s>(&self, split: &SpatialSplit, share: Share<'s>) -> [Share<'s>; 2] {
        let division = split.divide(self.triangles, share.storage, share.count);
        let share = Share { count: division.both, ..share };
        let (left, right) = share.references().split_at(division.left);
        if left.is_empty() || right.is_empty() {
            return share.at_middle();
        }
        let extents = [left, right].map(Extent::new);
        share.cut(division.left, extents)
    }
}

impl<'a> Share<'a> {
    fn references(&self) -> &[Reference] {
        &self.storage[..self.count]
    }

    fn at(self, split: &ObjectSplit) -> [Self; 2] {
        let partition = split.partition(&mut self.storage[..self.count]);
        self.cut(partition.left, partition.extents)
    }

    fn at_middle(self) -> [Self; 2] {
        let left = self.count / 2;
        let (before, after) = self.references().split_at(left);
        let extents = [before, after].map(Extent::new);
        self.cut(left, extents)
    }

    /// The first `left` references and the others, each with their part of the room for copies.
    fn cut(self, left: usize, extents: [Extent; 2]) -> [Self; 2] {
        let spare = (self.storage.len() - self.count) as u64;
        let left_spare = (spare * left as u64 / self.count as u64) as usize;
        if left_spare > 0 {
            self.storage.copy_within(left..self.count, left + left_spare);
        }
        let storage = self.storage.split_at_mut(left + left_spare);
        let depth = self.depth + 1;
        [
            Self { storage: storage.0, count: left, extent: extents[0], depth },
            Self { storage: storage.1, count: self.count - left, extent: extents[1], depth },
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::ThreadPoolBuilder;

    /// Long and short triangles in all directions, enough of them for all that is done in parallel,
    /// and such that spatial splits pay.
    fn thicket(count: usize) -> Vec<[DVec3; 3]> {
        let mut state = 1_u64;
        let mut number = || {
            state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(1);
            (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
        };
        let mut point = |size: f64| size * DVec3::new(number(), number(), number());
        (0..count)
            .map(|i| {
                let a = point(1.0);
                let length = if i % 3 == 0 { 0.2 } else { 0.02 };
                [a, a + point(length), a + point(0.02)]
            })
            .collect()
    }

    #[test]
    fn the_number_of_threads_does_not_show() {
        let corners = thicket(70_000);
        let frame = Frame::new(DVec3::splat(-1.0), DVec3::splat(1.0));
        let tree_of = |threads| {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| collapse(&build(&corners, frame)))
        };
        let tree = tree_of(1);
        let copies = tree.leaves.iter().map(|leaf| leaf.triangles().len()).sum::<usize>();
        assert!(copies > corners.len() * 21 / 20, "no spatial splits to speak of: {copies}");
        for threads in [2, 7] {
            assert!(tree_of(threads) == tree, "another tree on {threads} threads");
        }
    }
}
