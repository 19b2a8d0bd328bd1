//! Validation of a hierarchy against all assumptions of the traversal.
//!
//! What the traversal relies on, all of which is checked: indices exist, no way down is longer than
//! its stack, boxes lie in the boxes above them, places without a child cannot be met, blocks hold
//! what their triangles make them hold, the frame holds all corners, and every point of every
//! triangle is in a box of the triangle, with the margin that the bounds on rounding ask for
//! ([`GROWTH`]).

use crate::coverage::{Solid, is_covered};
use crate::frame::{Frame, H};
use crate::node::{Block, Child, FramedTriangle, GROWTH, NONE, Node, WIDTH};
use crate::traversal_stack::MAX_DEPTH;
use crate::traverse::Tree;
use glam::Vec3A;

/// How far inside of its box everything must be: the growth, but for the rounding of the box and of
/// its grown planes.
const MARGIN: f64 = (GROWTH - 2.0 * H) as f64;

/// A box of a child as it is stored.
#[derive(Clone, Copy)]
struct Stored {
    low: Vec3A,
    high: Vec3A,
}

/// Findings of the walk over a tree so far.
struct Survey<'a> {
    tree: &'a Tree,
    frame: &'a Frame,
    /// How often each node and each block was met.
    nodes: Vec<u32>,
    blocks: Vec<u32>,
    /// Boxes with the triangles in them.
    boxes: Vec<(u32, Stored)>,
}

/// Checks depth, links, boxes and blocks.
pub(crate) fn validate(tree: &Tree, frame: &Frame) -> Result<(), String> {
    let mut survey = Survey {
        tree,
        frame,
        nodes: vec![0; tree.nodes.len()],
        blocks: vec![0; tree.blocks.len()],
        boxes: Vec::new(),
    };
    let all = Stored { low: Vec3A::NEG_INFINITY, high: Vec3A::INFINITY };
    survey.visit(Child::node(0), all, 0)?;
    // Without triangles there is one block all the same, for places without a child to lead to.
    let blocks = if tree.corners.is_empty() { &[] } else { &*survey.blocks };
    if survey.nodes.iter().chain(blocks).any(|&count| count != 1) {
        return Err("a node or a block is not met exactly once".to_owned());
    }
    survey.check_triangles()
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
            let Some(stored) = stored(node, slot)? else {
                let nowhere = node.children[slot];
                if nowhere.is_block() && nowhere.index() < self.tree.blocks.len() {
                    continue;
                }
                return Err("a place without a child does not lead to a block".to_owned());
            };
            if !bounds.contains(&stored) {
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
            let corners = corners.points().map(|corner| self.frame.point(corner));
            here.push(FramedTriangle { triangle, corners });
            self.boxes.push((triangle, bounds));
        }
        if here.is_empty() {
            return Err("a block is empty".to_owned());
        }
        let fresh = Block::new(here.into_iter());
        if *block == fresh { Ok(()) } else { Err("a block differs from its triangles".to_owned()) }
    }

    fn check_triangles(&mut self) -> Result<(), String> {
        self.boxes.sort_by_key(|&(triangle, _)| triangle);
        let mut boxes = self.boxes.chunk_by(|a, b| a.0 == b.0).peekable();
        for (triangle, corners) in self.tree.corners.iter().enumerate() {
            let framed = corners.points().map(|corner| self.frame.point(corner));
            if !framed.iter().all(|p| p.abs().max_element() <= 1.0) {
                return Err(format!("triangle {triangle} sticks out of the frame"));
            }
            let own = boxes.next_if(|own| own[0].0 as usize == triangle).unwrap_or_default();
            let solids: Vec<Solid> = own.iter().map(|(_, stored)| stored.solid()).collect();
            if !is_covered(framed, &solids) {
                return Err(format!("triangle {triangle} sticks out of its boxes"));
            }
        }
        Ok(())
    }
}

impl Stored {
    fn contains(&self, other: &Self) -> bool {
        self.low.cmple(other.low).all() && other.high.cmple(self.high).all()
    }

    /// The box, smaller by the margin on all sides.
    fn solid(&self) -> Solid {
        let (low, high) = (self.low.as_dvec3(), self.high.as_dvec3());
        Solid { low: low + MARGIN, high: high - MARGIN }
    }
}

