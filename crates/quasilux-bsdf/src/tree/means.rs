//! Means over exit squares, as functions of the incident direction.
//!
//! The mean of a branch is a function of the incidence, constant in boxes: a tree over the incident
//! axes alone. At an incidence it is the mean over four children, so its boxes are those that all
//! four agree on. A full tree of height h has 2^(h d) of them at a node, d incident axes, and the
//! nodes of all levels together a third of the leaves of the whole tree.

use super::{Incidence, Node};

/// Trees over the incident axes, one for each branch.
#[derive(Clone, Debug, Default)]
pub(super) struct Means(Vec<MeanNode>);

#[derive(Clone, Copy, Debug, Default)]
struct MeanNode {
    /// Of a leaf.
    value: f64,
    /// Of a branch: the index of its first child. 0 in a leaf: no first child is the first node.
    first_child: u32,
}

/// A box of incident directions: number `cell` along each axis, 2^`level` a side.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct IncidentBox {
    pub(super) level: usize,
    pub(super) cell: [u32; 2],
}

/// A function of the incidence.
#[derive(Clone, Copy, Debug)]
enum Mean {
    Constant(f64),
    Node(u32),
}

impl Means {
    /// The value at an incidence, of the tree of a branch of that level.
    pub(super) fn at(&self, root: u32, mut level: usize, incidence: Incidence) -> f64 {
        let mut node = self.0[root as usize];
        while node.first_child != 0 {
            node = self.0[node.first_child as usize + incidence.half(level)];
            level += 1;
        }
        node.value
    }

    /// The boxes in which the tree of the root is constant.
    pub(super) fn boxes(&self, root: u32, incident_axes: usize) -> Vec<IncidentBox> {
        let (mut boxes, mut open) = (Vec::new(), vec![(root, IncidentBox::default())]);
        while let Some((node, at)) = open.pop() {
            let first = self.0[node as usize].first_child;
            if first == 0 {
                boxes.push(at);
                continue;
            }
            for half in (0..1_u32 << incident_axes).rev() {
                let cell = [0, 1].map(|axis| 2 * at.cell[axis] + (half >> axis & 1));
                open.push((first + half, IncidentBox { level: at.level + 1, cell }));
            }
        }
        boxes
    }

    /// Makes the means of all branches; children lie behind their parents. `None` if there are too
    /// many.
    pub(super) fn new(nodes: &mut [Node], incident_axes: usize) -> Option<Self> {
        let mut means = Self::default();
        for index in (0..nodes.len()).rev() {
            let first = nodes[index].first_child as usize;
            if first == 0 {
                continue;
            }
            let root = means.push_block(1)?;
            let children = means.push_block(1 << incident_axes)?;
            means.0[root as usize].first_child = children;
            for incident in 0..1 << incident_axes {
                let of_child = |exit: usize| {
                    let child = &nodes[first + incident + (exit << incident_axes)];
                    match child.first_child {
                        0 => Mean::Constant(child.value),
                        _ => Mean::Node(child.mean),
                    }
                };
                let merged = [0, 1, 2, 3].map(of_child);
                means.merge(merged, children + incident as u32, incident_axes)?;
            }
            nodes[index].mean = root;
        }
        Some(means)
    }

    /// Writes the mean of four functions to a node.
    fn merge(&mut self, means: [Mean; 4], into: u32, incident_axes: usize) -> Option<()> {
        let is_branch = |mean: &Mean| match *mean {
            Mean::Constant(_) => false,
            Mean::Node(node) => self.0[node as usize].first_child != 0,
        };
        if !means.iter().any(is_branch) {
            let sum: f64 = means.into_iter().map(|mean| self.constant(mean)).sum();
            self.0[into as usize].value = 0.25 * sum;
            return Some(());
        }
        let children = self.push_block(1 << incident_axes)?;
        self.0[into as usize].first_child = children;
        for incident in 0..1 << incident_axes {
            let parts = means.map(|mean| match mean {
                Mean::Node(node) if is_split(&self.0, node) => {
                    Mean::Node(self.0[node as usize].first_child + incident)
                }
                other => other,
            });
            self.merge(parts, children + incident, incident_axes)?;
        }
        Some(())
    }

    fn constant(&self, mean: Mean) -> f64 {
        match mean {
            Mean::Constant(value) => value,
            Mean::Node(node) => self.0[node as usize].value,
        }
    }

    /// The index of new nodes.
    fn push_block(&mut self, count: usize) -> Option<u32> {
        let first = u32::try_from(self.0.len()).ok()?;
        self.0.resize(self.0.len() + count, MeanNode::default());
        Some(first)
    }
}

fn is_split(nodes: &[MeanNode], node: u32) -> bool {
    nodes[node as usize].first_child != 0
}
