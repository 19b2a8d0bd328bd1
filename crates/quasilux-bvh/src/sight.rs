//! What a ray sees of boxes and triangles, eight at a time, with room for every rounding.

use crate::frame::{FrameRay, H};
use crate::lanes::Lanes;
use crate::node::{Block, Node, Slack, WIDTH};

/// A ray as boxes see it.
pub(crate) struct Slabs<L> {
    inverse: [L; 3],
    /// Origin times inverse direction.
    offset: [L; 3],
    /// Which of a node's planes come first along each axis, and which last.
    first: [usize; 3],
    last: [usize; 3],
}

impl<L: Lanes> Slabs<L> {
    #[inline(always)]
    pub(crate) fn new(ray: &FrameRay) -> Self {
        let (o, r) = (ray.origin.to_array(), ray.inverse.to_array());
        let below = [r[0] < 0.0, r[1] < 0.0, r[2] < 0.0].map(usize::from);
        Self {
            inverse: r.map(L::splat),
            offset: [L::splat(o[0] * r[0]), L::splat(o[1] * r[1]), L::splat(o[2] * r[2])],
            first: [below[0], 2 + below[1], 4 + below[2]],
            last: [1 - below[0], 3 - below[1], 5 - below[2]],
        }
    }

    /// Where the ray enters and leaves the children's boxes; those are met where it enters no
    /// later than it leaves.
    #[inline(always)]
    pub(crate) fn cross(&self, node: &Node, end: f32) -> (L, L) {
        let plane = |at: usize, axis: usize| {
            // SAFETY: `first` and `last` are numbers of planes.
            let planes = unsafe { node.planes.get_unchecked(at) };
            L::load(planes).mul_sub(self.inverse[axis], self.offset[axis])
        };
        let [x, y, z] = self.first;
        let near = plane(x, 0).max(plane(y, 1)).max(plane(z, 2).max(L::splat(0.0)));
        let [x, y, z] = self.last;
        let far = plane(x, 0).min(plane(y, 1)).min(plane(z, 2).min(L::splat(end)));
        (near, far)
    }
}

/// A ray as triangles see it.
pub(crate) struct Sight<L> {
    origin: [L; 3],
    direction: [L; 3],
}

impl<L: Lanes> Sight<L> {
    #[inline(always)]
    pub(crate) fn new(ray: &FrameRay) -> Self {
        Self {
            origin: ray.origin.to_array().map(L::splat),
            direction: ray.direction.to_array().map(L::splat),
        }
    }

    /// [`Self::new`] of a ray in memory.
    #[inline(always)]
    pub(crate) fn of(ray: &FrameRay) -> Self {
        let (origin, direction): (&[f32; 3], &[f32; 3]) =
            (ray.origin.as_ref(), ray.direction.as_ref());
        Self {
            origin: [0, 1, 2].map(|axis| L::splat_from(&origin[axis])),
            direction: [0, 1, 2].map(|axis| L::splat_from(&direction[axis])),
        }
    }

    /// What the ray sees of a block, up to `end`.
    #[inline(always)]
    pub(crate) fn view<'a>(&self, block: &'a Block, end: f32) -> View<'a, L> {
        let edge_1 = block.edge_1.each_ref().map(L::load);
        let edge_2 = block.edge_2.each_ref().map(L::load);
        let corner = block.corner.each_ref().map(L::load);
        let c = [0, 1, 2].map(|axis| corner[axis].sub(self.origin[axis]));
        let r = cross(c, self.direction);
        let n = cross(edge_2, edge_1);
        let determinant = dot(n, self.direction);
        let size = determinant.flip_by(determinant);
        let second = dot(edge_2, r).flip_by(determinant);
        let third = dot(edge_1, r).flip_by(determinant);
        let reach = dot(n, c).flip_by(determinant);
        View {
            block,
            weights: second.min(third),
            rest: size.sub(second).sub(third),
            reach,
            size,
            left: size.mul_sub(L::splat(end), reach),
        }
    }
}

/// What a ray sees of the triangles of a block, all times the size of the determinant.
pub(crate) struct View<'a, L> {
    block: &'a Block,
    /// The smaller of the weights of second and third corner.
    weights: L,
    /// The weight of the first corner.
    rest: L,
    /// The distance.
    reach: L,
    /// One.
    size: L,
    /// What is left of the ray behind the hit.
    left: L,
}

/// Bounds of distances.
pub(crate) struct Distances {
    reach: [f32; WIDTH],
    size: [f32; WIDTH],
    slack: Slack,
}

impl<L: Lanes> View<'_, L> {
    /// A bit for each triangle that the ray may hit.
    #[inline(always)]
    pub(crate) fn possible(&self) -> u32 {
        let slack = &self.block.slack;
        let distance = L::splat(slack.distance);
        let any = [
            self.weights.add(L::splat(slack.weight)),
            self.rest.add(L::splat(slack.rest)),
            self.reach.add(distance),
            self.left.add(distance),
        ];
        !L::any_negative(any)
    }

    /// A bit for each triangle that the ray hits for sure, if it is there.
    #[inline(always)]
    pub(crate) fn sure(&self) -> u32 {
        let slack = &self.block.slack;
        let distance = L::splat(slack.distance);
        let one = L::any_negative([
            self.weights.sub(L::splat(slack.weight)),
            self.rest.sub(L::splat(slack.rest)),
            self.reach.sub(distance),
            self.left.sub(distance),
        ]);
        !one & L::splat(slack.determinant()).at_most(self.size)
    }

    #[inline(always)]
    pub(crate) fn bounds(&self) -> Distances {
        Distances { reach: self.reach.store(), size: self.size.store(), slack: self.block.slack }
    }
}

impl Distances {
    /// The triangle cannot be hit before.
    #[inline(always)]
    pub(crate) fn earliest(&self, lane: usize) -> f32 {
        const DOWN: f32 = 1.0 - 8.0 * H;
        let slack = &self.slack;
        (self.reach[lane] - slack.distance) / (self.size[lane] + slack.determinant()) * DOWN
    }

    /// A triangle that is hit for sure cannot be hit behind.
    #[inline(always)]
    pub(crate) fn latest(&self, lane: usize) -> f32 {
        const UP: f32 = 1.0 + 8.0 * H;
        let slack = &self.slack;
        (self.reach[lane] + slack.distance) / (self.size[lane] - 0.5 * slack.determinant()) * UP
    }
}

#[inline(always)]
fn cross<L: Lanes>(a: [L; 3], b: [L; 3]) -> [L; 3] {
    let minor = |i: usize, j: usize| a[i].mul_sub(b[j], a[j].mul(b[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

#[inline(always)]
fn dot<L: Lanes>(a: [L; 3], b: [L; 3]) -> L {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2].mul(b[2])))
}