/// The box of a child; `None` where there is none.
fn stored(node: &Node, slot: usize) -> Result<Option<Stored>, String> {
    let of = |node: &Node, side: usize| {
        Vec3A::from_array([0, 1, 2].map(|axis| node.planes[2 * axis + side][slot]))
    };
    let stored = Stored { low: of(node, 0), high: of(node, 1) };
    if stored.low == of(&Node::EMPTY, 0) && stored.high == of(&Node::EMPTY, 1) {
        return Ok(None);
    }
    let ordered = stored.low.cmple(stored.high).all() && (stored.high - stored.low).is_finite();
    if ordered { Ok(Some(stored)) } else { Err("a box is neither a box nor empty".to_owned()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Corners, TriangleBvh};
    use glam::DVec3;

    /// Large triangles across each other, which have spatial splits, and small ones.
    fn mesh() -> Vec<[DVec3; 3]> {
        let at = |i: usize| {
            let part = |prime: usize| (i * prime % 101) as f64 / 101.0;
            DVec3::new(part(37), part(53), part(71))
        };
        let large = (0..40).map(|i| [at(3 * i), at(3 * i + 1), at(3 * i + 2)]);
        let small = (0..200).map(|i| [at(i), at(i) + 0.01 * at(i + 7), at(i) + 0.01 * at(i + 8)]);
        large.chain(small).collect()
    }

    /// Message about a tree after a change.
    fn flaw(change: impl FnOnce(&mut Tree)) -> String {
        let mut bvh = TriangleBvh::build(mesh());
        assert_eq!(bvh.validate(), Ok(()));
        change(&mut bvh.tree);
        bvh.validate().unwrap_err()
    }

    /// A place of a block below the root.
    struct BlockSlot {
        node: usize,
        slot: usize,
    }

    /// The first place of a block below the root.
    fn above_a_block(tree: &Tree) -> BlockSlot {
        let slot = |node: &Node| {
            (0..WIDTH).find(|&slot| {
                node.children[slot].is_block() && node.planes[0][slot] < f32::INFINITY
            })
        };
        let mut places = tree.nodes.iter().enumerate().skip(1);
        places.find_map(|(i, node)| Some(BlockSlot { node: i, slot: slot(node)? })).unwrap()
    }

    #[test]
    fn boxes_without_their_margin_are_found() {
        for plane in 0..6 {
            let inward = if plane % 2 == 0 { GROWTH } else { -GROWTH };
            let mut found = 0;
            let blocks = TriangleBvh::build(mesh()).tree.nodes.len();
            for node in 0..blocks {
                let mut bvh = TriangleBvh::build(mesh());
                for slot in 0..WIDTH {
                    bvh.tree.nodes[node].planes[plane][slot] += inward;
                }
                found += usize::from(bvh.validate().is_err());
            }
            assert_eq!(found, blocks, "plane {plane}");
        }
    }

    #[test]
    fn wrong_boxes_are_found() {
        let flawed = flaw(|tree| {
            let BlockSlot { node, slot } = above_a_block(tree);
            tree.nodes[node].planes[1][slot] += 9.0;
        });
        assert!(flawed.contains("out of the box above"), "{flawed}");
        for wrong in [f32::NAN, f32::INFINITY, -9.0] {
            let flawed = flaw(|tree| {
                let BlockSlot { node, slot } = above_a_block(tree);
                tree.nodes[node].planes[3][slot] = wrong;
            });
            assert!(flawed.contains("neither"), "{flawed}");
        }
        let flawed = flaw(|tree| {
            let BlockSlot { node, slot } = above_a_block(tree);
            for plane in 0..6 {
                tree.nodes[node].planes[plane][slot] = Node::EMPTY.planes[plane][slot];
            }
        });
        assert!(flawed.contains("exactly once"), "{flawed}");
    }

    #[test]
    fn wrong_links_are_found() {
        let link = |to: fn(&Tree, Child) -> Child| {
            flaw(|tree| {
                let BlockSlot { node, slot } = above_a_block(tree);
                let child = tree.nodes[node].children[slot];
                tree.nodes[node].children[slot] = to(tree, child);
            })
        };
        assert!(link(|tree, _| Child::block(tree.blocks.len())).contains("block is missing"));
        assert!(link(|tree, _| Child::node(tree.nodes.len())).contains("node is missing"));
        let looped = link(|_, _| Child::node(0));
        assert!(looped.contains("deeper") || looped.contains("out of the box above"), "{looped}");
        let swapped = link(|tree, child| Child::block((child.index() + 1) % tree.blocks.len()));
        assert!(swapped.contains("exactly once"), "{swapped}");
        let flawed = flaw(|tree| tree.nodes[0].children = [Child::node(1); WIDTH]);
        assert!(flawed.contains("out of the box above"), "{flawed}");
        assert!(flaw(|tree| tree.nodes.clear()).contains("node is missing"));
        assert!(flaw(|tree| tree.nodes.push(Node::EMPTY)).contains("exactly once"));
    }

    #[test]
    fn long_ways_down_are_found() {
        let flawed = flaw(|tree| {
            // Nodes above the root, each with all of it in its only child.
            let count = tree.nodes.len();
            let root = tree.nodes[0].clone();
            for i in 0..MAX_DEPTH {
                let mut above = Node::EMPTY;
                let next = if i + 1 == MAX_DEPTH { 0 } else { count + i + 1 };
                above.set(0, Vec3A::splat(-2.0), Vec3A::splat(2.0), Child::node(next));
                tree.nodes.push(above);
            }
            tree.nodes.swap(0, count);
            tree.nodes[count] = root;
            let last = tree.nodes.len() - 1;
            tree.nodes[last].children[0] = Child::node(count);
        });
        assert!(flawed.contains("deeper"), "{flawed}");
    }

    #[test]
    fn wrong_blocks_and_triangles_are_found() {
        let differs = [
            |block: &mut Block| block.slack.weight = 0.0,
            |block: &mut Block| block.slack.rest *= 0.999,
            |block: &mut Block| block.slack.distance = 0.0,
            |block: &mut Block| block.edge_1[0][0] *= 1.0001,
            |block: &mut Block| block.edge_2[1][0] += 1e-7,
            |block: &mut Block| block.corner[2][0] += 1e-6,
            |block: &mut Block| block.triangles[0] ^= 1,
        ];
        for change in differs {
            let flawed = flaw(|tree| change(&mut tree.blocks[0]));
            assert!(flawed.contains("differs"), "{flawed}");
        }
        let flawed = flaw(|tree| tree.blocks[0].triangles[0] = tree.corners.len() as u32);
        assert!(flawed.contains("triangle is missing"), "{flawed}");
        let flawed = flaw(|tree| tree.blocks[0].triangles = [NONE; WIDTH]);
        assert!(flawed.contains("empty"), "{flawed}");
        let flawed = flaw(|tree| tree.corners.push(Corners::new([DVec3::splat(0.5); 3])));
        assert!(flawed.contains("out of its boxes"), "{flawed}");
        let flawed = flaw(|tree| tree.corners.push(Corners::new([DVec3::splat(50.0); 3])));
        assert!(flawed.contains("out of the frame"), "{flawed}");
    }
}
