//! Shaft culling: four planes through the origins of a group of rays and two across.
//!
//! Let `z` be the coordinate along the heading, so that all rays rise in it, and `s = dx / dz` the
//! slope of a ray aside. For slopes in `[s0, s1]` each point of a ray has `x - s0 z >= ox - s0 oz`
//! and `s1 z - x >= s1 oz - ox`, and so has each point of all rays with the least right sides among
//! them. A box is outside where the largest left side in it falls short, and so is a triangle.
//!
//! Rounding, in units of `h`, with slopes at most below 3: slopes are off by four of themselves,
//! which over a depth of `3.7` is `45`; origins by `2`, so right sides by `2 + 3 * 2` and their
//! rounding by `14`; left sides by `9`, and by `12 (1 + 3)` more where the corners of a triangle
//! come from its edges. The sum is `124`.

use crate::frame::H;
use crate::group::coherence::Heading;
use crate::group::rays::Rays;
use crate::lanes::Lanes;
use crate::node::{Block, Node};
use crate::ray_simd::Crossing;

/// Distance by which planes are moved outward.
const SLACK: f32 = 160.0 * H;

/// The space around the rays of a group.
pub(crate) struct Shaft<L> {
    pub(crate) heading: Heading,
    /// One or minus one: the sense of the heading.
    sense: L,
    /// Where the first ray starts along the heading.
    front: f32,
    /// The least and largest slopes aside.
    pub(crate) slopes: [[f32; 2]; 2],
    sides: [Side<L>; 4],
}

/// A plane that rays are on one side of: `z tilt + sign x >= bound`.
#[derive(Clone, Copy)]
struct Side<L> {
    tilt: L,
    bound: L,
    /// Which of a node's planes is the outermost along the heading.
    along: usize,
}

impl<L: Lanes> Shaft<L> {
    /// The shaft around rays that have a heading in common.
    #[inline(always)]
    pub(crate) fn new(rays: &Rays, heading: Heading) -> Self {
        let [a, b] = heading.aside();
        let sense = if heading.backward { -1.0 } else { 1.0 };
        let one = L::splat(sense);
        let most = L::splat(f32::INFINITY);
        // The least and the largest, with its sign changed, of the slopes along both axes.
        let (mut low_a, mut high_a, mut low_b, mut high_b) = (most, most, most, most);
        let mut front = most;
        for k in 0..rays.vectors {
            let inverse = one.div(L::load(&rays.direction[heading.axis][k]));
            let slope_a = L::load(&rays.direction[a][k]).mul(inverse);
            let slope_b = L::load(&rays.direction[b][k]).mul(inverse);
            (low_a, high_a) = (low_a.min(slope_a), high_a.min(L::splat(0.0).sub(slope_a)));
            (low_b, high_b) = (low_b.min(slope_b), high_b.min(L::splat(0.0).sub(slope_b)));
            front = front.min(L::load(&rays.origin[heading.axis][k]).mul(one));
        }
        let slopes = [[low_a.least(), -high_a.least()], [low_b.least(), -high_b.least()]];
        let sides = [
            Side::new(rays, heading, a, -sense * slopes[0][0], 1.0),
            Side::new(rays, heading, a, sense * slopes[0][1], -1.0),
            Side::new(rays, heading, b, -sense * slopes[1][0], 1.0),
            Side::new(rays, heading, b, sense * slopes[1][1], -1.0),
        ];
        Self { heading, sense: one, front: front.least() - SLACK, slopes, sides }
    }

    /// How deep the longest of the rays reaches from the front.
    #[inline(always)]
    pub(crate) fn depth(&self, rays: &Rays) -> f32 {
        // The largest, with its sign changed.
        let mut depth = L::splat(f32::INFINITY);
        let back = L::splat(0.0).sub(self.sense);
        for k in 0..rays.vectors {
            let start =
                L::load(&rays.origin[self.heading.axis][k]).mul_add(back, L::splat(self.front));
            let retreat = L::load(&rays.direction[self.heading.axis][k]).mul(back);
            depth = depth.min(L::load(&rays.end[k]).mul_add(retreat, start));
        }
        SLACK - depth.least()
    }

