//! Trees from branches and grids of values, and trees turned round.

use super::means::Means;
use super::{DEEPEST, Node, TensorTree};
use std::sync::Arc;

/// A tree that is being built, from the root on.
#[derive(Debug)]
pub(crate) struct TreeBuilder {
    incident_axes: usize,
    nodes: Vec<Node>,
    height: usize,
}

impl TreeBuilder {
    /// Begins with a root that is a leaf of value zero, number 0. `incident_axes` is 1 or 2.
    pub(crate) fn new(incident_axes: usize) -> Self {
        Self { incident_axes, nodes: vec![Node::default()], height: 0 }
    }

    /// The same with room for this many nodes, and no more.
    fn with_room(incident_axes: usize, nodes: usize) -> Self {
        let mut builder = Self::new(incident_axes);
        builder.nodes.reserve_exact(nodes);
        builder
    }

    /// Axes of the tree.
    pub(crate) fn axes(&self) -> usize {
        self.incident_axes + 2
    }

    /// Makes a branch of a leaf at `level`, and returns the number of its first child; `None` if
    /// the tree becomes too deep or too large.
    pub(crate) fn branch(&mut self, node: usize, level: usize) -> Option<usize> {
        let first = self.nodes.len();
        let end = first.checked_add(1 << self.axes())?;
        if level >= DEEPEST || u32::try_from(end).is_err() {
            return None;
        }
        self.nodes.resize(end, Node::default());
        self.nodes[node].first_child = first as u32;
        self.height = self.height.max(level + 1);
        Some(first)
    }

    /// Writes a grid of values with 2^`log_side` of them along each axis, the last axis running
    /// fastest, to a leaf at `level`. `None` as in [`Self::branch`].
    pub(crate) fn grid(
        &mut self,
        node: usize,
        level: usize,
        values: &[f64],
        log_side: usize,
    ) -> Option<()> {
        // All boxes of all sizes: less than twice the values.
        let (mut boxes, mut nodes) = (values.len(), 0_usize);
        while boxes > 1 {
            nodes += boxes;
            boxes >>= self.axes();
        }
        if nodes > 2 * self.nodes.capacity() {
            self.nodes.reserve_exact(nodes);
        }
        self.part(node, level, Part { values, log_side, log_size: log_side, start: 0 })
    }

    fn part(&mut self, node: usize, level: usize, part: Part<'_>) -> Option<()> {
        if part.log_size == 0 {
            self.nodes[node].value = part.values[part.start];
            return Some(());
        }
        let first = self.branch(node, level)?;
        let axes = self.axes();
        let half = 1 << (part.log_size - 1);
        for child in 0..1 << axes {
            let stride = |axis: usize| half << (part.log_side * (axes - 1 - axis));
            let offset: usize = (0..axes).map(|axis| (child >> axis & 1) * stride(axis)).sum();
            let part = Part { log_size: part.log_size - 1, start: part.start + offset, ..part };
            self.part(first + child, level + 1, part)?;
        }
        Some(())
    }

    /// The finished tree; `None` if its means become too many.
    pub(crate) fn finish(mut self) -> Option<TensorTree> {
        self.nodes.shrink_to_fit();
        let means = Means::new(&mut self.nodes, self.incident_axes)?;
        let Self { incident_axes, nodes, height } = self;
        Some(TensorTree { incident_axes, nodes: Arc::new(nodes), means: Arc::new(means), height })
    }
}

/// A cube of a grid of values.
#[derive(Clone, Copy)]
struct Part<'v> {
    values: &'v [f64],
    /// Of the grid.
    log_side: usize,
    /// Of the cube.
    log_size: usize,
    /// Of the cube's first value.
    start: usize,
}

impl TensorTree {
    /// The adjoint, for light that travels in reverse, from the other side: f'(wi, wo) = f(wo, wi).
    ///
    /// Of rank 4: the squares of a direction and of its opposite are mirror images, and the old
    /// place of an axis is one less the new place of its counterpart. `None` of rank 3, see
    /// [`AdjointTree`](super::AdjointTree).
    pub(crate) fn adjoint(&self) -> Option<Self> {
        if self.is_isotropic() {
            return None;
        }
        let mut builder = TreeBuilder::with_room(self.incident_axes, self.nodes.len());
        self.reverse_into(&mut builder, [0, 0], 0)?;
        builder.finish()
    }

    fn reverse_into(
        &self,
        builder: &mut TreeBuilder,
        [from, to]: [usize; 2],
        level: usize,
    ) -> Option<()> {
        let Node { value, first_child, .. } = self.nodes[from];
        if first_child == 0 {
            builder.nodes[to].value = value;
            return Some(());
        }
        let first = builder.branch(to, level)?;
        for child in 0..16 {
            let opposite = (child >> 2 | child << 2) & 15 ^ 15;
            self.reverse_into(
                builder,
                [first_child as usize + opposite, first + child],
                level + 1,
            )?;
        }
        Some(())
    }
}
