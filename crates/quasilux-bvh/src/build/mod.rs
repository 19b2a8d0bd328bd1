//! A binary tree over triangles, by the surface area heuristic.
//!
//! Costs are expected visits of blocks of up to eight triangles, so a side counts its blocks,
//! not its triangles. What is built does not depend on the number of threads: subtrees share
//! nothing, and bins are merged by minima, maxima and sums of integers.

mod bins;
mod reference;
mod spatial;
mod wide;

pub(crate) use wide::{Leaf, WideTree, collapse};

use crate::frame::Frame;
use crate::node::WIDTH;
use bins::ObjectSplit;
use glam::DVec3;
use reference::{Bounds, Reference};
use spatial::{LEAST_OVERLAP, MOST_COPIES, SpatialSplit, Triangles, WORTHWHILE};
use wide::Plan;

/// A binary tree.
pub(crate) struct Binary {
    bounds: Bounds,
    kind: Kind,
}

/// What is below a node of a binary tree.
enum Kind {
    Leaf(Leaf),
    /// Two halves, and how they are best spread over the slots of wide nodes.
    Inner(Box<[Binary; 2]>, Plan),
}

/// Below this depth halves have equally many triangles, which bounds the depth.
const BALANCED_BELOW: u32 = 32;

/// Subtrees with more references are built on all threads.
const PARALLEL: usize = 2048;

/// What a child costs its parent, in units of a block.
const CHILD_COST: f32 = 0.3;

/// The tree over all triangles, of which there must be some.
pub(crate) fn build(corners: &[[DVec3; 3]], frame: Frame) -> Binary {
    let references = reference::all(corners, &frame);
    let bounds = reference::bounds(&references);
    let builder =
        Builder { triangles: Triangles { corners, frame }, half_area: bounds.half_area() };
    let spare = (references.len() as f64 * MOST_COPIES) as usize;
    builder.subtree(Share { references, bounds, spare, depth: 0 })
}

struct Builder<'a> {
    triangles: Triangles<'a>,
    /// Half the surface of everything.
    half_area: f32,
}

/// The references of a subtree, and how many copies it may make of them.
struct Share {
    references: Vec<Reference>,
    bounds: Bounds,
    spare: usize,
    depth: u32,
}

impl Builder<'_> {
    fn subtree(&self, share: Share) -> Binary {
        let (count, bounds) = (share.references.len(), share.bounds);
        let [left, right] = match self.halves(share) {
            Ok(halves) => halves,
            Err(share) => {
                let leaf = Leaf::new(share.references.iter().map(Reference::triangle));
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
    fn halves(&self, share: Share) -> Result<[Share; 2], Share> {
        let count = share.references.len();
        let fits = count <= WIDTH;
        if count < 2 || (fits && share.depth >= BALANCED_BELOW) {
            return Err(share);
        }
        if share.depth >= BALANCED_BELOW {
            return Ok(share.at_middle());
        }
        let object = ObjectSplit::best(&share.references);
        let spatial = self.spatial_split(&share, object.as_ref());
        let cost = spatial.as_ref().map(|split| split.cost).or(object.map(|split| split.cost));
        if fits
            && cost.is_none_or(|cost| {
                cost + CHILD_COST * share.bounds.half_area() >= share.bounds.half_area()
            })
        {
            return Err(share);
        }
        match (spatial, object) {
            (Some(split), _) => Ok(self.divide(&split, share)),
            (None, Some(split)) => Ok(share.at(&split)),
            (None, None) => Ok(share.at_middle()),
        }
    }

    /// A spatial split, where that is better than the object split and not too many copies.
    fn spatial_split(&self, share: &Share, object: Option<&ObjectSplit>) -> Option<SpatialSplit> {
        let object = object?;
        let [left, right] = object.bounds;
        let overlap = left.intersection(right).half_area();
        if share.spare == 0
            || share.references.len() <= WIDTH
            || overlap < LEAST_OVERLAP * self.half_area
        {
            return None;
        }
        let split = SpatialSplit::best(self.triangles, &share.references, share.bounds)?;
        let affordable = split.copies(share.references.len()) <= share.spare;
        (split.cost < WORTHWHILE * object.cost && affordable).then_some(split)
    }

    fn divide(&self, split: &SpatialSplit, share: Share) -> [Share; 2] {
        let before = share.references.len();
        let sides = split.divide(self.triangles, share.references);
        let [left, right] = sides.references;
        let after = left.len() + right.len();
        let spare = share.spare - (after - before);
        let left_spare = (spare as u64 * left.len() as u64 / after as u64) as usize;
        let depth = share.depth + 1;
        [
            Share { references: left, bounds: sides.bounds[0], spare: left_spare, depth },
            Share { references: right, bounds: sides.bounds[1], spare: spare - left_spare, depth },
        ]
    }
}

impl Share {
    fn at(mut self, split: &ObjectSplit) -> [Self; 2] {
        let left = split.partition(&mut self.references);
        self.cut(left, split.bounds)
    }

    fn at_middle(self) -> [Self; 2] {
        let left = self.references.len() / 2;
        let parts = self.references.split_at(left);
        let bounds = [parts.0, parts.1].map(reference::bounds);
        self.cut(left, bounds)
    }

    fn cut(mut self, left: usize, bounds: [Bounds; 2]) -> [Self; 2] {
        let count = self.references.len();
        let right = self.references.split_off(left);
        let left_spare = (self.spare as u64 * left as u64 / count as u64) as usize;
        let depth = self.depth + 1;
        [
            Self { references: self.references, bounds: bounds[0], spare: left_spare, depth },
            Self { references: right, bounds: bounds[1], spare: self.spare - left_spare, depth },
        ]
    }
}