    /// How deep in the shaft the children's boxes begin, and up to where they do so to be met.
    #[inline(always)]
    pub(crate) fn cross(&self, node: &Node, depth: f32) -> Crossing<L> {
        let [a, b] = self.heading.aside();
        let backward = usize::from(self.heading.backward);
        let front = L::splat(self.front);
        let first = plane::<L>(node, 2 * self.heading.axis + backward).mul_sub(self.sense, front);
        let last =
            plane::<L>(node, 2 * self.heading.axis + 1 - backward).mul_sub(self.sense, front);
        let [one, two, three, four] = &self.sides;
        let in_a = one
            .below(plane(node, one.along), plane(node, 2 * a + 1))
            .min(two.above(plane(node, two.along), plane(node, 2 * a)));
        let in_b = three
            .below(plane(node, three.along), plane(node, 2 * b + 1))
            .min(four.above(plane(node, four.along), plane(node, 2 * b)));
        Crossing { near: first.max(L::splat(0.0)), far: limit(in_a.min(in_b).min(last), depth) }
    }

    /// A bit for each triangle of a block that the shaft may meet.
    #[inline(always)]
    pub(crate) fn meets(&self, block: &Block, depth: f32) -> u32 {
        let [a, b] = self.heading.aside();
        let z = corners::<L>(block, self.heading.axis);
        let [one, two, three, four] = &self.sides;
        let aside = corners::<L>(block, a);
        let in_a = one.most_below(z, aside).min(two.most_above(z, aside));
        let aside = corners::<L>(block, b);
        let in_b = three.most_below(z, aside).min(four.most_above(z, aside));
        let front = L::splat(self.front);
        let z = [
            z[0].mul_sub(self.sense, front),
            z[1].mul_sub(self.sense, front),
            z[2].mul_sub(self.sense, front),
        ];
        let (first, last) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
        first.at_most(limit(in_a.min(in_b).min(last), depth))
    }
}

impl<L: Lanes> Side<L> {
    #[inline(always)]
    fn new(rays: &Rays, heading: Heading, aside: usize, tilt: f32, sign: f32) -> Self {
        let mut bound = L::splat(f32::INFINITY);
        for k in 0..rays.vectors {
            let along = L::load(&rays.origin[heading.axis][k]);
            let aside = L::load(&rays.origin[aside][k]).mul(L::splat(sign));
            bound = bound.min(along.mul_add(L::splat(tilt), aside));
        }
        Self {
            tilt: L::splat(tilt),
            bound: L::splat(bound.least() - SLACK),
            along: 2 * heading.axis + usize::from(tilt > 0.0),
        }
    }

    /// How far a point is within this plane, where the plane lies below the rays.
    #[inline(always)]
    fn below(&self, along: L, aside: L) -> L {
        along.mul_add(self.tilt, aside).sub(self.bound)
    }

    /// How far a point is within this plane, where the plane lies above the rays.
    #[inline(always)]
    fn above(&self, along: L, aside: L) -> L {
        along.mul_sub(self.tilt, aside).sub(self.bound)
    }

    /// Of three points the one most within.
    #[inline(always)]
    fn most_below(&self, along: [L; 3], aside: [L; 3]) -> L {
        let two = self.below(along[0], aside[0]).max(self.below(along[1], aside[1]));
        two.max(self.below(along[2], aside[2]))
    }

    #[inline(always)]
    fn most_above(&self, along: [L; 3], aside: [L; 3]) -> L {
        let two = self.above(along[0], aside[0]).max(self.above(along[1], aside[1]));
        two.max(self.above(along[2], aside[2]))
    }
}

#[inline(always)]
fn plane<L: Lanes>(node: &Node, at: usize) -> L {
    debug_assert!(at < 6);
    // SAFETY: shafts have only numbers of planes.
    L::load(unsafe { node.planes.get_unchecked(at) })
}

/// A coordinate of the three corners.
#[inline(always)]
fn corners<L: Lanes>(block: &Block, axis: usize) -> [L; 3] {
    let corner = L::load(&block.corner[axis]);
    let second = corner.sub(L::load(&block.edge_1[axis]));
    [corner, second, corner.add(L::load(&block.edge_2[axis]))]
}

/// The depth where there is room, and less than nothing where that is negative.
#[inline(always)]
fn limit<L: Lanes>(room: L, depth: f32) -> L {
    const STEEP: f32 = 1e30;
    room.min(L::splat(0.0)).mul_add(L::splat(STEEP), L::splat(depth))
}
