//! A hierarchy of boxes: which of many small things may a segment meet, and which is nearest.

use crate::spectrum::Spectrum;
use crate::world::World;
use glam::DVec3;

/// Things in a leaf at most.
const LEAF: usize = 4;

/// Boxes around things that are known by their numbers.
pub(super) struct BoxTree {
    nodes: Vec<BoxNode>,
    /// Numbers of the things, leaf by leaf.
    things: Vec<u32>,
}

/// A box around things.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoxNode {
    pub(super) low: DVec3,
    pub(super) high: DVec3,
    /// The number of the first of two children, or of the first thing.
    first: u32,
    /// Things in it; 0 where it has children.
    count: u32,
}

/// Contents of a box.
pub(super) enum Inside<'t> {
    Boxes([u32; 2]),
    Things(&'t [u32]),
}

impl BoxTree {
    /// Around things with these corners.
    pub(super) fn new(corners: &[[DVec3; 2]]) -> Self {
        let mut things: Vec<u32> = (0..corners.len() as u32).collect();
        let mut nodes = Vec::new();
        if !things.is_empty() {
            nodes.push(around(corners, &things));
            let mut open = vec![(0_usize, 0, things.len())];
            while let Some((node, first, end)) = open.pop() {
                let BoxNode { low, high, .. } = nodes[node];
                if end - first <= LEAF {
                    (nodes[node].first, nodes[node].count) = (first as u32, (end - first) as u32);
                    continue;
                }
                let axis = (high - low).max_position();
                let middle = (first + end) / 2;
                let along = |thing: &u32| {
                    let [low, high] = corners[*thing as usize];
                    low[axis] + high[axis]
                };
                things[first..end].select_nth_unstable_by(middle - first, |a, b| {
                    along(a).total_cmp(&along(b)).then(a.cmp(b))
                });
                let left = nodes.len();
                nodes.push(around(corners, &things[first..middle]));
                nodes.push(around(corners, &things[middle..end]));
                nodes[node].first = left as u32;
                open.push((left, first, middle));
                open.push((left + 1, middle, end));
            }
        }
        Self { nodes, things }
    }

    /// Around these facets, which are its things in this order.
    pub(super) fn of_facets<S: Spectrum>(world: &World<S>, facets: &[usize]) -> Self {
        let corners = facets.iter().map(|number| {
            let [a, b, c] = world.facets[*number].corners();
            [a.min(b).min(c), a.max(b).max(c)]
        });
        Self::new(&corners.collect::<Vec<[DVec3; 2]>>())
    }

    /// The box around everything.
    pub(super) fn root(&self) -> Option<u32> {
        (!self.nodes.is_empty()).then_some(0)
    }

    pub(super) fn node(&self, number: u32) -> &BoxNode {
        &self.nodes[number as usize]
    }

    pub(super) fn inside(&self, number: u32) -> Inside<'_> {
        let node = self.node(number);
        let first = node.first as usize;
        match node.count {
            0 => Inside::Boxes([node.first, node.first + 1]),
            count => Inside::Things(&self.things[first..first + count as usize]),
        }
    }

    /// The largest value of the things in each box, by its number.
    pub(super) fn largest_in(&self, value: impl Fn(u32) -> f64) -> Vec<f64> {
        let mut largest = vec![0.0; self.nodes.len()];
        // Children have larger numbers.
        for number in (0..self.nodes.len()).rev() {
            largest[number] = match self.inside(number as u32) {
                Inside::Boxes([a, b]) => f64::max(largest[a as usize], largest[b as usize]),
                Inside::Things(things) => things.iter().map(|it| value(*it)).fold(0.0, f64::max),
            };
        }
        largest
    }

    /// Tells of all things whose box a segment meets.
    pub(super) fn on_segment(
        &self,
        from: DVec3,
        direction: DVec3,
        length_m: f64,
        mut meet: impl FnMut(u32),
    ) {
        let inverse = direction.recip();
        let mut open = [0_u32; 64];
        let mut count = usize::from(!self.nodes.is_empty());
        while count > 0 {
            count -= 1;
            let number = open[count];
            let node = self.node(number);
            let (a, b) = ((node.low - from) * inverse, (node.high - from) * inverse);
            // NaN, on a face of the box, counts as met.
            let near = a.min(b).max_element().max(0.0);
            let far = a.max(b).min_element().min(length_m);
            if near > far {
                continue;
            }
            match self.inside(number) {
                Inside::Boxes(children) => {
                    open[count..count + 2].copy_from_slice(&children);
                    count += 2;
                }
                Inside::Things(things) => things.iter().copied().for_each(&mut meet),
            }
        }
    }
}

fn around(corners: &[[DVec3; 2]], things: &[u32]) -> BoxNode {
    let boxes = things.iter().map(|thing| corners[*thing as usize]);
    let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
    let [low, high] = boxes.fold(empty, |[low, high], [a, b]| [low.min(a), high.max(b)]);
    BoxNode { low, high, first: 0, count: 0 }
}
