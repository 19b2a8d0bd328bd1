//! From a binary to an eight-wide tree of least expected cost.
//!
//! A subtree can take up to eight slots of the wide node above it. The cost of each number of slots
//! follows from those of the halves (Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray
//! Traversal on GPUs Through Compressed Wide BVHs", High Performance Graphics, section 3.1).
//! Deviation: leaves are those of the binary tree.

use super::reference::Bounds;
use crate::node::{Child, Node, WIDTH};

/// Cost of a wide node, in units of a block.
const NODE_COST: f32 = 1.0;

/// A binary tree.
pub(crate) struct Binary {
    pub(super) bounds: Bounds,
    pub(super) kind: Kind,
}

/// A node of a binary tree.
pub(super) enum Kind {
    Leaf(Leaf),
    /// Two halves, and how they are best spread over the slots of wide nodes.
    Inner(Box<[Binary; 2]>, Plan),
}

/// Up to eight triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Leaf {
    triangles: [u32; WIDTH],
    count: u32,
}

/// The least costs of a subtree, and how they come about.
pub(crate) struct Plan {
    /// Cost with at most 1, 2, ... 8 slots.
    costs: [f32; WIDTH],
    /// Number of slots that the left half gets; 0 if one slot less is as good.
    left: [u8; WIDTH],
    /// Number of slots that the left half gets inside of a wide node of its own.
    left_below: u8,
}

/// Wide nodes, the root first, and what their blocks hold.
#[derive(Debug, PartialEq)]
pub(crate) struct WideTree {
    pub(crate) nodes: Vec<Node>,
    pub(crate) leaves: Vec<Leaf>,
}

impl Leaf {
    pub(crate) fn new(triangles: impl ExactSizeIterator<Item = u32>) -> Self {
        let mut leaf = Self { triangles: [0; WIDTH], count: triangles.len() as u32 };
        for (slot, triangle) in leaf.triangles.iter_mut().zip(triangles) {
            *slot = triangle;
        }
        leaf
    }

    pub(crate) fn triangles(&self) -> &[u32] {
        &self.triangles[..self.count as usize]
    }
}

impl Plan {
    pub(crate) fn new(bounds: Bounds, left: &Binary, right: &Binary) -> Self {
        let (left, right) = (left.costs(), right.costs());
        let mut plan = Self { costs: [0.0; WIDTH], left: [0; WIDTH], left_below: 0 };
        for slots in 2..=WIDTH {
            let shares = (1..slots).map(|l| (left[l - 1] + right[slots - l - 1], l as u8));
            let (cost, share) =
                shares.fold((f32::INFINITY, 0), |a, b| if b.0 < a.0 { b } else { a });
            (plan.costs[slots - 1], plan.left[slots - 1]) = (cost, share);
        }
        plan.costs[0] = plan.costs[WIDTH - 1] + NODE_COST * bounds.half_area();
        plan.left_below = plan.left[WIDTH - 1];
        for slots in 2..=WIDTH {
            if plan.costs[slots - 1] >= plan.costs[slots - 2] {
                plan.costs[slots - 1] = plan.costs[slots - 2];
                plan.left[slots - 1] = 0;
            }
        }
        plan
    }
}

impl Binary {
    fn costs(&self) -> [f32; WIDTH] {
        match &self.kind {
            Kind::Leaf(_) => [self.bounds.half_area(); WIDTH],
            Kind::Inner(_, plan) => plan.costs,
        }
    }

    /// The subtrees that take the slots of the wide node above.
    fn spread<'a>(&'a self, slots: usize, into: &mut Vec<&'a Self>) {
        match &self.kind {
            Kind::Inner(_, plan) if slots > 1 && plan.left[slots - 1] == 0 => {
                self.spread(slots - 1, into);
            }
            Kind::Inner(halves, plan) if slots > 1 => {
                let left = plan.left[slots - 1] as usize;
                halves[0].spread(left, into);
                halves[1].spread(slots - left, into);
            }
            _ => into.push(self),
        }
    }
}

/// The wide tree of a binary one.
pub(crate) fn collapse(binary: &Binary) -> WideTree {
    let mut tree = WideTree { nodes: Vec::new(), leaves: Vec::new() };
    if let Kind::Leaf(_) = binary.kind {
        tree.nodes.push(Node::EMPTY);
        let child = tree.place(binary);
        tree.nodes[0].set(0, binary.bounds.low, binary.bounds.high, child);
    } else {
        tree.place(binary);
    }
    tree
}

impl WideTree {
    fn place(&mut self, binary: &Binary) -> Child {
        let (halves, plan) = match &binary.kind {
            Kind::Leaf(leaf) => {
                self.leaves.push(*leaf);
                return Child::block(self.leaves.len() - 1);
            }
            Kind::Inner(halves, plan) => (halves, plan),
        };
        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        let mut children = Vec::with_capacity(WIDTH);
        let left = plan.left_below as usize;
        halves[0].spread(left, &mut children);
        halves[1].spread(WIDTH - left, &mut children);
        for (slot, child) in children.into_iter().enumerate() {
            let placed = self.place(child);
            self.nodes[index].set(slot, child.bounds.low, child.bounds.high, placed);
        }
        Child::node(index)
    }
}
