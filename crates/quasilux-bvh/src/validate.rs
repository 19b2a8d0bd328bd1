//! Whether a hierarchy is what the traversal takes it for.

use crate::frame::Frame;
use crate::node::{Block, Child, NONE, Node, WIDTH};
use crate::traverse::{MAX_DEPTH, Tree};
use glam::{DVec3, Vec3A};

/// Weights of the points of a triangle that must be in a box: corners, edges and inside.
const PROBES: [[f64; 3]; 10] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.5],
    [0.5, 0.0, 0.5],
    [0.1, 0.2, 0.7],
    [0.7, 0.1, 0.2],
    [0.2, 0.7, 0.1],
    [1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0],
];

/// A box of a child as it is stored.
#[derive(Clone, Copy)]
struct Stored {
    low: Vec3A,
    high: Vec3A,
}

/// What the walk over a tree has found so far.
struct Survey<'a> {
    tree: &'a Tree,
    frame: &'a Frame,
    /// How often each node and each block was met.
    nodes: Vec<u32>,
    blocks: Vec<u32>,
    /// A bit for each probe of each triangle that is in a box of its own.
    seen: Vec<u16>,
}

/// Checks depth, links, boxes and blocks.
pub(crate) fn validate(tree: &Tree, frame: &Frame) -> Result<(), String> {
    let mut survey = Survey {
        tree,
        frame,
        nodes: vec![0; tree.nodes.len()],
        blocks: vec![0; tree.blocks.len()],
        seen: vec![0; tree.corners.len()],
    };
    let all = Stored { low: Vec3A::NEG_INFINITY, high: Vec3A::INFINITY };
    survey.visit(Child::node(0), all, 0)?;
    if survey.nodes.iter().chain(&survey.blocks).any(|&count| count != 1) {
        return Err("a node or a block is not met exactly once".to_owned());
    }
    let every = (1 << PROBES.len()) - 1;
    match survey.seen.iter().position(|&seen| seen != every) {
        Some(triangle) => Err(format!("triangle {triangle} sticks out of its boxes")),
        None => Ok(()),
    }
}

impl Survey<'_> {
    fn visit(&mut self, child: Child, bounds: Stored, depth: usize) -> Result<(), String> {
        if child.is_block() {
            let block = self.tree.blocks.get(child.index()).ok_or("a block is missing")?;
            self.blocks[child.index()] += 1;
            return self.check_block(block, bounds);
        }
        if depth >= MAX_DEPTH {
            return Err(format!("deeper than {MAX_DEPTH} levels"));
        }
        let node = self.tree.nodes.get(child.index()).ok_or("a node is missing")?;
        self.nodes[child.index()] += 1;
        for slot in 0..WIDTH {
            let Some(stored) = stored(node, slot) else {
                continue;
            };
            if !bounds.contains(stored.low) || !bounds.contains(stored.high) {
                return Err(format!("a box sticks out of the box above it, at depth {depth}"));
            }
            self.visit(node.children[slot], stored, depth + 1)?;
        }
        Ok(())
    }

    fn check_block(&mut self, block: &Block, bounds: Stored) -> Result<(), String> {
        let triangles = block.triangles.iter().copied().filter(|&triangle| triangle != NONE);
        let mut here = Vec::with_capacity(WIDTH);
        for triangle in triangles {
            let corners =
                self.tree.corners.get(triangle as usize).ok_or("a triangle is missing")?;
            let framed = corners.points().map(|corner| self.frame.point(corner));
            here.push((triangle, framed));
            for (bit, weights) in PROBES.iter().enumerate() {
                let terms = framed.iter().zip(weights).map(|(corner, weight)| *corner * *weight);
                let inside = bounds.contains(terms.sum::<DVec3>().as_vec3a());
                self.seen[triangle as usize] |= u16::from(inside) << bit;
            }
        }
        if here.is_empty() {
            return Err("a block is empty".to_owned());
        }
        let fresh = Block::new(here.into_iter());
        if *block == fresh { Ok(()) } else { Err("a block differs from its triangles".to_owned()) }
    }
}

impl Stored {
    fn contains(&self, p: Vec3A) -> bool {
        self.low.cmple(p).all() && p.cmple(self.high).all()
    }
}

/// The box of a child; `None` where there is none.
fn stored(node: &Node, slot: usize) -> Option<Stored> {
    let corner =
        |side: usize| Vec3A::from_array([0, 1, 2].map(|axis| node.planes[2 * axis + side][slot]));
    let stored = Stored { low: corner(0), high: corner(1) };
    stored.low.cmple(stored.high).all().then_some(stored)
}
